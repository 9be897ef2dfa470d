# shellcheck shell=bash disable=SC2034
# Video of gray pictures, what they become, and what makes fields of them, for scripts about video.

# y4m FILE HEADER COUNT CODES: COUNT pictures in Y4M of 10 bits 4:4:4, each of one gray of a list
# of codes that is gone through again and again.
y4m()
{
    python3 - "$@" <<'P'
import sys
name, header, count, codes = sys.argv[1], sys.argv[2], int(sys.argv[3]), [int(c) for c in sys.argv[4:]]
words = dict((w[0], w[1:]) for w in header.split())
pixels = int(words["W"]) * int(words["H"])
with open(name, "wb") as f:
    f.write(b"YUV4MPEG2 %s\n" % header.encode())
    for k in range(count):
        f.write(b"FRAME\n" + codes[k % len(codes)].to_bytes(2, "little") * pixels +
                (512).to_bytes(2, "little") * (2 * pixels))
P
}

# first_code FILE CODE FRAMES: the first luma of all frames of 64x32 4:2:2 of 10 bits is CODE.
first_code()
{
    python3 - "$@" <<'P'
import sys
data, code, frames = open(sys.argv[1], "rb").read(), int(sys.argv[2]), int(sys.argv[3])
size = 64 * 32 * 4 + 6
data = data[data.index(b"\n") + 1:]
got = [int.from_bytes(data[at + 6 + 2000:at + 6 + 2002], "little") for at in range(0, len(data), size)]
if len(got) != frames or any(abs(g - code) > 1 for g in got): sys.exit("codes %r, not %d times %d" % (got, frames, code))
P
}

box="--raster 64x32@25i --aperture box --temporal-width 1 --bits 10 --dither none -q --overwrite"
y4m turns.y4m "W64 H32 F100:1 Ip A1:1 C444p10" 100 64 940
