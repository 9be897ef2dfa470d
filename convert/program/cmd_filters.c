/* weft filters: apertures and their responses. */
#include <stdio.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/job/options.h"
#include "convert/program/cmd.h"
#include "convert/program/filters_print.h"
#include "filters/base/spelling.h"

typedef struct filters_state {
    weft_filters asked;
    char joined[320]; /* "design" and what follows, from two arguments */
    bool json;
} filters_state;

/* Refuses several names, which most likely are keys of a design without commas, or a misspelled
 * 'design'. */
static weft_status refuse(int names, char **name, weft_error *err) {
    wf_spelling spelling = {.text = name[0]};
    const wf_aperture_kind *kind;
    char joined[320] = "";
    if (!strcmp(name[0], "design") || strchr(name[0], '=')) {
        for (int i = strchr(name[0], '=') ? 0 : 1, used = 0;
             i < names && used < (int)sizeof joined; i++)
            used += snprintf(joined + used, sizeof joined - (size_t)used, "%s%s",
                             used ? "," : "", name[i]);
        return wf_fail(err, WEFT_USAGE, "put commas between the keys of a design: design %s",
                       joined);
    }
    for (size_t i = 0; strchr(name[1], '=') && (kind = wf_aperture_at(i)); i++)
        wf_spelling_offer(&spelling, kind->name);
    if (spelling.best && strcmp(spelling.best, name[0]) != 0)
        return wf_fail(err, WEFT_USAGE, "no aperture is called '%.100s'; did you mean %s?",
                       name[0], spelling.best);
    return wf_fail(err, WEFT_USAGE, "one aperture at a time, and '%.200s' is a second",
                   name[1]);
}

/* The name of an aperture that the operands are. */
static weft_status take_name(filters_state *state, int names, char **name, weft_error *err) {
    if (names == 2 && !strcmp(name[0], "design")) {
        snprintf(state->joined, sizeof state->joined, "design:%s", name[1]);
        state->asked.name = state->joined;
        return WEFT_OK;
    }
    state->asked.name = names ? name[0] : NULL;
    return names > 1 ? refuse(names, name, err) : WEFT_OK;
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    filters_state state = {.asked = {.size = sizeof state.asked}};
    wf_filters_query query;
    int names = 0;
    weft_job *job = weft_job_new();
    if (!job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = wf_cmd_parse(cmd, argc, argv, &state, job, &names, err);
    if (!status) status = take_name(&state, names, argv, err);
    if (!status) status = wf_ask_filters(job, &state.asked, state.json, &query, err);
    if (!status && !state.json && !state.asked.frontier) wf_filters_print(&query);
    return wf_cmd_answer(job, state.json && !status, status);
}

static const char group[] = "Options";

static const wf_cmd_option options[] = {
    {{"input-lines", "N", NULL,
      "Also what the weights for N input lines leave, stretched over the raster's.", group},
     .offset = offsetof(filters_state, asked.input_lines)},
    {{"plot", "FILE", NULL, "Draw the vertical response into a PNG file.", group},
     .offset = offsetof(filters_state, asked.plot)},
    {{"frontier", "FILE", NULL,
      "Draw the least flicker there is against sharpness, and where the apertures lie, into a "
      "PNG file, without a NAME; with --json print it too.",
      group},
     .offset = offsetof(filters_state, asked.frontier)},
    {{"json", NULL, NULL, "Print JSON.", group}, .offset = offsetof(filters_state, json)},
};

const wf_cmd wf_cmd_filters = {
    .name = "filters",
    .operands = "[NAME | design KEY=VALUE,..]",
    .summary = "apertures and their responses",
    .text = "Lists the apertures a field can look through, or shows the frequency response of\n"
            "one: along the lines, across them and in time, 1 (0 dB) at frequency 0.\n"
            "\n"
            "  weft filters shaped --plot shaped.png\n"
            "  weft filters box --input-lines 1080 --raster 525i\n"
            "  weft filters mitchell:0,0.5 --json\n"
            "  weft filters design sharp=0.7,overshoot=0.08\n",
    .notes =
        "With --input-lines N the response of the weights themselves is added: the largest\n"
        "|sum W exp(2 pi i f y)| / sum W of any line of the raster, y being the centers of\n"
        "the input lines. box, notch and shaped vanish at 0.5 cycles/line, where alternate\n"
        "lines would flicker, when N is a multiple of half the raster's lines; otherwise\n"
        "this tells what is left. Zero is -inf dB, and -400 in JSON, which has no infinity.\n"
        "\n"
        "'design' finds the vertical aperture with the least interline flicker (of a still "
        "zone\n"
        "plate) that is sharp enough, or the sharpest that flickers little enough:\n"
        "\n"
        "  sharp=S,at=F    the response at F cycles/line (0.25) and below is at least S;\n"
        "                  more than once if need be\n"
        "  flicker=R       instead: flicker of R at most, the sharpest at F\n"
        "  support=N       lines to each side, whole or half, 1.5 to 6 (4)\n"
        "  overshoot=P     of a step (0.05); alias=A: response beyond 0.5 (0.05)\n"
        "  width=W         pixels across, 1 to 4 (1)\n"
        "\n"
        "As an aperture it is --aperture design:KEY=VALUE,.. 'crisp' and 'calm' are designs "
        "with\n"
        "names. Responses are never below -0.05 beyond 0.25, and zero at 0.5.\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .taken_by = WF_TAKEN_BY_FILTERS,
    .run = run,
};
