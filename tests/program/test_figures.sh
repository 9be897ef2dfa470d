#!/bin/bash
# The figures, JSON and plots of `weft filters` and `weft rasters`, designs and their certificates.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh plots and designs"

# ---- Filters ----

for name in line rotated box ccd notch shaped diamond mitchell:B,C crisp calm design:KEY=VALUE; do
    check "$name is listed" shows "$name" filters
done
# At half a cycle a line.
check "box, 1080 to 486" shows "leave -27.75 dB" filters box --input-lines 1080 --raster 525i
check "notch, 1080 to 486" shows "leave -64.98 dB" filters notch --input-lines 1080
check "box, 1440 to 1080" shows "leave -19.10 dB" filters box --input-lines 1440 --raster 1080i50
check "notch, 1440 to 1080" shows "leave -50.59 dB" filters notch --input-lines 1440 --raster 1080i50
for name in box notch shaped crisp calm; do
    check "$name, 972 to 486" shows "leave -inf dB" filters $name --input-lines 972
    exits 0 weft filters $name --input-lines 972 --json
    check "$name, 972 to 486, JSON" value "d['residue']['weights'] == 0 and d['residue']['weights_db'] < -300"
done
check "list as JSON" exits 0 weft filters --json
check "list is JSON" json
check "twelve apertures" value "len(d['apertures']) == 12"
check "their flicker" value "{a['name']: round(a['flicker'], 3) for a in d['apertures']}['box'] == 0.063"
check "list with residues" exits 0 weft filters --json --input-lines 1080
check "residues" value "all('weights_db' in a['residue'] for a in d['apertures'])"
check "one as JSON" exits 0 weft filters mitchell:0,0.5 --json --temporal-width 1 --raster 625i --input-lines 1000
check "one is JSON" json
check "its width" value "d['temporal_width'] == 1 and d['parameters'] == [0, 0.5]"
check "its lines" value "d['residue']['lines'] == 576"
check "a width" exits 0 weft filters line --json --temporal-width 2
check "its response" value "all(abs(r['temporal'] - (math.sin(2 * math.pi * r['frequency']) /
    (2 * math.pi * r['frequency']) if r['frequency'] else 1)) < 1e-8 for r in d['response'])"

# Designs, and their certificates.
check "design" shows "flicker of the still zone plate" filters design sharp=0.7,overshoot=0.08
check "design in one word" shows "flicker at most 0.05" filters design:flicker=0.05
check "a named design" shows "at least 0.802 at 0.25 cycles/line" filters crisp
check "design as JSON" exits 0 weft filters design sharp=0.95,at=0.125,sharp=0.49 --json
check "design is JSON" json
check "certificate" value "abs(d['design']['response_quarter'] - 0.49) < 1e-3 and d['design']['response_eighth'] > 0.949 and
    d['design']['flicker'] < 0.0415 and d['design']['overshoot'] < 0.0501 and d['design']['gap'] < 1e-8 and
    d['design']['response_half'] < 1e-12 and d['design']['least_beyond_quarter'] > -0.0501 and
    abs(2 * sum(d['design']['kernel']) * d['design']['step_lines'] - 1) < 1e-9 and d['reach_lines'] == 4"
check "unknown key" refuses "did you mean support?" filters design suport=3
check "too sharp" refuses "is the most that support=4" filters design sharp=1
check "too calm" refuses "is the least" convert --aperture design:flicker=0.001 in.exr -o x.y4m
check "nothing asked" refuses "design:sharp=0.7" filters design
check "keys apart" refuses "design sharp=.5,support=3" filters design sharp=.5 support=3
check "keys apart, without a name" refuses "design sharp=.5,support=3" filters sharp=.5 support=3
check "design misspelt" refuses "did you mean design?" filters desing sharp=.5
check "two apertures" refuses "one aperture at a time" filters box notch
check "what a wish of flicker proves" shows "as sharp at 0.25 cycles/line flickers less than" filters design flicker=.05
check "what a wish of too much flicker proves" shows "responds by more than" filters design flicker=.5
check "it as JSON" exits 0 weft filters design flicker=.5 --json
check "it is JSON" json
check "its gap" value "d['design']['gap'] is None and 0 < d['design']['gap_response'] < 1e-5"
check "a name is not the frontier's" refuses "leave out crisp" filters crisp --frontier no.png
check "a plot is not the frontier's" refuses "leave out --plot" filters --frontier no.png --plot no.png
check "neither was drawn" test ! -e no.png

check "plot" exits 0 weft filters shaped --input-lines 1080 --plot shaped.png
check "plot is a PNG" png shaped.png
check "plot of a design" exits 0 weft filters design sharp=0.7 --plot design.png
check "plot of a design is a PNG" png design.png
check "frontier" exits 0 weft filters --frontier frontier.png --json
check "frontier is a PNG" png frontier.png
check "frontier is JSON" json
check "frontier's figures" value "len(d['curves']) == 4 and {'crisp', 'ffmpeg linear', 'ffmpeg complex'} <=
    {p['name'] for p in d['points']} and all(a <= b + 1e-9 for c in d['curves'] for a, b in
    zip(c['flicker'], c['flicker'][1:]))"
check "nothing named lies above the frontier of its width" value "all(p['flicker'] > max([f for f, s in
    zip(c['flicker'], c['sharpness']) if s <= p['sharpness']]) - 1e-6 for c in [d['curves'][2]]
    for p in d['points'] if p['name'] not in ('crisp', 'shaped'))"
check "plot of all" exits 0 weft filters --plot all.png
check "plot of all is a PNG" png all.png
check "plots differ" test "$(cksum <shaped.png)" != "$(cksum <all.png)"
check "a plot that cannot be" exits 1 weft filters box --plot absent/box.png
check "says where" says "absent"

# ---- Rasters ----

check "list" shows "525i            720x486    30000/1001  bottom first  10:11   601-525  {21,283} of 525" rasters
check "one" shows "625i-dv-wide" rasters 625i-dv-wide
check "only one" test "$(wc -l <out)" = 2
check "described" shows "top first" rasters 180x122@30i,tff
check "list as JSON" exits 0 weft rasters --json
check "list is JSON" json
check "orders" value "{r['name']: r['order'] for r in d['rasters']}['525i-rp202'] == 'top first'"
check "line maps" value "all(r['order'] == 'one instant' or (r['order'] == 'top first') ==
    (r['line_map']['line1'] < r['line_map']['line2'] - r['line_map']['total'] / 2)
    for r in d['rasters'] if 'line_map' in r)"
check "one as JSON" exits 0 weft rasters 525i-wide --json
check "its aspect" value "d['pixel_aspect'] == '40:33' and d['line_map']['line2'] == 283"

finish
