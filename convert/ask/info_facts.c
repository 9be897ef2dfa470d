/* Facts of files as lines for people, or as members of a JSON object. */
#include "convert/ask/info_facts.h"

#include <inttypes.h>
#include <stdio.h>

void wf_fact_text(wf_facts *facts, const char *key, const char *value) {
    if (facts->line)
        facts->line(facts->user, key, value);
    else
        wf_json_text(facts->json, key, value);
}

void wf_fact_int(wf_facts *facts, const char *key, int64_t value) {
    char text[24];
    snprintf(text, sizeof text, "%" PRId64, value);
    if (facts->line)
        wf_fact_text(facts, key, text);
    else
        wf_json_int(facts->json, key, value);
}

void wf_fact_ratio(wf_facts *facts, const char *key, wf_rational value, char between) {
    char text[48];
    snprintf(text, sizeof text, "%" PRId64 "%c%" PRId64, value.num, between, value.den);
    wf_fact_text(facts, key, text);
}

void wf_fact_real(wf_facts *facts, const char *key, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.9g", value);
    if (facts->line)
        wf_fact_text(facts, key, text);
    else
        wf_json_real(facts->json, key, value);
}

void wf_facts_taken(wf_facts *facts, const wf_taken_list *taken) {
    if (!facts->line) {
        wf_json_open(facts->json, "input", '{');
        wf_taken_json(facts->json, taken);
        wf_json_close(facts->json);
        return;
    }
    for (int i = 0; i < taken->count; i++) {
        char text[192];
        const char *value = taken->row[i].value;
        snprintf(text, sizeof text, "%s (%s)", *value ? value : "without a name",
                 taken->row[i].reason);
        wf_fact_text(facts, taken->row[i].key, text);
    }
}
