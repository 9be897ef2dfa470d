/* weft render: a scene straight to interlaced video. */
#include "convert/job/options.h"
#include "convert/program/job_command.h"

const wf_cmd wf_cmd_render = {
    .name = "render",
    .operands = "SCENE.lua -o OUTPUT",
    .summary = "a scene straight to interlaced video",
    .text =
        "Traces a scene where the apertures of its fields are, in space and in time, and "
        "writes\n"
        "video; nothing dense is stored. Scenes are Lua: examples/scenes/README.md (of a "
        "package\n"
        "below /usr/share/doc/weft) tells how to write one.\n"
        "\n"
        "  weft render carousel.lua -o carousel.y4m\n"
        "\n"
        "One frame as a picture, quickly:\n"
        "\n"
        "  weft render carousel.lua --frames 0 --samples 16 -o still.#.png\n"
        "\n"
        "Through another aperture, with a shutter of 180 degrees, in 1080i:\n"
        "\n"
        "  weft render carousel.lua --aperture notch --shutter-angle 180 --raster 1080i50 \\\n"
        "      -o carousel.####.dpx\n",
    .notes = wf_job_command_notes,
    .options = wf_job_command_options,
    .option_count = WF_VIDEO_COMMAND_OPTIONS,
    .taken_by = WF_TAKEN_BY_RENDER,
    .run = wf_job_command_run,
};
