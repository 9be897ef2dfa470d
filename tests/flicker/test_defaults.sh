#!/bin/bash
# The bench of defaults: a small run of it, and that its published figures, the page and the program agree.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh runs what it runs"
needs python3 ffmpeg
python3 -c 'import numpy' 2>/dev/null || { echo "skipped: no numpy"; exit 77; }
bench=$WEFT_SOURCE/tests/bench/defaults.py
check "page, program and figures agree" exits 0 python3 -B "$bench" "$WEFT_BUILD" --check
check "a small run" exits 0 python3 -B "$bench" "$WEFT_BUILD" --small --out small
check "tells the frontier" prints "RMS beside"
check "draws it" test -s small/defaults_small.svg

finish
