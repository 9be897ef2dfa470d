/* What a television shows of a job's input. */
#ifndef WF_CONVERT_ASK_COMPOSITE_H
#define WF_CONVERT_ASK_COMPOSITE_H

/* Values of options, in the order of wf_tv_system, wf_tv_encoder and wf_tv_decoder. */
#define WF_ASK_SYSTEMS  "ntsc|pal"
#define WF_ASK_ENCODERS "cheap|filtered"
#define WF_ASK_DECODERS "notch|comb2|comb3"

#endif
