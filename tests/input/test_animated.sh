#!/bin/bash
# Animated pictures: PNG and GIF are video with their times and sRGB, WebP is refused with what helps.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh converts"
needs_libav
needs ffmpeg python3
. "$WEFT_SOURCE/tests/input/gray_video.sh"

# animated COLOR NAME [OPTION..]: half a second, 50 pictures a second.
animated() { quiet_ffmpeg -f lavfi -i "color=$1:s=64x32:r=50:d=0.5" "${@:3}" "$2"; }
# chunk FROM TO NAME HEX: a PNG with one chunk more, after its first.
chunk()
{
    python3 - "$@" <<'P'
import struct, sys, zlib
data, (name, value) = open(sys.argv[1], "rb").read(), (sys.argv[3].encode(), bytes.fromhex(sys.argv[4]))
more = struct.pack(">I", len(value)) + name + value + struct.pack(">I", zlib.crc32(name + value))
open(sys.argv[2], "wb").write(data[:33] + more + data[33:])
P
}

# Code 128 of sRGB is .2159 of the light, and 526 of 10 bits.
animated 0x808080 gray.apng -pix_fmt rgb24
animated 0x808080 gray.gif -pix_fmt gray
cp gray.apng gray.png
for file in gray.apng gray.png gray.gif; do
    check "$file" exits 0 weft convert $file ${box/-q/} -o o.y4m --report -
    check "has its pictures, which are sRGB" first_code o.y4m 526 12
    check "and is told to be so" value "d['input']['transfer'] == {'value': 'sRGB', 'reason': 'default'} and d['input']['listed'] == 25"
    check "without a warning" [ ! -s said ]
    check "by info too" eval 'exits 0 weft info $file && prints "sRGB (default)" && prints "kind              video"'
    check "by a dry run" eval 'exits 0 weft convert $file ${box/-q/} -o o.y4m --dry-run && prints "input transfer: sRGB (default)"'
done
quiet_ffmpeg -f lavfi -i color=white:s=64x32:r=100:d=0.5 -vf "lutrgb=r=0:g=0:b=0:enable='mod(n,2)'" -pix_fmt rgb24 turns.apng
check "white and black in turn" exits 0 weft convert turns.apng $box -o o.y4m
check "are half the light" first_code o.y4m 720 12

# What a PNG says of its colors counts for all its pictures.
quiet_ffmpeg -i gray.apng -frames:v 1 -update 1 one.png
for said in cICP:09100001 cICP:01010000 gAMA:000186a0 sRGB:00; do
    chunk gray.apng said.apng ${said%:*} ${said#*:}
    chunk one.png said.png ${said%:*} ${said#*:}
    check "$said" exits 0 weft convert said.apng $box --frames 0-3 -o o.y4m
    check "of a picture" exits 0 weft convert said.png $box --frames 0 --subframe-rate 25 -o p.y4m
    check "is the same" eval 'cmp <(head -c 8000 o.y4m | tail -c 7000) <(head -c 8000 p.y4m | tail -c 7000)'
done
# Threads of libav's decoder would wait for each other at pictures that cannot be decoded.
quiet_ffmpeg -f lavfi -i testsrc2=s=64x32:r=50:d=0.5 -pix_fmt rgb24 long.apng
for place in 3 5 7; do
    cp long.apng bad.apng
    head -c 64 /dev/zero | dd of=bad.apng bs=1 seek=$(($(stat -c %s bad.apng) * place / 9)) conv=notrunc 2>dd.said
    check "damaged at $place ninths" eval 'timeout 100 "$WEFT" convert bad.apng $box -o o.y4m 2>said; [ $? -lt 2 ]'
done
animated 0x808080 deep.apng -vf format=rgb24,format=rgb48be
check "16 bits" exits 0 weft convert deep.apng $box -o o.y4m
check "are the same" first_code o.y4m 526 12

printf 'RIFF\x1e\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0\x3f\0\0\x1f\0\0ANIM\0\0\0\0' >a.webp
check "animated WebP" fails "animated WebP.*convert IN -coalesce.*--subframe-rate" weft convert a.webp $box -o no.y4m
check "by info" fails "animated WebP" weft info a.webp
cat one.png one.png >both.png
check "PNG after PNG" fails "several PNG.*png_pipe" weft convert both.png $box --subframe-rate 50 -o no.y4m
if has oiiotool; then
    oiiotool --create 64x32 3 --fill:color=.8,.4,.2 64x32+0+0 -d uint8 -o page.tif
    oiiotool page.tif page.tif --siappend -o pages.tif
    check "pages of TIFF" fails "several pictures.*--subimage 0" weft convert pages.tif $box --subframe-rate 50 -o no.y4m
    oiiotool pages.tif --subimage 0 -o first.tif
    check "the first of them" exits 0 weft convert first.tif $box --raster 64x32@50p --subframe-rate 50 -o o.y4m
    oiiotool page.tif -otex levels.tif
    check "smaller forms of a picture are none" exits 0 weft convert levels.tif $box --raster 64x32@50p --subframe-rate 50 -o o.y4m
fi
check "nothing is left" [ ! -e no.y4m ]
finish
