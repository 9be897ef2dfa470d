#!/bin/bash
# Renders to an error instead of a number of samples: the estimate keeps the goal, and the picture
# the estimate.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_adaptive.c keeps its goals"
needs oiiotool
size=90x60
is_long && size=180x122
is_sanitized && size=48x36

# holds E A B REPORT: the difference of two pictures is at most the estimate, and that at most E.
holds()
{
    local is says
    is=$(oiiotool "$2" "$3" --diff | awk '/RMS/ { print $4 }')
    says=$(grep -o '"error_estimate": [0-9.e-]*' "$4" | awk '{ print $2 }')
    echo "error $1: estimated $says, is $is"
    awk -v e="$1" -v is="$is" -v says="$says" 'BEGIN { exit !(is <= says && says <= e && is > 0) }'
}

for aperture in line shaped; do
    set -- "$WEFT_SOURCE/examples/scenes/carousel.lua" --raster "$size@30i,tff,par=10:11" --frames 0 \
        --aperture $aperture --to rec709 --overwrite
    check "converged" exits 0 weft render "$@" --samples 1024 --seed 9 -o converged.exr
    for error in 0.02 0.005; do
        check "to $error" exits 0 weft render "$@" --error $error -o spent.exr --report spent.json
        check "$aperture reaches $error" holds $error converged.exr spent.exr spent.json
    done
done

finish
