/* The beginning of files of hot loops. */
#ifndef WF_FILTERS_BASE_ISA_FILE_H
#define WF_FILTERS_BASE_ISA_FILE_H

/* What every *_isa.c includes. The build compiles such a file once for each level, with WF_ISA
 * defined as the level's suffix, and the file defines its table as
 *     const wf_row_ops WF_ISA_TABLE(wf_row_ops) = {..};
 * which is wf_row_ops_v1, wf_row_ops_v3 or wf_row_ops_v4. Everything else in it is static. */

#ifndef WF_ISA
#define WF_ISA v1
#endif

#define WF_ISA_JOIN_(ops, level) ops##_##level
#define WF_ISA_JOIN(ops, level)  WF_ISA_JOIN_(ops, level)
#define WF_ISA_TABLE(ops)        WF_ISA_JOIN(ops, WF_ISA)

#endif
