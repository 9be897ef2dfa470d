#!/bin/bash
# 'weft measure' as its users run it: field order beside ffmpeg's idet on every interlaced raster and
# every wrong way to weave, video of other programs, differences beside ffmpeg's, limits, JSON, heat
# maps, and what is refused.
. "$WEFT_SOURCE/tests/program/script.sh"

# ---- Field order ----

# verdict FILE WORD [OPTION..]: weft's word on the order.
verdict()
{
    local file=$1 word=$2
    shift 2
    exits 0 weft measure "$file" --json "$@" && value "d['order']['verdict'] == '$word'"
}

# idet FILE WORD: ffmpeg's, the most frequent of TFF, BFF, Progressive and Undetermined.
idet()
{
    local most
    most=$(ffmpeg -nostdin -hide_banner -i "$1" -vf idet -f null - 2>&1 |
        sed -n 's/.*Multi frame detection: *//p' | sed 's/: */:/g' | tr -s ' ' '\n' |
        sort -t: -k2 -n | tail -n 1)
    [ "${most%:*}" = "$2" ] || { echo "idet: $most, not $2"; return 1; }
}

# same FILE VERDICT WORD: both say so.
same()
{
    verdict "$1" "$2" && { [ -z "$have_ffmpeg" ] || idet "$1" "$3"; }
}

have_ffmpeg=$(command -v ffmpeg || true)
[ -n "$have_ffmpeg" ] || { skipped=$((skipped + 1)); echo "skipped: no ffmpeg"; }

# clip OUTPUT RATE RASTER: the moving subframes, RATE a second, as video.
"$WEFT_BUILD/make_subframes" in 96 || exit 1
clip()
{
    "$WEFT" convert in --subframe-rate "$2" --raster "$3" --aperture box --temporal-width 0 --fit stretch \
        --overwrite -q -o "$1" 2>/dev/null
}

rasters="525i:bff 360x288@25i,tff:tff 360x288@25i,bff:bff"
[ -n "${WEFT_SANITIZE:-}" ] || rasters="$rasters 525i-imx:tff 525i-dv:bff 525i-rp202:tff 625i:tff 625i-dv:bff
    1080i50:tff 1080i59.94:tff 1080i60:tff"
for raster in $rasters; do
    clip a.y4m 400 "${raster%:*}"
    order=${raster##*:}
    check "${raster%:*}" same a.y4m "$order" "$(echo "$order" | tr a-z A-Z)"
done
clip psf.y4m 400 1920x1080@25psf
clip p.y4m 200 360x244@25p
clip film.y4m 144 720x480@24000/1001p
clip tff.y4m 400 360x288@25i,tff
mkdir stills
for i in 0 1 2 3 4 5; do cp in/subframe.0000.exr stills/s.000$i.exr; done
"$WEFT" convert stills --subframe-rate 60000/1001 --raster 525i --fit stretch -q -o still.y4m
check "psf is progressive to the eye" same psf.y4m progressive Progressive
check "psf, if that is what it is" verdict psf.y4m psf --raster 1920x1080@25psf
check "progressive" same p.y4m progressive Progressive
check "still" verdict still.y4m still
"$WEFT" convert stills --subframe-rate 60000/1001 --raster 525i --fit stretch --bits 8 --dither tpdf -q -o dither.y4m
frames() { python3 -c "
d = open('$1', 'rb').read().split(b'FRAME\n')[1:]
print(len(d), len(set(d)))"; }
check "a dithered still: every frame has the same codes" test "$(frames dither.y4m)" = "3 1"
check "and is one" verdict dither.y4m still

# weave NAME FILTER: the top first video, fields put together in another way.
weave() { ffmpeg -nostdin -v error -y -i tff.y4m -vf "$2" -strict -1 "$1.y4m"; }
if [ -n "$have_ffmpeg" ]; then
    weave swapped "il=l=i:c=i,separatefields,weave=first_field=bottom"
    weave lines "il=ls=1:cs=1"
    weave late "separatefields,trim=start_frame=1,weave=first_field=top"
    weave early "separatefields,shuffleframes=1 0,weave=first_field=top"
    for name in swapped lines late early; do
        [ -s $name.y4m ] || continue
        word=$(python3 - "$name" <<'END'
import re, subprocess, sys
text = subprocess.run(['ffmpeg', '-nostdin', '-hide_banner', '-i', sys.argv[1] + '.y4m', '-vf', 'idet',
                       '-f', 'null', '-'], capture_output=True, text=True).stderr
found = re.search(r'Multi frame detection: TFF: *(\d+) BFF: *(\d+) Progressive: *(\d+)', text)
counts = dict(zip(('tff', 'bff', 'progressive'), map(int, found.groups())))
print(max(counts, key=counts.get))
END
)
        check "woven wrong: $name ($word)" verdict $name.y4m "$word"
    done
    # Fields of progressive frames, a field late: each frame holds two instants.
    ffmpeg -nostdin -v error -y -i p.y4m -vf "separatefields,trim=start_frame=1,weave=first_field=bottom" \
        -strict -1 torn.y4m
    word=$(ffmpeg -nostdin -hide_banner -i torn.y4m -vf idet -f null - 2>&1 |
        awk '/Multi frame/ { for (i = 1; i < NF; i++) if ($i ~ /^(TFF|BFF):/) n[$i] = $(i + 1) }
             END { print (n["TFF:"] > n["BFF:"]) ? "tff" : "bff" }')
    check "progressive fields a field late ($word)" verdict torn.y4m "$word"
    ffmpeg -nostdin -v error -y -i film.y4m -vf telecine=first_field=top:pattern=23 -strict -1 tele.y4m
    check "telecined" verdict tele.y4m telecined
    ffmpeg -nostdin -v error -y -i film.y4m -vf telecine=first_field=bottom:pattern=32 -strict -1 tele.y4m
    check "telecined the other way" verdict tele.y4m telecined
fi

# Grain moves everything, and says nothing of order.
strengths="4 8 20"
[ -z "${WEFT_SANITIZE:-}" ] || strengths=8
if [ -n "$have_ffmpeg" ]; then
    for strength in $strengths; do
        ffmpeg -nostdin -v error -y -i p.y4m -vf "noise=alls=$strength:allf=t:all_seed=7" -strict -1 grain.y4m
        check "progressive under grain $strength" verdict grain.y4m progressive
        ffmpeg -nostdin -v error -y -i tff.y4m -vf "noise=alls=$strength:allf=t:all_seed=7" -strict -1 grain.y4m
        check "top first under grain $strength" verdict grain.y4m tff
        ffmpeg -nostdin -v error -y -f lavfi -i smptebars=s=360x288:r=25:d=1 -vf "noise=alls=$strength:allf=t:all_seed=7" \
            -pix_fmt yuv420p grain.y4m
        check "a still under grain $strength has no order" bash -c \
            "'$WEFT' measure grain.y4m --json | grep -Eq '\"verdict\": \"(still|progressive)\"'"
    done
fi

# ---- Other programs' video ----

if [ -n "$have_ffmpeg" ] && [ -e "$WEFT_BUILD/lib/weft/weft-libav.so" ]; then
    exits 0 weft measure tff.y4m --json && cp out y4m.json
    for way in mov:v210 mkv:ffv1 mov:prores_ks avi:ffvhuff; do
        file=copy.${way%:*}
        ffmpeg -nostdin -v error -y -i tff.y4m -c:v "${way#*:}" -flags +ildct -field_order tt "$file"
        check "$way is measured" exits 0 weft measure "$file" --json
        check "$way is as the Y4M" value "d['order']['verdict'] == 'tff' and d['frames'] == 6 and
            abs(d['flicker']['rms'] / json.load(open('y4m.json'))['flicker']['rms'] - 1) < 0.1"
    done
    check "v210 in MOV is the Y4M bit for bit" exits 0 weft measure copy.avi --against tff.y4m --json
    check "no difference" value "d['difference']['rmse'] == 0"
    ffmpeg -nostdin -v error -y -i tff.y4m -pix_fmt yuv420p -c:v mpeg2video -flags +ildct+ilme -qscale 3 x.mpg
    check "MPEG-2 is measured" verdict x.mpg tff
    head -c 200000 copy.mov >cut.mov
    check "a cut MOV is refused" exits 1 weft measure cut.mov
    check "and named" says cut.mov
    size=$(stat -c %s copy.mkv)
    head -c $((size * 7 / 10)) copy.mkv >cut.mkv
    check "a cut Matroska is refused" exits 1 weft measure cut.mkv
    check "and its end is told" says "ends after"
    ffmpeg -nostdin -v error -y -f lavfi -i testsrc=s=320x240:r=25:d=2 -pix_fmt yuv420p -c:v mpeg4 -g 12 long.mp4
    ffmpeg -nostdin -v error -y -ss 0.5 -i long.mp4 -c copy trimmed.mp4
    check "an edit list is not" exits 0 weft measure trimmed.mp4
    cp copy.mkv take:1.mkv
    check "a colon in a name" exits 0 weft measure take:1.mkv
    for tag in bt709 smpte170m; do
        ffmpeg -nostdin -v error -y -f lavfi -i smptebars=s=720x576:r=25:d=0.2 -pix_fmt yuv422p -c:v ffv1 \
            -colorspace $tag tag-$tag.mkv
        check "$tag" exits 0 weft measure tag-$tag.mkv --json
        cp out $tag.json
    done
    check "the matrix that is tagged is taken" value "d['flicker'] != json.load(open('bt709.json'))['flicker']"
    for tag in smpte2084 arib-std-b67; do
        ffmpeg -nostdin -v error -y -f lavfi -i smptebars=s=720x576:r=25:d=0.2 -pix_fmt yuv422p10le -c:v ffv1 \
            -color_trc $tag pq.mkv
        check "$tag" exits 0 weft measure pq.mkv --json
        check "$tag is another display" value "d['flicker'] != json.load(open('smpte170m.json'))['flicker']"
    done
    ffmpeg -nostdin -v error -y -f lavfi -i sine=d=0.1 sound.wav
    check "a sound file is refused" exits 1 weft measure sound.wav
else
    skipped=$((skipped + 1)); echo "skipped: no ffmpeg, or built without libav"
fi

# ---- Differences beside ffmpeg's ----

"$WEFT" convert in --subframe-rate 400 --raster 360x288@25i,tff --aperture notch -q -o other.y4m
check "difference" exits 0 weft measure other.y4m --against tff.y4m --json
if [ -n "$have_ffmpeg" ]; then
    ffmpeg -nostdin -hide_banner -i other.y4m -i tff.y4m -lavfi '[0]split[a][b];[1]split[c][d];[a][c]psnr;[b][d]ssim' \
        -f null - >ffmpeg.log 2>&1
    theirs() { sed -n "s/.*$1.* $2:\([0-9.]*\).*/\1/p" ffmpeg.log; }
    check "PSNR is ffmpeg's" value "abs(d['difference']['psnr'] - $(theirs PSNR average)) < 2e-3"
    check "PSNR of luma is ffmpeg's" value "abs(d['planes']['y']['frame']['psnr'] - $(theirs PSNR y)) < 2e-3"
    check "SSIM of luma is ffmpeg's" value "abs(d['planes']['y']['frame']['ssim'] - $(theirs SSIM Y)) < 2e-5"
    ffmpeg -nostdin -v error -y -i other.y4m -pix_fmt gray10le -strict -1 gray1.y4m
    ffmpeg -nostdin -v error -y -i tff.y4m -pix_fmt gray10le -strict -1 gray2.y4m
    check "lone luma" exits 0 weft measure gray1.y4m --against gray2.y4m --json
    check "is not thinned by empty chroma" value "d['difference']['psnr'] == d['planes']['y']['frame']['psnr'] and
        list(d['planes']) == ['y']"
fi

# ---- Forms ----

for form in v210 uyvy; do
    clip f.$form 480000/1001 525i
    check "$form" exits 0 weft measure f.$form --raster 525i --json
    check "$form is bottom first" value "d['order']['verdict'] == 'bff' and d['frames'] == 6"
done
check "another raster" exits 1 weft measure f.v210 --raster 625i
check "which is said" says "--raster"
# With few samples noise adds to what the aperture leaves.
samples=16 rms=.02 p999=.03
[ -z "${WEFT_SANITIZE:-}" ] || { samples=4 rms=.04 p999=.15; }
for form in '####.exr' '####.dpx' y4m; do
    "$WEFT" render "$WEFT_SOURCE/examples/scenes/zoneplate.lua" -q --raster 525i --samples $samples --aperture line \
        --temporal-width 0 --frames 0-1 -o "z.$form"
done
check "EXR sequence" exits 0 weft measure 'z.####.exr' --json --chart zoneplate
check "its flicker and sharpness" value "abs(d['flicker']['rms'] / .1387 - 1) < $rms and
    abs(d['flicker']['p999'] / .339 - 1) < $p999 and abs(d['sharpness'] - .9003) < .01 and d['order']['verdict'] == 'still'"
check "the same in DPX and Y4M" exits 0 weft measure 'z.####.dpx' z.y4m --json
check "displayed light is light" value "len(d) == 2 and all(abs(f['flicker']['rms'] / .1387 - 1) < $rms for f in d)"
check "cross-color does not depend on the form" value "abs(d[0]['cross_color']['rms'] / d[1]['cross_color']['rms'] - 1) < .01"
check "standard input" bash -c "'$WEFT' measure - --json <z.y4m >out"
check "is measured" value "d['frames'] == 2"
check "a pipe" exits 0 weft measure <(cat z.y4m) --json
check "is measured" value "d['frames'] == 2"
check "zeros" exits 1 weft measure <(head -c 1000 /dev/zero)
check "are not Y4M" says "Y4M header"
check "for people" exits 0 weft measure z.y4m
check "flicker is told" prints "interline flicker"
check "a single picture" exits 0 weft measure z.0000.exr --json
check "has no order" value "d['order']['verdict'] is None and d['sharpness'] is None and d['difference']['rmse'] is None"
check "keys" value "set(d) >= {'flicker', 'sharpness', 'cross_color', 'cross_luma', 'order', 'legal', 'difference'} and
    set(d['flicker']) == {'rms', 'p999', 'share'} and set(d['cross_color']) == {'rms', 'p999'} and
    set(d['legal']) == {'range_share', 'r103_share'} and set(d['order']) == {'verdict', 'ratio'}"

# ---- Limits and heat maps ----

check "within its limits" exits 0 weft measure z.y4m --limit flicker.rms=0.15 --limit legal.range_share=0
check "beyond a limit" exits 1 weft measure z.y4m --limit flicker.rms=0.01
check "which is said" says "flicker.rms is 0.1"
check "the second of two" exits 1 weft measure z.y4m --limit flicker.rms=0.2,flicker.p999=0.1
check "which is said" says "flicker.p999"
check "a floor" exits 1 weft measure z.y4m --chart zoneplate --limit sharpness=0.95
check "a floor that is kept" exits 0 weft measure z.y4m --chart zoneplate --limit sharpness=0.8
check "a verdict" exits 1 weft measure z.y4m --limit order.verdict=tff
check "a verdict that is so" exits 0 weft measure z.y4m --limit order.verdict=still
check "what cannot be measured" exits 1 weft measure z.0000.exr --limit order.ratio=1
check "unknown limit" exits 2 weft measure z.y4m --limit flicker.rmss=1
check "and what was meant" says "did you mean flicker.rms?"
check "limit without a number" exits 2 weft measure z.y4m --limit flicker.rms=much
check "limit without =" exits 2 weft measure z.y4m --limit flicker.rms
check "unknown chart" exits 2 weft measure z.y4m --chart rings
check "impossible grating" exits 2 weft measure z.y4m --chart grating:0.7
check "unknown display" exits 2 weft measure z.y4m --display lcd
check "heat map" exits 0 weft measure z.y4m --heatmap heat.png
check "is a picture" test "$(head -c 4 heat.png | tail -c 3)" = PNG
check "heat map over its video" exits 2 weft measure z.0000.exr --heatmap z.0000.exr
check "standard input twice" exits 2 weft measure - --against -
check "too much memory" exits 1 weft measure z.y4m --max-memory 2M
check "is said" says "--max-memory"
check "heat map of two" exits 2 weft measure z.y4m z.y4m --heatmap heat.png

# ---- What is refused ----

check "nothing" exits 2 weft measure
check "absent" exits 1 weft measure absent.y4m
check "the others are measured" exits 1 weft measure absent.y4m z.y4m --json
check "in place" value "'error' in d[0] and d[1]['frames'] == 2"
head -c 1000000 z.y4m >cut.y4m
check "a cut Y4M" exits 1 weft measure cut.y4m
check "its frame is named" says "frame 0"
echo text >text.y4m
check "no video" exits 1 weft measure text.y4m

finish
