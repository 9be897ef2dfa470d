/* What checks say. */
#include "convert/check/verify/finding.h"

#include <stdio.h>
#include <string.h>

wf_verdict wf_say(wf_finding *f, bool right, const char *is, const char *should) {
    snprintf(f->is, sizeof f->is, "%s", is);
    snprintf(f->should, sizeof f->should, "%s", right ? "" : should);
    return right ? WF_RIGHT : WF_WRONG;
}

wf_verdict wf_open_question(wf_finding *f, const char *is) {
    wf_say(f, true, is, "");
    return WF_OPEN;
}

bool wf_in_words(const char *words, const char *name) {
    size_t length = strlen(name);
    for (const char *w = words; *w; w += strspn(w, " ")) {
        size_t word = strcspn(w, " ");
        if (word == length && !strncmp(w, name, length)) return true;
        w += word;
    }
    return false;
}
