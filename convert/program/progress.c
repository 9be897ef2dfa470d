/* Shows how far a job is, in the styles of --progress. */
#include "convert/program/progress.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* Frames, with the parts of those that are being made. */
static double done_of(const weft_progress *p) {
    return fmax((double)p->frames_done + p->frame_part, p->frames_made);
}

/* Below 0 where it is not known how many frames there are, as of a pipe. */
static int percent_of(const weft_progress *p) {
    return p->frames_total > 0 ? (int)(100 * done_of(p) / (double)p->frames_total) : -1;
}

static double rate_of(const weft_progress *p) {
    return p->seconds > 0 ? done_of(p) / p->seconds : 0;
}

/* Seconds that are left at the pace so far, which is that since work on frames began; below 0
 * as long as there is no pace, or no end is known. */
static double remaining_s(const wf_meter *meter, const weft_progress *p) {
    double done = done_of(p), took_s = p->seconds - meter->began_s;
    return done > 0 ? ((double)p->frames_total - done) * took_s / done : -1;
}

static bool finished(const weft_progress *p) {
    return p->frames_total > 0 && p->frames_done >= p->frames_total;
}

/* ---- Styles ---- */

static int terminal_columns(void) {
    struct winsize size;
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) || size.ws_col < 20 ? 80 : size.ws_col;
}

static void clock_text(double seconds, char *text, size_t size) {
    int64_t s = seconds < 0 ? -1 : (int64_t)fmin(ceil(seconds), 359999);
    if (s < 0)
        snprintf(text, size, "--:--");
    else if (s < 3600)
        snprintf(text, size, "%02d:%02d", (int)(s / 60), (int)(s % 60));
    else
        snprintf(text, size, "%d:%02d:%02d", (int)(s / 3600), (int)(s / 60 % 60),
                 (int)(s % 60));
}

static int tty_text(const wf_meter *meter, const weft_progress *p, char *text, size_t size) {
    if (p->frames_total <= 0)
        return snprintf(text, size, " %" PRId64 " frames  %.1f/s", p->frames_done, rate_of(p));
    char left[16];
    clock_text(remaining_s(meter, p), left, sizeof left);
    return snprintf(text, size, " %3d%%  %" PRId64 "/%" PRId64 " frames  %.1f/s  %s left",
                    percent_of(p), p->frames_done, p->frames_total, rate_of(p), left);
}

/* Shows a line on a terminal that is rewritten at most ten times a second. */
static void show_tty(wf_meter *meter, const weft_progress *p) {
    if (meter->shown_s >= 0 && p->seconds - meter->shown_s < 0.1 && !finished(p)) return;
    char text[160];
    int length = tty_text(meter, p, text, sizeof text);
    int bar = terminal_columns() - length - 1;
    bar = bar < 8 || p->frames_total <= 0 ? 0 : bar > 40 ? 40 : bar;
    int full = bar * percent_of(p) / 100;
    fputs(meter->color ? "\r\033[K\033[36m" : "\r", stderr);
    for (int i = 0; i < bar; i++) fputc(i < full ? '#' : '.', stderr);
    fprintf(stderr, "%s%.*s", meter->color ? "\033[0m" : "", terminal_columns() - 1 - bar,
            text);
    meter->drawn = true;
    meter->shown_s = p->seconds;
}

/* Writes a line every ten percent, for logs; every ten seconds where there are none. */
static void show_plain(wf_meter *meter, const weft_progress *p) {
    int percent = percent_of(p);
    if (p->frames_total <= 0) {
        if (meter->shown_s >= 0 && p->seconds - meter->shown_s < 10) return;
        fprintf(stderr, "%s: %" PRId64 " frames, %.1f a second\n", p->stage, p->frames_done,
                rate_of(p));
        meter->shown_s = p->seconds;
        return;
    }
    if (meter->percent >= 0 && percent / 10 == meter->percent / 10) return;
    char left[16];
    clock_text(remaining_s(meter, p), left, sizeof left);
    fprintf(stderr, "%s: %" PRId64 " of %" PRId64 " frames (%d%%), %.1f a second, %s left\n",
            p->stage, p->frames_done, p->frames_total, percent, rate_of(p), left);
    meter->percent = percent;
}

/* Writes the lines that render queues of the Alfred and Tractor kind read. */
static void show_alf(wf_meter *meter, const weft_progress *p) {
    int percent = percent_of(p);
    if (percent < 0 || percent == meter->percent) return;
    fprintf(stderr, "ALF_PROGRESS %d%%\n", percent);
    meter->percent = percent;
}

static double thousandths(double value) {
    return round(1000 * value) / 1000;
}

/* Writes a JSON object a line, at most ten a second. */
static void show_json(wf_meter *meter, const weft_progress *p) {
    if (meter->shown_s >= 0 && p->seconds - meter->shown_s < 0.1 && !finished(p)) return;
    double left_s = remaining_s(meter, p);
    json_t *line =
        json_pack("{s:s, s:I, s:I, s:f, s:f, s:f, s:o}", "stage", p->stage, "frames_done",
                  (json_int_t)p->frames_done, "frames_total", (json_int_t)p->frames_total,
                  "seconds", thousandths(p->seconds), "frames_per_second",
                  thousandths(rate_of(p)), "frame_part", thousandths(p->frame_part),
                  "seconds_left", left_s < 0 ? json_null() : json_real(thousandths(left_s)));
    if (line) json_dumpf(line, stderr, JSON_PRESERVE_ORDER | JSON_REAL_PRECISION(12));
    if (line) fputc('\n', stderr);
    json_decref(line);
    meter->shown_s = p->seconds;
}

/* ---- The meter ---- */

bool wf_meter_init(wf_meter *meter, const char *style) {
    static const struct {
        const char *name;
        void (*show)(wf_meter *, const weft_progress *);
    } styles[] = {{"tty", show_tty},
                  {"plain", show_plain},
                  {"alf", show_alf},
                  {"json", show_json},
                  {"none", NULL}};
    const char *no_color = getenv("NO_COLOR");
    bool terminal = isatty(STDERR_FILENO);
    *meter =
        (wf_meter){.shown_s = -1, .percent = -1, .color = terminal && !(no_color && *no_color)};
    if (!style) style = terminal ? "tty" : "none";
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++)
        if (!strcmp(styles[i].name, style)) {
            meter->show = styles[i].show;
            return true;
        }
    return false;
}

void wf_meter_update(const weft_progress *progress, void *user) {
    wf_meter *meter = user;
    meter->last = *progress;
    if (done_of(progress) <= 0) meter->began_s = progress->seconds;
    if (!meter->show) return;
    meter->show(meter, progress);
    fflush(stderr);
}

void wf_meter_clear(wf_meter *meter) {
    if (meter->drawn) fprintf(stderr, "\r%*s\r", terminal_columns() - 1, "");
    meter->drawn = false;
}
