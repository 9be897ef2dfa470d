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
# MP4 has AAC in pairs of tracks, whose first samples are the encoder's and left out by an edit list.
sine() { ffmpeg -nostdin -v error -f lavfi -i "aevalsrc='0.5*sin(2*PI*1000*t)|0.2*sin(2*PI*300*t)|0':s=48000:d=1" -c:a pcm_s24le sine.wav; }
mp4()
{
    local raster=$1 video=$2 seconds=$3 streams=$4 channels=$5
    exits 0 weft convert "$video" --overwrite --fit stretch --raster "$raster" --output-frames 0-5 --audio sine.wav \
        "${@:6}" -o aac.mp4 && says "sound is written as AAC, which is lossy" &&
        sound lossy aac.mp4 "$streams" "$channels" "$seconds" 1000
}
if ffmpeg -v error -encoders | grep -q libx264; then
    sine
    check "MP4 has AAC" mp4 64x48@25i v25.mkv 6/25 1 2 --audio-tracks 2
    check "of an odd number of tracks, at 29.97" mp4 64x48@29.97i v29.mkv "round(48000*6*1001/30000)/48000" 2 1
    check "of two seconds, which are no whole number of its frames" mp4 64x48@59.94p v29.mkv \
        "round(48000*6*1001/60000)/48000" 2 1
    check "the same again is the same" eval 'cp aac.mp4 first.mp4 && mp4 64x48@59.94p v29.mkv 4805/48000 2 1 && cmp aac.mp4 first.mp4'
    check "its length, and that all is heard, is right" eval 'weft verify aac.mp4 | grep -E "right  (sound|heard|durations)" | wc -l | grep -qx 3'
else
    skip_part "no libx264"
fi
check "D-10 has one stream of four" into imx50 625i d10.mxf 1 4 24
check "at 29.97 too" into imx50 525i-imx d10.mxf 1 4 24
finish
