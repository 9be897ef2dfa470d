#!/bin/bash
# Jobs of every kind, in each of which a call for memory or for a thread fails: the video is whole and the same, or there is none and
# a message says why. All calls: tests/campaign/faults.sh.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/hard/common.sh"
check "memory and threads" campaign --faults alloc,thread --few 2

# A sphere at the bottom: what was looked at until memory was out was empty.
cat >low.lua <<'END'
camera{eye={0, 0, 9}, look_at={0, 0, 0}}
light{point={5, 5, 5}}
add(sphere{}:translate{0, -2.4, 0})
END
no_false_warning()
{
    local n failed=0
    for n in $(seq 5 9 900); do
        failing "alloc:$n" "$WEFT" render low.lua --raster 96x64@30i --frames 0 --samples 1 --threads 1 --overwrite -o low.y4m 2>said ||
            failed=$((failed + 1))
        if grep "in view" said; then return 1; fi
    done
    [ "$failed" -gt 20 ] || { echo "$failed failed"; return 1; }
}
check "what was not looked at is not taken for empty" no_false_warning
finish
