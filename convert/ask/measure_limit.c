/* Limits on figures, by which a pipeline stops at what is too bad. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/ask/measure_limit.h"
#include "filters/base/spelling.h"

#define VERDICT "order.verdict"

static const char *const verdicts[] = {"tff",       "bff",   "progressive", "psf",
                                       "telecined", "still", "open"};
#define VERDICTS (sizeof verdicts / sizeof *verdicts)

static void name_of(const wf_figure_kind *kind, char name[64]) {
    snprintf(name, 64, "%s%s%s", kind->group, kind->key ? "." : "", kind->key ? kind->key : "");
}

static weft_status unknown_key(const char *key, weft_error *err) {
    char names[32][64], all[512] = VERDICT;
    wf_spelling spelling = {.text = key};
    const wf_figure_kind *kind;
    size_t used = strlen(all);
    wf_spelling_offer(&spelling, VERDICT);
    for (size_t i = 0; i < 32 && (kind = wf_figure_at(i)); i++) {
        name_of(kind, names[i]);
        wf_spelling_offer(&spelling, names[i]);
        if (used < sizeof all)
            used += (size_t)snprintf(all + used, sizeof all - used, ", %s", names[i]);
    }
    if (spelling.best)
        return wf_fail(err, WEFT_USAGE,
                       "--limit: no figure is called '%.100s'; did you mean %s?", key,
                       spelling.best);
    return wf_fail(err, WEFT_USAGE, "--limit: no figure is called '%.100s'; there are %s", key,
                   all);
}

static weft_status parse_verdict(const char *value, wf_limit *out, weft_error *err) {
    for (size_t i = 0; i < VERDICTS; i++)
        if (!strcmp(value, verdicts[i])) {
            out->verdict = value;
            return WEFT_OK;
        }
    return wf_fail(err, WEFT_USAGE,
                   "--limit " VERDICT "=%.100s: it is one of tff, bff, progressive, psf, "
                   "telecined, still, open",
                   value);
}

static weft_status parse_number(const char *key, const char *value, wf_limit *out,
                                weft_error *err) {
    char *end;
    out->value = strtod(value, &end);
    if (end != value && !*end && isfinite(out->value)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE,
                   "--limit %.100s=%.100s: a number follows the =, such as 0.05", key, value);
}

weft_status wf_limit_parse(const char *text, wf_limit *out, weft_error *err) {
    char key[128], name[64];
    const char *equals = strchr(text, '=');
    if (!equals || equals == text)
        return wf_fail(err, WEFT_USAGE,
                       "--limit: '%.200s' will not do; it takes KEY=VALUE, such as "
                       "flicker.rms=0.05",
                       text);
    snprintf(key, sizeof key, "%.*s", (int)(equals - text), text);
    *out = (wf_limit){.kind = NULL};
    if (!strcmp(key, VERDICT)) return parse_verdict(equals + 1, out, err);
    for (size_t i = 0; (out->kind = wf_figure_at(i)); i++) {
        name_of(out->kind, name);
        if (!strcmp(name, key)) return parse_number(key, equals + 1, out, err);
    }
    return unknown_key(key, err);
}

static weft_status check_verdict(const wf_limit *limit, const char *path,
                                 const wf_figures *figures, weft_error *err) {
    const char *verdict = figures->order_verdict;
    if (verdict && !strcmp(verdict, limit->verdict)) return WEFT_OK;
    if (!verdict)
        return wf_fail(err, WEFT_FAILED,
                       "%s: " VERDICT " cannot be told of a single frame, and --limit wants %s",
                       path, limit->verdict);
    return wf_fail(err, WEFT_FAILED, "%s: " VERDICT " is %s, and --limit wants %s", path,
                   verdict, limit->verdict);
}

weft_status wf_limit_check(const wf_limit *limit, const char *path, const wf_figures *figures,
                           weft_error *err) {
    char name[64];
    if (!limit->kind) return check_verdict(limit, path, figures, err);
    double value = wf_figure_value(figures, limit->kind);
    name_of(limit->kind, name);
    if (isnan(value))
        return wf_fail(
            err, WEFT_FAILED,
            "%s: there is no %s, on which --limit was set: it could not be measured of "
            "this video",
            path, name);
    bool exceeded = limit->kind->more_better ? value < limit->value : value > limit->value;
    if (!exceeded) return WEFT_OK;
    return wf_fail(err, WEFT_FAILED, "%s: %s is %.4g, and --limit allows %s %.4g", path, name,
                   value, limit->kind->more_better ? "no less than" : "no more than",
                   limit->value);
}
