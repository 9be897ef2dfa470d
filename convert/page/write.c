/* Writes a page: the template's places filled with what is known, sources and packed fields. */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert/base/json.h"
#include "convert/page/assets.h"
#include "convert/page/parts.h"

typedef weft_status fill_fn(const wf_page *page, wf_outfile *file, weft_error *err);

static weft_status no_memory(weft_error *err) {
    return wf_fail(err, WEFT_NO_MEMORY, "no memory for the page");
}

/* Writes text and frees it. */
static weft_status put_text(wf_text *text, wf_outfile *file, weft_error *err) {
    weft_status status = text->failed ? no_memory(err) : WEFT_OK;
    if (!status && text->length) status = wf_outfile_write(file, text->at, text->length, err);
    free(text->at);
    return status;
}

static weft_status put_asset(const char *name, wf_outfile *file, weft_error *err) {
    size_t bytes;
    const unsigned char *data = wf_page_asset(name, &bytes);
    return wf_outfile_write(file, data, bytes, err);
}

/* ---- Packed fields ---- */

static weft_status put_base64(const uint8_t *data, size_t bytes, wf_outfile *file,
                              weft_error *err) {
    static const char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char four[4096];
    size_t used = 0;
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < bytes && !status; i += 3) {
        size_t left = bytes - i;
        unsigned three = (unsigned)data[i] << 16;
        if (left > 1) three |= (unsigned)data[i + 1] << 8;
        if (left > 2) three |= data[i + 2];
        for (int k = 0; k < 4; k++) four[used++] = digits[three >> (18 - 6 * k) & 63];
        if (left < 3) four[used - 1] = '=';
        if (left < 2) four[used - 2] = '=';
        if (used < sizeof four && left > 3) continue;
        status = wf_outfile_write(file, four, used, err);
        used = 0;
    }
    return status;
}

static weft_status put_packed(const char *kind, size_t number, const wf_packer *packer,
                              wf_outfile *file, weft_error *err) {
    size_t bytes;
    wf_text open = {0}, close = {0};
    const uint8_t *data = wf_packer_data(packer, &bytes);
    wf_text_add(&open, "<script type=\"text/plain\" id=\"%s-%zu\">", kind, number);
    wf_text_add(&close, "</script>\n");
    weft_status status = put_text(&open, file, err);
    if (!status) status = put_base64(data, bytes, file, err);
    weft_status closed = put_text(&close, file, status ? NULL : err);
    return status ? status : closed;
}

static weft_status fill_packed(const wf_page *page, wf_outfile *file, weft_error *err) {
    weft_status status = WEFT_OK;
    for (size_t i = 0; i < page->clips && !status; i++) {
        status = put_packed("fields", i, page->clip[i].fields, file, err);
        if (!status) status = put_packed("heat", i, page->clip[i].heat, file, err);
    }
    return status;
}

/* ---- What the player is told ---- */

static void add_colors(wf_json *json, const wf_page_form *form) {
    const wf_page_colors *c = &form->colors;
    const int all[] = {c->black, c->luma, c->red_cr, c->green_cb, c->green_cr, c->blue_cb};
    if (!form->ycbcr) {
        wf_json_text(json, "colors", NULL);
        return;
    }
    wf_json_open(json, "colors", '[');
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) wf_json_int(json, NULL, all[i]);
    wf_json_close(json);
}

/* The figures that stand beside the picture, in few words. */
static void add_figures(wf_json *json, const wf_figures *f) {
    char text[160] = "";
    int used = 0;
    if (!isnan(f->flicker_rms))
        used = snprintf(text, sizeof text, "flicker %.3g RMS, seen %.2g JND", f->flicker_rms,
                        f->visible_jnd_p999);
    if (!isnan(f->crawl_jnd_p999))
        snprintf(text + used, sizeof text - (size_t)used, "%scrawl %.2g JND", used ? " · " : "",
                 f->crawl_jnd_p999);
    wf_json_text(json, "figures", text);
}

static void add_variant(wf_json *json, const wf_page_packed *clip, size_t number) {
    char name[32];
    wf_json_open(json, NULL, '{');
    snprintf(name, sizeof name, "clip-%zu", number);
    wf_json_text(json, "name", name);
    wf_json_text(json, "label", clip->label);
    wf_json_int(json, "first", wf_raster_parity(&clip->info.raster, 0));
    add_figures(json, &clip->figures);
    snprintf(name, sizeof name, "fields-%zu", number);
    wf_json_text(json, "packed", name);
    snprintf(name, sizeof name, "heat-%zu", number);
    wf_json_text(json, "heat", name);
    wf_json_open(json, "widths", '[');
    for (int p = 0; p < clip->form.shape.planes; p++)
        wf_json_int(json, NULL, clip->form.shape.width_px[p]);
    wf_json_close(json);
    add_colors(json, &clip->form);
    wf_json_close(json);
}

static char *player_data(const wf_page *page) {
    const wf_video_info *info = &page->clip[0].info;
    wf_json json = {0};
    wf_json_open(&json, NULL, '{');
    wf_json_bool(&json, "fit", true);
    wf_json_open(&json, "clips", '[');
    wf_json_open(&json, NULL, '{');
    wf_json_text(&json, "id", "clips");
    wf_json_text(&json, "title", page->title);
    wf_json_int(&json, "width", info->width_px);
    wf_json_int(&json, "lines", info->lines);
    wf_json_int(&json, "fields", 2 * page->frames);
    wf_json_int(&json, "first", wf_raster_parity(&info->raster, 0));
    wf_json_real(&json, "rate", 2 * wf_ratio_value(info->raster.frame_rate));
    wf_json_real(&json, "high", page->heat_high);
    wf_json_open(&json, "variants", '[');
    for (size_t i = 0; i < page->clips; i++) add_variant(&json, &page->clip[i], i);
    return wf_json_finish(&json);
}

/* JSON within HTML: "</" would end the script. */
static weft_status fill_data(const wf_page *page, wf_outfile *file, weft_error *err) {
    char *data = player_data(page);
    wf_text text = {0};
    if (!data) return no_memory(err);
    for (const char *at = data; *at;) {
        size_t plain = strcspn(at, "<");
        wf_text_add(&text, "%.*s", (int)plain, at);
        at += plain;
        if (*at) wf_text_add(&text, "\\u003c");
        at += *at != '\0';
    }
    free(data);
    return put_text(&text, file, err);
}

/* ---- The template's places ---- */

static weft_status fill_title(const wf_page *page, wf_outfile *file, weft_error *err) {
    wf_text text = {0};
    wf_text_add_words(&text, page->title);
    return put_text(&text, file, err);
}

static weft_status fill_lead(const wf_page *page, wf_outfile *file, weft_error *err) {
    const wf_video_info *info = &page->clip[0].info;
    wf_text text = {0};
    wf_text_add(&text, "%" PRId64 " fields of %d by %d, %.4g a second", 2 * page->frames,
                info->width_px, info->lines, 2 * wf_ratio_value(info->raster.frame_rate));
    if (page->clips > 1) wf_text_add(&text, ", of %zu clips", page->clips);
    wf_text_add(&text, ": every line stands where the field has it.");
    return put_text(&text, file, err);
}

static weft_status fill_table(const wf_page *page, wf_outfile *file, weft_error *err) {
    wf_text text = {0};
    wf_page_table(&text, page);
    return put_text(&text, file, err);
}

static weft_status fill_notes(const wf_page *page, wf_outfile *file, weft_error *err) {
    wf_text text = {0};
    wf_page_notes(&text, page);
    return put_text(&text, file, err);
}

static weft_status fill_version(const wf_page *page, wf_outfile *file, weft_error *err) {
    (void)page;
    return wf_outfile_write(file, weft_version(), strlen(weft_version()), err);
}

static const struct {
    const char *name;
    fill_fn *fill;
} places[] = {{"title", fill_title},  {"lead", fill_lead},       {"table", fill_table},
              {"notes", fill_notes},  {"version", fill_version}, {"data", fill_data},
              {"packed", fill_packed}};

/* A place's name is a row of `places`, or else that of a file. */
static weft_status fill(const wf_page *page, const char *name, wf_outfile *file,
                        weft_error *err) {
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        if (!strcmp(places[i].name, name)) return places[i].fill(page, file, err);
    return put_asset(name, file, err);
}

weft_status wf_page_write(const wf_page *page, wf_outfile *file, weft_error *err) {
    size_t bytes;
    const char *at = (const char *)wf_page_asset("look.html", &bytes), *end = at + bytes;
    weft_status status = WEFT_OK;
    while (at < end && !status) {
        char name[32] = "";
        const char *open = memmem(at, (size_t)(end - at), "{{", 2);
        const char *close = open ? memmem(open, (size_t)(end - open), "}}", 2) : NULL;
        if (!close) return wf_outfile_write(file, at, (size_t)(end - at), err);
        snprintf(name, sizeof name, "%.*s", (int)(close - open - 2), open + 2);
        status = wf_outfile_write(file, at, (size_t)(open - at), err);
        if (!status) status = fill(page, name, file, err);
        at = close + 2;
    }
    return status;
}
