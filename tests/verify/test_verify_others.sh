#!/bin/bash
# weft verify on files that others made and joined, on AVC-Intra, and on image sequences whose labels do not
# count on: what is wrong is told, and nothing else.
. "$WEFT_SOURCE/tests/program/script.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 32

check "v210" made a.mov --codec v210 --raster 525i --timecode "01:00:00;00" --audio silent:2
check "XDCAM" made x.mxf --codec xdcamhd422 --raster 1080i50 --timecode 10:00:00:00 --audio silent:8
# What others made and joined.
check "v210 of 1080" made h.mov --codec v210 --raster 1080i50 --timecode 10:00:00:00
quiet_ffmpeg -i h.mov -map 0:v -c copy -timecode 10:00:00:00 copied.mov
check "ffmpeg's copy is right" right copied.mov --profile v210-1080i
quiet_ffmpeg -i h.mov -map 0:v -c copy -write_tmcd 0 timecode.mov
check "timecode" only timecode timecode.mov --profile v210-1080i
check "which nobody asks for" right timecode.mov
quiet_ffmpeg -i h.mov -f lavfi -t 1 -i anullsrc=r=48000 -map 0:v -map 1 -c:v copy -c:a pcm_s24le -timecode 10:00:00:00 sound.mov
check "sound" only sound sound.mov
quiet_ffmpeg -i x.mxf -map 0 -c:v copy -c:a pcm_s16le -timecode 10:00:00:00 bits.mxf
check "sound bits" only "sound bits" bits.mxf --profile as-hdf01a
quiet_ffmpeg -i x.mxf -map 0:v -map 0:a:0 -map 0:a:1 -c copy -timecode 10:00:00:00 channels.mxf
check "channels" only channels channels.mxf --profile as-hdf01a

if ffmpeg -hide_banner -encoders 2>/dev/null | grep -q libx264; then
    check "AVC-Intra" made v.mxf --codec avci100 --raster 1080i50 --timecode 10:00:00:00 --audio silent:4
    check "is right" right v.mxf --profile as11-uk-dpp-hd
    check "start" wrong start v.mxf item 1501 0 0000000000000000 --profile as11-uk-dpp-hd
    quiet_ffmpeg -i v.mxf -map 0:v -c:v libx264 -g 1 -bf 0 -profile:v high422 -level 41 -pix_fmt yuv422p -flags +ildct+ilme \
        -top 1 -color_primaries 1 -color_trc 1 -colorspace 1 -x264-params aud=1 8.264
    check "as large as pictures of AVC-Intra" python3 "$WEFT_SOURCE/tests/verify/pad_pictures.py" 8.264 padded.264 568832
    quiet_ffmpeg -i padded.264 -i v.mxf -map 0:v -map 1:a -c copy -timecode 10:00:00:00 8.mxf
    check "bits" wrong bits 8.mxf item 3303 0 00 --profile as11-uk-dpp-hd
    check "tracks of AVC-Intra" made t.mxf --codec avci100 --raster 1080i50 --timecode 10:00:00:00 --audio silent:2
    check "tracks" only tracks t.mxf --profile as11-uk-dpp-hd
else
    skip_part "AVC-Intra, as there is no libx264"
fi

# ---- Image sequences ----

# Byte 3 of a DPX file's time code (SMPTE ST 268-1) is frames; byte 1928 is interlace.
poked() { printf '%b' "$3" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none; }
small=(--raster 180x122@25i,tff)
check "DPX" made s.####.dpx "${small[@]}" --timecode 10:00:00:23
check "labels that count on are right" right s.####.dpx "${small[@]}"
check "and told" prints "10:00:00:23, in"
poked s.0001.dpx 1923 '\x23'
check "a label twice" only labels s.####.dpx "${small[@]}"
check "the one that it should be is told" grep -q '"should": "10:00:00:24"' out
poked s.0001.dpx 1923 '\x24'
for file in s.*.dpx; do poked "$file" 1928 '\x00'; done
check "fields that are not said to be" only interlace s.####.dpx "${small[@]}"
check "EXR" made s.####.exr "${small[@]}" --timecode 10:00:00:23
check "its labels" right s.####.exr "${small[@]}"
rm s.0001.exr && cp s.0000.exr s.0001.exr
check "are looked at" exits 1 weft verify --json s.####.exr "${small[@]}"
check "one by one" grep -q '"should": "10:00:00:24"' out

finish
