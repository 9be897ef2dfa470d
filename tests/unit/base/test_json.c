/* JSON as reports have it: the order of members, what is not finite, bytes that are no UTF-8.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "convert/base/json.h"

static json_t *finished(wf_json *json) {
    char *text = wf_json_finish(json);
    assert_non_null(text);
    assert_int_equal(text[strlen(text) - 1], '\n');
    json_t *read = json_loads(text, 0, NULL);
    assert_non_null(read);
    free(text);
    return read;
}

static void values(void **state) {
    (void)state;
    wf_json json = {0};
    wf_json_open(&json, NULL, '{');
    wf_json_int(&json, "int", INT64_MIN);
    wf_json_real(&json, "whole", 25);
    wf_json_real(&json, "third", 1.0 / 3);
    wf_json_real(&json, "nan", NAN);
    wf_json_real(&json, "inf", -INFINITY);
    wf_json_bool(&json, "bool", true);
    wf_json_text(&json, "none", NULL);
    json_t *read = finished(&json);
    assert_true(json_integer_value(json_object_get(read, "int")) == INT64_MIN);
    assert_int_equal(json_integer_value(json_object_get(read, "whole")), 25);
    assert_true(json_number_value(json_object_get(read, "third")) == 0.333333333);
    assert_true(json_is_null(json_object_get(read, "nan")));
    assert_true(json_is_null(json_object_get(read, "inf")));
    assert_true(json_is_true(json_object_get(read, "bool")));
    assert_true(json_is_null(json_object_get(read, "none")));
    json_decref(read);
}

static void members_keep_their_order(void **state) {
    (void)state;
    static const char *const keys[] = {"z", "a", "m", "b"};
    wf_json json = {0};
    wf_json_open(&json, NULL, '{');
    for (int i = 0; i < 4; i++) wf_json_int(&json, keys[i], i);
    json_t *read = finished(&json), *value;
    const char *key;
    int i = 0;
    json_object_foreach(read, key, value) assert_string_equal(key, keys[i++]);
    assert_int_equal(i, 4);
    json_decref(read);
}

/* What is open at the end is closed. */
static void containers_in_containers(void **state) {
    (void)state;
    wf_json json = {0};
    wf_json_open(&json, NULL, '[');
    for (int i = 0; i < 3; i++) {
        wf_json_open(&json, NULL, '{');
        wf_json_open(&json, "list", '[');
        for (int k = 0; k < i; k++) wf_json_int(&json, NULL, k);
        wf_json_close(&json);
        wf_json_int(&json, "after", i);
        if (i < 2) wf_json_close(&json);
    }
    json_t *read = finished(&json);
    assert_int_equal(json_array_size(read), 3);
    for (size_t i = 0; i < 3; i++) {
        const json_t *member = json_array_get(read, i);
        assert_int_equal(json_array_size(json_object_get(member, "list")), i);
        assert_int_equal(json_integer_value(json_object_get(member, "after")), i);
    }
    json_decref(read);
}

/* RFC 3629: bytes that are not UTF-8 become U+FFFD one by one, overlong forms and surrogates
 * too. */
static void any_bytes(void **state) {
    (void)state;
#define BAD "\xEF\xBF\xBD"
    static const struct {
        const char *bytes, *text;
    } cases[] = {
        {"", ""},
        {"a\"b\\c\n\x01\x7f", "a\"b\\c\n\x01\x7f"},
        {"\xC3\xA9\xE2\x82\xAC\xF0\x9F\x8E\xA0", "\xC3\xA9\xE2\x82\xAC\xF0\x9F\x8E\xA0"},
        {"a\xFFz", "a" BAD "z"},
        {"\xE2\x82", BAD BAD},
        {"\xC0\x80", BAD BAD},
        {"\xED\xA0\x80", BAD BAD BAD},
        {"\xF4\x90\x80\x80", BAD BAD BAD BAD},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wf_json json = {0};
        wf_json_open(&json, NULL, '[');
        wf_json_text(&json, NULL, cases[i].bytes);
        json_t *read = finished(&json);
        assert_string_equal(json_string_value(json_array_get(read, 0)), cases[i].text);
        json_decref(read);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values),
        cmocka_unit_test(members_keep_their_order),
        cmocka_unit_test(containers_in_containers),
        cmocka_unit_test(any_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
