/* What is guessed on a page and what is left out. */
#include <ctype.h>
#include <inttypes.h>
#include <string.h>

#include "convert/page/parts.h"

static bool any(const wf_page *page, bool (*has)(const wf_page_packed *)) {
    for (size_t i = 0; i < page->clips; i++)
        if (has(&page->clip[i])) return true;
    return false;
}

/* An item, which names the clips that it is about, unless it is about all. */
static void add_item(wf_text *text, const wf_page *page, bool (*has)(const wf_page_packed *),
                     const char *says) {
    size_t about = 0, named = 0;
    wf_text_add(text, "<li>");
    for (size_t i = 0; i < page->clips; i++) about += has(&page->clip[i]);
    for (size_t i = 0; i < page->clips && about < page->clips; i++) {
        if (!has(&page->clip[i])) continue;
        wf_text_add(text, "%s<b>", named++ ? ", " : "");
        wf_text_add_words(text, page->clip[i].label);
        wf_text_add(text, "</b>");
    }
    wf_text_add(text, "%s%c%s</li>\n", named ? ": " : "", named ? *says : toupper(*says),
                says + 1);
}

/* ---- What may be said ---- */

static bool scan_is_guessed(const wf_page_packed *clip) {
    return !clip->info.scan_known;
}

static bool range_is_guessed(const wf_page_packed *clip) {
    return clip->info.layout == WF_YCBCR && !clip->info.tags.range_said;
}

static bool is_rounded(const wf_page_packed *clip) {
    return clip->form.rounded;
}

static bool is_brought(const wf_page_packed *clip) {
    return clip->form.brought;
}

static bool is_linear(const wf_page_packed *clip) {
    return clip->info.layout == WF_LINEAR;
}

static bool has_alpha(const wf_page_packed *clip) {
    return clip->info.alpha || clip->info.alpha_lost;
}

static bool is_coarse(const wf_page_packed *clip) {
    return clip->form.ycbcr && (clip->info.across > 1 || is_linear(clip));
}

static bool is_segmented(const wf_page_packed *clip) {
    return clip->info.raster.scan == WF_SEGMENTED;
}

static const struct {
    bool (*has)(const wf_page_packed *);
    const char *says;
} rows[] = {
    {scan_is_guessed,
     "guessed: how it is scanned, which the file does not say; what it was taken "
     "for stands below, and <code>--raster</code> says otherwise."},
    {range_is_guessed,
     "guessed: the file does not say its code range, and was taken for what its "
     "kind usually has."},
    {is_segmented, "both fields of a frame show one instant (segmented frames)."},
    {is_rounded,
     "8 bits are shown of what has more, to the nearest gray and, of color, to a code or two; "
     "measures are of all bits."},
    {is_linear, "scene-linear light was encoded as its raster has it."},
    {is_brought, "wider colors, or more light than white, were brought to Rec. 709 through "
                 "light, and what a "
                 "screen of that cannot show is cut off."},
    {has_alpha, "left out: alpha."},
    {is_coarse,
     "color that is shared by two pixels is, between them, their mean; of 4:2:0 the lines of a "
     "field share that field's."},
};

static void add_clips(wf_text *text, const wf_page *page) {
    for (size_t i = 0; i < page->clips; i++) {
        const wf_page_packed *clip = &page->clip[i];
        wf_text_add(text, "<li><b>");
        wf_text_add_words(text, clip->label);
        wf_text_add(text, "</b> is ");
        wf_text_add_words(text, clip->info.format);
        wf_text_add(text, ", %dx%d, taken for ", clip->info.width_px, clip->info.lines);
        wf_text_add_words(text, clip->info.raster.name);
        wf_text_add(text, " (%s).</li>\n", wf_raster_order(&clip->info.raster));
    }
}

static void add_lengths(wf_text *text, const wf_page *page) {
    for (size_t i = 0; i < page->clips; i++)
        if (page->clip[i].frames > page->frames) {
            wf_text_add(
                text,
                "<li>Clips are not equally long: the first %" PRId64
                " frames of each are shown, and measures are of all that each has.</li>\n",
                page->frames);
            return;
        }
}

void wf_page_notes(wf_text *text, const wf_page *page) {
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!any(page, rows[i].has)) continue;
        add_item(text, page, rows[i].has, rows[i].says);
    }
    add_lengths(text, page);
    wf_text_add(
        text,
        "<li>Codes are given to the screen as R'G'B' by the clip's own matrix and range, "
        "as they are given to a television: how bright and how colored that is, is up "
        "to the screen.</li>\n"
        "<li>Pixels are shown square. On the clip's own display they are %.4g as wide as "
        "they are high.</li>\n"
        "<li>Left out: sound, timecode, and all that lies outside of the picture.</li>\n"
        "<li>The tube is a model: lines of the field before are left at 14 %% of their "
        "code, nothing glows beyond its line.</li>\n",
        wf_ratio_value(page->clip[0].info.raster.pixel_aspect));
    add_clips(text, page);
}
