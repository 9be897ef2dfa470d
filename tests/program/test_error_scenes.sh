#!/bin/bash
# --error on scenes made to fool it: pixels within, RMS, estimate and light against a truth.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_adaptive.c keeps its goals"
needs python3

size=48x32 samples=2048
is_long && size=64x48 samples=4096

# keeps ERROR APERTURE SCENE..
keeps()
{
    local error=$1 aperture=$2
    shift 2
    python3 -B "$WEFT_SOURCE/tests/bench/error.py" "$WEFT_BUILD" --small --scenes "$(IFS=,; echo "$*")" \
        --errors "$error" --apertures "$aperture" --raster "$size@30i,tff,par=1:1" --truth $samples --out "$PWD"
}

check "spheres smaller than a pixel" keeps 0.02 box,shaped dust
check "stars that no neighbor tells of" keeps 0.005 box stars
is_long && check "a far checker, mirrors, thin spokes at 900 rpm" keeps 0.04,0.01 box,shaped \
    far_checker mirrors fast_spokes

# What would take more samples than there may be.
check "an error out of reach" exits 3 weft render "$WEFT_SOURCE/tests/bench/scenes/dust.lua" --error 0.0001 \
    --raster 12x8@30i,tff,par=1:1 --frames 0 -o far.y4m
check "says so" says "error 0.0001 is not reached"

finish
