/* weft plot: numbers in a JSON file as a plot. */
#include "convert/base/fail.h"
#include "convert/program/cmd.h"

typedef struct plot_state {
    const char *output;
} plot_state;

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    plot_state state = {0};
    int files = 0;
    weft_status status = wf_cmd_parse(cmd, argc, argv, &state, NULL, &files, err);
    if (status) return status;
    if (files != 1)
        return wf_fail(err, WEFT_USAGE,
                       "plot takes one JSON file, or - for standard input; it was given %d",
                       files);
    return weft_plot(argv[0], state.output, err);
}

static const wf_cmd_option options[] = {
    {{"output", "OUTPUT", NULL,
      "Where to draw: .svg or .png, which replaces what is there; - is SVG on standard output.",
      "Options"},
     .letter = 'o',
     .offset = offsetof(plot_state, output)},
};

const wf_cmd wf_cmd_plot = {
    .name = "plot",
    .operands = "FILE -o OUTPUT",
    .summary = "numbers in a JSON file as a plot",
    .text =
        "Draws lines, points and maps over a pair of axes. FILE is JSON; - is standard input.\n"
        "\n"
        "  weft plot speed.json -o speed.svg\n"
        "\n"
        "speed.json:\n"
        "\n"
        "  {\"title\": \"Run time\",\n"
        "   \"x\": {\"label\": \"lines\", \"log\": true},\n"
        "   \"y\": {\"label\": \"milliseconds\", \"low\": 0, \"high\": 20},\n"
        "   \"items\": [{\"kind\": \"line\", \"name\": \"box\", \"series\": 1,\n"
        "              \"points\": [[480, 2.1], [1080, 6.9], [2160, 17.5]]}]}\n",
    .notes =
        "Keys of the plot: title, subtitle, description (for those who do not see it), width\n"
        "(560), height (320), x, y, items. Of an axis: label, low, high (what is drawn and a\n"
        "little more; low may be the larger one), log, ticks (round numbers), digits.\n"
        "\n"
        "Items are drawn in their order. Each has a kind, and of it\n"
        "\n"
        "  line    points; name, series, dashed\n"
        "  points  points; name, series, radius, hollow, dashed, shades (0 black, 1 white)\n"
        "  label   at, text; series, radius: a dot whose name finds its own place\n"
        "  word    at, text; series, anchor (start, middle, end), shift ([right, down])\n"
        "  rule    x or y; text\n"
        "  band    across ([x0, x1]); text\n"
        "  boxes   boxes ([x0, x1, y0, y1] each); series\n"
        "  map     box, values (rows of numbers, the upper one first); range ([least, most]);\n"
        "          text: what the colors mean, at a bar of them beside the axes\n"
        "  ring    at; text, radius, below, dashed: points out a place of a map\n"
        "\n"
        "Points are [x, y]. What has a name is in the legend; series is 1 to 8, or 0. Lengths\n"
        "(width, radius, shift) are units of the picture: pixels of an SVG, half of a PNG's.\n"
        "An SVG follows the reader's light or dark scheme, in a page of HTML as well.\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .run = run,
};
