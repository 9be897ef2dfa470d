#!/bin/bash
# The command line itself: help, what it refuses and how it says so, exit codes.
. "$WEFT_SOURCE/tests/program/script.sh"

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

finish
