#!/bin/bash
# Samples that the tracer stores, and those of other renderers, converted: the fields are those of a
# render without a file between.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh traces and converts"
scenes=$WEFT_SOURCE/examples/scenes
width=180 lines=122
is_sanitized && width=48 lines=36
small=(--raster "${width}x$lines@30i,tff,par=10:11")

# ---- Stored and taken up again ----

# near A B: two EXR pictures are within the resampler's bound.
near() { oiiotool "$1" "$2" --fail 2e-6 --diff >diff.log 2>&1 || { cat diff.log; return 1; }; }

for how in '--aperture shaped' '--aperture diamond' '--aperture box --shutter-position center --temporal-width 3/2' \
    '--aperture notch --scan-skew 1 --temporal-width 0'; do
    # shellcheck disable=SC2086
    set -- "$scenes/carousel.lua" "${small[@]}" --samples 8 --frames 0-2 $how --overwrite
    check "render $how" exits 0 weft render "$@" -o r.####.exr
    check "trace $how" exits 0 weft trace "$@" -o d.####.exr
    # shellcheck disable=SC2086
    check "convert $how" exits 0 weft convert d.####.exr "${small[@]}" $how --overwrite -o c.####.exr
    if has oiiotool; then
        for n in 0 1 2; do check "frame $n of $how" near r.000$n.exr c.000$n.exr; done
    fi
done
check "subframes" exits 0 weft trace "$scenes/carousel.lua" "${small[@]}" --frames 0 \
    --oversample 2x2x4 -o sub.####.exr
check "eight of them" test "$(find . -name 'sub.*.exr' | wc -l)" = 8
check "which say what they are" exits 0 weft convert sub.####.exr "${small[@]}" -o sub.y4m
check "samples are not written over" refuses 'would replace an input' convert d.####.exr "${small[@]}" \
    --overwrite -o d.####.exr
# shellcheck disable=SC2086
check "samples once" exits 0 weft convert d.####.exr "${small[@]}" $how -o once.y4m
cp -p once.y4m before.y4m
# shellcheck disable=SC2086
check "resumed when all is there" exits 0 weft convert d.####.exr "${small[@]}" $how --resume -o once.y4m
check "which makes nothing again" test ! once.y4m -nt before.y4m
check "a raster that is not theirs" fails "${width}x$lines" weft convert d.####.exr -o x.y4m
check "samples of half a field" exits 0 weft trace "$scenes/carousel.lua" "${small[@]}" --samples 8 \
    --frames 0 --overwrite -o d.####.exr
rm d.0001.exr d.0002.exr
check "samples that do not reach" fails 'no sample reached' weft convert d.####.exr "${small[@]}" \
    --temporal-width 1/60 -o x.y4m
check "nothing is left of it" test ! -e x.y4m
check "or the nearest" exits 3 weft convert d.####.exr "${small[@]}" --temporal-width 1/60 \
    --on-empty nearest -o x.y4m

# ---- Other renderers ----

check "a renderer in C builds" ${CC:-cc} -O1 "$WEFT_SOURCE/examples/write_samples.c" -o write_samples \
    $(pkg-config --cflags --libs OpenEXR)
check "and writes" ./write_samples c.0000.exr 0 $width $lines
check "samples of C" exits 0 weft convert c.0000.exr "${small[@]}" --aperture box -o from_c.exr
if has python3; then
    check "Python writes" python3 "$WEFT_SOURCE/examples/write_samples.py" p.0000.exr 0 $width $lines
    check "samples of Python" exits 0 weft convert p.0000.exr "${small[@]}" --aperture box -o from_p.exr
    # The same picture from other samples at random.
    has oiiotool && check "are those of C" \
        bash -c 'oiiotool from_c.exr from_p.exr --diff | awk "/RMS/ { exit !(\$4 < 0.05) }"'
fi

finish
