#!/bin/bash
# weft verify on files with the conventions of other makers, which are right or open and never wrong.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/verify/foreign.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96
tools=$WEFT_SOURCE/tests/verify

fields=(-flags +ildct+ilme)
dvd=(-c:v mpeg2video -b:v 8M "${fields[@]}")
made t.y4m --raster 625i && made b.y4m --raster 525i-dv && made r.y4m --raster 525i-rp202 && made h.y4m --raster 1080i50
made p.y4m --raster 720x480@29.97p,par=10:11,601-525

# ---- Elementary, program and transport streams ----

ff -i t.y4m "${dvd[@]}" -aspect 4:3 dar.m2v
check "MPEG-2 has the shape of the picture" found dar.m2v "" "aspect colors timecode"
ff -i t.y4m "${dvd[@]}" -aspect 16:9 wide.m2v
check "16:9" found wide.m2v "" "aspect"
check "which is that of wide rasters" found wide.m2v "colors" "aspect" --raster 625i-wide
check "and of no others" found wide.m2v "aspect colors" "" --raster 625i
ff -i r.y4m "${dvd[@]}" -aspect 4:3 ntsc.m2v
check "a rate of its own" found ntsc.m2v "" "aspect"
check "30000/1001" grep -q '"is": "30000/1001"' out
ff -i r.y4m "${dvd[@]}" -aspect 4:3 ntsc.mpg
check "program stream" found ntsc.mpg "" "whole aspect durations"
ff -i r.y4m "${dvd[@]}" -aspect 4:3 ntsc.ts
check "transport stream" found ntsc.ts "" "whole aspect durations"
ff -i r.y4m "${dvd[@]}" -aspect 4:3 -bf 2 -c:a mp2 b.ts
check "with B pictures" found b.ts "" "whole aspect"

# ---- Film on fields ----

ff -i p.y4m "${dvd[@]}" -bf 0 -aspect 4:3 coded.m2v && python3 "$tools/soft_telecine.py" coded.m2v film.m2v
check "repeated fields" found film.m2v "" "flags"
ff -i film.m2v -c copy film.mpg
check "in a program stream" found film.mpg "" "flags whole"
ff -i film.m2v -c copy film.mov
check "in QuickTime" found film.mov "" "flags fiel"

# ---- Pairs of fields, and fields by macroblock ----

python3 "$tools/field_pairs.py" top.264 720 576 8 top
python3 "$tools/field_pairs.py" bottom.264 720 576 8 bottom
check "pairs of fields" found top.264 "" "timecode"
for to in ts mkv mp4 mov; do
    ff -framerate 25 -i top.264 -c copy top.$to
    check "the same in $to" found top.$to "" "timecode"
    check "frames, and not fields" grep -q '"is": "25/1"' out
done
ff -framerate 25 -i bottom.264 -c copy bottom.mkv
check "bottom first" found bottom.mkv "flags order" "" --raster 625i
if ffmpeg -hide_banner -encoders 2>/dev/null | grep -q libx264; then
    for to in mp4 mkv ts; do
        ff -i t.y4m -c:v libx264 -bf 2 "${fields[@]}" mbaff.$to
        check "fields by macroblock in $to" found mbaff.$to "" "timecode"
    done
else
    skip_part "fields by macroblock, as there is no libx264"
fi

# ---- Containers of others ----

ff -i t.y4m "${dvd[@]}" -bf 0 -aspect 4:3 whole.mp4 && ff -ss 0.1 -i whole.mp4 -c copy trimmed.mp4
check "pictures that an edit list leaves out" found trimmed.mp4 "" "timecode"
check "are not missed" grep -q '"is": "6 said, 3 there"' out

ff -i h.y4m -c:v dnxhd -b:v 120M -pix_fmt yuv422p "${fields[@]}" -f mxf_opatom atom.mxf
check "OP-Atom" found atom.mxf "" "pattern"
check "is not for a profile" found atom.mxf "colors pattern" "" --profile dnxhd-1080i50
for to in avi dv mov mkv; do
    ff -i b.y4m -c:v dvvideo -pix_fmt yuv411p -aspect 4:3 d.$to
done
check "DV alone" found d.dv "" "colors"
check "DV in AVI" found d.avi "" "durations"
check "DV in QuickTime" found d.mov "" "clap"
check "DV in Matroska" found d.mkv "" "timecode"

made v.mov --codec v210 --raster 1080i50 && made s.mov --codec v210 --raster 625i
ff -i v.mov -map 0:v -c copy -write_tmcd 0 untimed.mov
check "no time code" found untimed.mov "" "timecode"
patched v.mov clap.mov atom clap 0 00000760000000010000042600000001
check "1888x1062" found clap.mov "" "clap"
patched s.mov 702.mov atom clap 0 000002be00000001
check "702x576" found 702.mov "" "clap"
patched s.mov par.mov atom pasp 0 0000003b00000036
check "59:54" found par.mov "" "aspect"
patched s.mov square.mov atom pasp 0 0000000100000001
check "but not 1:1" found square.mov "aspect" ""

finish
