#!/bin/bash
# weft verify on more files with the conventions of other makers, copies from container to container above all: right or
# open; and on files that are near to these and wrong.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/verify/foreign.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96

fields=(-flags +ildct+ilme)
tags=(-color_primaries 1 -color_trc 1 -colorspace 1)
tone=(-f lavfi -i sine=r=48000)
made h.y4m --raster 1080i50 && made n.y4m --raster 525i && made t.y4m --raster 625i
made p.y4m --raster 720x576@25p,par=12:11,601-625

# ---- Lengths ----

ff -i n.y4m "${tone[@]}" -c:v mpeg2video "${fields[@]}" -bf 2 -aspect 4:3 -c:a aac -shortest late.mkv
check "video that begins after its sound does" found late.mkv "" "frames"
made dv.mov --codec dvcpro50 --raster 525i-dv
ff -i dv.mov -c copy dv.avi
check "AVI counts ticks" found dv.avi "" "durations"
made ff.mkv --codec ffv1 --raster 525i --audio silent:2
ff -i ff.mkv -map 0 -c copy rounded.mov
check "times in milliseconds" found rounded.mov "" "clap"
check "are of 30000/1001" grep -q '"is": "30000/1001"' out
ff -i t.y4m -f lavfi -i sine=r=44100 -c:v mpeg2video "${fields[@]}" -aspect 4:3 -c:a aac -ar 44100 -shortest 44.mp4
check "sound of another rate" found 44.mp4 "" "sound"
ff -i t.y4m -c:v mpeg2video -b:v 50M -pix_fmt yuv422p -g 1 "${fields[@]}" -aspect 4:3 -f gxf fields.gxf
check "GXF counts fields" found fields.gxf "" "whole frames"
check "and has frames" grep -q '"is": "25/1"' out

# ---- Labels ----

made v.mov --codec v210 --raster 525i
ff -i n.y4m -c:v v210 -color_primaries 6 -color_trc 6 -colorspace 6 -aspect 4:3 all.mov
check "a clean aperture of all" found all.mov "" "clap"
made x.mxf --raster 1080i50 --audio silent:2
ff -i x.mxf -map 0 -c copy x.mov
check "fields apart of MPEG-2, which weaves them" found x.mov "" "fiel"
patched x.mov bottom.mov atom fiel 0 0206
check "in the wrong order" found bottom.mov "flags coded fiel" "" --raster 1080i50
patched v.mov apart.mov atom fiel 0 0206
check "of v210, which does not" found apart.mov "fiel" "" --raster 525i
made i.mxf --codec imx50 --raster 625i --audio silent:4
for ending in mov mkv; do
    ff -i i.mxf -map 0 -c copy i.$ending
    check "608 lines of 4:3 in $ending" found i.$ending "" "aspect"
done
check "which no other shape is" found i.mov "aspect" "" --raster 625i-wide

# ---- Progressive ----

ff -i p.y4m -c:v mpeg2video -b:v 8M -aspect 4:3 whole.mpg
check "576 lines of whole pictures" found whole.mpg "" "aspect"
check "are called so" grep -q '"name": "720x576@25p"' out
check "and not what has fields" found whole.mpg "flags colors" "" --raster 625i
ff -i t.y4m -vf setfield=prog -c:v mpeg2video -b:v 8M -aspect 4:3 lies.mpg
check "unless they show fields" found lies.mpg "order" ""
ff -i p.y4m -c:v mpeg1video -s 352x288 -b:v 1150k vcd.mpg
check "MPEG-1 has no fields" found vcd.mpg "" "colors"
finish
