#!/bin/bash
# --flicker-limit visible:N: no more of flicker is seen than is allowed, and the picture is sharper than a blurred one.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh holds flicker"

# Stills unlike the scenes: noise, stars, lines, and blocks like lettering.
cat >stills.py <<'END'
import random, struct, zlib

def chunk(kind, data):
    return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))

def write(name, width, lines, light):
    """A PNG of 16 bits, gray."""
    rows = b''.join(b'\0' + b''.join(struct.pack('>H', round(65535 * light(x, y) ** (1 / 2.2))) for x in range(width))
                    for y in range(lines))
    header = struct.pack('>IIBBBBB', width, lines, 16, 0, 0, 0, 0)
    with open(name, 'wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', header) + chunk(b'IDAT', zlib.compress(rows, 1)) +
                   chunk(b'IEND', b''))

random.seed(7)
width, lines = 240, 320
noise = [[random.random() ** 3 for _ in range(width // 2)] for _ in range(lines)]
stars = {(random.randrange(width), random.randrange(lines)) for _ in range(60)}
glyph = [[random.random() < .5 for _ in range(30)] for _ in range(lines)]
pictures = {
    'noise': lambda x, y: noise[y][x // 2],
    'stars': lambda x, y: 1.0 if (x, y // 2 * 2) in stars or (x - 1, y // 2 * 2) in stars else 0.01,
    'lines': lambda x, y: 0.9 if (y + x // 40) % (4 + x // 60) < 2 else 0.05,
    'letters': lambda x, y: (0.95 if glyph[y // 4 * 4][x // 8] and y % 40 > 12 else 0.08) * (1 if y < 200 else 0.1),
}
for name, light in pictures.items():
    write(name + '.png', width, lines, light)
END
needs python3
python3 stills.py

# Each in an interlaced raster as it is, and with 2, 1 and a half of a just noticeable difference allowed.
worst=0
for picture in noise stars lines letters; do
    make() { "$WEFT" convert $picture.png --subframe-rate 30 --raster 240x160@30psf --overwrite -q --temporal-width 0 "$@"; }
    make --aperture line -o "sharp.####.exr"
    check "$picture is measured" exits 0 weft measure sharp.0000.exr --raster 240x160@30psf --json
    cp out sharp.json
    for allowed in 2 1 0.5; do
        make --flicker-limit visible:$allowed -o "held.####.exr" --report report.json
        check "$picture with $allowed" exits 0 weft measure held.0000.exr --raster 240x160@30psf --json
        check "no more is seen" value "d['flicker']['visible']['jnd_p999'] <= 1.1 * $allowed"
        check "it would have been more, or little is done" value "
            json.load(open('sharp.json'))['flicker']['visible']['jnd_p999'] > $allowed or
            d['flicker']['visible']['jnd_p999'] > .3 * json.load(open('sharp.json'))['flicker']['visible']['jnd_p999']"
    done
    check "the report says so" python3 -c "import json; f = json.load(open('report.json'))['flicker']
assert f['limit'] is None and f['limit_jnd'] == .5 and f['columns_solved'] > 0"
done

# From afar and in the dark less is seen, so more may flicker.
cp lines.png one.png
far() { "$WEFT" convert one.png --subframe-rate 30 --raster 240x160@30psf -q --overwrite --temporal-width 0 \
    --flicker-limit visible:1 "$@" -o 'f.####.exr' && weft measure f.0000.exr --raster 240x160@30psf --json >out; }
check "as usual" far
cp out usual.json
check "in the dark" far --peak 5
check "more flickers" value "d['flicker']['rms'] > 1.1 * json.load(open('usual.json'))['flicker']['rms']"
check "moving fields" "$WEFT" render "$WEFT_SOURCE/examples/scenes/slow_edges.lua" -q --samples 4 --raster 240x160@30i,tff \
    --frames 0-2 --flicker-limit visible:1 -o moving.y4m
check "are measured" exits 0 weft measure moving.y4m --json
check "and hold it" value "d['flicker']['visible']['jnd_p999'] <= 1.1"
for threads in 1 3; do
    "$WEFT" render "$WEFT_SOURCE/examples/scenes/slow_edges.lua" -q --samples 4 --raster 240x160@30i,tff \
        --frames 0-2 --flicker-limit visible:1 --threads $threads -o threads$threads.y4m
done
check "threads do not matter" cmp threads1.y4m threads3.y4m

check "nothing after the colon" refuses "visible:N" convert one.png --flicker-limit visible: -o x.y4m
check "too little" refuses "from 0.05" convert one.png --flicker-limit visible:0.01 -o x.y4m
check "a distance for nothing" refuses "visible:N" convert one.png --subframe-rate 30 --view-distance 3 -o x.y4m
check "a peak for light" refuses "visible:N" convert one.png --subframe-rate 30 --flicker-limit 0.02 --peak 100 -o x.y4m

finish
