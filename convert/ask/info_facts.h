/* What the parts of telling what files are share. */
#ifndef WF_CONVERT_ASK_INFO_FACTS_H
#define WF_CONVERT_ASK_INFO_FACTS_H

#include "convert/base/json.h"
#include "convert/job/taken.h"
#include "convert/read/video.h"
#include "filters/base/rational.h"

/* What is found out of a file, told one fact at a time: as a line of text each, or as a member
 * of a JSON object. Keys are JSON's. */
typedef struct wf_facts {
    void (*line)(void *user, const char *key, const char *value); /* NULL: as JSON */
    void *user;
    wf_json *json;
} wf_facts;

void wf_fact_text(wf_facts *facts, const char *key, const char *value);
void wf_fact_int(wf_facts *facts, const char *key, int64_t value);
void wf_fact_real(wf_facts *facts, const char *key, double value);
void wf_fact_ratio(wf_facts *facts, const char *key, wf_rational value, char between);

/* What the input is taken for: a line "key value (reason)" each, or members of "input". */
void wf_facts_taken(wf_facts *facts, const wf_taken_list *taken);

/* Tells what the header of a YUV4MPEG2 file says. *is_y4m is false, and nothing is told, if the
 * file is not one. */
weft_status wf_info_y4m(const char *path, wf_facts *facts, bool *is_y4m, weft_error *err);

/* Tells what a container says of its video, the first frame of which is decoded. */
weft_status wf_info_video(const char *path, wf_facts *facts, weft_error *err);

/* Tells what video would be taken for as a source, without options. */
weft_status wf_info_meaning(const wf_video *video, const char *path, wf_facts *facts,
                            weft_error *err);

#endif
