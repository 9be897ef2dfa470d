#!/bin/bash
# Water in glass as POV-Ray sees it: each pixel's middle shows the same, sky or which square. Squares
# that are 1,300 units away may differ: there POV-Ray's steps off surfaces show, and of the eight that
# do numbers of 50 digits say what weft does.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
weft=${WEFT_BUILD:-$source_dir/build}/weft
command -v povray >/dev/null && command -v oiiotool >/dev/null || { echo "skipped: no povray or oiiotool"; exit 77; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cd "$out"
cat >glass.lua <<'END'
camera{eye={0, 2, 9}, look_at={0, 0, 0}, fov=40}
background{.1, .2, .3}
depth(20)
add(halfspace{normal={0, 1, 0}, offset=-1.6}:material{unlit=true, texture=checker{.8, .2}})
local clear = {color=1, diffuse=0, ambient=0, refract=1}
clear.index = 1.5 add(sphere{radius=1.5}:material(clear))
clear.index = 1.33 add(sphere{radius=1.2}:material(clear))
END
"$weft" render glass.lua --raster 400x300@25p,par=1:1 --samples 1 --sampler grid --aperture line \
    --temporal-width 0 --frames 0 -q -o weft.exr
povray "+I$source_dir/tests/peers/nested_glass.pov" +Opov.exr +FE +W400 +H300 -A -D >log 2>&1 || { cat log; exit 1; }
for who in weft pov; do oiiotool $who.exr --ch R,G,B -d uint8 -o $who.ppm; done
python3 - <<'END'
def pixels(name):
    data = open(name, "rb").read()[-400 * 300 * 3:]
    return [tuple(data[k:k + 3]) for k in range(0, len(data), 3)]

def kind(rgb):
    return "sky" if rgb[0] < rgb[2] else "light" if rgb[0] > 128 else "dark"

pairs = [(kind(a), kind(b)) for a, b in zip(pixels("weft.ppm"), pixels("pov.ppm"))]
sky = sum((a == "sky") != (b == "sky") for a, b in pairs)
other = sum(a != b for a, b in pairs)
print(f"{len(pairs)} pixels: {sky} are sky in one alone, {other} another square")
raise SystemExit(sky > 0 or other > 8)
END
