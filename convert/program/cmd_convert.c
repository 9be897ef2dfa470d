/* weft convert: subframes or sample buffers to interlaced video. */
#include "convert/job/options.h"
#include "convert/program/job_command.h"

const wf_cmd wf_cmd_convert = {
    .name = "convert",
    .operands = "INPUT... -o OUTPUT",
    .summary = "subframes or samples to interlaced video",
    .text =
        "Turns pictures rendered many times a field into broadcast video. Every field sees\n"
        "the subframes of its own time through an aperture, in linear light.\n"
        "\n"
        "INPUT is a sequence (shot.####.exr, shot.%04d.exr, subframes as shot.#.#.exr), a\n"
        "directory, or files in order. Eight subframes a field of 525-line video:\n"
        "\n"
        "  weft convert shot.####.exr --subframe-rate 480000/1001 -o shot.y4m\n"
        "\n"
        "The same as 1080i at 25 frames a second, 400 subframes a second, in 10-bit DPX:\n"
        "\n"
        "  weft convert shot.####.exr --subframe-rate 400 --raster 1080i50 -o out.####.dpx\n"
        "\n"
        "To look at it while it is being made:\n"
        "\n"
        "  weft convert shot.####.exr --subframe-rate 480000/1001 -o - | mpv -\n"
        "\n"
        "Deep EXR files with channels sample.x, sample.y and sample.t are sample buffers, one "
        "a\n"
        "frame, as 'weft trace' and other renderers write them.\n",
    .notes = wf_job_command_notes,
    .options = wf_job_command_options,
    .option_count = WF_VIDEO_COMMAND_OPTIONS,
    .taken_by = WF_TAKEN_BY_CONVERT,
    .run = wf_job_command_run,
};
