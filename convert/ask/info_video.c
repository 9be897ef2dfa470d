/* What files are: video in containers, as the libav module reads it. */
#include <string.h>

#include "convert/ask/info_facts.h"
#include "convert/base/module.h"
#include "convert/read/rate.h"
#include "convert/sound/sound.h"
#include "convert/video/meaning.h"
#include "convert/video/rate.h"

static void tell_video(const wf_video_info *info, wf_facts *facts) {
    const wf_raster *r = &info->raster;
    wf_fact_text(facts, "kind", "video");
    wf_fact_text(facts, "format", info->format);
    wf_fact_int(facts, "width", info->width_px);
    wf_fact_int(facts, "height", info->lines);
    wf_fact_ratio(facts, "frame_rate", r->frame_rate, '/');
    wf_fact_text(facts, "order", info->scan_known ? wf_raster_order(r) : "not said");
    wf_fact_ratio(facts, "pixel_aspect", r->pixel_aspect, ':');
    wf_fact_text(facts, "raster", r->name);
    if (info->frames >= 0) wf_fact_int(facts, "frames", info->frames);
}

weft_status wf_info_meaning(const wf_video *video, const char *path, wf_facts *facts,
                            weft_error *err) {
    const wf_video_info *info = wf_video_info_of(video);
    wf_taken_list taken = {0};
    wf_meaning meaning;
    wf_rational rate;
    weft_status status = wf_meaning_of(info, path, &meaning, err);
    if (status) return status;
    wf_meaning_take(&meaning, info, &taken);
    (void)wf_meaning_alpha(info, WF_ALPHA_UNSET, &taken);
    char text[48] = "irregular";
    weft_error why;
    if (!wf_video_rate(info, path, &rate, &why)) {
        if (wf_ratio_given(rate)) wf_rate_text(rate, text);
        wf_take(&taken, "rate", text, "file");
    } else {
        wf_fact_text(facts, "trouble", why.text);
    }
    wf_facts_taken(facts, &taken);
    return WEFT_OK;
}

weft_status wf_info_video(const char *path, wf_facts *facts, weft_error *err) {
    const wf_video_options options = {
        .max_memory_bytes = (size_t)2 << 30, .want_times = true, .codes_only = true};
    wf_video *video = NULL;
    weft_status status = wf_video_open(path, &options, &video, err);
    if (status) return status;
    char sound[WF_SOUND_TEXT];
    tell_video(wf_video_info_of(video), facts);
    weft_error why;
    bool heard = !wf_sound_in(path, sound, &why);
    if (heard || !wf_module_check("libav", "sound", NULL))
        wf_fact_text(facts, "sound", heard ? sound : why.text);
    status = wf_info_meaning(video, path, facts, err);
    wf_video_close(video);
    return status;
}
