#!/bin/bash
# weft verify: a file for each check that no other script fails alone, and profiles of H.264 and of fill with key.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/verify/foreign.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 48

# spoiled WHAT FROM CHECK PROFILE
spoiled()
{
    python3 "$WEFT_SOURCE/tests/verify/one_thing.py" "$1" "$2" spoiled.mxf && only "$3" spoiled.mxf --profile "$4"
}

check "XDCAM HD422" made x.mxf --raster 1080i50 --timecode 10:00:00:00 --audio silent:8
check "is right" right x.mxf --profile as-hdf01a
check "codec profile" spoiled profile x.mxf "codec profile" as-hdf01a
check "level" spoiled level x.mxf level as-hdf01a
check "partitions" spoiled open x.mxf partitions as-hdf01a
check "sound codec" spoiled big-endian x.mxf "sound codec" as-hdf01a
ff -i x.mxf -f lavfi -i anullsrc=r=48000:cl=7.1 -map 0:v -map 1:a -c:v copy -c:a pcm_s24le -shortest -timecode 10:00:00:00 mono.mxf
check "mono" only mono mono.mxf --profile as-hdf01a

made h.y4m --raster 1080i50
for ((k = 0; k < 8; k++)); do eight+=(-map 1:a); done
ff -i h.y4m -f lavfi -i anullsrc=r=48000:cl=mono -map 0:v "${eight[@]}" -c:v mpeg2video -pix_fmt yuv420p -profile:v 0 -level:v 2 \
    -g 12 -bf 2 -dc 10 -intra_vlc 1 -non_linear_quant 1 -minrate 50M -maxrate 50M -b:v 50M -bufsize 36408333 -qmin 1 -qmax 28 \
    -flags +ildct+ilme -color_primaries 1 -color_trc 1 -colorspace 1 -timecode 10:00:00:00 -c:a pcm_s24le -shortest chroma.mxf
check "chroma" only chroma chroma.mxf --profile as-hdf01a

check "D-10" made i.mxf --codec imx50 --raster 625i --timecode 10:00:00:00 --audio silent:4
check "is right" right i.mxf --profile imx50-625
ff -i i.mxf -f lavfi -i anullsrc=r=48000:cl=mono -map 0:v -map 1:a -map 1:a -map 1:a -map 1:a -c:v copy -c:a pcm_s24le -shortest \
    -timecode 10:00:00:00 streams.mxf
check "one stream" only "one stream" streams.mxf --profile imx50-625

# ---- Fill with key ----

for fill in straight premultiplied; do
    check "$fill" made $fill.mov --codec prores-4444 --raster 1080i50 --alpha-out --fill $fill --timecode 10:00:00:00 --audio silent:2
    check "$fill is right" right $fill.mov --profile prores-4444
    check "$fill is said" prints "right  alpha      $fill"
done
patched straight.mov unsaid.mov atom vmhd 4 0000
check "a fill that is not said" found unsaid.mov "" "alpha" --profile prores-4444
check "4444 without alpha" made none.mov --codec prores-4444 --raster 1080i50 --timecode 10:00:00:00
check "is no key" only alpha none.mov --profile prores-4444
made 422.mov --codec prores --raster 1080i50 --timecode 10:00:00:00
check "422 is neither" found 422.mov "codec_profile alpha bits" "" --profile prores-4444

# ---- H.264 ----

if ffmpeg -hide_banner -encoders 2>/dev/null | grep -q libx264; then
    while read -r name raster profile bits; do
        check "$name" made "$name" --codec h264 --raster "$raster" --bits "$bits"
        check "$name is right" right "$name" --profile "$profile"
    done <<'END_OF_TABLE'
525i.mp4 525i h264 8
625i.mov 625i h264 8
1080i50.mp4 1080i50 h264 8
720p50.mov 720p50 h264 8
10bits.mp4 625i h264-422 10
10bits.mov 525i h264-422 10
END_OF_TABLE
    check "which are not 8" found 10bits.mov "codec_profile chroma bits" "" --profile h264
    check "all top first by libx264" ff -i h.y4m -vf setfield=bff -c:v libx264 -flags +ildct+ilme -x264-params bff=1 -pix_fmt yuv420p \
        -color_primaries 1 -color_trc 1 -colorspace 1 bff.mp4
    check "and not so" found bff.mp4 "flags" "" --profile h264
    check "MPEG-2 in MP4" ff -i h.y4m -c:v mpeg2video -pix_fmt yuv420p -flags +ildct+ilme -color_primaries 1 -color_trc 1 -colorspace 1 mpeg2.mp4
    check "is no H.264" found mpeg2.mp4 "codec" "" --profile h264
else
    skip_part "H.264, as there is no libx264"
fi
finish
