#!/bin/bash
# A page of three clips in headless Chromium: pixels line by line, keys, wipes, heat maps, small screens.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_page_inputs makes pages"
needs python3
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || skip "no chromium"
look() { python3 -B "$WEFT_SOURCE/tests/page/look_at_page.py" "$chromium" "$@"; }

subframes in 32
for aperture in line box shaped; do
    "$WEFT" convert in --subframe-rate 480000/1001 --aperture $aperture -q -o $aperture.y4m
done
"$WEFT" page line.y4m box.y4m shaped.y4m -o three.html -q
check "a page of three clips of 525 lines" look three.html line.y4m box.y4m shaped.y4m

# Other bits, planes, orders and lengths, and one clip alone.
small='90x64@30i,tff,par=1:1,601-525'
"$WEFT" convert in --subframe-rate 480000/1001 --raster "$small" --bits 8 --chroma 444 -q -o a.y4m
"$WEFT" convert in --subframe-rate 480000/1001 --raster "${small/tff/bff}" --frames 0-15 --bits 8 -q -o b.y4m
"$WEFT" page a.y4m b.y4m -o orders.html -q
check "a page of 4:4:4, and of a shorter clip of the other order; the files do not say a matrix" \
    look orders.html a.y4m:709 b.y4m:709
python3 -B "$WEFT_SOURCE/tests/page/noise.py" n.y4m 46 36 3 It 420 XCOLORRANGE=FULL
python3 -B "$WEFT_SOURCE/tests/page/noise.py" m.y4m 46 36 4 Ib 422
"$WEFT" page n.y4m m.y4m -o noise.html -q
check "a page of noise, of 4:2:0 of full range and of 4:2:2" look noise.html n.y4m:709 m.y4m:709
"$WEFT" page a.y4m --raster "$small" -o one.html -q
check "a page of one clip" look one.html a.y4m

if is_long; then
    for aperture in line box shaped; do
        "$WEFT" render "$WEFT_SOURCE/examples/scenes/carousel.lua" --frames 0-59 --aperture $aperture -q \
            -o long_$aperture.y4m
    done
    check "two seconds in three apertures" exits 0 weft page long_*.y4m -o long.html
    check "are less than 20 MB" test "$(stat -c %s long.html)" -lt 20000000
fi
finish
