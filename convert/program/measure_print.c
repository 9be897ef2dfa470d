/* Part of weft measure: the figures of a file, as lines for people. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "convert/program/measure_print.h"
#include "convert/read/television.h"

static void print_number(const char *label, double value, const char *unit) {
    if (isnan(value))
        printf("  %s -", label);
    else
        printf("  %s %.4g%s", label, value, unit);
}

static void print_percent(const char *label, double share) {
    print_number(label, 100 * share, " %");
}

static void print_row(const char *name) {
    printf("  %-22s", name);
}

static void print_flicker(const wf_measure_options *options, const wf_figures *f) {
    char name[64] = "interline flicker";
    if (options->display != WF_DISPLAY_BOB)
        snprintf(name, sizeof name, "interline flicker, %s", wf_display_name(options->display));
    print_row(name);
    print_number("rms", f->flicker_rms, "");
    print_number("p999", f->flicker_p999, "");
    print_percent("over 2 %:", f->flicker_share);
    if (isnan(f->flicker_rms)) printf("  (nothing is still in it)");
    putchar('\n');
    print_row("seen of it");
    print_number("p999", f->visible_jnd_p999, " JND");
    print_percent("over 1 JND:", f->visible_share);
    putchar('\n');
    if (isnan(f->crawl_rms)) return;
    print_row("crawl");
    print_number("rms", f->crawl_rms, "");
    print_number("p999", f->crawl_p999, "");
    print_number("seen", f->crawl_jnd_p999, " JND");
    print_percent("over 1 JND:", f->crawl_share);
    putchar('\n');
}

static void print_sharpness(const wf_figures *f) {
    if (isnan(f->sharpness)) return;
    print_row("vertical sharpness");
    print_number("response", f->sharpness, "");
    putchar('\n');
}

static void print_composite(const wf_figures *f) {
    wf_tv tv = {.width_px = 0};
    if (!wf_television_of(&f->info.raster, &tv)) return;
    print_row("cross-color");
    print_number("rms", f->cross_color_rms, "");
    print_number("p999", f->cross_color_p999, "");
    printf("  (%s, cheap encoder, notch decoder)\n", tv.system == WF_NTSC ? "NTSC" : "PAL");
    print_row("cross-luma");
    print_number("rms", f->cross_luma_rms, "");
    print_number("p999", f->cross_luma_p999, "");
    putchar('\n');
}

static void print_order(const wf_figures *f) {
    static const struct {
        const char *verdict, *words;
    } rows[] = {{"tff", "top field first"},
                {"bff", "bottom field first"},
                {"progressive", "progressive"},
                {"psf", "segmented frames: both fields show one instant"},
                {"telecined", "telecined: fields repeat in 2:3"},
                {"still", "still: nothing moves"},
                {"open", "open: the picture's regions do not agree"}};
    print_row("field order");
    for (size_t i = 0; f->order_verdict && i < sizeof rows / sizeof *rows; i++)
        if (!strcmp(rows[i].verdict, f->order_verdict)) printf("  %s", rows[i].words);
    if (!f->order_verdict) printf("  - (a single frame, or a few lines, have none)");
    if (!isnan(f->order_ratio))
        printf("  (bottom first varies %.3g times as much)", f->order_ratio);
    putchar('\n');
}

static void print_difference(const wf_figures *f) {
    static const char *const lines[] = {"frame", "top field", "bottom field"};
    if (isnan(f->rmse)) return;
    print_row("difference");
    print_number("rmse", f->rmse, "");
    print_number("psnr", f->psnr, " dB");
    print_number("ssim", f->ssim, "");
    putchar('\n');
    for (int p = 0; p < 3 && f->plane_name[p]; p++)
        for (int which = 0; which < 3; which++) {
            const wf_plane_difference *d = &f->plane[p][which];
            printf("    %-2s %-17s  rmse %-10.4g  psnr %-7.4g dB  ssim %.6f\n",
                   f->plane_name[p], lines[which], d->rmse, d->psnr, d->ssim);
        }
}

void wf_measure_print(const char *path, const wf_measure_options *options,
                      const wf_figures *f) {
    printf("%s\n", path);
    print_row("what it is");
    printf("  %" PRId64 " frame%s of %dx%d, %s, taken for %s (%s)\n", f->frames,
           f->frames == 1 ? "" : "s", f->info.width_px, f->info.lines, f->info.format,
           f->info.raster.name,
           f->info.scan_known ? wf_raster_order(&f->info.raster)
                              : "it does not say how scanned");
    print_flicker(options, f);
    print_sharpness(f);
    print_composite(f);
    print_order(f);
    print_row("outside");
    print_percent("narrow range", f->range_share);
    print_percent("R103", f->r103_share);
    putchar('\n');
    print_difference(f);
}
