#!/bin/bash
# The order of fields as 'weft measure' sees it, beside ffmpeg's idet, on interlaced rasters, stills,
# film, fields that were woven in wrong ways, and grain.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_measure.c measures orders"

# idet FILE WORD: ffmpeg's, the most frequent of TFF, BFF, Progressive and Undetermined.
idet()
{
    local most
    most=$(ffmpeg -nostdin -hide_banner -i "$1" -vf idet -f null - 2>&1 |
        sed -n 's/.*Multi frame detection: *//p' | sed 's/: */:/g' | tr -s ' ' '\n' |
        sort -t: -k2 -n | tail -n 1)
    [ "${most%:*}" = "$2" ] || { echo "idet: $most, not $2"; return 1; }
}

# both_say FILE VERDICT WORD: weft and ffmpeg do.
both_say()
{
    verdict "$1" "$2" && { [ -z "$have_ffmpeg" ] || idet "$1" "$3"; }
}

have_ffmpeg=$(command -v ffmpeg || true)
[ -n "$have_ffmpeg" ] || skip_part "no ffmpeg"

subframes in 96

rasters="525i:bff 360x288@25i,tff:tff 360x288@25i,bff:bff"
is_sanitized || rasters="$rasters 525i-imx:tff 525i-dv:bff 625i:tff 625i-dv:bff 1080i50:tff"
is_long && rasters="$rasters 525i-rp202:tff 1080i59.94:tff 1080i60:tff"
for raster in $rasters; do
    clip a.y4m 400 "${raster%:*}"
    order=${raster##*:}
    check "${raster%:*}" both_say a.y4m "$order" "$(echo "$order" | tr a-z A-Z)"
done
# The subframes as the quick start converts them: at their own rate, through the default aperture.
right_order() { exits 0 weft verify own.y4m --raster "$1" --json && value '{"order": "right"}.items() <=
    {c["check"]: c["verdict"] for c in d[0]["checks"]}.items()'; }
for raster in 525i 625i 1080i50 1080i59.94; do
    "$WEFT" convert in --raster $raster -q -o own.y4m --overwrite
    check "the quick start's subframes in $raster" right_order $raster
done
psf=960x540@25psf
is_long && psf=1920x1080@25psf
clip psf.y4m 400 $psf
clip p.y4m 200 360x244@25p
clip film.y4m 144 720x480@24000/1001p
clip tff.y4m 400 360x288@25i,tff
mkdir stills
for i in 0 1 2 3 4 5; do cp in/subframe.0000.exr stills/s.000$i.exr; done
"$WEFT" convert stills --subframe-rate 60000/1001 --raster 525i --fit stretch -q -o still.y4m
check "psf is progressive to the eye" both_say psf.y4m progressive Progressive
check "psf, if that is what it is" verdict psf.y4m psf --raster $psf
check "progressive" both_say p.y4m progressive Progressive
check "still" verdict still.y4m still
"$WEFT" convert stills --subframe-rate 60000/1001 --raster 525i --fit stretch --bits 8 --dither tpdf -q -o dither.y4m
frames() { python3 -c "
d = open('$1', 'rb').read().split(b'FRAME\n')[1:]
print(len(d), len(set(d)))"; }
check "a dithered still: every frame has the same codes" test "$(frames dither.y4m)" = "3 1"
check "and is one" verdict dither.y4m still

# weave NAME FILTER: the top first video, fields put together in another way.
weave() { quiet_ffmpeg -i tff.y4m -vf "$2" -strict -1 "$1.y4m"; }
if [ -n "$have_ffmpeg" ]; then
    weave swapped "separatefields,weave=first_field=bottom"
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
    quiet_ffmpeg -i p.y4m -vf "separatefields,trim=start_frame=1,weave=first_field=bottom" \
        -strict -1 torn.y4m
    word=$(ffmpeg -nostdin -hide_banner -i torn.y4m -vf idet -f null - 2>&1 |
        awk '/Multi frame/ { for (i = 1; i < NF; i++) if ($i ~ /^(TFF|BFF):/) n[$i] = $(i + 1) }
             END { print (n["TFF:"] > n["BFF:"]) ? "tff" : "bff" }')
    check "progressive fields a field late ($word)" verdict torn.y4m "$word"
    quiet_ffmpeg -i film.y4m -vf telecine=first_field=top:pattern=23 -strict -1 tele.y4m
    check "telecined" verdict tele.y4m telecined
    quiet_ffmpeg -i film.y4m -vf telecine=first_field=bottom:pattern=32 -strict -1 tele.y4m
    check "telecined the other way" verdict tele.y4m telecined
fi

# Grain moves everything, and says nothing of order.
strengths="4 20"
is_long && strengths="4 8 20"
is_sanitized && strengths=8
if [ -n "$have_ffmpeg" ]; then
    for strength in $strengths; do
        quiet_ffmpeg -i p.y4m -vf "noise=alls=$strength:allf=t:all_seed=7" -strict -1 grain.y4m
        check "progressive under grain $strength" verdict grain.y4m progressive
        quiet_ffmpeg -i tff.y4m -vf "noise=alls=$strength:allf=t:all_seed=7" -strict -1 grain.y4m
        check "top first under grain $strength" verdict grain.y4m tff
        quiet_ffmpeg -f lavfi -i smptebars=s=360x288:r=25:d=1 -vf "noise=alls=$strength:allf=t:all_seed=7" \
            -pix_fmt yuv420p grain.y4m
        check "a still under grain $strength has no order" bash -c \
            "'$WEFT' measure grain.y4m --json | grep -Eq '\"verdict\": \"(still|progressive)\"'"
    done
fi

finish
