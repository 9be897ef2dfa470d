#!/bin/bash
# weft verify on cuts of what does not say where it ends: streams of transport and of programs, live Matroska, MP4 in
# pieces, elementary streams, and raw frames. At two hundred places, and between packets, none is called whole.
. "$WEFT_SOURCE/tests/program/script.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96
. "$WEFT_SOURCE/tests/verify/verdicts.sh"

groups=(-c:v mpeg2video -g 4 -bf 2)
quiet_ffmpeg "${input[@]}" "${groups[@]}" -c:a mp2 t.ts
quiet_ffmpeg "${input[@]}" "${groups[@]}" -c:a mp2 -mpegts_m2ts_mode 1 -f mpegts t.m2ts
quiet_ffmpeg "${input[@]}" "${groups[@]}" -c:a mp2 p.mpg
quiet_ffmpeg "${input[@]}" "${groups[@]}" -an e.m2v
quiet_ffmpeg "${input[@]}" "${groups[@]}" -c:a aac -movflags frag_keyframe+empty_moov pieces.mp4
quiet_ffmpeg "${input[@]}" "${groups[@]}" -c:a aac -movflags frag_keyframe first.mp4
quiet_ffmpeg "${input[@]}" -f matroska -c:v ffv1 -c:a pcm_s16le - >live.mkv
quiet_ffmpeg "${input[@]}" -c:v ffv1 f.nut
for file in t.ts t.m2ts p.mpg e.m2v pieces.mp4 live.mkv f.nut; do
    check "no cut of $file passes" no_cut_passes $file 200 -200 -17 -4
done
check "nor one between packets" no_cut_passes t.ts 0 every:188
check "nor of those with a time" no_cut_passes t.m2ts 0 every:192
check "nor between packs" no_cut_passes p.mpg 0 every:2048
for file in t.ts t.m2ts p.mpg e.m2v live.mkv f.nut; do
    check "$file may go on" found whole $file open
done

# A picture that is cut between packets is told by its decoder; one that fills its last packet may be whole.
quiet_ffmpeg "${input[@]}" -c:v mpeg2video -c:a mp2 whole.ts
head -c $((188 * 34)) whole.ts >between.ts
check "a picture that is cut between packets" found reading between.ts wrong

# Of MP4 in pieces the header counts the first at most.
for file in pieces.mp4 first.mp4; do
    check "$file has its index at its end" found whole $file right
    check "its frames are not counted" found frames $file open
    check "its length is not that of its first piece" found durations $file open
    python3 -c 'import sys
data = open(sys.argv[1], "rb").read()
open("cut.mp4", "wb").write(data[:data.rindex(b"mfra") - 4])' $file
    check "without that it may go on" found whole cut.mp4 open
done

# ---- Frames one after the other ----

for ending in y4m v210 uyvy; do
    check "$ending" made r.$ending "${small[@]}"
    RASTER=180x122@25i,tff check "no cut of $ending passes" no_cut_passes r.$ending 50
    check "$ending is right" right r.$ending "${small[@]}"
    check "$ending may go on" eval "prints 'open   whole'"
done
frame=$(($(stat -c %s r.v210) / 6))
RASTER=180x122@25i,tff check "nor between frames" no_cut_passes r.v210 0 every:$frame

# RGB in a container is held to it too.
quiet_ffmpeg "${input[@]}" -an -c:v ffv1 -pix_fmt gbrp rgb.mkv
check "RGB in Matroska" found whole rgb.mkv right
check "no cut of it passes" no_cut_passes rgb.mkv 50

finish
