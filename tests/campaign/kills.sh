#!/bin/bash
# SIGKILL at random moments of jobs that make sequences, then --resume: the files are those of an undisturbed run. COUNT (200 of each
# job) is its argument.
set -u
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export WEFT_BUILD=${WEFT_BUILD:-$source_dir/build} WEFT_SOURCE=$source_dir
export WEFT=$WEFT_BUILD/weft
[ -f "$WEFT_BUILD/tests/libfaults.so" ] || { echo "skipped: no $WEFT_BUILD/tests/libfaults.so"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset OCIO
python3 "$source_dir/tests/hard/campaign.py" --folder "$work/kills" --faults kill --few 100 --resumes "${1:-200}" \
    --jobs exr-exr,exr-png,exr-dpx,trace,trace-deep
