/* weft trace: a scene to subframes or sample buffers. */
#include "convert/job/options.h"
#include "convert/program/job_command.h"

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
    .taken_by = WF_TAKEN_BY_TRACE,
    .run = wf_job_command_run,
};
