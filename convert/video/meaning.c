/* What the codes of a stream mean, from its tags and its size. */
#include "convert/video/meaning.h"

#include <stdio.h>
#include <strings.h>

#include "convert/media/color_tags.h"
#include "convert/media/formats.h"

enum { UNSAID = 2, SRGB = 13 };

/* ---- Tables of Rec. ITU-T H.273 ---- */

static const struct {
    int code_point;
    const char *name;
    double kr, kb;
    int primaries; /* that go with it where nothing is said of these */
} matrices[] = {
    {1, "Rec. 709", 0.2126, 0.0722, 1}, {4, "FCC", 0.30, 0.11, 6},
    {5, "Rec. 601", 0.299, 0.114, 5},   {6, "Rec. 601", 0.299, 0.114, 6},
    {7, "SMPTE 240M", 0.212, 0.087, 7}, {9, "Rec. 2020", 0.2627, 0.0593, 9},
};

#define COUNT(table) (sizeof(table) / sizeof *(table))

/* ---- What is not said ---- */

/* Standard definition is below 720 lines; 576 is of 625. */
static int usual_primaries(int lines) {
    return lines >= 720 ? 1 : lines > 486 ? 5 : 6;
}

static int primaries_of_matrix(int matrix, int lines) {
    if (matrix == 6) return lines > 486 && lines < 720 ? 5 : 6; /* it is both systems' */
    for (size_t i = 0; i < COUNT(matrices); i++)
        if (matrices[i].code_point == matrix) return matrices[i].primaries;
    return usual_primaries(lines);
}

static int matrix_of_primaries(int of) {
    return of == 9 ? 9 : of == 5 || of == 6 || of == 7 ? 6 : 1;
}

static void fill_in(wf_meaning *m, const wf_video_info *info) {
    const wf_video_tags *tags = &info->tags;
    bool rgb = !m->ycbcr, matrix_said = !rgb && tags->matrix != UNSAID && tags->matrix != 0;
    bool primaries_said = tags->primaries != UNSAID && tags->primaries != 0;
    m->colors.transfer_said = tags->transfer != UNSAID && tags->transfer != 0;
    m->colors.primaries_said = primaries_said || matrix_said;
    m->tagged =
        tags->pictures || (m->colors.transfer_said && primaries_said && (rgb || matrix_said));
    m->transfer = m->colors.transfer_said ? tags->transfer : tags->pictures ? SRGB : 1;
    m->primaries = primaries_said   ? tags->primaries
                   : tags->pictures ? 1
                   : matrix_said    ? primaries_of_matrix(tags->matrix, info->lines)
                                    : usual_primaries(info->lines);
    m->matrix = rgb ? 0 : matrix_said ? tags->matrix : matrix_of_primaries(m->primaries);
    m->full_range = info->full_range;
}

int wf_matrix_of_space(const char *space) {
    static const struct {
        const char *space;
        int code_point;
    } rows[] = {{"rec709", 1},  {"rec601-525", 6}, {"rec601-625", 5},
                {"rec2020", 9}, {"rec2100-pq", 9}, {"rec2100-hlg", 9}};
    for (size_t i = 0; i < COUNT(rows); i++)
        if (!strcasecmp(space, rows[i].space)) return rows[i].code_point;
    return UNSAID;
}

/* ---- All of it ---- */

static const char *find_matrix(wf_meaning *m) {
    for (size_t i = 0; i < COUNT(matrices); i++) {
        if (matrices[i].code_point != m->matrix) continue;
        m->kr = matrices[i].kr;
        m->kb = matrices[i].kb;
        return matrices[i].name;
    }
    return m->ycbcr ? NULL : "R'G'B'";
}

static void find_colors(wf_meaning *m) {
    const wf_chromaticities *primaries = wf_chromaticities_of_code_point(m->primaries);
    const char *what = !wf_decoding_of_code_point(m->transfer, &m->colors.decoding) ? "transfer"
                       : !primaries ? "set of primaries"
                                    : NULL;
    m->colors.primaries = primaries ? *primaries : wf_chromaticities_of[WF_PRIMARIES_709];
    if (what)
        snprintf(m->colors.trouble, sizeof m->colors.trouble,
                 "its %s is number %d of Rec. ITU-T H.273, of which weft does not know the "
                 "light; name its space with --from",
                 what, *what == 't' ? m->transfer : m->primaries);
}

/* libav 5.1 does not tell all that a PNG says. */
static weft_status read_png(const char *path, wf_file_colors *colors, weft_error *err) {
    wf_color_said said = {0};
    bool animated;
    weft_status status = wf_is_animated_png(path, &animated, err);
    if (status || !animated) return status;
    status = wf_read_color_tags(path, "png", &said, err);
    *colors = wf_file_colors_of(&said);
    return status;
}

weft_status wf_meaning_of(const wf_video_info *info, const char *path, wf_meaning *out,
                          weft_error *err) {
    *out = (wf_meaning){.ycbcr = info->layout == WF_YCBCR};
    fill_in(out, info);
    find_colors(out);
    weft_status status = info->tags.pictures ? read_png(path, &out->colors, err) : WEFT_OK;
    if (status || find_matrix(out)) return status;
    return wf_fail(
        err, WEFT_FAILED,
        "%s: its matrix is number %d of Rec. ITU-T H.273, which is not read; convert "
        "it first, such as with ffmpeg -i IN -vf zscale=m=709 -c:v ffv1 OUT.mkv",
        path, out->matrix);
}

void wf_meaning_take(const wf_meaning *m, const wf_video_info *info, wf_taken_list *list) {
    wf_meaning found = *m;
    bool matrix_said = m->matrix && m->matrix == info->tags.matrix;
    wf_file_colors_take(&m->colors, list);
    wf_take(list, "matrix", find_matrix(&found),
            m->matrix_asked            ? "option"
            : matrix_said || !m->ycbcr ? "file"
                                       : "default");
    wf_take(list, "range", m->full_range ? "full" : "narrow",
            info->tags.range_said ? "file" : "default");
}

wf_alpha wf_meaning_alpha(const wf_video_info *info, wf_alpha asked, wf_taken_list *list) {
    static const char *const names[] = {"none", "straight", "premultiplied", "ignore"};
    bool has = info->alpha, lost = info->alpha_lost && !has, given = asked != WF_ALPHA_UNSET;
    wf_alpha said = info->alpha_said ? info->alpha_said : WF_ALPHA_STRAIGHT;
    wf_alpha taken = has ? (given ? asked : said) : lost ? WF_ALPHA_IGNORED : WF_ALPHA_UNSET;
    bool by_file = lost ? false : !has || (!given && info->alpha_said);
    given = given && (has || asked == WF_ALPHA_IGNORED) && (has || lost);
    wf_take(list, "alpha", names[taken], given ? "option" : by_file ? "file" : "default");
    return taken;
}
