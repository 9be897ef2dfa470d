/* The sound of a run: opened before the output is settled, begun when the frames are known. */
#include <string.h>

#include "convert/finish/setup.h"
#include "convert/read/video.h"
#include "convert/job/delivery.h"
#include "convert/sound/sound.h"

/* An output that holds no sound refuses --audio when it is settled. */
weft_status wf_setup_sound(const weft_job *job, wf_setup *s, wf_taken_list *taken,
                           weft_error *err) {
    bool container;
    char text[WF_SOUND_TEXT];
    const wf_delivery *delivery = wf_delivery_for(job->output, job->codec, &container, NULL);
    weft_status status = delivery ? wf_sound_open(job, delivery, &s->sound, err) : WEFT_OK;
    if (!status && s->sound) wf_take(taken, "audio", wf_sound_text(s->sound, text), "option");
    return status;
}

weft_status wf_setup_keep_sound(weft_job *job, weft_error *err) {
    char text[WF_SOUND_TEXT];
    const wf_output_kind *kind = wf_output_for(job->output, job->codec, err).kind;
    weft_error why;
    bool video;
    weft_status status = wf_video_is(job->inputs[0], &video, err);
    if (status) return status;
    if (wf_sound_in(job->inputs[0], text, &why) && video)
        wf_job_warn(job, "its sound is left out: %s", why.text);
    if (!*text || !strcmp(text, "none")) return WEFT_OK;
    if (kind->container) return weft_job_set(job, "audio", "copy", err);
    wf_job_warn(job, "%.500s: %s has no sound, and that of the input is left out", job->output,
                kind->name);
    return WEFT_OK;
}

weft_status wf_setup_begin_sound(const wf_setup *s, weft_error *err) {
    const wf_sound_place place = {
        .copied_s = s->sound_s, .speed = s->speed, .first_frame = s->first_frame};
    return s->sound ? wf_sound_begin(s->sound, &place, err) : WEFT_OK;
}

void wf_setup_tell_sound(const wf_setup *s) {
    if (s->sound) wf_sound_tell(s->sound);
}
