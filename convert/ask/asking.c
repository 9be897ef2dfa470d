/* What all questions share: reading what is asked, files one after another, the report. */
#include "convert/ask/asking.h"

#include <stdlib.h>
#include <string.h>

weft_status wf_asked(const void *given, const char *name, void *own, size_t own_size,
                     weft_error *err) {
    size_t size = 0;
    memset(own, 0, own_size);
    if (err) err->text[0] = '\0';
    if (!given) return WEFT_OK;
    memcpy(&size, given, sizeof size);
    if (size < sizeof size || size > 4096)
        return wf_fail(err, WEFT_USAGE,
                       "the size of a %s is %zu, and this version's is %zu; set it to "
                       "sizeof(%s)",
                       name, size, own_size, name);
    for (size_t i = own_size; i < size; i++)
        if (((const char *)given)[i])
            return wf_fail(err, WEFT_USAGE,
                           "a member of %s is given that weft " WEFT_VERSION
                           " does not know; it takes a later libweft",
                           name);
    memcpy(own, given, size < own_size ? size : own_size);
    return WEFT_OK;
}

void wf_asked_give(const void *own, size_t own_size, void *to) {
    size_t size = 0;
    memcpy(&size, to, sizeof size);
    memcpy(to, own, size < own_size ? size : own_size);
}

weft_status wf_ask_choose(const char *name, const char *takes, const char *value, int *index,
                          weft_error *err) {
    if (!value) return WEFT_OK;
    const char *word = takes;
    for (int i = 0; word; i++) {
        size_t length = strcspn(word, "|");
        if (strlen(value) == length && !strncmp(word, value, length)) {
            *index = i;
            return WEFT_OK;
        }
        word = word[length] ? word + length + 1 : NULL;
    }
    return wf_fail(err, WEFT_USAGE, "--%s: '%.200s' will not do; it takes one of %s", name,
                   value, takes);
}

weft_status wf_ask_raster(const char *name, wf_raster *raster, weft_error *err) {
    char why[512];
    if (!name || wf_raster_parse(name, raster, why, sizeof why)) return WEFT_OK;
    return wf_fail(err, WEFT_USAGE, "--raster: %s", why);
}

void wf_trouble(wf_troubles *troubles, weft_status status, const char *text) {
    if (troubles->tell) troubles->tell(text, troubles->user);
    if (!troubles->count++) wf_fail(&troubles->first, status, "%s", text);
    if (status > troubles->worst) troubles->worst = status;
}

weft_status wf_troubles_end(const wf_troubles *troubles, weft_error *err) {
    if (troubles->tell || !troubles->count) return troubles->worst;
    if (troubles->count == 1) return wf_fail(err, troubles->worst, "%s", troubles->first.text);
    return wf_fail(err, troubles->worst, "%.900s; and %zu more like it", troubles->first.text,
                   troubles->count - 1);
}

weft_status wf_ask_inputs(const weft_job *job, const char *message, weft_error *err) {
    return job->input_count ? WEFT_OK : wf_fail(err, WEFT_USAGE, "%s", message);
}

weft_status wf_ask_report(weft_job *job, wf_json *json, weft_error *err) {
    free(job->report);
    job->report = wf_json_finish(json);
    return job->report ? WEFT_OK : wf_fail(err, WEFT_NO_MEMORY, "out of memory");
}
