#!/bin/bash
# The program as its users run it: moving pictures to video that other tools must read and find
# interlaced the right way; pipes, full devices and signals.
. "$WEFT_SOURCE/tests/program/script.sh"

not_sanitized "test_jobs.sh writes video"
subframes in 64
rate=480000/1001

# ---- Field order, as others see it ----

# fields FILE WORD: more frames of this kind than of any other. idet prints TFF:, BFF:, Progressive:.
fields()
{
    ffmpeg -nostdin -hide_banner -i "$1" -vf idet -f null - 2>&1 | tee idet.log |
        awk -v want="$2" '/Multi frame/ { for (i = 1; i < NF; i++) if ($(i + 1) ~ /^[0-9]+$/) n[$i] = $(i + 1) }
            END { for (k in n) if (k != want ":" && n[k] >= n[want ":"]) exit 1; exit !n[want ":"] }' ||
        { cat idet.log; return 1; }
}

check "525i" exits 0 "$WEFT" convert in/subframe.####.exr -o 525i.y4m --temporal-width 1
check "1080i50" exits 0 "$WEFT" convert in/subframe.####.exr --subframe-rate 400 --raster 1080i50 \
    -o 1080i.y4m --aperture line
check "1080p" exits 0 "$WEFT" convert in/subframe.####.exr --subframe-rate 400 --raster 1080p50 -o p.y4m
if has ffmpeg; then
    check "525i is bottom field first" fields 525i.y4m BFF
    check "1080i50 is top field first" fields 1080i.y4m TFF
    check "1080p50 is progressive" fields p.y4m Progressive
fi

# ---- What readers make of the files ----

# told FILE KEY VALUE: ffprobe's word.
told()
{
    local got
    got=$(stream "$1" "stream=$2")
    same "${got%,}" "$3"
}

# same_frames A B: the frames of two files are equal, bit for bit.
same_frames()
{
    local a b
    a=$(ffmpeg -nostdin -v error $3 -i "$1" -pix_fmt yuv422p10le -f md5 -) || return 1
    b=$(ffmpeg -nostdin -v error $4 -i "$2" -pix_fmt yuv422p10le -f md5 -) || return 1
    [ "$a" = "$b" ] || { echo "$1 and $2 differ"; return 1; }
}

for bits in 8 10 12; do
    check "$bits bits" exits 0 "$WEFT" convert in/subframe.####.exr --bits $bits -o bits$bits.y4m
done
check "444" exits 0 "$WEFT" convert in/subframe.####.exr --chroma 444 -o 444.y4m
check "v210" exits 0 "$WEFT" convert in/subframe.####.exr -o out.v210
check "uyvy" exits 0 "$WEFT" convert in/subframe.####.exr -o out.uyvy
for kind in dpx tif png exr; do
    check "$kind" exits 0 "$WEFT" convert in/subframe.####.exr -o "pictures.####.$kind"
done
if has ffprobe; then
    check "size" told 525i.y4m width,height 720,486
    check "rate" told 525i.y4m r_frame_rate 30000/1001
    check "aspect" told 525i.y4m sample_aspect_ratio 10:11
    check "bottom first" told 525i.y4m field_order bb
    check "top first" told 1080i.y4m field_order tt
    check "progressive" told p.y4m field_order progressive
    check "10 bits" told 525i.y4m pix_fmt yuv422p10le
    check "8 bits" told bits8.y4m pix_fmt yuv422p
    check "12 bits" told bits12.y4m pix_fmt yuv422p12le
    check "4:4:4" told 444.y4m pix_fmt yuv444p10le
    raw="-video_size 720x486 -framerate 30000/1001"
    check "v210 is the Y4M" same_frames bits10.y4m out.v210 "" "-f v210 $raw"
    check "uyvy is the 8-bit Y4M" same_frames bits8.y4m out.uyvy "" "-f rawvideo $raw -pixel_format uyvy422"
    for kind in dpx tif png exr; do
        check "$kind is read" exits 0 ffmpeg -nostdin -v error -i "pictures.%04d.$kind" -f null -
    done
fi
if has mediainfo; then
    check "MediaInfo reads Y4M" grep -q "^720 486 30000" <(mediainfo --Inform="Video;%Width% %Height% %FrameRate_Num%" 525i.y4m)
fi

# ---- Streams ----

"$WEFT" convert in/subframe.####.exr --temporal-width 1 -o - >piped.y4m
check "standard output has the same bytes" cmp 525i.y4m piped.y4m
check "a full device" exits 1 bash -c "'$WEFT' convert in/subframe.####.exr -o - >/dev/full"
check "a full device is named" grep -qi "space" said
closed() { "$WEFT" convert in/subframe.####.exr -o - 2>said | head -c 100 >/dev/null; [ "${PIPESTATUS[0]}" = 1 ]; }
check "a closed pipe" closed
check "a closed pipe is named" grep -qi "pipe" said

# ---- Signals ----

stopped()
{
    interrupted "$1" "$2" 0.5 "$WEFT" convert in/subframe.####.exr --threads 1 --raster 2160p25 \
        --subframe-rate 200 --aperture shaped --temporal-width 2 -o left/long.y4m
}
check "SIGINT" stopped INT 130
check "SIGTERM" stopped TERM 143
check "SIGKILL" stopped KILL 137

finish
