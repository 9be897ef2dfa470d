/* The numbers of the two composite systems. */
#include "color/composite/standard.h"

/* SMPTE 170M and Rec. ITU-R BT.1700; line lengths and picture starts from Rec. ITU-R BT.601-7.
 * 709379/2160000 is 4433618.75 Hz / 13.5 MHz. */
static const wf_tv_standard standards[] = {
    [WF_NTSC] = {.name = "ntsc",
                 .total_lines = 525,
                 .line_samples = 858,
                 .first_sample = 122,
                 .cycles = {35, 132},
                 .sequence_frames = 2,
                 .burst_degrees = {180, 180},
                 .comb_lines = 1},
    [WF_PAL] = {.name = "pal",
                .total_lines = 625,
                .line_samples = 864,
                .first_sample = 132,
                .cycles = {709379, 2160000},
                .sequence_frames = 4,
                .v_switch = true,
                .burst_degrees = {135, 225},
                .comb_lines = 2},
};

const wf_tv_standard *wf_tv_standard_of(wf_tv_system system) {
    return &standards[system];
}
