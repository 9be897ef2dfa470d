#!/bin/bash
# How far ahead of kernels the nearest picture is: for scenes that come along, as stills of 525 lines, beside
# each kernel a weight of the same flicker (RMS), and the lowest limit that is no farther from `line`.
#   nearest.sh BUILD_DIRECTORY [SCENE..]
set -eu
build=$(realpath "$1") scenes=$(realpath "$(dirname "$0")/../../examples/scenes")
shift
[ $# -gt 0 ] || set -- still panorama carousel slow_edges
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# made NAME OPTION..: renders the scene and leaves flicker RMS, 99.9th percentile and distance in rms, peak, off.
made()
{
    local name=$1
    shift
    "$build/weft" render "$scenes/$scene.lua" --raster 720x486@30psf,par=10:11 --temporal-width 0 --samples 36 --frames 0 -q \
        --overwrite "$@" -o "$name.####.exr"
    read -r rms peak off <<<"$("$build/tests/bench-nearest" "$name.0000.exr" line.0000.exr)"
}
less() { awk "BEGIN { exit !($1 < $2) }"; }
halved() { awk "BEGIN { print sqrt($1 * $2) }"; }

for scene; do
    cp /dev/null line.0000.exr
    "$build/weft" render "$scenes/$scene.lua" --raster 720x486@30psf,par=10:11 --temporal-width 0 --samples 36 --frames 0 -q \
        --overwrite --aperture line -o 'line.####.exr'
    for kernel in box shaped calm; do
        made kernel --aperture $kernel
        set -- "$rms" "$peak" "$off"
        low=0.05 high=200
        for _ in 1 2 3 4 5 6 7 8 9 10; do
            weight=$(halved $low $high)
            made least --aperture least:"$weight"
            if less "$rms" "$1"; then high=$weight; else low=$weight; fi
        done
        echo "$scene $kernel: rms $1 p99.9 $2 d $3; least:$weight d x $(awk "BEGIN { printf \"%.3f\", $off / $3 }")"
        best=1
        for share in 0 0.3 0.6 0.8; do
            mu=$(awk "BEGIN { printf \"%.6f\", $share * $weight }")
            for factor in 0.9 0.85 0.8 0.7 0.65 0.6 0.55 0.5 0.4; do
                limit=$(awk "BEGIN { printf \"%.6f\", $factor * $2 }")
                made held --flicker-weight "$mu" --flicker-limit "$limit"
                less "$1" "$rms" && continue
                less "$3" "$off" && break
                best=$(printf '%s\n' "$best" "$(awk "BEGIN { printf \"%.3f\", $peak / $2 }")" | sort -n | head -n 1)
            done
        done
        echo "$scene $kernel: weight and limit, rms and d no worse: p99.9 x $best"
    done
done
