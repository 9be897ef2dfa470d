/* What convert, render and trace share. */
#ifndef WF_CONVERT_PROGRAM_JOB_COMMAND_H
#define WF_CONVERT_PROGRAM_JOB_COMMAND_H

#include "convert/program/cmd.h"

/* What the commands that run a job (convert, render, trace) have in common. Their rows differ
 * in name, text and the job's options that they take. */
#define WF_JOB_COMMAND_OPTIONS   6
#define WF_VIDEO_COMMAND_OPTIONS 9 /* those that make video have as many */
extern const wf_cmd_option wf_job_command_options[WF_VIDEO_COMMAND_OPTIONS];
extern const char wf_job_command_notes[];

/* A wf_cmd's run: reads job files and arguments into a job, runs it, and writes its report. */
weft_status wf_job_command_run(const wf_cmd *cmd, int argc, char **argv, weft_error *err);

#endif
