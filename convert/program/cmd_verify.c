/* weft verify: whether a delivered file says and holds what it should. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/base/json.h"
#include "convert/check/verify/verify.h"
#include "convert/job/report.h"
#include "convert/program/cmd.h"

typedef struct verify_state {
    const char *profile_name, *raster_name, *progress;
    bool json, list;
    wf_meter meter;
    wf_raster raster;
    wf_verify_options options;
} verify_state;

/* ---- Telling ---- */

static const char *const verdicts[] = {
    [WF_RIGHT] = "right", [WF_WRONG] = "WRONG", [WF_OPEN] = "open"};

static void print_findings(const char *path, const wf_verification *v) {
    printf("%s: held to %s%s%s\n", path, *v->raster.name ? v->raster.name : "no raster",
           v->profile ? ", " : "", v->profile ? v->profile->name : "");
    for (size_t i = 0; i < v->count; i++) {
        const wf_finding *f = &v->finding[i];
        printf("  %-6s %-10s %s", verdicts[f->verdict], f->check, f->is);
        if (f->verdict == WF_WRONG) printf("; it should be: %s (%s)", f->should, f->by);
        putchar('\n');
    }
}

static void add_findings(wf_json *json, const char *path, const wf_verification *v) {
    static const char *const words[] = {
        [WF_RIGHT] = "right", [WF_WRONG] = "wrong", [WF_OPEN] = "open"};
    wf_json_open(json, NULL, '{');
    wf_json_text(json, "file", path);
    wf_json_text(json, "profile", v->profile ? v->profile->name : NULL);
    wf_report_raster(json, "raster", *v->raster.name ? &v->raster : NULL);
    wf_json_bool(json, "right", !v->wrong);
    wf_json_open(json, "checks", '[');
    for (size_t i = 0; i < v->count; i++) {
        const wf_finding *f = &v->finding[i];
        wf_json_open(json, NULL, '{');
        wf_json_text(json, "check", f->check);
        wf_json_text(json, "verdict", words[f->verdict]);
        wf_json_text(json, "is", f->is);
        wf_json_text(json, "should", *f->should ? f->should : NULL);
        wf_json_text(json, "by", f->by);
        wf_json_close(json);
    }
    wf_json_close(json);
    wf_json_close(json);
}

static weft_status list_profiles(bool as_json, weft_error *err) {
    const wf_profile *p;
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

/* ---- Verifying ---- */

static weft_status read_state(verify_state *s, int files, weft_error *err) {
    char why[512];
    s->options = (wf_verify_options){.max_memory_bytes = (size_t)2 << 30,
                                     .progress = wf_meter_update,
                                     .progress_user = &s->meter};
    if (!files)
        return wf_fail(err, WEFT_USAGE,
                       "nothing to verify; give a delivered file, such as shot.mxf");
    weft_status status = wf_cmd_meter(&s->meter, s->progress, false, err);
    if (!status && s->profile_name) {
        s->options.profile = wf_profile_find(s->profile_name, err);
        if (!s->options.profile) return WEFT_USAGE;
    }
    if (status || !s->raster_name) return status;
    s->options.raster = &s->raster;
    if (wf_raster_parse(s->raster_name, &s->raster, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--raster: %s", why);
}

static weft_status verify_one(verify_state *s, const char *path, wf_json *json,
                              weft_error *err) {
    wf_verification v;
    weft_status status = wf_verify(path, &s->options, &v, err);
    wf_meter_clear(&s->meter);
    if (status) return status;
    if (json)
        add_findings(json, path, &v);
    else
        print_findings(path, &v);
    if (!v.wrong) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED, "%.700s: %zu of %zu checks found it wrong", path, v.wrong,
                   v.count);
}

static weft_status verify_all(verify_state *s, int count, char **paths, weft_error *err) {
    wf_json json = {0};
    weft_status worst = WEFT_OK;
    wf_identities *all = wf_identities_read((const char *const *)paths, (size_t)count);
    if (!all) return wf_fail(err, WEFT_NO_MEMORY, "out of memory");
    s->options.others = all;
    if (s->json) wf_json_open(&json, NULL, '[');
    for (int i = 0; i < count; i++) {
        weft_error trouble = {""};
        weft_status status = verify_one(s, paths[i], s->json ? &json : NULL, &trouble);
        fflush(stdout);
        if (status) wf_cmd_say("", trouble.text);
        if (status > worst) worst = status;
    }
    wf_identities_free(all);
    if (s->json) wf_json_close(&json);
    weft_status printed = s->json ? wf_cmd_print_json(wf_json_finish(&json), err) : WEFT_OK;
    return worst ? worst : printed;
}

static weft_status run(const wf_cmd *cmd, int argc, char **argv, weft_error *err) {
    verify_state state = {0};
    int count = 0;
    weft_status status = wf_cmd_parse(cmd, argc, argv, &state, NULL, &count, err);
    if (!status && state.list) return list_profiles(state.json, err);
    if (!status) status = read_state(&state, count, err);
    return status ? status : verify_all(&state, count, argv, err);
}

static const char group[] = "Options";

#define STATE(member) offsetof(verify_state, member)

static const wf_cmd_option options[] = {
    {{"profile", "NAME", NULL, "Hold it to a delivery profile as well; --profiles lists them.",
      group},
     .offset = STATE(profile_name)},
    {{"profiles", NULL, NULL, "List the profiles.", group}, .offset = STATE(list)},
    {{"raster", "NAME", "as it says", "The raster that it should be of.", group},
     .offset = STATE(raster_name)},
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
