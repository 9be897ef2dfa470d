/* The page's HTML, CSS and scripts, which are files of this room, as the build has embedded
 * them. */
#ifndef WF_CONVERT_PAGE_ASSETS_H
#define WF_CONVERT_PAGE_ASSETS_H

#include <stddef.h>

/* The file of that name ("player.js"), *bytes long; NULL if there is none. Static storage. */
const unsigned char *wf_page_asset(const char *name, size_t *bytes);

#endif
