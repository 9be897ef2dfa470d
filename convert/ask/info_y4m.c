/* What files are: the header of a Y4M file. */
#include <stdio.h>
#include <string.h>

#include "convert/base/fail.h"
#include "convert/base/infile.h"
#include "convert/media/y4m.h"
#include "convert/ask/info_facts.h"

static void tell_header(const wf_y4m *h, int64_t frames, wf_facts *facts) {
    wf_fact_text(facts, "kind", "video");
    wf_fact_text(facts, "format", WF_Y4M_MAGIC);
    wf_fact_int(facts, "width", h->width_px);
    wf_fact_int(facts, "height", h->lines);
    wf_fact_ratio(facts, "frame_rate", h->rate, '/');
    wf_fact_text(facts, "order", wf_y4m_order(h));
    if (wf_ratio_given(h->aspect) && h->aspect.num)
        wf_fact_ratio(facts, "pixel_aspect", h->aspect, ':');
    wf_fact_text(facts, "chroma", h->chroma);
    if (frames >= 0) wf_fact_int(facts, "frames", frames);
}

static weft_status tell_meaning(const char *path, wf_facts *facts, weft_error *err) {
    const wf_video_options options = {.max_memory_bytes = (size_t)2 << 30, .codes_only = true};
    wf_video *video = NULL;
    weft_status status = wf_video_open(path, &options, &video, err);
    if (!status) status = wf_info_meaning(video, path, facts, err);
    wf_video_close(video);
    return status;
}

weft_status wf_info_y4m(const char *path, wf_facts *facts, bool *is_y4m, weft_error *err) {
    char line[WF_Y4M_LINE];
    wf_y4m h;
    FILE *file;
    weft_status status = wf_infile_open(path, &file, err);
    if (status) return status;
    size_t got = fread(line, 1, sizeof line - 1, file);
    line[got] = '\0';
    char *end = memchr(line, '\n', got);
    *is_y4m = !strncmp(line, WF_Y4M_MAGIC " ", sizeof WF_Y4M_MAGIC);
    if (end) *end = '\0';
    if (*is_y4m && end && wf_y4m_parse(line, &h)) {
        tell_header(&h, wf_y4m_count(&h, file, end - line + 1), facts);
        status = h.known ? tell_meaning(path, facts, err) : WEFT_OK;
    } else if (*is_y4m) {
        status = wf_fail(
            err, WEFT_FAILED,
            "%s: the Y4M header is not whole; it has W, H and F within its first line", path);
    }
    return wf_infile_close(file, path, status, err);
}
