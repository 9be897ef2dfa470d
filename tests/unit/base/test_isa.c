/* Every hot loop at every level that this processor has: the same bits at all of them, and
 * those of a plain reference, or within its bound, where there is one. The first level is
 * compiled from the same C for the baseline of the architecture, without vectors written by
 * hand but for the bytes of ZIP, which have a reference; so is what sums samples. Input is
 * random and extreme, of odd lengths and none, in memory that ends where a page ends that may
 * not be touched. */
#include <ftw.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "filters/base/isa.h"
#include "tests/unit/support/levels.h"

static const level_table *const rooms[] = {level_filters, level_color, level_read,
                                           level_tracer};
#define ROOMS (sizeof rooms / sizeof *rooms)

/* A result to compare with. */
typedef struct kept {
    double *value;
    size_t count;
} kept;

static void keep(const level_run *run, kept *to) {
    to->count = run->results;
    to->value = malloc((run->results + 1) * sizeof *to->value);
    assert_non_null(to->value);
    memcpy(to->value, run->result, run->results * sizeof *to->value);
}

static void run_row(const level_row *row, level_run *run) {
    level_begin(run);
    row->run(run);
    if (!level_end(run)) fail_msg("%s wrote in front of its output", row->name);
}

static const char *by_whom(const level_run *run) {
    return run->plain ? "the plain reference" : wf_isa_name(run->level);
}

/* `allowed`: how far apart two results may be; 0: their bits are compared. */
static void compare(const level_row *row, const level_run *run, const kept *want,
                    double allowed) {
    if (run->results != want->count)
        fail_msg("%s gives %zu numbers, not %zu", row->name, run->results, want->count);
    for (size_t i = 0; i < want->count; i++) {
        double got = run->result[i], wanted = want->value[i];
        bool same = !memcmp(&got, &wanted, sizeof got);
        if (!same && !(allowed > 0 && fabs(got - wanted) <= allowed))
            fail_msg("%s: %s gives %.17g (%a) and not %.17g (%a), result %zu of %zu, count %zu",
                     row->name, by_whom(run), got, got, wanted, wanted, i, want->count,
                     run->count);
    }
}

static double largest(const kept *k) {
    double most = 0;
    for (size_t i = 0; i < k->count; i++) most = fmax(most, fabs(k->value[i]));
    return most;
}

/* One input: level by level, and against the plain reference where there is one. A reference
 * that is only near is not asked about wild input. */
static void check_input(const level_row *row, size_t count, uint32_t seed, bool wild) {
    level_run run = {.count = count, .wild = wild, .draws = seed};
    kept first;
    run_row(row, &run);
    keep(&run, &first);
    for (size_t level = 1; level < wf_isa_levels(); level++) {
        run = (level_run){.level = level, .count = count, .wild = wild, .draws = seed};
        run_row(row, &run);
        compare(row, &run, &first, 0);
    }
    if (row->has_plain && !(wild && row->bound > 0)) {
        run = (level_run){.plain = true, .count = count, .wild = wild, .draws = seed};
        run_row(row, &run);
        compare(row, &run, &first, row->bound * largest(&first));
    }
    free(first.value);
}

/* Every size up to more than a packet and every vector, and some larger. */
static void check_row(const level_row *row) {
    static const size_t larger[] = {255, 256, 257, 1003, 4999};
    for (size_t i = 0; i < 136; i++)
        for (uint32_t seed = 0; seed < 10; seed++) {
            size_t count = i < 131 ? i : larger[i - 131];
            check_input(row, count, seed * 7919 + (uint32_t)count, seed % 2 != 0);
        }
}

static void every_level(void **state) {
    (void)state;
    for (size_t r = 0; r < ROOMS; r++)
        for (const level_table *t = rooms[r]; t->file; t++)
            for (size_t i = 0; i < t->count; i++) check_row(&t->rows[i]);
    print_message("levels:");
    for (size_t level = 0; level < wf_isa_levels(); level++)
        print_message(" %s", wf_isa_name(level));
    print_message("\n");
}

/* ---- Nothing is left out ---- */

static int files;

static bool has_table(const char *path) {
    for (size_t r = 0; r < ROOMS; r++)
        for (const level_table *t = rooms[r]; t->file; t++) {
            size_t whole = strlen(path), length = strlen(t->file);
            if (whole > length && !strcmp(path + whole - length, t->file)) return true;
        }
    return false;
}

static int look_at(const char *path, const struct stat *info, int kind, struct FTW *where) {
    size_t length = strlen(path);
    (void)info, (void)where;
    if (kind != FTW_F || length < 6 || strcmp(path + length - 6, "_isa.c") != 0) return 0;
    files++;
    if (!has_table(path)) fail_msg("%s has no rows here", path);
    return 0;
}

static void every_file_has_a_table(void **state) {
    (void)state;
    static const char *const folders[] = {"convert", "color", "filters", "tracer"};
    const char *source = getenv("WEFT_SOURCE");
    char path[4096];
    if (!source) skip();
    for (int i = 0; i < 4; i++) {
        snprintf(path, sizeof path, "%s/%s", source, folders[i]);
        assert_int_equal(nftw(path, look_at, 16, FTW_PHYS), 0);
    }
    assert_true(files > 0);
}

static void every_function_has_a_row(void **state) {
    (void)state;
    for (size_t r = 0; r < ROOMS; r++)
        for (const level_table *t = rooms[r]; t->file; t++)
            if (t->count < t->functions)
                fail_msg("%s: %zu functions and %zu rows", t->file, t->functions, t->count);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_file_has_a_table),
        cmocka_unit_test(every_function_has_a_row),
        cmocka_unit_test(every_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
