/* weft filters: apertures and their responses. */
#include "convert/program/filters_parts.h"

#include <stdio.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/job/job.h"
#include "convert/job/options.h"
#include "convert/program/cmd.h"
#include "filters/base/spelling.h"

typedef struct filters_state {
    const char *plot, *frontier, *input_lines;
    char joined[320]; /* "design" and what follows, from two arguments */
    bool json;
} filters_state;

static weft_status ask(const filters_state *state, const weft_job *job, wf_filters_query *query,
                       weft_error *err) {
    char why[512];
    wf_rational lines = {0, 1};
    query->raster = job->raster;
    query->tau = wf_ratio_given(job->temporal_width) ? wf_ratio_value(job->temporal_width) : -1;
    if (query->name && !wf_aperture_parse(query->name, &query->aperture, why, sizeof why))
        return wf_fail(err, WEFT_USAGE, "%s", why);
    if (query->name && !wf_filters_design(query, why, sizeof why))
        return wf_fail(err, query->design.no_memory ? WEFT_NO_MEMORY : WEFT_FAILED, "%s", why);
    if (state->frontier && (query->name || state->plot || state->input_lines))
        return wf_fail(err, WEFT_USAGE,
                       "--frontier shows every aperture there is; leave out %s",
                       query->name   ? query->name
                       : state->plot ? "--plot"
                                     : "--input-lines");
    bool fits = !state->input_lines || (wf_ratio_parse(state->input_lines, &lines) &&
                                        lines.den == 1 && lines.num >= 1 && lines.num <= 16384);
    if (!fits)
        return wf_fail(err, WEFT_USAGE,
                       "--input-lines: '%.200s' will not do; it takes a whole number from 1 to "
                       "16384, such as 1080",
                       state->input_lines);
    query->input_lines = (int)lines.num;
    return WEFT_OK;
}

static weft_status answer(const filters_state *state, const wf_filters_query *query,
                          weft_error *err) {
    if (state->frontier) return wf_filters_frontier(state->frontier, state->json, err);
    weft_status status = state->plot ? wf_filters_plot(query, state->plot, err) : WEFT_OK;
    if (status) return status;
    if (state->json) return wf_filters_print_json(query, err);
    wf_filters_print(query);
    return WEFT_OK;
}

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

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    filters_state state = {0};
    wf_filters_query query = {0};
    int names = 0;
    weft_job *job = weft_job_new();
    if (!job) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    weft_status status = wf_cmd_parse(cmd, argc, argv, &state, job, &names, err);
    query.name = names ? argv[0] : NULL;
    if (names == 2 && !strcmp(argv[0], "design")) {
        snprintf(state.joined, sizeof state.joined, "design:%s", argv[1]);
        query.name = state.joined;
    } else if (!status && names > 1)
        status = refuse(names, argv, err);
    if (!status) status = ask(&state, job, &query, err);
    weft_job_free(job);
    return status ? status : answer(&state, &query, err);
}

static const char group[] = "Options";

static const wf_cmd_option options[] = {
    {{"input-lines", "N", NULL,
      "Also what the weights for N input lines leave, stretched over the raster's.", group},
     .offset = offsetof(filters_state, input_lines)},
    {{"plot", "FILE", NULL, "Draw the vertical response into a PNG file.", group},
     .offset = offsetof(filters_state, plot)},
    {{"frontier", "FILE", NULL,
      "Draw the least flicker there is against sharpness, and where the apertures lie, into a "
      "PNG file, without a NAME; with --json print it too.",
      group},
     .offset = offsetof(filters_state, frontier)},
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
