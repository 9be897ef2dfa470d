#!/bin/bash
# What the README says under its first picture is what its three ways measure.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test-flicker holds flicker"
needs python3 ffmpeg
python3 -c 'import numpy' 2>/dev/null || { echo "skipped: no numpy"; exit 77; }
check "the README's first picture" exits 0 python3 -B "$WEFT_SOURCE/tests/flicker/opening.py" "$WEFT" "$WEFT_SOURCE"
cat out

finish
