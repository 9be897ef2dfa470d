#!/bin/bash
# 'weft measure' on every form of video that weft writes, limits, JSON, heat maps, and what is refused.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh measures"

subframes in 96

# ---- Forms ----

for form in v210 uyvy; do
    clip f.$form 480000/1001 525i
    check "$form" exits 0 weft measure f.$form --raster 525i --json
    check "$form is bottom first" value "d['order']['verdict'] == 'bff' and d['frames'] == 6"
done
check "another raster" exits 1 weft measure f.v210 --raster 625i
check "which is said" says "--raster"
# With few samples noise adds to what the aperture leaves.
samples=16 rms=.02 p999=.03
is_sanitized && samples=4 rms=.04 p999=.15
for form in '####.exr' '####.dpx' y4m; do
    "$WEFT" render "$WEFT_SOURCE/examples/scenes/zoneplate.lua" -q --raster 525i --samples $samples --aperture line \
        --temporal-width 0 --frames 0-1 -o "z.$form"
done
check "EXR sequence" exits 0 weft measure 'z.####.exr' --json --chart zoneplate
check "its flicker and sharpness" value "abs(d['flicker']['rms'] / .1387 - 1) < $rms and
    abs(d['flicker']['p999'] / .339 - 1) < $p999 and abs(d['sharpness'] - .9003) < .01 and d['order']['verdict'] == 'still'"
check "the same in DPX and Y4M" exits 0 weft measure 'z.####.dpx' z.y4m --json
check "displayed light is light" value "len(d) == 2 and all(abs(f['flicker']['rms'] / .1387 - 1) < $rms for f in d)"
check "cross-color does not depend on the form" value "abs(d[0]['cross_color']['rms'] / d[1]['cross_color']['rms'] - 1) < .01"
check "standard input" bash -c "'$WEFT' measure - --json <z.y4m >out"
check "is measured" value "d['frames'] == 2"
check "a pipe" exits 0 weft measure <(cat z.y4m) --json
check "is measured" value "d['frames'] == 2"
check "zeros" exits 1 weft measure <(head -c 1000 /dev/zero)
check "are not video" says "nor Y4M"
check "for people" exits 0 weft measure z.y4m
check "flicker is told" prints "interline flicker"
check "a single picture" exits 0 weft measure z.0000.exr --json
check "has no order" value "d['order']['verdict'] is None and d['sharpness'] is None and d['difference']['rmse'] is None"
check "keys" value "set(d) >= {'flicker', 'sharpness', 'cross_color', 'cross_luma', 'order', 'legal', 'difference'} and
    set(d['flicker']) == {'rms', 'p999', 'share', 'visible'} and
    set(d['flicker']['visible']) == {'jnd_p999', 'share'} and
    set(d['crawl']) == {'rms', 'p999', 'jnd_p999', 'share'} and set(d['cross_color']) == {'rms', 'p999'} and
    set(d['legal']) == {'range_share', 'r103_share'} and set(d['order']) == {'verdict', 'ratio', 'agreement'}"

# ---- Limits and heat maps ----

check "within its limits" exits 0 weft measure z.y4m --limit flicker.rms=0.15 --limit legal.range_share=0
check "beyond a limit" exits 1 weft measure z.y4m --limit flicker.rms=0.01
check "which is said" says "flicker.rms is 0.1"
check "the second of two" exits 1 weft measure z.y4m --limit flicker.rms=0.2,flicker.p999=0.1
check "which is said" says "flicker.p999"
check "a floor" exits 1 weft measure z.y4m --chart zoneplate --limit sharpness=0.95
check "a floor that is kept" exits 0 weft measure z.y4m --chart zoneplate --limit sharpness=0.8
check "a verdict" exits 1 weft measure z.y4m --limit order.verdict=tff
check "a verdict that is so" exits 0 weft measure z.y4m --limit order.verdict=still
check "what cannot be measured" exits 1 weft measure z.0000.exr --limit order.ratio=1
check "unknown limit" exits 2 weft measure z.y4m --limit flicker.rmss=1
check "and what was meant" says "did you mean flicker.rms?"
check "limit without a number" exits 2 weft measure z.y4m --limit flicker.rms=much
check "limit without =" exits 2 weft measure z.y4m --limit flicker.rms
check "unknown chart" exits 2 weft measure z.y4m --chart rings
check "impossible grating" exits 2 weft measure z.y4m --chart grating:0.7
check "unknown display" exits 2 weft measure z.y4m --display lcd
check "heat map" exits 0 weft measure z.y4m --heatmap heat.png
check "is a picture" test "$(head -c 4 heat.png | tail -c 3)" = PNG
check "heat map over its video" exits 2 weft measure z.0000.exr --heatmap z.0000.exr
check "standard input twice" exits 2 weft measure - --against -
check "too much memory" exits 1 weft measure z.y4m --max-memory 2M
check "is said" says "--max-memory"
check "heat map of two" exits 2 weft measure z.y4m z.y4m --heatmap heat.png

# ---- What is refused ----

check "nothing" exits 2 weft measure
check "absent" exits 1 weft measure absent.y4m
check "the others are measured" exits 1 weft measure absent.y4m z.y4m --json
check "in place" value "'error' in d[0] and d[1]['frames'] == 2"
head -c 1000000 z.y4m >cut.y4m
check "a cut Y4M" exits 1 weft measure cut.y4m
check "its frame is named" says "frame 0"
echo text >text.y4m
check "no video" exits 1 weft measure text.y4m

finish
