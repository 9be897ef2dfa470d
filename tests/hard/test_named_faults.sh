#!/bin/bash
# What the system has against a file is said, through every door, and not taken for what the file is; what cannot be written is
# told before the work.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/hard/common.sh"
scene=$WEFT_SOURCE/examples/scenes/carousel.lua
small=(--raster 48x36@30i,tff -q --overwrite)

check "subframes" exits 0 weft trace "$scene" "${small[@]}" --samples 1 --frames 0-1 --oversample 1x1x2 -o in.####.exr
check "samples" exits 0 weft trace "$scene" "${small[@]}" --samples 1 --frames 0 -o deep.####.exr
check "pictures" exits 0 weft convert in.####.exr --raster 48x36@60p -q -o p.####.png
check "Y4M" exits 0 weft convert in.####.exr --raster 48x36@60p -q -o v.y4m

# ---- EIO and EMFILE ----

while read -r fault words; do
    check "$fault of EXR" every "$fault" "$words" "$WEFT" convert in.####.exr "${small[@]}" -o o.y4m
    check "$fault of deep EXR" every "$fault" "$words" "$WEFT" convert deep.####.exr "${small[@]}" -o o.y4m
    check "$fault of Y4M" every "$fault" "$words" "$WEFT" convert v.y4m "${small[@]}" -o o.y4m
    check "$fault of Y4M, measured" every "$fault" "$words" "$WEFT" measure v.y4m
    check "$fault of Y4M, verified" every "$fault" "$words" "$WEFT" verify v.y4m
    check "$fault of PNG" every "$fault" "$words" "$WEFT" convert p.####.png --subframe-rate 60 "${small[@]}" -o o.y4m
    if has_libav; then
        [ -f v.mov ] || check "MOV" exits 0 weft convert in.####.exr --raster 48x36@60p -q --audio silent:2 -o v.mov
        [ -f s.wav ] || python3 "$WEFT_SOURCE/tests/input/sound.py" wav s.wav 48000 16 2 4000
        check "$fault of MOV" every "$fault" "$words" "$WEFT" convert v.mov "${small[@]}" -o o.y4m
        check "$fault of WAV" every "$fault" "$words" "$WEFT" convert v.mov "${small[@]}" --audio s.wav -o o.mov
    fi
    [ "$fault" = read ] || continue
    echo '{"inputs": "v.y4m", "output": "o.y4m", "raster": "48x36@30i,tff", "overwrite": true}' >job.json
    check "$fault of a job file" every "$fault" "$words" "$WEFT" convert --job job.json
    cp "$scene" scene.lua
    check "$fault of a scene" every "$fault" "$words" "$WEFT" render scene.lua "${small[@]}" --samples 1 --frames 0 -o o.y4m
done <<'END'
read Input/output error
open Too many open files
END

# ---- Threads ----

check "no threads" exits 0 failing thread:1:more "$WEFT" convert in.####.exr "${small[@]}" --threads 4 -o one.y4m
check "the same" cmp one.y4m <("$WEFT" convert in.####.exr "${small[@]}" --threads 1 -o -)
check "no threads for OpenImageIO" fails "no more of them" failing thread:1:more "$WEFT" convert in.####.exr "${small[@]}" -o x.####.tif
if [ "$(id -u)" = 0 ] && command -v setpriv >/dev/null; then
    limited() { setpriv --reuid=65534 --regid=65534 --clear-groups bash -c 'ulimit -u 1; exec "$@"' - "$@"; }
    chmod 711 . && mkdir free && chmod 777 free
    if setpriv --reuid=65534 --regid=65534 --clear-groups test -x "$WEFT"; then
        check "ulimit -u, a scene" exits 0 limited "$WEFT" render "$scene" "${small[@]}" --samples 2 --frames 0 --threads 4 -o free/o.y4m
        check "ulimit -u, TIFF" fails "ulimit -u" limited "$WEFT" render "$scene" "${small[@]}" --samples 2 --frames 0 -o free/o.####.tif
        check "ulimit -u, a design" exits 0 limited "$WEFT" filters design sharp=0.7
    else
        skip_part "the build is in a folder that another user cannot enter"
    fi
else
    skip_part "ulimit -u does not count root's threads, and there is no setpriv"
fi

# ---- Outputs that cannot be written ----

rm -f o.y4m
heavy=("$WEFT" render "$scene" --raster 525i --samples 64 --frames 0-99 -q)
for options in '-o /nonexistent/o.y4m' '-o /nonexistent/o.####.png' '-o /nonexistent/o.####.exr' '-o /nonexistent/o.####.dpx' \
    '-o o.y4m --report /nonexistent/r.json' '-o o.y4m --report .' '-o o.####.png --alpha-out --key /nonexistent/k.####.png'; do
    # shellcheck disable=SC2086
    check "$options" exits 1 timeout 60 "${heavy[@]}" $options
    check "$options is named" grep -q "nothing can be written in the directory\|this is a directory" said
    check "$options leaves nothing" test ! -e o.y4m -a ! -e o.0000.png
done
check "a trace" exits 1 timeout 60 "$WEFT" trace "$scene" --raster 1080i50 --samples 64 --frames 0-9 --oversample 2x2x4 -q -o /nonexistent/o.####.exr
check "a heat map" fails "nothing can be written" failing read:1 "$WEFT" measure v.y4m --heatmap /nonexistent/h.png
check "a response" fails "nothing can be written" "$WEFT" filters shaped --plot /nonexistent/h.png
check "a frontier" fails "nothing can be written" "$WEFT" filters --frontier /nonexistent/h.png
echo '{"items": [}' >broken.json
check "a plot" fails "nothing can be written" "$WEFT" plot broken.json -o /nonexistent/h.png

# ---- NaN without a finite neighbor ----

python3 - <<'END'
import struct
# A scanline EXR, half, without compression: channels B G R of 8x4, whose left 4 columns are NaN.
def attr(name, kind, data): return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data
def channel(name): return name.encode() + b"\0" + struct.pack("<iB3xii", 1, 0, 1, 1)
box = struct.pack("<4i", 0, 0, 7, 3)
head = struct.pack("<ii", 20000630, 2) + attr("channels", "chlist", b"".join(map(channel, "BGR")) + b"\0") \
    + attr("compression", "compression", b"\0") + attr("dataWindow", "box2i", box) + attr("displayWindow", "box2i", box) \
    + attr("lineOrder", "lineOrder", b"\0") + attr("pixelAspectRatio", "float", struct.pack("<f", 1)) \
    + attr("screenWindowCenter", "v2f", bytes(8)) + attr("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
line = (struct.pack("<H", 0x7e00) * 4 + struct.pack("<e", 0.5) * 4) * 3
size = 8 + len(line)
table = b"".join(struct.pack("<Q", len(head) + 32 + y * size) for y in range(4))
body = b"".join(struct.pack("<ii", y, len(line)) + line for y in range(4))
open("nan.0000.exr", "wb").write(head + table + body)
END
check "NaN beside NaN" exits 3 weft convert nan.0000.exr --subframe-rate 24 --raster 8x4@24p --aperture box --report r.json -o nan.y4m
check "is told" says "16 pixels of the input were NaN or infinite: they are the means of their neighbors, but for 12 that had no finite one and are black"
check "and reported" python3 -c "import json; i = json.load(open('r.json'))['input']; assert (i['nan_fixed'], i['nan_alone']) == (16, 12), i"

# ---- A program of the examples ----

check "make_subframes --help" exits 0 "$WEFT_BUILD/make_subframes" --help
check "says how" prints "usage: make_subframes DIRECTORY [COUNT]"
check "no directory --help" test ! -e --help
for wrong in '-x' 'd 0' 'd x' 'd 3x' ''; do
    # shellcheck disable=SC2086
    check "make_subframes $wrong" exits 2 "$WEFT_BUILD/make_subframes" $wrong
done
finish
