/* Gaussian blurs of pictures, in tiles of lines that threads may share out. */
#ifndef WF_FILTERS_SEEN_BLUR_H
#define WF_FILTERS_SEEN_BLUR_H

#include <stdbool.h>
#include <stddef.h>

enum {
    WF_BLUR_TILE = 8,   /* lines that are blurred together */
    WF_BLUR_SPAN = 64,  /* columns that are left out together, where there is nothing */
    WF_BLUR_STEP = 1024 /* the most that means are of */
};

/* A low pass: weight[reach] in the middle, and the same to both sides. */
typedef struct wf_low_pass {
    int reach;
    float *weight; /* [2 * reach + 1] */
} wf_low_pass;

/* In both directions. Wide ones are of means of `step` samples, between which lies a straight
 * line: these take and give what a Gaussian does whose variance is step^2 / 4, which the low
 * pass has less. `which` below is that of two pictures. */
typedef struct wf_blur {
    int width_px, picture_lines;
    int step_x, step_y, width, lines; /* of means */
    wf_low_pass down, across;
    float *mean[2], *out[2]; /* [lines][width] and these blurred; NULL: it is of samples */
} wf_blur;

/* Where a picture is not zero: above[y][span], how many of the lines above y have something in
 * the span, [lines + 1][wf_blur_spans(width_px)]. */
typedef struct wf_blur_marks {
    int *above;
    int spans;
} wf_blur_marks;

/* What one thread needs. `wide` is a tile of lines of `stride` floats. */
typedef struct wf_blur_room {
    const float **row;
    float *wide, *line;
    bool *middle; /* [spans]: after the first of the two low passes there is something */
    size_t stride;
    int reach;
} wf_blur_room;

int wf_blur_spans(int width_px);

/* By a Gaussian of so many samples down and across. false: no memory; free in either case. */
bool wf_blur_init(wf_blur *blur, int width_px, int lines, double down, double across);
void wf_blur_free(wf_blur *blur);

/* For any of these blurs, of whose tiles every `every`th line is wanted. */
bool wf_blur_room_init(wf_blur_room *room, const wf_blur *blurs, int count, int every);
void wf_blur_room_free(wf_blur_room *room);

bool wf_blur_marks_init(wf_blur_marks *marks, int width_px, int lines);
void wf_blur_marks_free(wf_blur_marks *marks);
void wf_blur_mark(wf_blur_marks *marks, const float *picture, int width_px, int lines);

/* Makes a blur that is of means ready for picture[lines][width_px]; others are always. */
void wf_blur_prepare(wf_blur *blur, wf_blur_room *room, const float *picture, int which);

/* Lines y, y + every, .., `count` of them, of a picture that has been prepared; out[count] has
 * lines of `stride` floats, with wf_blur_margin(blur) before and after each for the blur to
 * write into. live[spans] tells which spans there may be something in: the others of `out` are
 * not written. Without marks all are. */
void wf_blur_tile(const wf_blur *blur, wf_blur_room *room, const float *picture, int which,
                  const wf_blur_marks *marks, int y, int every, int count, float *out,
                  size_t stride, bool *live);
size_t wf_blur_margin(const wf_blur *blur);

#endif
