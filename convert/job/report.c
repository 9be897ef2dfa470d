/* The report of a run as JSON; its keys are in convert/README.md. */
#include "convert/job/report.h"

#include <math.h>
#include <inttypes.h>
#include <stdio.h>

#include "convert/weft.h"

static void ratio_text(wf_json *json, const char *key, wf_rational r, char between) {
    char text[48];
    snprintf(text, sizeof text, "%" PRId64 "%c%" PRId64, r.num, between, r.den);
    wf_json_text(json, key, text);
}

void wf_report_raster(wf_json *json, const char *key, const wf_raster *raster) {
    static const char *const scans[] = {"interlaced", "segmented", "progressive"};
    wf_json_open(json, key, '{');
    if (raster) {
        wf_json_text(json, "name", raster->name);
        wf_json_int(json, "width", raster->width_px);
        wf_json_int(json, "height", raster->lines);
        ratio_text(json, "frame_rate", raster->frame_rate, '/');
        wf_json_real(json, "frames_per_second", wf_ratio_value(raster->frame_rate));
        wf_json_text(json, "scan", scans[raster->scan]);
        wf_json_text(json, "order", wf_raster_order(raster));
        ratio_text(json, "pixel_aspect", raster->pixel_aspect, ':');
        wf_json_text(json, "matrix", wf_matrix_name(raster->matrix));
    }
    if (raster && raster->total_lines) {
        wf_json_open(json, "line_map", '{');
        wf_json_int(json, "line1", raster->line1);
        wf_json_int(json, "line2", raster->line2);
        wf_json_int(json, "total", raster->total_lines);
        wf_json_close(json);
    }
    wf_json_close(json);
}

static void add_input(wf_json *json, const wf_report *report) {
    wf_json_open(json, "input", '{');
    wf_json_int(json, "listed", report->listed);
    wf_json_int(json, "opened", report->opened);
    wf_json_open(json, "missing", '[');
    for (size_t i = 0; i < report->missing_count; i++) {
        wf_rational number = report->missing[i];
        if (number.den == 1)
            wf_json_int(json, NULL, number.num);
        else
            wf_json_real(json, NULL, wf_ratio_value(number));
    }
    wf_json_close(json);
    wf_json_int(json, "chunks_decoded", report->chunks_decoded);
    wf_json_int(json, "chunks_reused", report->chunks_reused);
    wf_json_int(json, "nan_fixed", report->nan_fixed);
    wf_json_int(json, "nan_alone", report->nan_alone);
    wf_taken_json(json, &report->taken);
    wf_json_close(json);
}

static void add_tracer(wf_json *json, const wf_report *report) {
    wf_json_open(json, "tracer", '{');
    if (report->traced) {
        wf_json_int(json, "samples", report->samples);
        wf_json_int(json, "rays", report->rays);
        wf_json_int(json, "tiles", report->tiles);
        wf_json_int(json, "tiles_skipped", report->tiles_skipped);
        wf_json_int(json, "tiles_reused", report->tiles_reused);
        wf_json_int(json, "fields_reused", report->fields_reused);
        wf_json_real(json, "error_estimate", report->error_estimate);
    }
    wf_json_close(json);
}

static void add_alpha(wf_json *json, const wf_report *report) {
    wf_json_open(json, "alpha", '{');
    if (report->fill) {
        wf_json_text(json, "fill", report->fill);
        wf_json_text(json, "law", report->key_law);
        wf_json_real(json, "clipped_share", report->fill_clipped_share);
        if (report->key) wf_json_text(json, "key", report->key);
    }
    wf_json_close(json);
}

static void add_flicker(wf_json *json, const wf_report_flicker *flicker) {
    wf_json_open(json, "flicker", '{');
    if (flicker->held) {
        wf_json_real(json, "weight", flicker->weight);
        bool light = flicker->limit > 0 && !flicker->limit_is_seen;
        wf_json_real(json, "limit", light ? flicker->limit : NAN);
        wf_json_real(json, "limit_jnd", flicker->limit_is_seen ? flicker->limit : NAN);
        wf_json_int(json, "clipped", flicker->clipped);
        wf_json_int(json, "columns_solved", flicker->columns_solved);
    }
    wf_json_close(json);
}

static void add_legal(wf_json *json, const wf_report_legal *legal) {
    wf_json_open(json, "legal", '{');
    if (legal->legalize) {
        wf_json_text(json, "legalize", legal->legalize);
        wf_json_text(json, "dither", legal->dither);
        wf_json_text(json, "range", legal->range);
        wf_json_int(json, "bits", legal->bits);
    }
    if (legal->counts.pixels) {
        double pixels = (double)legal->counts.pixels;
        wf_json_real(json, "touched_share", (double)legal->counts.touched / pixels);
        wf_json_real(json, "outside_share", (double)legal->counts.outside / pixels);
        wf_json_real(json, "worst_frame_share", legal->worst_share);
    }
    wf_json_close(json);
}

static void add_seconds(wf_json *json, const wf_report *report) {
    wf_json_open(json, "seconds", '{');
    wf_json_real(json, "wall", report->wall_s);
    wf_json_real(json, "decode", report->decode_s);
    if (report->traced) wf_json_real(json, "trace", report->trace_s);
    wf_json_real(json, "resample", report->resample_s);
    wf_json_real(json, "color", report->color_s);
    wf_json_real(json, "write", report->write_s);
    wf_json_close(json);
}

/* /proc rather than getrusage, whose figure is inherited from the process that started this
 * one. */
int64_t wf_peak_memory_bytes(void) {
    FILE *status = fopen("/proc/self/status", "r");
    if (!status) return 0;
    char line[256];
    int64_t kib = 0;
    while (fgets(line, sizeof line, status))
        if (sscanf(line, "VmHWM: %" SCNd64 " kB", &kib) == 1) break;
    fclose(status);
    return kib * 1024;
}

char *wf_report_json(const wf_report *report) {
    wf_json json = {0};
    int64_t peak = report->peak_memory_bytes;
    wf_json_open(&json, NULL, '{');
    wf_json_text(&json, "version", weft_version());
    wf_json_text(&json, "command", report->command);
    wf_report_raster(&json, "raster", report->raster);
    wf_json_int(&json, "frames", report->frames);
    wf_json_int(&json, "fields", report->fields);
    add_input(&json, report);
    add_tracer(&json, report);
    add_legal(&json, &report->legal);
    add_alpha(&json, report);
    add_flicker(&json, &report->flicker);
    add_seconds(&json, report);
    wf_json_int(&json, "peak_memory_bytes", peak ? peak : wf_peak_memory_bytes());
    wf_json_bool(&json, "degraded", report->degraded);
    if (report->add_plan) report->add_plan(&json, report->plan);
    wf_json_text(&json, "error", report->error);
    return wf_json_finish(&json);
}
