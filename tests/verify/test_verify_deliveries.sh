#!/bin/bash
# What weft delivers in every codec, of either order where the codec has both, passes its own profile, says its order to
# ffprobe and MediaInfo, and shows it to idet or to a vote of blocks.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/verify/foreign.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96
has mediainfo && mediainfo=yes
ffmpeg -hide_banner -encoders 2>/dev/null | grep -q libx264 && x264=yes

# say_mixed_order FILE ORDER: of mixed fields ffprobe has none, and MediaInfo says which beside "progressive".
say_mixed_order()
{
    same "$(stream "$1" stream=field_order)" unknown || return 1
    local first=TFF
    [ "$2" = top ] || first=BFF
    [ -z "${mediainfo:-}" ] || same "$(mediainfo --Inform='Video;%ScanOrder%' "$1")" $first
}

# say_order FILE ORDER: ffprobe's and MediaInfo's words for it.
say_order()
{
    local word
    case $codec:$1 in v210:*.mxf | uyvy:*.mxf) say_mixed_order "$@"; return ;; esac
    word=$(stream "$1" stream=field_order)
    case "$2:${word%%,*}" in
    top:tt | top:tb | bottom:bb | bottom:bt) ;;
    *) echo "ffprobe: $word, not $2"; return 1 ;;
    esac
    [ -n "${mediainfo:-}" ] || return 0
    word=$(mediainfo --Inform='Video;%ScanType% %ScanOrder%' "$1")
    case "$2:$word" in
    top:Interlaced\ TFF | top:MBAFF\ TFF | bottom:Interlaced\ BFF | bottom:MBAFF\ BFF) ;;
    *) echo "MediaInfo: $word, not $2"; return 1 ;;
    esac
}

# shows_order FILE ORDER: most frames to idet, or the blocks to weft.
shows_order()
{
    local first=TFF
    [ "$2" = top ] || first=BFF
    ffmpeg -nostdin -hide_banner -i "$1" -vf idet -f null - 2>&1 |
        grep -Eq "Multi frame detection:.*$first: *[1-9]" || verdict "$1" "$(echo $first | tr A-Z a-z)"
}

count=0
while read -r name codec raster order profile sound; do
    [ "$codec" = avci100 ] || [ "$codec" = h264 ] && [ -z "${x264:-}" ] && { skip_part "no libx264 for $name"; continue; }
    silence=() options=()
    [ "$sound" = 0 ] || silence=(--audio "silent:$sound")
    check "$name" made "$name" --codec "$codec" --raster "$raster" --timecode 10:00:00:00 "${silence[@]}"
    [ "$profile" = - ] || options=(--profile "$profile")
    check "$name is right" right "$name" "${options[@]}"
    check "$name: its order is said" say_order "$name" "$order"
    check "$name: its order is seen" shows_order "$name" "$order"
    count=$((count + 1))
done <<'END_OF_TABLE'
v525.mov v210 525i bottom v210-525 2
v625.mov v210 625i top v210-625 8
v1080.mov v210 1080i50 top v210-1080i 2
p50.mov prores 1080i50 top prores-1080i50 4
p525.mov prores-hq 525i bottom - 2
d50.mov dnxhd 1080i50 top dnxhd-1080i50 2
d59.mxf dnxhd 1080i59.94 top dnxhd-1080i59.94 2
x50.mov xdcamhd422 1080i50 top - 2
x50.mxf xdcamhd422 1080i50 top as-hdf01a 8
x59.mxf xdcamhd422 1080i59.94 top xdcamhd422-1080i59.94 4
dv525.mov dvcpro50 525i-dv bottom dvcpro50-525 2
dv625.mxf dvcpro50 625i-dv bottom dvcpro50-625 2
a50.mxf avci100 1080i50 top as11-uk-dpp-hd 4
a59.mov avci100 1080i59.94 top - 2
i625.mxf imx50 625i top imx50-625 4
i525.mxf imx50 525i-imx top imx50-525 8
r525.mxf v210 525i bottom - 2
u625.mxf uyvy 625i top - 2
f525.mkv ffv1 525i bottom ffv1-archive 2
f625.mkv ffv1 625i top ffv1-archive 2
h525.mp4 h264 525i bottom - 0
h625.mov h264 625i top - 2
END_OF_TABLE
check "all were looked at" test $count -ge 19
finish
