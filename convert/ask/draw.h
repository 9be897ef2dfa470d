/* Pictures by the plot module. */
#ifndef WF_CONVERT_ASK_DRAW_H
#define WF_CONVERT_ASK_DRAW_H

#include "convert/base/fail.h"

/* Has an entry point of the plot module (convert/plot/plot.h) draw into a file, which replaces
 * one that is there. */
weft_status wf_draw(const char *symbol, const void *plot, const char *path, weft_error *err);

#endif
