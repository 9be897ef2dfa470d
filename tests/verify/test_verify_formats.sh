#!/bin/bash
# weft verify on files that have the container, size and codec of a delivery and are not the format: each fails what it
# is not, and nothing else.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/verify/foreign.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96

made h.y4m --raster 1080i50 && made t.y4m --raster 625i
fields=(-flags +ildct+ilme)
tags=(-color_primaries 1 -color_trc 1 -colorspace 1)
tags625=(-color_primaries 5 -color_trc 6 -colorspace 5)
clock=(-timecode 10:00:00:00)
silence=(-f lavfi -i anullsrc=r=48000:cl=mono)
# tracks COUNT: options that map so many mono tracks of the silence, which is input 1.
tracks() { local k; echo -map 0:v; for ((k = 0; k < $1; k++)); do echo -map 1:a; done; }
sited() { patched "$1" "$2" item 3303 0 00; }
# foreign NAME TRACKS OPTION..: MXF of an hour's 1080i50, of another encoder.
foreign()
{
    local name=$1 count=$2
    shift 2
    # shellcheck disable=SC2046
    ff -i h.y4m "${silence[@]}" $(tracks "$count") "$@" "${fields[@]}" "${tags[@]}" "${clock[@]}" -c:a pcm_s24le \
        -shortest whole.mxf && sited whole.mxf "$name"
}

# ---- MPEG-2 ----

mpeg2=(-c:v mpeg2video -pix_fmt yuv422p -profile:v 0 -level:v 2 -g 12 -bf 2 -dc 10 -intra_vlc 1 -non_linear_quant 1
    -minrate 50M -maxrate 50M -b:v 50M -bufsize 36408333 -qmin 1 -qmax 28)
check "XDCAM HD422 of another encoder" foreign x.mxf 8 "${mpeg2[@]}"
check "is the format" found x.mxf "" "not_checked" --profile as-hdf01a
check "8 Mb/s" foreign 8.mxf 8 "${mpeg2[@]}" -b:v 8M -minrate 8M -maxrate 8M
check "is not" found 8.mxf "bit_rate" "" --profile as-hdf01a
check "35 Mb/s of 4:2:0" foreign 35.mxf 8 "${mpeg2[@]}" -pix_fmt yuv420p -profile:v 4 -level:v 4 -b:v 35M -minrate 35M -maxrate 35M
check "nor is that" found 35.mxf "codec_profile level chroma bit_rate" "" --profile as-hdf01a
check "long groups" foreign g.mxf 8 -vf loop=2:6:0 "${mpeg2[@]}" -g 100
check "are none of this format" found g.mxf "groups" "" --profile as-hdf01a
check "every picture whole" foreign intra.mxf 8 "${mpeg2[@]}" -g 1 -bf 0
check "is no group" found intra.mxf "groups" "" --profile as-hdf01a
check "four tracks" foreign 4.mxf 4 "${mpeg2[@]}"
check "are not eight" found 4.mxf "channels" "" --profile as-hdf01a
ff -i x.mxf -map 0:v -map 0:a:0 -c copy -f mxf "${clock[@]}" - >pipe.mxf
check "through a pipe its header stays open" found pipe.mxf "header partitions channels" "" --profile as-hdf01a

made i.mxf --codec imx50 --raster 625i --timecode 10:00:00:00 --audio silent:4
d10=(-vf pad=720:608:0:32,setfield=tff -c:v mpeg2video -pix_fmt yuv422p -g 1 "${fields[@]}" -flags +ildct+ilme+low_delay
    -dc 10 -intra_vlc 1 -non_linear_quant 1 -ps 1 -qmin 1 -qmax 12 -rc_max_vbv_use 1 -rc_min_vbv_use 1 -top 1)
imx()
{
    ff -i t.y4m -f lavfi -i anullsrc=r=48000:cl=4.0 "${d10[@]}" -b:v "$2" -minrate "$2" -maxrate "$2" -bufsize "$3" -rc_init_occupancy "$3" \
        "${tags625[@]}" -aspect 4:3 "${clock[@]}" -c:a pcm_s24le -shortest -f mxf_d10 "$1"
}
check "D-10 of 30 Mb/s" imx 30.mxf 30M 1200000
check "is not of 50" found 30.mxf "frame_size" "" --profile imx50-625
check "nor of 40" imx 40.mxf 40M 1600000
check "is it" found 40.mxf "frame_size" "" --profile imx50-625

# ---- H.264 ----

if ffmpeg -hide_banner -encoders 2>/dev/null | grep -q libx264; then
    check "AVC-Intra 100 of another encoder" foreign v.mxf 4 -c:v libx264 -avcintra-class 100 -pix_fmt yuv422p10le
    check "is the format" found v.mxf "" "not_checked" --profile as11-uk-dpp-hd
    check "12 Mb/s with long groups" foreign 12.mxf 4 -c:v libx264 -b:v 12M -pix_fmt yuv422p10le -level 41
    check "is not" found 12.mxf "codec_profile groups frame_size" "" --profile as11-uk-dpp-hd
    check "AVC-Intra 50" foreign 50.mxf 4 -c:v libx264 -avcintra-class 50 -pix_fmt yuv420p10le -s 1440x1080
    check "is another class" found 50.mxf "codec_profile level chroma frame_size size" "" --profile as11-uk-dpp-hd
    check "whole pictures of any size" foreign any.mxf 4 -c:v libx264 -g 1 -bf 0 -profile:v high422 -pix_fmt yuv422p10le -level 41
    check "are not of one size" found any.mxf "frame_size" "" --profile as11-uk-dpp-hd
else
    skip_part "H.264, as there is no libx264"
fi
finish
