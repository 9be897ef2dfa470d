#ifndef WF_CONVERT_MEDIA_BOX_H
#define WF_CONVERT_MEDIA_BOX_H

#include <stdbool.h>

/* Rectangles of pixels. An empty one holds no pixel, and adds nothing to another. */

/* Half-open: x0 <= x < x1. */
typedef struct wf_box {
    int x0, y0, x1, y1;
} wf_box;

static inline bool wf_box_is_empty(wf_box a) {
    return a.x0 >= a.x1 || a.y0 >= a.y1;
}

/* Pixels of both; may be empty. */
static inline wf_box wf_box_overlap(wf_box a, wf_box b) {
    return (wf_box){a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0,
                    a.x1 < b.x1 ? a.x1 : b.x1, a.y1 < b.y1 ? a.y1 : b.y1};
}

/* The smallest that has both within it. */
static inline wf_box wf_box_around(wf_box a, wf_box b) {
    if (wf_box_is_empty(a)) return b;
    if (wf_box_is_empty(b)) return a;
    return (wf_box){a.x0 < b.x0 ? a.x0 : b.x0, a.y0 < b.y0 ? a.y0 : b.y0,
                    a.x1 > b.x1 ? a.x1 : b.x1, a.y1 > b.y1 ? a.y1 : b.y1};
}

/* Whether b lies within a. */
static inline bool wf_box_contains(wf_box a, wf_box b) {
    return a.x0 <= b.x0 && a.y0 <= b.y0 && a.x1 >= b.x1 && a.y1 >= b.y1;
}

static inline wf_box wf_box_moved(wf_box a, int x, int y) {
    return (wf_box){a.x0 + x, a.y0 + y, a.x1 + x, a.y1 + y};
}

#endif
