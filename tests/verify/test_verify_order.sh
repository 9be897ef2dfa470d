#!/bin/bash
# weft verify on files that say a wrong order of fields, or none where their raster has one.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/verify/foreign.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96

tags625=(-color_primaries bt470bg -color_trc gamma28 -colorspace bt470bg)
made t.y4m --raster 625i && made h.y4m --raster 1080i50
made v.mov --codec v210 --raster 1080i50 && made s.mov --codec v210 --raster 625i
ff -i t.y4m -vf setfield=bff -strict -1 w.y4m

patched s.mov unsaid.mov atom fiel -4 66726565
check "no order, which 625 lines want" found unsaid.mov "flags fiel" ""
patched v.mov unsaid1080.mov atom fiel -4 66726565
check "nor 1080 lines whose pixels show fields" found unsaid1080.mov "flags fiel" ""
ff -i t.y4m -c:v huffyuv -pix_fmt yuv422p -aspect 4:3 unsaid.avi
check "AVI cannot say it" found unsaid.avi "flags" "aspect"
sed '1s/ It / I? /' h.y4m >unsaid.y4m
check "Y4M need not" found unsaid.y4m "flags" ""
check "which a raster asks for" found unsaid.y4m "flags" "" --raster 1080i50
sed '1s/ It / I? /' t.y4m >unsaid625.y4m
check "or has alone" found unsaid625.y4m "flags" ""
ff -f lavfi -i color=gray:s=1920x1080:r=25:d=0.1 -pix_fmt yuv422p10 -strict -1 gray.y4m
sed -i '1s/ Ip / I? /' gray.y4m
check "a still of 1080 lines may be progressive" found gray.y4m "" "flags"
ff -i t.y4m -c:v ffv1 -aspect 4:3 "${tags625[@]}" said.mkv
check "Matroska says it" found said.mkv "" "aspect colors"
ff -i w.y4m -c:v ffv1 -aspect 4:3 "${tags625[@]}" lies.mkv
check "wrong in what it says" found lies.mkv "flags" "aspect" --raster 625i
check "wrong in its pixels" found w.y4m "order" "" --raster 720x576@25i,bff,par=12:11,601-625
made b625.y4m --raster 720x576@25i,bff,par=12:11,601-625
ff -i t.y4m -i b625.y4m -filter_complex "[0:v]crop=360:576:0:0[l];[1:v]crop=360:576:360:0[r];[l][r]hstack,setfield=tff" -strict -1 halves.y4m
check "two halves in two orders have none" found halves.y4m "" "order" --raster 720x576@25i,tff,par=12:11,601-625

# A wheel whose spokes alias: idet calls it bottom first. It is no such thing.
wheel=${WEFT_SHARED:-}/data/wheel
if [ -d "$wheel" ]; then
    check "a wheel" exits 0 weft convert "$wheel" --raster 625i --subframe-rate 480 -q -o wheel.mov
    check "whose spokes alias is not wrong" found wheel.mov "" "order"
    check "the same of 525 lines" exits 0 weft convert "$wheel" --raster 525i --subframe-rate 480000/1001 -q -o wheel525.mov
    check "is right" found wheel525.mov "" ""
else
    skip_part "the wheel, as the sample data is not here"
fi
finish
