#!/bin/bash
# What pictures say of their colors and alpha in tags: TIFF, PNG's profiles and ranges, WebP, JPEG.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/input/pictures.sh"
not_sanitized "test_file_colors.c and test_oiio.c read tags"
needs oiiotool python3

tiff() { python3 "$WEFT_SOURCE/tests/input/tiff.py" "$@"; }

# warns TEXT FILE: it is converted with a warning.
warns()
{
    exits 0 weft convert "$2" --raster 32x24@24p --subframe-rate 24 --overwrite -o o.y4m && says "$1" && says "--from names"
}

# ---- TIFF ----

p3=("319=.68,.32,.265,.69,.15,.06" "318=.3127,.329")
for order in II MM; do
    tiff p3.tif 32 3 2 - $order .5 .4 .3 "${p3[@]}"
    check "floats keep their primaries, $order" light ".5 .4 .3" p3.tif
    check "and say them, $order" eval 'oiiotool --info -v out.0000.exr | grep -q "chromaticities: 0.68, 0.32, 0.265"'
done
tiff codes.tif 16 1 2 - II 32768 26214 19660 "${p3[@]}"
check "codes of other primaries" warns "chromaticities are not those of sRGB" codes.tif
tiff none.tif 32 3 2 - II .8 .4 .2 .5
check "a fourth sample that is not said to be alpha" light ".8 .4 .2" none.tif --background 1
tiff straight.tif 32 3 2 2 II .8 .4 .2 .5
check "unassociated alpha" light ".9 .7 .6" straight.tif --background 1
tiff multiplied.tif 32 3 2 1 II .4 .2 .1 .5
check "associated alpha" light ".9 .7 .6" multiplied.tif --background 1
tiff fifth.tif 32 3 2 0,2 II .8 .4 .2 .1 .5
check "the one that is called alpha" light ".9 .7 .6" fifth.tif --background 1
tiff negative.tif 16 1 0 - II 9000
check "white of 0" fails "whose 0 is white" weft convert negative.tif "${raster[@]}" -o no.y4m
tiff lab.tif 8 1 8 - II 90 80 70
check "L*a*b*" fails 'CIE L\*a\*b\*' weft convert lab.tif "${raster[@]}" -o no.y4m
tiff inks.tif 8 1 5 - II 90 80 70 60
check "inks" warns "amounts of ink" inks.tif

# ---- PNG ----

png linear.png 126 cICP:01080000
v=$(python3 -c 'print(110 / 219)')
check "light of narrow range" light "$v $v $v" linear.png
png primaries.png 128 cICP:4d0d0001
check "unknown primaries" warns '"77"' primaries.png
profile() { python3 -c "import zlib, sys; print((sys.argv[1].encode() + b'\0\0' + zlib.compress(sys.argv[2].encode() * 9)).hex())" "$@"; }
png p3.png 128 "iCCP:$(profile "Display P3" "desc Display P3")"
check "a profile that is not sRGB's" warns '"Display P3"' p3.png
png srgb.png 128 "iCCP:$(profile "ICC" "desc sRGB IEC61966-2.1")"
check "sRGB's" exits 0 weft convert srgb.png "${raster[@]}" -o o.y4m
check "is not told" test ! -s said

# ---- JPEG and WebP ----

oiiotool --pattern constant:color=.5,.5,.5 32x24 3 -d uint8 -o a.jpg
python3 - <<'PATCH'
import struct
data, body = open('a.jpg', 'rb').read(), b'ICC_PROFILE\0\1\1' + b'Display P3'.ljust(200)
open('p3.jpg', 'wb').write(data[:2] + b'\xff\xe2' + struct.pack('>H', 2 + len(body)) + body + data[2:])
PATCH
check "a profile in a JPEG" warns "ICC profile is not of sRGB" p3.jpg
if has ffmpeg && ffmpeg -v error -f lavfi -i "color=0xcc6633@0.5:s=32x24,format=rgba" -frames:v 1 -lossless 1 a.webp; then
    exits 0 weft convert a.webp "${raster[@]}" --background 1 -o out.####.exr
    check "WebP is straight" python3 -c "
import sys; lit = lambda c: ((c / 255 + .055) / 1.055) ** 2.4
got, a = list(map(float, sys.argv[1].split())), 127.5 / 255
sys.exit(max(abs(g - (lit(c) * a + 1 - a)) for g, c in zip(got, (204, 102, 51))) > .008)" \
        "$(oiiotool --stats out.0000.exr | awk '/Stats Avg/ { print $3, $4, $5 }')"
    python3 - <<'PATCH'
import struct
data = open('a.webp', 'rb').read()
icc = b'Display P3'.ljust(200)
body = data[12:] + b'ICCP' + struct.pack('<I', len(icc)) + icc
open('p3.webp', 'wb').write(b'RIFF' + struct.pack('<I', 4 + len(body)) + b'WEBP' + body)
PATCH
    check "a profile in a WebP" warns "ICC profile is not of sRGB" p3.webp
fi
finish
