#!/bin/bash
# Jobs of every kind on a disk that gets full, and killed; of sequences, killed at any moment and then resumed.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/hard/common.sh"
check "a full disk, SIGKILL and --resume" campaign --faults disk,kill --few 1 --resumes 2
finish
