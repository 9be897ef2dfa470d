/* Displays of configurations, by their names. */
#include "convert/finish/named_display.h"

#include <stdio.h>
#include <strings.h>

/* The first row whose word the name has, in any case. */
static const struct {
    const char *word;
    wf_primaries primaries;
    const wf_curve *curve; /* NULL: gamma counts */
    double gamma;
    const char *hdr;
} rows[] = {
    {"ST2084-P3-D65", WF_PRIMARIES_P3, &wf_curve_pq, 0, "rec2100-pq"},
    {"ST2084", WF_PRIMARIES_2020, &wf_curve_pq, 0, "rec2100-pq"},
    {"PQ", WF_PRIMARIES_2020, &wf_curve_pq, 0, "rec2100-pq"},
    {"HLG", WF_PRIMARIES_2020, &wf_curve_hlg, 0, "rec2100-hlg"},
    {"2020", WF_PRIMARIES_2020, &wf_curve_bt1886, 0, NULL},
    {"Display P3", WF_PRIMARIES_P3, &wf_curve_srgb, 0, NULL},
    {"P3-D65", WF_PRIMARIES_P3, NULL, 2.6, NULL},
    {"Gamma 2.2", WF_PRIMARIES_709, NULL, 2.2, NULL},
    {"sRGB", WF_PRIMARIES_709, &wf_curve_srgb, 0, NULL},
    {"601-525", WF_PRIMARIES_SMPTE_C, &wf_curve_bt1886, 0, NULL},
    {"601-625", WF_PRIMARIES_EBU, &wf_curve_bt1886, 0, NULL},
    {"1886", WF_PRIMARIES_709, &wf_curve_bt1886, 0, NULL},
    {"709", WF_PRIMARIES_709, &wf_curve_bt1886, 0, NULL},
};

static bool has_word(const char *name, const char *word) {
    size_t length = 0;
    while (word[length]) length++;
    for (; *name; name++)
        if (!strncasecmp(name, word, length)) return true;
    return false;
}

bool wf_named_display_of(const char *display, wf_named_display *out) {
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!has_word(display, rows[i].word)) continue;
        const wf_curve gamma = wf_curve_gamma(rows[i].gamma > 0 ? rows[i].gamma : 1, 1);
        *out = (wf_named_display){&wf_chromaticities_of[rows[i].primaries],
                                  wf_decoding_of(rows[i].curve ? rows[i].curve : &gamma),
                                  rows[i].hdr};
        return true;
    }
    return false;
}
