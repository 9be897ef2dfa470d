/* Shows how far a job is, in the styles of --progress. */
#include "convert/program/progress.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* Frames, with the part of the one that is being made. */
static double done_of(const weft_progress *p) {
    return (double)p->frames_done + p->frame_part;
}

static int percent_of(const weft_progress *p) {
    return p->frames_total > 0 ? (int)(100 * done_of(p) / (double)p->frames_total) : 100;
}

static double rate_of(const weft_progress *p) {
    return p->seconds > 0 ? done_of(p) / p->seconds : 0;
}

/* Seconds that are left at the pace so far; below 0 as long as there is no pace. */
static double remaining_s(const weft_progress *p) {
    double rate = rate_of(p);
    return rate > 0 ? ((double)p->frames_total - done_of(p)) / rate : -1;
}

static bool finished(const weft_progress *p) {
    return p->frames_done >= p->frames_total;
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

/* Shows a line on a terminal that is rewritten at most ten times a second. */
static void show_tty(wf_meter *meter, const weft_progress *p) {
    if (meter->shown_s >= 0 && p->seconds - meter->shown_s < 0.1 && !finished(p)) return;
    char text[160], eta[16];
    clock_text(remaining_s(p), eta, sizeof eta);
    int length =
        snprintf(text, sizeof text, " %3d%%  %" PRId64 "/%" PRId64 " frames  %.1f/s  %s left",
                 percent_of(p), p->frames_done, p->frames_total, rate_of(p), eta);
    int bar = terminal_columns() - length - 1;
    bar = bar < 8 ? 0 : bar > 40 ? 40 : bar;
    int full = bar * percent_of(p) / 100;
    fputs(meter->color ? "\r\033[K\033[36m" : "\r", stderr);
    for (int i = 0; i < bar; i++) fputc(i < full ? '#' : '.', stderr);
    fprintf(stderr, "%s%.*s", meter->color ? "\033[0m" : "", terminal_columns() - 1 - bar,
            text);
    meter->drawn = true;
    meter->shown_s = p->seconds;
}

/* Writes a line every ten percent, for logs. */
static void show_plain(wf_meter *meter, const weft_progress *p) {
    int percent = percent_of(p);
    if (meter->percent >= 0 && percent / 10 == meter->percent / 10) return;
    fprintf(stderr, "%s: %" PRId64 " of %" PRId64 " frames (%d%%), %.1f a second\n", p->stage,
            p->frames_done, p->frames_total, percent, rate_of(p));
    meter->percent = percent;
}

/* Writes the lines that render queues of the Alfred and Tractor kind read. */
static void show_alf(wf_meter *meter, const weft_progress *p) {
    int percent = percent_of(p);
    if (percent == meter->percent) return;
    fprintf(stderr, "ALF_PROGRESS %d%%\n", percent);
    meter->percent = percent;
}

static double thousandths(double value) {
    return round(1000 * value) / 1000;
}

/* Writes a JSON object a line, at most ten a second. */
static void show_json(wf_meter *meter, const weft_progress *p) {
    if (meter->shown_s >= 0 && p->seconds - meter->shown_s < 0.1 && !finished(p)) return;
    json_t *line =
        json_pack("{s:s, s:I, s:I, s:f, s:f, s:f}", "stage", p->stage, "frames_done",
                  (json_int_t)p->frames_done, "frames_total", (json_int_t)p->frames_total,
                  "seconds", thousandths(p->seconds), "frames_per_second",
                  thousandths(rate_of(p)), "frame_part", thousandths(p->frame_part));
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
    if (!meter->show) return;
    meter->show(meter, progress);
    fflush(stderr);
}

void wf_meter_clear(wf_meter *meter) {
    if (meter->drawn) fprintf(stderr, "\r%*s\r", terminal_columns() - 1, "");
    meter->drawn = false;
}
