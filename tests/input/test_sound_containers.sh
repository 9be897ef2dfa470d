#!/bin/bash
# Sound in every container and with every codec: its tracks are read back by ffprobe with their length,
# count and bits, and are the samples that went in.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_sound.sh converts"
needs_libav
needs ffmpeg ffprobe python3

sound() { python3 "$WEFT_SOURCE/tests/input/sound.py" "$@"; }
ffmpeg -nostdin -v error -f lavfi -i testsrc2=s=64x48:r=30000/1001:d=0.3 -c:v ffv1 v29.mkv
ffmpeg -nostdin -v error -f lavfi -i testsrc2=s=64x48:r=25:d=0.3 -c:v ffv1 v25.mkv
sound wav four.wav 48000 24 4 20000

# into CODEC RASTER NAME STREAMS CHANNELS BITS: six frames beside four channels of noise.
into()
{
    local codec=$1 raster=$2 name=$3 streams=$4 channels=$5 bits=$6 video=v25.mkv samples=11520
    # Six frames at 29.97 are 9609.6 samples, and at 59.94 4804.8.
    case $raster in
        720p50) samples=5760 ;;
        720p59.94) samples=4805 video=v29.mkv ;;
        *29.97* | *59.94 | 525*) samples=9610 video=v29.mkv ;;
    esac
    exits 0 weft convert $video -q --overwrite --fit stretch --raster "$raster" --codec "$codec" --output-frames 0-5 \
        --audio four.wav --audio-bits "$bits" -o "$name" &&
        sound probe "$name" "$streams" "$channels" "$bits" "$samples/48000" &&
        sound tracks "$name" four.wav 0 $samples "$bits"
}
for row in "v210 525i a.mov" "v210 48x36@25i b.mov" "prores 625i c.mov" "prores-hq 525i d.mov" "dnxhd 720p50 e.mov" \
    "dnxhr 256x144@25p f.mov" "xdcamhd422 720p59.94 g.mov" "dvcpro50 525i-dv h.mov" "avci100 720p50 i.mov" "h264 64x48@25i t.mov" \
    "xdcamhd422 720p50 j.mxf" "xdcamhd422 1080i59.94 k.mxf" "dnxhd 720p59.94 l.mxf" "dvcpro50 625i-dv m.mxf" \
    "dvcpro50 525i-dv n.mxf" "avci100 720p59.94 o.mxf" "v210 525i p.mxf" "uyvy 48x36@25p q.mxf" \
    "ffv1 525i r.mkv" "ffv1 625i s.mkv"; do
    [[ $row == avci100* || $row == h264* ]] && ! ffmpeg -v error -encoders | grep -q libx264 && { skip_part "no libx264"; continue; }
    # shellcheck disable=SC2086
    check "four tracks: $row" into $row 4 1 24
done
for row in "v210 64x48@29.97p a.mov 32" "v210 64x48@25p a.mov 16" "ffv1 64x48@29.97p a.mkv 32" "uyvy 64x48@29.97p a.mxf 16" \
    "dvcpro50 525i-dv n.mxf 16"; do
    # shellcheck disable=SC2086
    set -- $row
    check "bits: $row" into "$1" "$2" "$3" 4 1 "$4"
done
check "MP4 has none" exits 2 weft convert v25.mkv --raster 64x48@25i --audio tone:2 -o no.mp4
check "and says what does" says "or write .mov"
check "D-10 has one stream of four" into imx50 625i d10.mxf 1 4 24
check "at 29.97 too" into imx50 525i-imx d10.mxf 1 4 24
finish
