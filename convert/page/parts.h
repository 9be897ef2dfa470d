/* Inside the page: what is known of its clips when it is written. */
#ifndef WF_CONVERT_PAGE_PARTS_H
#define WF_CONVERT_PAGE_PARTS_H

#include "convert/base/outfile.h"
#include "convert/check/figures.h"
#include "convert/page/page.h"
#include "convert/page/shown.h"
#include "convert/page/text.h"

typedef struct wf_page_packed {
    const char *path;
    char *label; /* owned */
    wf_video_info info;
    wf_page_form form;
    wf_figures figures; /* the heat map is owned */
    int64_t frames;     /* that were packed; the page shows the least of all clips */
    wf_packer *fields, *heat;
} wf_page_packed;

typedef struct wf_page {
    const wf_page_request *request;
    wf_page_packed *clip; /* [clips] */
    size_t clips;
    char *title;
    int64_t frames;   /* that are shown */
    double heat_high; /* the flicker that is drawn as strongest */
} wf_page;

/* The measures of all clips, as a table. */
void wf_page_table(wf_text *text, const wf_page *page);

/* What is guessed and what is left out, as items of a list. */
void wf_page_notes(wf_text *text, const wf_page *page);

/* The whole page, into a file that is open. */
weft_status wf_page_write(const wf_page *page, wf_outfile *file, weft_error *err);

#endif
