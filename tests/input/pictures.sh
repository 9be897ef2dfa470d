# shellcheck shell=bash
# Pictures of one color, and what convert makes of their light. Sourced after tests/program/script.sh.

raster=(--raster 32x24@24p --subframe-rate 24 --aperture box --temporal-width 0 --overwrite -q)

# picture FILE COLOR OPTION..: a picture of one color, in codes.
picture()
{
    local file=$1 color=$2
    shift 2
    oiiotool --pattern "constant:color=$color" 32x24 3 "$@" -o "$file"
}

# png FILE CODE CHUNK..: a gray PNG of 8 bits and these chunks, NAME:HEX.
png()
{
    python3 - "$@" <<'END'
import struct, sys, zlib
def chunk(name, data):
    body = name.encode() + data
    return struct.pack('>I', len(data)) + body + struct.pack('>I', zlib.crc32(body))
name, code, chunks = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
with open(name, 'wb') as f:
    f.write(b'\x89PNG\r\n\x1a\n' + chunk('IHDR', struct.pack('>2I5B', 32, 24, 8, 0, 0, 0, 0)))
    for c in chunks: f.write(chunk(c[:4], bytes.fromhex(c[5:])))
    f.write(chunk('IDAT', zlib.compress((b'\0' + bytes([code]) * 32) * 24)) + chunk('IEND', b''))
END
}

# luma CODE TOLERANCE ARGUMENT..: the first Y' of 10 bits that convert makes of the arguments.
luma()
{
    local should=$1 tolerance=$2
    shift 2
    exits 0 weft convert "$@" "${raster[@]}" --bits 10 -o o.y4m && python3 - "$should" "$tolerance" <<'END'
import struct, sys
data = open('o.y4m', 'rb').read()
at = data.index(b'FRAME\n') + 6
got = struct.unpack_from('<H', data, at)[0]
good = abs(got - float(sys.argv[1])) <= float(sys.argv[2])
if not good: print(got)
sys.exit(not good)
END
}

# light "R G B" ARGUMENT..: what convert makes of the arguments is linear EXR of that color.
light()
{
    local should=$1 got
    shift
    exits 0 weft convert "$@" "${raster[@]}" -o out.####.exr || return 1
    got=$(oiiotool --stats out.0000.exr | awk '/Stats Avg/ { print $3, $4, $5 }')
    python3 -c "import sys; a, b = (list(map(float, s.split())) for s in sys.argv[1:]); \
sys.exit(len(a) != 3 or any(abs(x - y) > 2e-6 + 2e-6 * abs(y) for x, y in zip(a, b)))" "$got" "$should" ||
        { echo "$got, not $should"; return 1; }
}
