/* What the codes of a stream mean, from its tags and its size. */
#include "convert/video/meaning.h"

#include <stdio.h>

enum { UNSAID = 2 };

/* ---- Tables of Rec. ITU-T H.273 ---- */

static const struct {
    int code_point;
    const char *name, *space;
} primaries[] = {
    {1, "Rec. 709", "lin_rec709"},
    {5, "Rec. 601, 625 lines", "lin_rec601-625"},
    {6, "Rec. 601, 525 lines", "lin_rec601-525"},
    {7, "Rec. 601, 525 lines", "lin_rec601-525"},
    {9, "Rec. 2020", "lin_rec2020"},
    {12, "P3-D65", "lin_p3d65"},
};

/* Cameras' curves are decoded as their display does. */
static const struct {
    int code_point;
    const char *name;
} transfers[] = {{1, "BT.1886"},  {6, "BT.1886"}, {8, "linear"},   {11, "BT.1886"},
                 {12, "BT.1886"}, {13, "sRGB"},   {14, "BT.1886"}, {15, "BT.1886"},
                 {16, "PQ"},      {18, "HLG"}};

static const struct {
    int code_point;
    double kr, kb;
    int primaries; /* that go with it where nothing is said of these */
} matrices[] = {{1, 0.2126, 0.0722, 1}, {4, 0.30, 0.11, 6},   {5, 0.299, 0.114, 5},
                {6, 0.299, 0.114, 6},   {7, 0.212, 0.087, 7}, {9, 0.2627, 0.0593, 9}};

#define COUNT(table) (sizeof(table) / sizeof *(table))

const char *wf_primaries_name(int code_point) {
    for (size_t i = 0; i < COUNT(primaries); i++)
        if (primaries[i].code_point == code_point) return primaries[i].name;
    return "";
}

const char *wf_transfer_name(int code_point) {
    for (size_t i = 0; i < COUNT(transfers); i++)
        if (transfers[i].code_point == code_point) return transfers[i].name;
    return "";
}

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
    m->transfer_tagged = tags->transfer != UNSAID && tags->transfer != 0;
    m->space_tagged = tags->primaries != UNSAID || matrix_said;
    m->tagged = m->transfer_tagged && tags->primaries != UNSAID && (rgb || matrix_said);
    m->transfer = m->transfer_tagged ? tags->transfer : 1;
    m->primaries = tags->primaries != UNSAID && tags->primaries ? tags->primaries
                   : matrix_said ? primaries_of_matrix(tags->matrix, info->lines)
                                 : usual_primaries(info->lines);
    m->matrix = rgb ? 0 : matrix_said ? tags->matrix : matrix_of_primaries(m->primaries);
}

/* ---- All of it ---- */

static weft_status refuse(const char *path, const char *what, int code_point, weft_error *err) {
    return wf_fail(err, WEFT_FAILED,
                   "%s: its %s is number %d of Rec. ITU-T H.273, which is not read; convert it "
                   "to Rec. 709 or 2020 first, such as with ffmpeg -i IN -vf "
                   "zscale=p=709:t=709:m=709 -c:v ffv1 OUT.mkv",
                   path, what, code_point);
}

static bool find_matrix(wf_meaning *m) {
    for (size_t i = 0; i < COUNT(matrices); i++) {
        if (matrices[i].code_point != m->matrix) continue;
        m->kr = matrices[i].kr;
        m->kb = matrices[i].kb;
        return true;
    }
    return !m->ycbcr;
}

static bool find_space(wf_meaning *m) {
    for (size_t i = 0; i < COUNT(primaries); i++)
        if (primaries[i].code_point == m->primaries) m->space = primaries[i].space;
    return m->space;
}

weft_status wf_meaning_of(const wf_video_info *info, const char *path, wf_meaning *out,
                          weft_error *err) {
    *out = (wf_meaning){.ycbcr = info->layout == WF_YCBCR};
    fill_in(out, info);
    if (!find_matrix(out)) return refuse(path, "matrix", out->matrix, err);
    if (!find_space(out)) return refuse(path, "set of primaries", out->primaries, err);
    if (!*wf_transfer_name(out->transfer)) return refuse(path, "transfer", out->transfer, err);
    return WEFT_OK;
}
