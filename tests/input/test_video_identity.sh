#!/bin/bash
# Video that is decoded to light and encoded again: codes as they were, of every range of light; and half the light of
# black and white in turn, of every codec.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_video_light.c"
needs_libav
needs ffmpeg python3
. "$WEFT_SOURCE/tests/input/gray_video.sh"

# ---- Half the light ----

# halves BY FILE [OPTION..]: all frames are code 720 of 10 bits, within BY.
halves()
{
    local by=$1
    exits 0 weft convert "$2" $box --from rec709 "${@:3}" -o o.y4m || return 1
    python3 - "$by" <<'P'
import sys
data = open("o.y4m", "rb").read()
data = data[data.index(b"\n") + 1:]
size = 64 * 32 * 4 + 6
codes = [int.from_bytes(data[at + 6 + i:at + 8 + i], "little") for at in range(0, len(data), size) for i in range(0, 4096, 2)]
if len(data) != 25 * size or any(abs(c - 720) > int(sys.argv[1]) for c in codes):
    sys.exit("%d bytes, codes from %d to %d" % (len(data), min(codes), max(codes)))
P
}
coded() { quiet_ffmpeg -i turns.y4m "${@:2}" "$1"; }
check "Y4M" halves 1 turns.y4m
coded half.mov -pix_fmt yuv422p10le -c:v prores_ks
check "ProRes" halves 2 half.mov
coded half.mp4 -pix_fmt yuv420p -c:v libx264 -bf 2 -crf 12
check "H.264" halves 2 half.mp4
coded whole.mp4 -pix_fmt yuv420p -c:v libx264 -qp 0
check "H.264 without loss" halves 1 whole.mp4
coded half.ts -pix_fmt yuv422p -r 50 -vf select='not(mod(n\,2))' -c:v mpeg2video -q:v 2
check "white alone" exits 0 weft convert half.ts $box --from rec709 -o o.y4m
mkdir pictures && quiet_ffmpeg -i turns.y4m -pix_fmt gray pictures/%03d.png
check "PNG" halves 1 pictures --from sRGB --subframe-rate 100

# ---- Identity ----

# any FILE BITS HEADER: a frame of 4:4:4 with codes of all kinds.
any()
{
    python3 - "$@" <<'P'
import random, sys
name, bits = sys.argv[1], int(sys.argv[2])
random.seed(bits)
top = 1 << bits - 8
with open(name, "wb") as f:
    f.write(b"YUV4MPEG2 W16 H720 F25:1 Ip A1:1 C444%s\n" % (b"" if bits == 8 else b"p%d" % bits))
    f.write(b"FRAME\n" + b"".join(random.randint(top, 255 * top - 1).to_bytes((bits + 7) // 8, "little")
                                  for _ in range(3 * 16 * 720)))
P
}

# again BITS RASTER SPACE [OPTION..]: the codes come back within one.
again()
{
    local bits=$1 raster=$2
    exits 0 weft convert any.y4m --raster "$raster" --aperture line --temporal-width 0 --chroma 444 --dither none --bits "$bits" \
        --overwrite "${@:3}" -o again.y4m || return 1
    python3 - "$bits" <<'P'
import sys
size = (int(sys.argv[1]) + 7) // 8
def codes(name):
    data = open(name, "rb").read()
    data = data[data.index(b"FRAME\n") + 6:]
    return [int.from_bytes(data[i:i + size], "little") for i in range(0, len(data), size)]
a, b = codes("any.y4m"), codes("again.y4m")
off = [abs(x - y) for x, y in zip(a, b)]
if len(a) != len(b) or max(off) > 1: sys.exit("%d codes, %d; off by %d, %d of them" % (len(a), len(b), max(off), sum(o > 1 for o in off)))
P
}
for bits in 8 10 12; do
    any any.y4m $bits
    check "Rec. 709, $bits bits" again $bits 16x720@25p --from rec709
    check "Rec. 2020, $bits bits" again $bits 16x720@25p,2020 --from rec2020
    check "PQ, $bits bits" again $bits 16x720@25p,2020 --from rec2100-pq --to rec2100-pq
    check "HLG, $bits bits" again $bits 16x720@25p,2020 --from rec2100-hlg --to rec2100-hlg
done
finish
