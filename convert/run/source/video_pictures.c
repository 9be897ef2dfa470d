/* Video as a source: rows of light of the pictures that are at hand. */
#include "convert/run/source/video_source.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Fields that tell how windows overlap. */
#define FIELDS_LOOKED_AT 65536
/* ---- Pictures ---- */

typedef struct shown {
    const wf_light *light;
    const wf_video_source *source;
    const void *plane[4];
} shown;

/* Alpha has codes of full range. */
static void take_alpha(const shown *p, int y0, int y1, float *to) {
    const wf_video_info *info = &p->source->info;
    size_t width = (size_t)info->width_px, at = (size_t)y0 * width;
    size_t count = (size_t)(y1 - y0) * width;
    const uint8_t *bytes = (const uint8_t *)p->plane[3] + at;
    const uint16_t *pairs = (const uint16_t *)p->plane[3] + at;
    const float most = (float)((1 << info->bits) - 1);
    bool narrow = wf_video_code_bytes(info) == 1;
    for (size_t i = 0; i < count; i++) to[i] = (narrow ? bytes[i] : pairs[i]) / most;
}

static void multiply(float *const rgb[], const float *alpha, size_t count) {
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < count; i++) rgb[c][i] *= alpha[i];
}

/* Alpha that is not delivered is made after the scratch of light. */
static void make_rows_with_alpha(const shown *p, int y0, int y1, void *scratch,
                                 float *const rgb[]) {
    const wf_video_source *s = p->source;
    float *own = (float *)(void *)((char *)scratch + wf_light_scratch(p->light));
    float *alpha = s->channels == 4 ? rgb[3] : own;
    take_alpha(p, y0, y1, alpha);
    if (s->alpha == WF_ALPHA_PREMULTIPLIED) {
        wf_light_rows_multiplied(p->light, p->plane, y0, y1, scratch, alpha, rgb);
        return;
    }
    wf_light_rows(p->light, p->plane, y0, y1, scratch, rgb);
    multiply(rgb, alpha, (size_t)(y1 - y0) * (size_t)s->info.width_px);
}

static void make_rows(const void *picture, int y0, int y1, void *scratch, float *const rgb[]) {
    const shown *p = picture;
    if (wf_video_source_has_alpha(p->source))
        make_rows_with_alpha(p, y0, y1, scratch, rgb);
    else
        wf_light_rows(p->light, p->plane, y0, y1, scratch, rgb);
}

static weft_status open_picture(const wf_run *run, int64_t k, wf_subframe **out,
                                weft_error *err) {
    const wf_video_source *s = run->source;
    bool black = run->job->on_missing == WF_MISSING_BLACK;
    if (black && wf_video_window_lacks(s->window, s->picture + k * s->step)) return WEFT_OK;
    shown *p = calloc(1, sizeof *p);
    if (!p) return wf_fail(err, WEFT_NO_MEMORY, "no memory for a picture");
    p->light = s->light;
    p->source = s;
    if (!wf_video_window_find(s->window, s->picture + k * s->step, p->plane)) {
        free(p);
        return wf_fail(err, WEFT_FAILED, "%s: picture %" PRId64 " has passed", s->path, k);
    }
    return wf_subframe_made(&s->maker, p, s->info.width_px, s->info.lines, out, err);
}

static bool same(const wf_run *run, int64_t a, int64_t b) {
    (void)run;
    return a == b;
}

/* Pictures in memory at once, as codes. */
#define MOST_BYTES ((size_t)64 << 20)
/* Of sums that are carried: codes are smaller, and soon made light again. */
#define CARRIED_BYTES ((size_t)48 << 20)

static int open_together(const wf_video_source *s) {
    size_t pictures = MOST_BYTES / wf_video_window_picture_bytes(s->window);
    return pictures < 1 ? 1 : pictures > WF_UNITS_TOGETHER ? WF_UNITS_TOGETHER : (int)pictures;
}

static wf_picture_desc describe(const wf_run *run) {
    wf_video_source *s = run->source;
    int64_t looked_at = s->end_field < FIELDS_LOOKED_AT ? s->end_field : FIELDS_LOOKED_AT;
    size_t alpha = (size_t)WF_LIGHT_ROWS * (size_t)s->info.width_px * sizeof(float);
    s->maker =
        (wf_row_maker){wf_light_scratch(s->light) + (wf_video_source_has_alpha(s) ? alpha : 0),
                       WF_LIGHT_ROWS, s->channels, make_rows, free};
    return (wf_picture_desc){
        s->resampler, &s->options,         open_together(s),
        looked_at,    s->arrivals != NULL, CARRIED_BYTES,
    };
}

const wf_picture_reading wf_video_source_pictures = {
    .describe = describe,
    .prepare = wf_video_source_prepare,
    .open = open_picture,
    .same = same,
};
