#!/bin/bash
# weft verify on what is left of a file that was cut, at two hundred places: none of it passes.
. "$WEFT_SOURCE/tests/program/script.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96
. "$WEFT_SOURCE/tests/verify/verdicts.sh"

check "MXF of weft's own" made own.mxf --codec v210 "${small[@]}" --timecode 10:00:00:00 --audio silent:2
check "QuickTime" made m.mov --codec v210 "${small[@]}" --timecode 10:00:00:00 --audio silent:2
check "Matroska" made m.mkv --codec ffv1 "${small[@]}" --timecode 10:00:00:00 --audio silent:2
check "Y4M" made m.y4m "${small[@]}"
check "MXF of libavformat's" made i.mxf --codec imx50 --raster 625i --timecode 10:00:00:00 --audio silent:4 --frames 0-47
quiet_ffmpeg "${input[@]}" -c:v mpeg2video -c:a pcm_s16le others.mxf
quiet_ffmpeg "${input[@]}" -c:v mpeg2video -c:a aac last.mp4
quiet_ffmpeg "${input[@]}" -c:v mpeg2video -c:a aac -movflags +faststart first.mp4
quiet_ffmpeg "${input[@]}" -c:v ffv1 -c:a flac others.mkv
quiet_ffmpeg "${input[@]}" -c:v mpeg2video -c:a pcm_s16le others.avi
# Where the random index pack begins, its last byte, the last 200 bytes, and 200 places besides.
for file in own.mxf m.mov m.mkv others.mxf last.mp4 first.mp4 others.mkv others.avi; do
    check "no cut of $file passes" no_cut_passes $file 200 -200 -76 -60 -40 -17 -16 -8 -4
done
check "no cut of i.mxf passes" no_cut_passes i.mxf 20 -200 -76 -60 -4
check "no cut of m.y4m passes" no_cut_passes m.y4m 50
for file in own.mxf m.mov m.mkv i.mxf others.mxf last.mp4 first.mp4 others.mkv others.avi; do
    check "$file is whole itself" found whole $file right
done

finish
