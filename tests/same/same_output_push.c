/* Uses the library, for same_output.sh, and prints what it says:
 *
 *   same_output_push push FIELDS OUTPUT [OPTION VALUE]..   samples and tiles; what fields come
 * back is written to FIELDS as floats same_output_push job|cancel FILE                       a
 * job of a job file, to its end or its first frame same_output_push tables what the header
 * lists, and what it refuses */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <weft.h>

enum { WIDTH = 48, LINES = 32, EACH = 6, FRAMES = 2, COUNT = WIDTH * EACH };

static uint32_t seed = 1;

static float drawn(void) {
    seed = seed * 1664525u + 1013904223u;
    return (float)(seed >> 8) / 16777216.0f;
}

static void on_field(const weft_field *f, void *user) {
    size_t count = (size_t)f->lines * (size_t)f->width_px * 3;
    printf("field %d: line %d step %d, %dx%d\n", (int)f->index, f->first_line, f->line_step,
           f->width_px, f->lines);
    if (fwrite(f->rgb, sizeof *f->rgb, count, user) != count) exit(9);
}

static void on_warning(const char *text, void *user) {
    (void)user;
    printf("warning: %s\n", text);
}

static void on_progress(const weft_progress *p, void *user) {
    printf("%s: %d of %d\n", p->stage, (int)p->frames_done, (int)p->frames_total);
    if (user) weft_job_cancel(user);
}

/* One line of samples of a field, every other one with a weight of its own. */
static weft_status push_line(weft_fields *fields, int64_t field, int j, weft_error *err) {
    static float v[7][COUNT];
    for (int k = 0; k < COUNT; k++) {
        v[0][k] = (float)(k / EACH) + drawn();
        v[1][k] = (float)j + drawn();
        v[2][k] = 2 * drawn();
        float dx = v[0][k] - 16 - (float)field, dy = v[1][k] - 16;
        v[3][k] = dx * dx + dy * dy < 90 ? 0.9f : 0.05f;
        v[4][k] = 0.5f * v[3][k];
        v[5][k] = v[1][k] / LINES;
        v[6][k] = k % 2 ? 1 : 0.25f + drawn();
    }
    const weft_samples samples = {
        COUNT, v[0], v[1], v[2], field, v[3], v[4], v[5], j % 2 ? v[6] : NULL, NULL};
    return weft_fields_push(fields, &samples, err);
}

/* A tile over the upper left of the frame. */
static weft_status push_tile(weft_fields *fields, int64_t field, weft_error *err) {
    static float rgb[40][60][3];
    for (int y = 0; y < 40; y++)
        for (int x = 0; x < 60; x++)
            for (int c = 0; c < 3; c++) rgb[y][x][c] = 0.01f * (float)((x * (c + 1) + y) % 50);
    const weft_tile tile = {2.5, 1.25, 30, 20.75, 0.25, field, 60, 40, &rgb[0][0][0], NULL};
    return weft_fields_push_tile(fields, &tile, err);
}

static weft_status push_all(weft_fields *fields, weft_error *err) {
    weft_status status = WEFT_OK;
    for (int64_t n = 0; n < 2 * FRAMES && !status; n++) {
        for (int j = 0; j < LINES && !status; j++) status = push_line(fields, n, j, err);
        if (!status) status = push_tile(fields, n, err);
        if (!status) status = weft_fields_until(fields, n - 1, err);
    }
    if (!status) status = weft_fields_finish(fields, err);
    return status;
}

static weft_status push_job(weft_job *job, int argc, char **argv, FILE *to, weft_error *err) {
    weft_fields *fields = NULL;
    weft_job_on_warning(job, on_warning, NULL);
    weft_job_on_progress(job, on_progress, NULL);
    weft_status status = weft_job_set(job, "raster", "48x32@30i,tff", err);
    if (!status && *argv[3]) status = weft_job_set_output(job, argv[3], err);
    for (int i = 4; i + 1 < argc && !status; i += 2)
        status = weft_job_set(job, argv[i], argv[i + 1], err);
    if (!status) status = weft_fields_new(job, FRAMES, on_field, to, &fields, err);
    if (!status) status = push_all(fields, err);
    weft_fields_free(fields);
    printf("%s\n", weft_job_report(job));
    return status;
}

/* Everything about pushing; what is left to do is in argv. */
static weft_status push_to_file(weft_job *job, int argc, char **argv, weft_error *err) {
    FILE *to = fopen(argv[2], "wb");
    weft_status status = to ? push_job(job, argc, argv, to, err) : WEFT_FAILED;
    if (to && fclose(to)) status = WEFT_FAILED;
    return status;
}

static weft_status run_job(weft_job *job, const char *file, bool cancel, weft_error *err) {
    weft_job_on_warning(job, on_warning, NULL);
    weft_job_on_progress(job, on_progress, cancel ? job : NULL);
    printf("%s\n", weft_job_report(job));
    weft_status status = weft_job_load(job, file, err);
    if (!status) status = weft_job_run(job, err);
    printf("%s\n", weft_job_report(job));
    return status;
}

/* What is refused, and how. */
static void try_wrong(weft_job *job) {
    weft_error err = {""};
    weft_raster raster;
    double response = 0;
    static const char *const wrong[][2] = {
        {"rastr", "525i"}, {"raster", "524i"}, {"bits", "9"}, {"overwrite", "x"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        printf("%d %s\n", (int)weft_job_set(job, wrong[i][0], wrong[i][1], &err), err.text);
    printf("%d %s\n", (int)weft_job_set_command(job, "rendr", &err), err.text);
    printf("%d %s\n", (int)weft_raster_parse("48x33@30i", &raster, &err), err.text);
    printf("%d %s\n", (int)weft_aperture_response("boxx", -1, 0, 0, 0, &response, &err),
           err.text);
}

static void print_responses(const char *aperture) {
    weft_error err = {""};
    for (int k = 0; k < 8; k++) {
        double response = 0;
        weft_status status = weft_aperture_response(aperture, k - 1, 0.1 * k, 0.07 * k, 0.2 * k,
                                                    &response, &err);
        printf("%s %d %d %.17g %s\n", aperture, k, (int)status, response, err.text);
    }
}

static void print_tables(void) {
    weft_option o;
    weft_raster r;
    printf("%s\n", weft_version());
    for (size_t i = 0; weft_option_at(i, &o); i++)
        printf("%s|%s|%s|%s|%s\n", o.name, o.takes ? o.takes : "-", o.preset ? o.preset : "-",
               o.help, o.group);
    for (size_t i = 0; weft_raster_at(i, &r); i++)
        printf("%s %dx%d %d/%d %d%d%d %d:%d %s %d,%d of %d\n", r.name, r.width_px, r.lines,
               (int)r.rate_num, (int)r.rate_den, r.interlaced, r.segmented, r.top_first,
               (int)r.pixel_aspect_num, (int)r.pixel_aspect_den, r.matrix, r.line1, r.line2,
               r.total_lines);
    for (size_t i = 0; weft_aperture_name(i); i++) print_responses(weft_aperture_name(i));
    print_responses("mitchell:0,0.5");
}

int main(int argc, char **argv) {
    weft_error err = {""};
    weft_status status = WEFT_OK;
    weft_job *job = weft_job_new();
    const char *what = argc > 1 ? argv[1] : "";
    if (!job) return 9;
    if (!strcmp(what, "push") && argc > 3) status = push_to_file(job, argc, argv, &err);
    if (!strcmp(what, "job") && argc == 3) status = run_job(job, argv[2], false, &err);
    if (!strcmp(what, "cancel") && argc == 3) status = run_job(job, argv[2], true, &err);
    if (!strcmp(what, "tables")) print_tables(), try_wrong(job);
    printf("status %d: %s\n", (int)status, err.text);
    weft_job_free(job);
    return 0;
}
