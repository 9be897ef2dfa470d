#!/bin/bash
# The command line itself: help, what it refuses and how it says so, exit codes, and the figures, JSON
# and pictures of filters, rasters and info.
. "$WEFT_SOURCE/tests/program/script.sh"

# refuses TEXT ARGUMENT..: status 2, one line with the text in it, nothing on standard output.
refuses()
{
    local text=$1
    shift
    exits 2 weft "$@" && says "$text" && [ ! -s out ] && [ "$(wc -l <said)" = 1 ]
}

# shows TEXT ARGUMENT..: status 0, the text on standard output, nothing on standard error.
shows()
{
    local text=$1
    shift
    exits 0 weft "$@" && { grep -qF -- "$text" out || { echo "weft $* does not print: $text"; return 1; }; } && [ ! -s said ]
}

# ---- Help and version ----

version=$(sed -n 's/^#define WEFT_VERSION "\(.*\)"/\1/p' "$WEFT_SOURCE/convert/weft.h")
check "version" shows "weft $version" --version
check "version of a command" shows "weft $version" convert --version
check "help" shows "usage: weft COMMAND" --help
check "-h" shows "usage: weft COMMAND" -h
for command in convert render trace measure composite filters rasters info; do
    check "$command is in the help" shows "weft $command" --help
    check "help of $command" shows "usage: weft $command" "$command" --help
    check "help of $command comes first" shows "usage: weft $command" "$command" --nonsense -h
    check "help of $command fits 100 columns" test "$(awk '{ print length }' out | sort -n | tail -n 1)" -le 100
done
"$WEFT" convert --help >out
for option in raster aperture temporal-width shutter-angle shutter-position scan-skew frames subframe-rate \
    subframe-time fit input-par background layer part ocio from to display view look bits range chroma \
    legalize dither timecode cadence fields on-missing fix-nan chunk threads skip max-memory overwrite resume progress quiet \
    report output help; do
    check "help of convert has --$option" grep -q -- "--$option\>" out
done
exits 2 weft && [ ! -s out ]
check "no command shows the help" says "usage: weft COMMAND"

# ---- What is refused ----

check "unknown command" refuses "covert: unknown command; did you mean convert?" covert
check "unknown command like no other" refuses "'weft --help' lists them" nonsense
check "option before command" refuses "a command comes first" --raster
check "unknown option" refuses "--rastr: unknown option; did you mean --raster?" convert --rastr 525i
check "unknown option like no other" refuses "'weft convert --help' lists them" convert --zzzzzz
check "unknown option of another command" refuses "'weft rasters --help' lists them" rasters --overwrite
check "unknown letter" refuses "-z: unknown option" convert -z
check "value forgotten" refuses "--raster needs a value: --raster NAME" convert --raster
check "value forgotten before an option" refuses "--output needs a value" convert -o -q
check "empty value" refuses "--raster needs a value" convert --raster=
check "value of a flag" refuses "--overwrite takes no value" convert --overwrite=yes
check "nothing to convert" refuses "shot.####.exr" convert
check "nowhere to write" refuses "-o out.y4m" convert in.####.exr
check "step with a colon" refuses "write 1-9x2" convert --frames 1-9:2
check "width twice" refuses "--shutter-angle" convert --temporal-width 1 --shutter-angle 360 in.exr -o x.y4m
check "progress" refuses "tty|plain|alf|json|none" convert --progress loud in.exr -o x.y4m
check "two streams on one output" refuses "both be standard output" convert in.exr -o - --report -
check "output of no kind" refuses "x.mp3" convert in.exr -o x.mp3
check "absent raster" refuses "did you mean 525i?" convert --raster 526i in.exr -o x.y4m
check "two rasters" refuses "'625i' is a second" rasters 525i 625i
check "two apertures" refuses "'notch' is a second" filters box notch
check "absent aperture" refuses "shaped" filters sharp
check "no input lines" refuses "--input-lines" filters box --input-lines 0
check "half an input line" refuses "--input-lines" filters box --input-lines 10.5
check "nothing to tell about" refuses "give a file" info
check "nothing was written" test -z "$(find . -name 'x.*')"

# Words that are refused list those there are.
check "bits" refuses "8|10|12|16" convert --bits 9
check "chroma" refuses "bt601|121|box|444" convert --chroma best
check "dither" refuses "none|tpdf" convert --dither blue
check "legalize" refuses "none|clip" convert --legalize hard
check "position" refuses "start|center|end" convert --shutter-position middle
check "fit" refuses "stretch|crop|pad" convert --fit squeeze

check "absent input" exits 1 weft convert absent.####.exr --subframe-rate 240 -o x.y4m
check "absent input is named" says "absent.####.exr"
check "absent file to tell about" exits 1 weft info absent.exr
check "absent file is named" says "absent.exr"
check "a closed output" bash -c "'$WEFT' rasters >&- 2>said; [ \$? = 1 ]"
check "a full device" bash -c "'$WEFT' rasters >/dev/full 2>said; [ \$? = 1 ] && grep -q space said"
left() { { sleep 0.2; "$WEFT" rasters 2>said; echo $? >code; } | true; [ "$(cat code)" = 1 ] && says "pipe"; }
check "a reader that left" left

# ---- Filters ----

json() { python3 -m json.tool <out >/dev/null; }

for name in line rotated box ccd notch shaped diamond mitchell:B,C crisp calm design:KEY=VALUE; do
    check "$name is listed" shows "$name" filters
done
# At half a cycle a line, as resampling.md has it in whole decibels.
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
check "eleven apertures" value "len(d['apertures']) == 11"
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

# png FILE: a whole PNG.
png() { [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] && tail -c 8 "$1" | grep -q IEND; }

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

# ---- Info and reports ----

"$WEFT_BUILD/make_subframes" in 32 || exit 1
check "info" shows "1440" info in
check "info as JSON" exits 0 weft info --json in 'in/subframe.####.exr' in/subframe.0003.exr
check "info is JSON" json
check "info counts" value "[f.get('subframes') for f in d['files']] == [32, 32, None] and
    d['files'][2]['rate'] == '480000/1001' and d['files'][0]['missing'] == []"
rm in/subframe.0005.exr
exits 0 weft info --json in
check "info sees what is missing" value "d['files'][0]['missing'] == [5]"
check "info tells the others too" exits 1 weft info --json in absent.exr
check "info with an error is JSON" json
check "missing subframe" exits 1 weft convert in -o x.y4m --report x.json --temporal-width 1
check "missing subframe is named" says "subframe 5 is missing"
check "missing subframe leaves no video" test ! -e x.y4m
cp x.json out
check "a failure has its report" value "d['input']['missing'] == [5] and 'missing' in d['error']"
check "held" exits 3 weft convert in -o x.y4m --report x.json --on-missing hold --temporal-width 1
cp x.json out
check "held in the report" value "d['degraded'] and d['frames'] == 2 and d['fields'] == 4 and
    d['input']['listed'] == 32 and d['raster']['name'] == '525i' and d['command'] == 'convert' and
    d['version'] == '$version' and d['peak_memory_bytes'] > 1e6 and d['seconds']['wall'] > 0"
check "held video" shows "bottom first" info x.y4m
check "existing output" exits 1 weft convert in -o x.y4m --on-missing hold
check "existing output says --overwrite" says "--overwrite"
check "overwritten" exits 3 weft convert in -o x.y4m --on-missing hold --overwrite --temporal-width 1
check "quiet" bash -c "'$WEFT' convert in -o q.y4m --on-missing hold --temporal-width 1 -q 2>said; [ \$? = 3 ] && [ ! -s said ]"
check "progress for programs" exits 3 weft convert in -o j.y4m --on-missing hold --temporal-width 1 --progress json
grep '^{' said | tail -n 1 >out
check "progress is JSON" value "d['frames_done'] == d['frames_total'] == 2"
check "progress for queues" exits 3 weft convert in -o a.y4m --on-missing hold --temporal-width 1 --progress alf
check "progress ends" says "ALF_PROGRESS 100%"

# ---- A reader that sleeps ----

# asleep SIGNAL CODE: a job whose standard output nobody reads ends within two seconds of the signal.
asleep()
{
    local pid began ended code
    mkfifo pipe
    sleep 20 <pipe &
    local reader=$!
    "$WEFT" convert in --on-missing hold --raster 1080i50 --subframe-rate 400 -o - >pipe 2>said &
    pid=$!
    sleep 1
    began=$(date +%s%N)
    kill -s "$1" $pid
    wait $pid
    code=$?
    ended=$(date +%s%N)
    kill $reader 2>/dev/null
    wait $reader 2>/dev/null
    rm pipe
    [ $code = "$2" ] && [ $((ended - began)) -lt 2000000000 ] ||
        { echo "status $code after $((ended - began)) ns"; return 1; }
}
check "SIGINT" asleep INT 130
check "SIGTERM" asleep TERM 143

finish
