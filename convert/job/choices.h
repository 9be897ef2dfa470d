#ifndef WF_CONVERT_JOB_CHOICES_H
#define WF_CONVERT_JOB_CHOICES_H

/* What options with a fixed set of words choose between, in the order of the words. */

typedef enum wf_fit { WF_FIT_STRETCH, WF_FIT_CROP, WF_FIT_PAD } wf_fit;
typedef enum wf_input_scan { WF_INPUT_AS_TAGGED, WF_INPUT_PROGRESSIVE } wf_input_scan;
typedef enum wf_on_missing {
    WF_MISSING_ERROR,
    WF_MISSING_HOLD,
    WF_MISSING_BLACK
} wf_on_missing;
typedef enum wf_on_empty { WF_EMPTY_ERROR, WF_EMPTY_NEAREST } wf_on_empty;
typedef enum wf_code_range { WF_RANGE_UNSET, WF_RANGE_NARROW, WF_RANGE_FULL } wf_code_range;

typedef enum wf_cadence { WF_CADENCE_NONE, WF_CADENCE_2_3 } wf_cadence;

typedef enum wf_command { WF_CONVERT, WF_RENDER, WF_TRACE } wf_command;
/* The law of fill and key (color/codes/key_law.h); UNSET: the output's. */
typedef enum wf_key_choice {
    WF_KEY_CHOICE_UNSET,
    WF_KEY_CHOICE_LIGHT,
    WF_KEY_CHOICE_ENCODED
} wf_key_choice;

/* Color that is written beside alpha; UNSET: as the output has it. */
typedef enum wf_fill { WF_FILL_UNSET, WF_FILL_PREMULTIPLIED, WF_FILL_STRAIGHT } wf_fill;

/* How color and alpha are stored. UNSET: as the file says; of a picture: it has no alpha. */
typedef enum wf_alpha {
    WF_ALPHA_UNSET,
    WF_ALPHA_STRAIGHT,
    WF_ALPHA_PREMULTIPLIED,
    WF_ALPHA_IGNORED
} wf_alpha;
typedef enum wf_nan_fix { WF_NAN_BOX3, WF_NAN_BLACK, WF_NAN_NONE, WF_NAN_ERROR } wf_nan_fix;

#endif
