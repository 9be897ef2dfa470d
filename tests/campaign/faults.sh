#!/bin/bash
# Every call for memory, threads and files fails once, in jobs of every kind (tests/hard/README.md), and the disk gets full at every
# 4 KiB; then calls of other libraries, some of which end the process. Its arguments are options of campaign.py.
set -u
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
export WEFT_BUILD=${WEFT_BUILD:-$source_dir/build} WEFT_SOURCE=$source_dir
export WEFT=$WEFT_BUILD/weft
[ -f "$WEFT_BUILD/tests/libfaults.so" ] || { echo "skipped: no $WEFT_BUILD/tests/libfaults.so"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
unset OCIO
python3 "$source_dir/tests/hard/campaign.py" --folder "$work/near" --every "$@"
near=$?
python3 "$source_dir/tests/hard/campaign.py" --folder "$work/far" --who far --few 40 --faults alloc,thread "$@"
exit $near
