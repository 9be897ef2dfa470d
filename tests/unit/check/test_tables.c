/* The tables of figures and profiles: what scripts and people look up in them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "convert/base/fail.h"
#include "convert/check/figures.h"
#include "convert/check/verify/finding.h"
#include "convert/check/verify/profiles.h"
#include "filters/raster/raster.h"

/* Each figure has a place of its own, and those of a group follow each other, which makes them
 * one object in JSON. */
static void figures_have_places(void **state) {
    (void)state;
    const wf_figure_kind *a, *b;
    for (size_t i = 0; (a = wf_figure_at(i)); i++) {
        bool ended = false;
        assert_true(a->offset + sizeof(double) <= sizeof(wf_figures) && *a->help);
        for (size_t j = i + 1; (b = wf_figure_at(j)); j++) {
            bool same = !strcmp(a->group, b->group);
            assert_true(a->offset != b->offset && !(same && ended));
            ended |= !same;
        }
    }
}

/* The rasters of a profile, one after the other. */
static void check_rasters(const char *rasters) {
    for (const char *w = rasters; *w; w += strspn(w, " ")) {
        wf_raster raster;
        char name[64], why[256];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(w, " "), w);
        if (!wf_raster_parse(name, &raster, why, sizeof why)) fail_msg("%s", why);
        assert_true(wf_in_words(rasters, name));
        w += strlen(name);
    }
}

static void profiles_are_whole(void **state) {
    (void)state;
    const wf_delivery_profile *p;
    weft_error err;
    for (size_t i = 0; (p = wf_profile_at(i)); i++) {
        assert_ptr_equal(wf_profile_find(p->name, &err), p); /* no name is there twice */
        assert_true(*p->about && *p->codec && *p->rasters);
        check_rasters(p->rasters);
    }
}

static void misspelled_profiles(void **state) {
    (void)state;
    weft_error err = {""};
    assert_null(wf_profile_find("imx50-652", &err));
    assert_non_null(strstr(err.text, "did you mean imx50-625?"));
    assert_null(wf_profile_find("525i", &err));
    assert_non_null(strstr(err.text, "'525i' is a raster; give --raster 525i"));
    assert_null(wf_profile_find("imx", &err));
    assert_non_null(strstr(err.text, "there are imx50-625, imx50-525"));
    assert_null(wf_profile_find("", &err));
    assert_non_null(strstr(err.text, "--profiles lists them"));
    assert_null(wf_profile_find("betamax", &err));
    assert_non_null(strstr(err.text, "--profiles lists them"));
}

static void words(void **state) {
    (void)state;
    assert_true(wf_in_words("4 16", "16") && wf_in_words("4 16", "4") && wf_in_words("a", "a"));
    assert_false(wf_in_words("4 16", "1") || wf_in_words("4 16", "6") || wf_in_words("", "4"));
}

static void findings(void **state) {
    (void)state;
    wf_finding f;
    assert_int_equal(wf_say(&f, true, "is", "should"), WF_RIGHT);
    assert_string_equal(f.is, "is");
    assert_string_equal(f.should, "");
    assert_int_equal(wf_say(&f, false, "is", "should"), WF_WRONG);
    assert_string_equal(f.should, "should");
    assert_int_equal(wf_open_question(&f, "none"), WF_OPEN);
    assert_string_equal(f.is, "none");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_have_places),
        cmocka_unit_test(profiles_are_whole),
        cmocka_unit_test(misspelled_profiles),
        cmocka_unit_test(words),
        cmocka_unit_test(findings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
