#!/bin/bash
# Legal colors from end to end: subframes of ACEScg's primaries, ten times as bright as white, thin
# lines, and pixels that are no numbers, through `weft convert --legalize r103`, as `weft measure`
# sees the file; that threads change nothing, and what the report says of it.
. "$WEFT_SOURCE/tests/program/script.sh"

# in/KIND.####.exr: float R G B without compression, two of each.
python3 - <<'END'
import os, random, struct
from array import array
W, H = 180, 122
NAN, INF = float('nan'), float('inf')
PRIMARIES = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 1), (1, 0, 1), (1, 1, 1), (0, 0, 0)]

def bright(x, y, rnd):
    return [10 * v for v in PRIMARIES[(x // 13 + y // 17) % 8]]

def thin(x, y, rnd):
    return [10 * v for v in PRIMARIES[x // (1 + y // 25) % 8]]

def spark(x, y, rnd):
    if rnd.random() > .08: return [.4, .4, .4]
    return [v * rnd.choice((1, 5, 50, 500)) for v in PRIMARIES[rnd.randrange(6)]]

def mended(x, y, rnd):
    p = list(PRIMARIES[(x // 13 + y // 17) % 8])
    if rnd.random() < .04:
        p = [rnd.choice((NAN, INF, -INF, 65504., 1e30)) if rnd.random() < .6 else v for v in p]
    return p

def legal(x, y, rnd):
    return [.3 + .1 * v for v in PRIMARIES[x // 30 % 8]]

def attribute(name, kind, data):
    return name + b'\0' + kind + b'\0' + struct.pack('<i', len(data)) + data

def write(path, pixel):
    rnd = random.Random(1)
    box = struct.pack('<4i', 0, 0, W - 1, H - 1)
    channels = b''.join(c + b'\0' + struct.pack('<4i', 2, 0, 1, 1) for c in (b'B', b'G', b'R')) + b'\0'
    head = struct.pack('<2i', 20000630, 2)
    head += attribute(b'channels', b'chlist', channels) + attribute(b'compression', b'compression', b'\0')
    head += attribute(b'dataWindow', b'box2i', box) + attribute(b'displayWindow', b'box2i', box)
    head += attribute(b'lineOrder', b'lineOrder', b'\0')
    head += attribute(b'pixelAspectRatio', b'float', struct.pack('<f', 1))
    head += attribute(b'screenWindowCenter', b'v2f', struct.pack('<2f', 0, 0))
    head += attribute(b'screenWindowWidth', b'float', struct.pack('<f', 1)) + b'\0'
    size = 8 + 12 * W
    first = len(head) + 8 * H
    with open(path, 'wb') as f:
        f.write(head + struct.pack('<%dQ' % H, *(first + i * size for i in range(H))))
        for y in range(H):
            line = [pixel(x, y, rnd) for x in range(W)]
            f.write(struct.pack('<2i', y, 12 * W))
            for c in (2, 1, 0): f.write(array('f', [p[c] for p in line]).tobytes())

for pixel in (bright, thin, spark, mended, legal):
    os.makedirs('in/' + pixel.__name__)
    for i in range(2): write('in/%s/s.%04d.exr' % (pixel.__name__, i), pixel)
END

# make OUTPUT KIND STATUS OPTION..: two fields of it, with that exit status.
make()
{
    local output=$1 kind=$2 status=$3
    shift 3
    exits "$status" weft convert "in/$kind" --subframe-rate 50 --raster 180x122@25i,tff,709 --from ACEScg \
        --aperture box --temporal-width 0 --fit stretch --fix-nan box3 --overwrite -q -o "$output" \
        --report report.json "$@"
}

# outside FILE MOST REPORTED: the share that `weft measure` finds, which the report must know of.
outside()
{
    exits 0 weft measure "$1" --json && python3 - "$2" <<'END'
import json, sys
found = json.load(open('out'))['legal']['r103_share']
told = json.load(open('report.json'))['legal']
good = found <= float(sys.argv[1]) and abs(told['outside_share'] - found) < 1e-4 and \
    told['worst_frame_share'] >= told['outside_share'] and told['touched_share'] > .05
if not good: print(found, told)
sys.exit(not good)
END
}

# within KIND OPTION..
within()
{
    local kind=$1 status=0
    shift
    [ "$kind" = mended ] && status=3
    make o.y4m "$kind" $status --legalize r103 "$@" && outside o.y4m .002
}

kinds="bright mended"
is_sanitized || kinds="bright thin spark mended"
for kind in $kinds; do
    check "$kind" within "$kind"
    check "$kind, adjusted, 12 bits" within "$kind" --chroma luma-adjust --bits 12
done
check "8 bits with noise" within mended --bits 8 --dither tpdf
check "4:4:4 of full range" within bright --chroma 444 --bits 12 --range full
# Scenes and sample buffers are counted as subframes are.
cat >scene.lua <<'END'
duration(.08)
camera{eye={0, 0, 10}, look_at={0, 0, 0}}
background{10, .05, .02}
END
# sampled COMMAND INPUT: two frames of it, held to r103.
sampled()
{
    exits 0 weft "$1" "$2" --raster 180x122@25i,tff,709 --from ACEScg --legalize r103 --overwrite -q \
        -o o.y4m --report report.json && outside o.y4m .002
}
check "a scene" sampled render scene.lua
check "samples are stored" exits 0 weft trace scene.lua --raster 180x122@25i,tff,709 -q -o 'deep.####.exr'
check "sample buffers" sampled convert 'deep.####.exr'

check "adjusted with noise" within bright --chroma luma-adjust --dither tpdf
check "without" make o.y4m bright 0
check "is outside without" eval "exits 0 weft measure o.y4m --json && value \"d['legal']['r103_share'] > .3\""

# Pictures are R'G'B' of full range, where there is nothing outside.
check "PNG" make 'o.####.png' bright 0 --legalize r103
check "PNG is within" eval "exits 0 weft measure o.0000.png --json && value \"d['legal']['r103_share'] == 0\""

# The codes of what is legal stay; a still stays one; threads do not matter.
for dither in none tpdf; do
    check "legal, $dither" make a.y4m legal 0 --dither $dither
    check "legal and held so, $dither" make b.y4m legal 0 --dither $dither --legalize r103
    check "legal codes stay, $dither" cmp a.y4m b.y4m
done
check "one thread" make a.y4m spark 0 --dither tpdf --legalize r103 --threads 1
check "three threads" make b.y4m spark 0 --dither tpdf --legalize r103 --threads 3
check "the same codes" cmp a.y4m b.y4m
finish
