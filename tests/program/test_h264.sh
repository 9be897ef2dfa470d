#!/bin/bash
# H.264 in MP4 and QuickTime: the order of fields in its stream, both ways, and its chroma.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh writes containers"
needs_libav
needs ffmpeg ffprobe
subframes in 64

# ordered FILE ORDER: every frame of the stream says that it is so, and the pixels are.
ordered()
{
    local first=1
    [ "$2" = top ] || first=0
    ffprobe -v error -select_streams v -show_entries frame=interlaced_frame,top_field_first -of csv=p=0 "$1" |
        sed 's/,*$//' | sort -u | grep -qx "1,$first" || { echo "$1: the stream does not say $2 first"; return 1; }
    exits 0 weft verify "$1" --raster "$3" || return 1
}
for bits in 8 10; do
    rm -f ./?.mov ./?.mp4
    for ending in mp4 mov; do
        check "H.264 of $bits bits in .$ending, top first" made t.$ending --codec h264 --raster 1080i50 --bits $bits
        check "says so" ordered t.$ending top 1080i50
        check "H.264 of $bits bits in .$ending, bottom first" made b.$ending --codec h264 --raster 525i-dv --bits $bits
        check "says so" ordered b.$ending bottom 525i-dv
    done
done
# alike A B: the mean of each component is that of the other within half a code of 8 bits.
alike()
{
    local name
    for name in "$1" "$2"; do
        ffmpeg -nostdin -v error -i "$name" -vf scale=flags=accurate_rnd,format=yuv444p,signalstats,metadata=print:file=- \
            -f null - | sed -n 's/.*\.[YUV]AVG=//p' >"$name.means"
    done
    paste "$1.means" "$2.means" | awk '{ d = $1 - $2; if (d > .5 || d < -.5) exit 1 }'
}
rm -f ./*.mov ./*.mp4
made c.mov --codec h264 --raster 525i --bits 8
check "480 of 486 lines" eval "ffprobe -v error -show_entries stream=height,pix_fmt -of csv=p=0 c.mov | grep -q '480,yuv420p'"
check "are still bottom first" ordered c.mov bottom 525i-dv
made c.y4m --raster 1080i50 --bits 8
made c.mp4 --codec h264 --raster 1080i50 --bits 8
check "its colors are those of 4:2:2" alike c.y4m c.mp4
made c2.mp4 --codec h264 --raster 1080i50 --bits 8 --threads 1
check "the same bytes of any threads" cmp c.mp4 c2.mp4
made hlg.mp4 --codec h264 --raster 1080i50 --bits 10 --to rec2100-hlg
check "HLG has the matrix of 2020" eval "ffprobe -v error -show_entries stream=color_space,color_transfer,color_primaries \
    -of csv=p=0 hlg.mp4 | grep -q bt2020nc,arib-std-b67,bt2020"
check "and is right" exits 0 weft verify hlg.mp4 --raster 1080i50

finish
