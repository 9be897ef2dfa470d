/* What rasters are called elsewhere. */
#ifndef WF_FILTERS_RASTER_RASTER_ALIAS_H
#define WF_FILTERS_RASTER_RASTER_ALIAS_H

#include <stdbool.h>
#include <stddef.h>

/* Another name of one raster, and that raster's own: "pal" is 625i, and 1080i25, which counts
 * frames as the EBU does (Tech 3299), is 1080i50. NULL past the end. Static storage. */
typedef struct wf_raster_other_name {
    const char *alias, *name;
} wf_raster_other_name;
const wf_raster_other_name *wf_raster_alias_at(size_t index);

/* The own name of a raster that text, in any case and with or without blanks and slashes, is
 * another name of; text itself where it is none. */
const char *wf_raster_own_name(const char *text);

/* Whether text is the name but for case, blanks, slashes, hyphens and a unit: "1080I/50 Hz". */
bool wf_raster_is_called(const char *text, const char *name);

/* What somebody should know who asks for a name that several rasters could be meant by, such as
 * 480i or 1080p; NULL for other names. Static storage. */
const char *wf_raster_advice(const char *text);

/* Whether a raster's name may be suggested for text: one of another scan, of another number of
 * lines or of a rate that is more than 1 off (of fields or frames) is never meant. */
bool wf_raster_may_mean(const char *text, const char *name);

#endif
