#!/bin/bash
# SIGKILL at random moments of jobs that make sequences, then --resume: the files are those of an undisturbed run. COUNT (200 of each
# job) is its argument.
. "$(dirname "${BASH_SOURCE[0]}")/hard.bash"
campaign kills --faults kill --few 100 --resumes "${1:-200}" \
    --jobs exr-exr,exr-png,exr-dpx,trace,trace-deep
