#ifndef WF_CONVERT_READ_CHOICE_PICK_H
#define WF_CONVERT_READ_CHOICE_PICK_H

#include "convert/read/choice/layers.h"

/* Which channels of a file are the picture. */

/* What the job asks for, in which case it is looked for alone. */
typedef struct wf_wish {
    const char *layer; /* channel prefix, or a part's name; NULL: none */
    const char *part;  /* name or number from 0; NULL: any */
    int only_part;     /* -1: any; else this one, which is a subframe of its own */
} wf_wish;

/* Why something was taken. */
typedef enum wf_reason { WF_REASON_DEFAULT, WF_REASON_FILE, WF_REASON_OPTION } wf_reason;
const char *wf_reason_name(wf_reason reason); /* "default", "file", "option" */

#define WF_LAYER_SIZE 128

typedef struct wf_pick {
    int part;
    int channel[4]; /* R G B A in the part's list; Y three times; or Y RY BY A */
    int count;      /* 3, or 4 with alpha */
    wf_picture_kind kind;
    char layer[WF_LAYER_SIZE]; /* prefix of its channels; "": they have none */
    wf_reason layer_reason, part_reason;
    char also[WF_LAYER_SIZE]; /* another layer or part named as the beauty; "": none */
} wf_pick;

/* Chooses the picture among all parts: what is wished for; else for R G B, then Y, then
 * Y RY BY: the channels without a prefix (of several parts that have them, the one named as the
 * beauty), the layer named as the beauty, the only layer. Vectors, depth and ids are never
 * taken unasked, whole numbers and Cryptomatte never at all. False with a reason that lists all
 * parts and layers. */
bool wf_pick_picture(const wf_part *parts, int count, const wf_wish *wish, wf_pick *out,
                     char *why, size_t why_size);

#endif
