/* weft trace: a scene to subframes or sample buffers. */
#include "convert/program/job_command.h"

static const char *const job_options[] = {
    "raster",    "aperture", "temporal-width", "shutter-angle", "shutter-position",
    "scan-skew", "frames",   WF_JOB_SCENE,     "oversample",    WF_JOB_RUNNING,
    NULL};

const wf_cmd wf_cmd_trace = {
    .name = "trace",
    .operands = "SCENE.lua -o SAMPLES",
    .summary = "a scene to subframes or sample buffers",
    .text = "Traces a scene and stores what it sees, for 'weft convert' to take up.\n"
            "\n"
            "With --oversample, subframes: pictures of so many samples a pixel, a line and a "
            "field.\n"
            "\n"
            "  weft trace carousel.lua --oversample 2x2x8 -o shot.####.exr\n"
            "  weft convert shot.####.exr -o carousel.y4m\n"
            "\n"
            "Without, sample buffers: deep EXR files, one a frame, of samples drawn where the\n"
            "aperture that is given will look for them.\n"
            "\n"
            "  weft trace carousel.lua --samples 16 --aperture box -o samples.####.exr\n"
            "  weft convert samples.####.exr --aperture box -o carousel.y4m\n",
    .notes = wf_job_command_notes,
    .options = wf_job_command_options,
    .option_count = WF_JOB_COMMAND_OPTIONS,
    .job_options = job_options,
    .run = wf_job_command_run,
};
