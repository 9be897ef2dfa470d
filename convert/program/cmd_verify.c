/* weft verify: whether a delivered file says and holds what it should. */
#include <stdio.h>

#include "convert/ask/verify.h"
#include "convert/base/json.h"
#include "convert/program/cmd.h"

typedef struct verify_state {
    weft_verify asked;
    const char *progress;
    bool json, list;
    wf_meter meter;
} verify_state;

/* ---- Telling ---- */

static const char *const verdicts[] = {
    [WF_RIGHT] = "right", [WF_WRONG] = "WRONG", [WF_OPEN] = "open"};

static void print_findings(void *user, const char *path, const wf_verification *v) {
    verify_state *s = user;
    wf_meter_clear(&s->meter);
    if (s->json) return;
    printf("%s: held to %s%s%s\n", path, *v->raster.name ? v->raster.name : "no raster",
           v->profile ? ", " : "", v->profile ? v->profile->name : "");
    for (size_t i = 0; i < v->count; i++) {
        const wf_finding *f = &v->finding[i];
        printf("  %-6s %-10s %s", verdicts[f->verdict], f->check, f->is);
        if (f->verdict == WF_WRONG) printf("; it should be: %s (%s)", f->should, f->by);
        putchar('\n');
    }
}

static weft_status list_profiles(bool as_json, weft_error *err) {
    const wf_delivery_profile *p;
    wf_json json = {0};
    if (as_json) wf_json_open(&json, NULL, '[');
    for (size_t i = 0; (p = wf_profile_at(i)); i++) {
        if (!as_json) {
            printf("  %-22s %s\n", p->name, p->about);
            if (p->not_checked) printf("  %-22s not checked: %s\n", "", p->not_checked);
            continue;
        }
        wf_json_open(&json, NULL, '{');
        wf_json_text(&json, "name", p->name);
        wf_json_text(&json, "about", p->about);
        wf_json_text(&json, "rasters", p->rasters);
        wf_json_text(&json, "not_checked", p->not_checked);
        wf_json_close(&json);
    }
    if (as_json) wf_json_close(&json);
    return as_json ? wf_cmd_print_json(wf_json_finish(&json), err) : WEFT_OK;
}

/* Takes the line of progress away first. */
static void say_trouble(const char *text, void *user) {
    verify_state *s = user;
    wf_meter_clear(&s->meter);
    wf_cmd_trouble(text, NULL);
}

/* ---- Verifying ---- */

static weft_status verify(verify_state *s, weft_job *job, weft_error *err) {
    const wf_verify_tell tell = {s, print_findings, say_trouble};
    weft_status status = wf_cmd_meter(&s->meter, s->progress, false, err);
    weft_job_on_progress(job, wf_meter_update, &s->meter);
    return status ? status : wf_ask_verify(job, &s->asked, &tell, err);
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    verify_state state = {.asked = {.size = sizeof state.asked}};
    weft_job *job;
    weft_status status = wf_cmd_question(cmd, argc, argv, &state, &job, err);
    if (!status && state.list)
        status = list_profiles(state.json, err);
    else if (!status)
        status = verify(&state, job, err);
    return wf_cmd_answer(job, state.json && !state.list, status);
}

static const char group[] = "Options";

#define STATE(member) offsetof(verify_state, member)

static const wf_cmd_option options[] = {
    {{"profile", "NAME", NULL, "Hold it to a delivery profile as well; --profiles lists them.",
      group},
     .offset = STATE(asked.profile)},
    {{"profiles", NULL, NULL, "List the profiles.", group}, .offset = STATE(list)},
    {{"raster", "NAME", "as it says", "The raster that it should be of.", group},
     .offset = STATE(asked.raster)},
    {WF_CMD_PROGRESS(group), .offset = STATE(progress)},
    {{"json", NULL, NULL, "Print JSON: an array with an object for each file.", group},
     .offset = STATE(json)},
};

const wf_cmd wf_cmd_verify = {
    .name = "verify",
    .operands = "FILE... [--profile P]",
    .summary = "whether a delivered file says and holds what it should",
    .text =
        "Reads a file back to its end and holds what it says (size, rate, scan, order, "
        "aspect,\n"
        "colors, line map, timecode, duration, sound) and what is in its pixels (order of the\n"
        "fields, levels) to its raster, and to a delivery profile.\n"
        "\n"
        "  weft verify shot.mxf --profile xdcamhd422-1080i50\n"
        "  weft verify shot.mov --raster 525i\n"
        "  weft verify --profiles\n",
    .notes =
        "'open' is a check that the file gives no answer to: the order of a still, say.\n"
        "Exit codes: 0 all is right, or open; 1 something is wrong; 2 the request makes no\n"
        "sense.\n",
    .options = options,
    .option_count = sizeof options / sizeof *options,
    .run = run,
};
