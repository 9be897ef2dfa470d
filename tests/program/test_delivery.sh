#!/bin/bash
# Deliveries in QuickTime, MXF and Matroska: codes that survive, sound and timecode, pictures that are
# hard to code, and what is refused. test_codecs.sh has every codec and raster.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh writes containers"
needs_libav
needs ffmpeg ffprobe mediainfo
subframes in 64

# delivered FILE CODEC RASTER [TIMECODE [TRACKS]]: it says and holds what its raster demands.
delivered() { python3 "$WEFT_SOURCE/tests/program/delivered.py" "$@"; }

# ---- Codes survive ----

# same_codes A B: the decoded codes of two files are equal, bit for bit.
same_codes()
{
    local name n=0
    for name in "$1" "$2"; do
        n=$((n + 1))
        ffmpeg -nostdin -v error -y -i "$name" -f rawvideo -pix_fmt "$3" codes$n.raw || return 1
    done
    cmp codes1.raw codes2.raw
}
check "Y4M" made 525i.y4m --raster 525i
check "v210" made 525i.mov --raster 525i
check "FFV1" made 525i.mkv --raster 525i
check "DV" made dv.mov --codec dvcpro50 --raster 525i
check "v210 in QuickTime has Y4M's codes" same_codes 525i.y4m 525i.mov yuv422p10le
check "and so has FFV1" same_codes 525i.y4m 525i.mkv yuv422p10le
made v.v210 --raster 525i
check "the raw v210 is in the file as it is" python3 -c "
raw, mov = open('v.v210', 'rb').read(), open('525i.mov', 'rb').read()
raise SystemExit(raw[:720 // 48 * 128 * 486] not in mov)"
for bits in 8 12; do
    made b.y4m --raster 360x244@25i,tff --bits $bits
    made b.mkv --raster 360x244@25i,tff --bits $bits
    pixels=yuv422p
    [ $bits = 8 ] || pixels=yuv422p${bits}le
    check "FFV1 of $bits bits" same_codes b.y4m b.mkv $pixels
    rm -f b.y4m b.mkv
done

# cropped FILE Y4M ABOVE: what DV keeps is what is below ABOVE lines (the codec loses little), and not
# what is a line higher or lower.
cropped()
{
    ffmpeg -nostdin -v error -y -i "$1" -frames:v 1 -pix_fmt yuv422p -f rawvideo kept.raw
    ffmpeg -nostdin -v error -y -i "$2" -frames:v 1 -pix_fmt yuv422p -f rawvideo all.raw
    python3 - "$3" <<'END'
import sys
kept, whole = open("kept.raw", "rb").read(), open("all.raw", "rb").read()
def error(above):
    pairs = [(kept[720 * y + x], whole[720 * (y + above) + x]) for y in range(0, 480, 7) for x in range(720)]
    return (sum((a - b) ** 2 for a, b in pairs) / len(pairs)) ** 0.5
above = int(sys.argv[1])
errors = {n: error(n) for n in (above - 1, above, above + 1)}
if not errors[above] < 2 < min(errors[above - 1], errors[above + 1]) / 5:
    sys.exit(f"RMS errors by lines above: {errors}")
END
}
check "DV keeps the lines of 525i from the fifth on" cropped dv.mov 525i.y4m 4

# ---- Sound and timecode ----

check "sound and timecode" made s.mxf --codec xdcamhd422 --raster 1080i59.94 --audio silent:2 --timecode "09:59:59;28"
check "in MXF" delivered s.mxf xdcamhd422 1080i59.94 "09:59:59;28" 2
check "of D-10" made d10.mxf --codec imx50 --raster 525i-imx --audio silent:8 --timecode 01:00:00:00
check "in its one element" delivered d10.mxf imx50 525i-imx 01:00:00:00 8
check "in QuickTime" made s.mov --raster 525i --audio silent:2 --timecode "23:59:59;28"
check "a track each" delivered s.mov v210 525i "23:59:59;28" 2
check "in Matroska" made s.mkv --raster 625i --audio silent:1 --timecode 10:00:00:00
check "a tag" eval "ffprobe -v error -show_entries format_tags=timecode -of csv=p=0 s.mkv | grep -q 10:00:00:00"
check "24 a second" made t24.mov --codec prores --raster 1080p23.976 --timecode 01:00:00:23
check "are 24 labels" delivered t24.mov prores 1080p23.976 01:00:00:23
silent() { ffmpeg -nostdin -v error -i "$1" -map 0:a -f s24le - | tr -d '\0' | wc -c | grep -qx 0; }
check "silence in MXF" silent s.mxf
check "silence in QuickTime" silent s.mov

# ---- Pictures that are hard to code ----

# steady KIND CODEC RASTER BYTES: every frame has this size, whatever is in it.
steady()
{
    local sizes
    exits 0 weft convert "$1" --subframe-rate 60 --fit stretch --aperture box --temporal-width 0 -q --overwrite \
        --codec "$2" --raster "$3" -o steady.mxf || return 1
    sizes=$(ffprobe -v error -select_streams v -show_entries packet=size -of csv=p=0 steady.mxf | tr -d , | sort -u)
    [ "$sizes" = "$4" ] || { echo "frames of $sizes bytes, not $4"; return 1; }
}
if has oiiotool; then
    mkdir noise black
    for i in 0 1 2 3 4 5 6 7; do
        oiiotool --pattern noise:type=uniform:seed=$i:min=0:max=1 720x576 3 -d half -o noise/s.000$i.exr
        oiiotool --create 64x64 3 -d half -o black/s.000$i.exr
    done
    for kind in noise black; do
        check "$kind in D-10 of 525 lines" steady $kind imx50 525i-imx 208540
        check "$kind in D-10 of 625 lines" steady $kind imx50 625i 250000
    done
fi

# ---- What is refused, and what is said ----

# refused TEXT OUTPUT OPTION..
refused()
{
    local word=$1
    shift
    exits 2 weft convert in --subframe-rate 400 -o "$@" && says "$word" && [ ! -e "$1" ]
}
check "625i into DV" refused "625i-dv" no.mov --codec dvcpro50 --raster 625i
check "bottom first into XDCAM" refused "1080i50" no.mxf --raster 525i
check "fields into DNxHR" refused "progressive" no.mov --codec dnxhr --raster 1080i50
check "D-10 into QuickTime" refused "goes into .mxf" no.mov --codec imx50
check "an unknown codec" refused "did you mean prores" no.mov --codec prorez
check "a codec and Y4M" refused "no codec" no.y4m --codec v210
check "4:2:0 of lines that four does not divide" refused "--bits 10" no.mp4 --raster 360x242@25i,tff
check "sound and Y4M" refused "no sound" no.y4m --audio silent:2
check "three tracks of D-10" refused "4 or 8" no.mxf --codec imx50 --raster 625i --audio silent:3
check "a bad number of tracks" refused "silent:N" no.mov --audio silent:0
check "10 bits of DV" refused "takes --bits 8" no.mov --codec dvcpro50 --raster 525i-dv --bits 10
check "4:4:4 of v210" refused "4:2:2" no.mov --chroma 444
check "full range" refused "narrow" no.mov --range full
check "chunks" refused "cannot be joined" no.mov --chunk 1/2
check "drop frame at 25" refused "drop frame" no.mov --raster 625i --timecode "01:00:00;00"
check "lines that are dropped" exits 0 weft convert in --subframe-rate 400 --codec dvcpro50 --raster 525i -o warn.mov
check "are told" says "4 above and 2 below"
check "what is there stays" exits 1 weft convert in --subframe-rate 400 -o warn.mov
check "and is named" says "--overwrite"
check "or is replaced" exits 0 weft convert in --subframe-rate 400 -q --overwrite -o warn.mov
ln -s /dev/full full.mov
check "a full device" exits 1 weft convert in --subframe-rate 400 -q -o full.mov
check "is named" says "full.mov"
mkdir limit
check "a limit to the size of files" exits 1 bash -c "ulimit -f 500; '$WEFT' convert in --subframe-rate 400 -q -o limit/big.mov"
check "is named" says "limit/big.mov"
check "and leaves nothing" test -z "$(ls -A limit)"

check "SIGINT" interrupted INT 130 0.7 "$WEFT" convert in --threads 1 --raster 2160p25 --subframe-rate 20 \
    --temporal-width 2 -q -o left/long.mov

finish
