/* The colors of plots. */
#ifndef WF_CONVERT_PLOT_INK_H
#define WF_CONVERT_PLOT_INK_H

#include <stdint.h>

/* What a color is for. WF_INK_SERIES + n is series n, from 1 on; series 0 is plain text. */
typedef enum wf_ink {
    WF_INK_TEXT,
    WF_INK_SERIES = WF_INK_TEXT,
    WF_INK_FAINT = 9,
    WF_INK_GRID,
    WF_INK_MARK,
    WF_INK_PAPER,
    WF_INK_RING,    /* over a map */
    WF_INK_CARRIER, /* over a map, dashed */
    WF_INKS
} wf_ink;

typedef struct wf_rgb {
    double r, g, b; /* 0 to 1, for the display */
} wf_rgb;

/* A row for each ink: its class in an SVG, and its colors on light and on dark paper. */
typedef struct wf_ink_row {
    const char *name;
    wf_rgb light;
    const char *light_text, *dark_text; /* "#rrggbb" */
} wf_ink_row;
extern const wf_ink_row wf_inks[WF_INKS];

wf_ink wf_ink_of_series(int series);

/* The color of a heat map for a share from 0 to 1, as cairo packs it: 0x00RRGGBB. */
uint32_t wf_heat_color(double share);

#endif
