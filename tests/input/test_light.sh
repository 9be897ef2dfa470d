#!/bin/bash
# Apertures see light: pictures are decoded by what they are, or by --from, before they are summed.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/input/pictures.sh"
not_sanitized "test_file_colors.c and test_decode.c do this"
needs oiiotool python3

# lit EXPRESSION..: colors in Python, of a signal's light.
lit()
{
    python3 -c "
srgb = lambda v: v / 12.92 if v <= .04045 else ((v + .055) / 1.055) ** 2.4
bt1886 = lambda v: v ** 2.4
pq = lambda v: 10000 / 203 * (max(v ** (32 / 2523) - .8359375, 0) / (18.8515625 - 18.6875 * v ** (32 / 2523))) ** (16384 / 2610)
print(*[$1])"
}

# ---- Pictures by what they are ----

png plain.png 128
png cicp.png 128 cICP:01010001 sRGB:00
png pq.png 128 cICP:09100001
png narrow.png 126 cICP:01010000
png srgb.png 128 sRGB:00 gAMA:000186a0
png gamma.png 128 gAMA:0000b18f
png linear.png 128 gAMA:000186a0
s=$(lit "srgb(128 / 255)")
check "PNG is sRGB" light "$s $s $s" plain.png
check "code 128 is Y' 526" luma 526 0 plain.png
check "sRGB before gAMA" light "$s $s $s" srgb.png
v=$(lit "bt1886(128 / 255)")
check "cICP before sRGB" light "$v $v $v" cicp.png
v=$(lit "pq(128 / 255)")
check "PQ" light "$v $v $v" pq.png
v=$(lit "bt1886(110 / 219)")
check "narrow range" light "$v $v $v" narrow.png
v=$(lit "(128 / 255) ** (100000 / 45455)")
check "gAMA" light "$v $v $v" gamma.png
v=$(lit "128 / 255")
check "a gAMA of 1" light "$v $v $v" linear.png
check "--from wins" light "$v $v $v" plain.png --from lin_rec709
v=$(lit "bt1886(128 / 255)")
check "an encoded --from wins" light "$v $v $v" plain.png --from rec709

for kind in tif tga webp jpg; do
    picture "a.$kind" .5,.5,.5 -d uint8 || continue
    check "$kind is sRGB" luma 526 3 "a.$kind"
done
picture half.tif .5,.25,.125 -d half
check "float TIFF is light" light ".5 .25 .125" half.tif
picture a.hdr .5,.25,.125 -d float
check "HDR is light" light ".5 .25 .125" a.hdr

# dpx FILE TRANSFER COLORIMETRIC
dpx()
{
    picture "$1" .5,.5,.5 -d uint10 &&
        python3 -c "import sys; f = open(sys.argv[1], 'r+b'); f.seek(801); f.write(bytes(map(int, sys.argv[2:])))" "$@"
}
dpx linear.dpx 2 2
dpx video.dpx 6 6
dpx density.dpx 1 1
dpx log.dpx 3 3
dpx unsaid.dpx 0 0
check "linear DPX" luma "$(lit "64 + 876 * (512 / 1023) ** (1 / 2.4)")" 1 linear.dpx
check "video DPX" luma "$(lit "64 + 876 * 512 / 1023")" 1 video.dpx
check "printing density" exits 2 weft convert density.dpx "${raster[@]}" -o no.y4m
check "it says so" says "printing density"
check "and what to do" says "--from"
check "logarithmic" exits 2 weft convert log.dpx "${raster[@]}" -o no.y4m
check "with --from" luma 514 25 density.dpx --from rec709
check "a DPX that says nothing" exits 0 weft convert unsaid.dpx --raster 32x24@24p --subframe-rate 24 --overwrite -o o.y4m
check "is a warning" says "--from names"

# ---- Before the aperture ----

mkdir turns
for i in 0 1 2 3 4 5 6 7; do
    png "turns/s.$i.png" $((i % 2 * 255))
    picture "turns/t.$i.tif" "$((i % 2)),$((i % 2)),$((i % 2))" -d uint16
done
for kind in png tif; do
    [ $kind = png ] && files=(turns/s.*.png) || files=(turns/t.*.tif)
    check "black and white in turn, $kind" exits 0 weft convert "${files[@]}" --raster 32x24@24p \
        --subframe-rate 48 --temporal-width 1 --aperture box --bits 10 --overwrite -o o.y4m
    check "are half the light, $kind" python3 -c "
import struct; d = open('o.y4m', 'rb').read(); y = struct.unpack_from('<H', d, d.index(b'FRAME\n') + 6)[0]
raise SystemExit(abs(y - 720) > 1 and bool(print(y)) is False)"
done
mkdir encoded
for i in 0 1; do picture "encoded/e.$i.exr" "$i,$i,$i" -d half; done
check "EXR with an encoded --from, summed" exits 0 weft convert encoded --raster 32x24@24p --from sRGB \
    --subframe-rate 48 --temporal-width 1 --aperture box --bits 10 --overwrite -o o.y4m

finish
