#!/bin/bash
# Alpha of scenes: against closed forms of coverage, over backgrounds, through glass, and cut by holdouts.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh renders alpha"
needs oiiotool python3

# ---- Coverage ----

values() { oiiotool --dumpdata "$1" 2>/dev/null | sed -n 's/^ *Pixel (\([0-9]*\), \([0-9]*\)): \(.*\)$/\1 \2 \3/p'; }

# One unit is a frame line and a pixel; (0, 0) is the middle. A disk and a block that move.
cat >covered.lua <<'END'
camera{eye={0, 0, 100}, look_at={0, 0, 0}, ortho_height=16}
background{0.5, 0.25, 2, alpha=0}
duration(0.04)
add(sphere{center={-4.3, 1.2, 0}, radius=3.6}:material{color=0.5, unlit=true}:velocity{30, 0, 0})
add(box{min={4.7, -6.4, -1}, max={7.2, 5.3, 1}}:material{color={0.25, 1, 0.5}, unlit=true}:velocity{0, 40, 0})
END
check "coverage" exits 0 weft render covered.lua --raster 20x16@25i,tff,par=1:1 --fields separate --aperture box --temporal-width 1 \
    --samples 8192 -q --alpha-out -o a.####.exr
values a.0000.exr >a0
values a.0001.exr >a1
check "is as it should be" python3 - <<'END'
def overlap(a, b, low, high):
    return max(0, min(b, high) - max(a, low))

def disk(x, y, r, left, top, steps=200):  # share of a pixel two lines high, by chords
    total = 0
    for k in range(steps):
        dy = top + (k + .5) * 2 / steps - y
        half = max(0, r * r - dy * dy) ** .5
        total += overlap(x - half, x + half, left, left + 1)
    return total / steps

wrong, seen = [], 0
for field in (0, 1):
    times = [(field + (k + .5) / 48) / 50 for k in range(48)]
    for row in open(f"a{field}"):
        i, l, r, g, b, a = (float(v) for v in row.split())
        j = 2 * int(l) + field
        if j < 1 or j > 14:
            continue
        top = j - .5
        want = sum(disk(10 - 4.3 + 30 * t, 8 - 1.2, 3.6, i, top) for t in times) / 48
        want += overlap(14.7, 17.2, i, i + 1) * sum(overlap(8 - 5.3 - 40 * t, 8 + 6.4 - 40 * t, top, top + 2) for t in times) / 96
        seen += 0 < want < 1
        if abs(a - want) > 2e-3:
            wrong.append(f"field {field}, pixel {i}, line {j}: {a}, not {want}")
if wrong or seen < 80:
    raise SystemExit(f"{seen} edges\n" + "\n".join(wrong[:9]))
END

# ---- Stored samples ----

grid=(--raster 20x16@25i,tff,par=1:1 -q)
has() { oiiotool --info -v "$1" | grep -q "channel list: R, G, B, A"; }
agree() { oiiotool "$1" "$2" --fail "${3:-0}" --diff >diff.log || { cat diff.log; return 1; }; }
check "samples" exits 0 weft trace covered.lua "${grid[@]}" --samples 16 --frames 0-1 -o kept.####.exr
check "have alpha" has kept.0000.exr
check "from which fields are made" exits 0 weft convert kept.####.exr "${grid[@]}" --alpha-out -o of_kept.####.exr
check "as the scene" exits 0 weft render covered.lua "${grid[@]}" --samples 16 --frames 0-1 --alpha-out -o at_once.####.exr
check "has them" agree of_kept.0000.exr at_once.0000.exr
check "subframes" exits 0 weft trace covered.lua "${grid[@]}" --oversample 8x8x8 --frames 0-1 -o grid.####.exr
check "have it" has grid.0000.exr
check "and their fields" exits 0 weft convert grid.####.exr "${grid[@]}" --alpha-out -o of_grid.####.exr
check "are those of many samples" exits 0 weft render covered.lua "${grid[@]}" --samples 512 --frames 0-1 --alpha-out -o many.####.exr
check "within what a grid misses" agree of_grid.0000.exr many.0000.exr 0.07
cat >cut.lua <<'END'
camera{eye={0, 0, 100}, look_at={0, 0, 0}, ortho_height=16}
add(sphere{center={0, 0, 0}, radius=4}:material{holdout=true})
END
check "a holdout" exits 0 weft trace cut.lua --raster 20x16@25p -q --samples 1 --frames 0 -o cut.####.exr
check "is alpha too" has cut.0000.exr
check "an opaque scene" exits 0 weft trace "$WEFT_SOURCE/examples/scenes/still.lua" --raster 20x16@25p -q --samples 1 --frames 0 -o opaque.####.exr
check "has none" eval '! has opaque.0000.exr'

# ---- Glass and holdouts ----

# In front of a disk that moves and a block that does, a pane of which half comes through each surface; at the right a
# block cut by a holdout.
cat >scene.lua <<'END'
camera{eye={0, 0, 100}, look_at={0, 0, 0}, ortho_height=raster.lines}
background{0.5, 0.25, 2, alpha=tonumber(param.alpha or 0)}
duration(0.04)
add(sphere{center={-8.3, 2.2, 0}, radius=5.1}:material{color=0.5, unlit=true}:velocity{param.speed or 30, 0, 0})
add(box{min={2.7, -10.4, -1}, max={6.2, 10.3, 1}}:material{color={0.25, 1, 0.5}, unlit=true}:velocity{0, param.speed or 40, 0})
add(box{min={-13, -11, 20}, max={-3, -6, 21}}:material{color=1, refract=0.5, index=1, unlit=true, ambient=0})
add(box{min={9, -8, -1}, max={15, 8, 1}}:material{color=0.75, unlit=true})
add(box{min={11, -4, 2}, max={15, 2, 3}}:material{holdout=true, unlit=true})
END
render=(render scene.lua --raster 32x24@25i,tff,par=1:1 --fields separate --aperture box --temporal-width 1 -q --overwrite)
check "a scene" exits 0 weft "${render[@]}" --samples 16 --alpha-out -o b.####.exr
values b.0000.exr >b0
# near FILE LINE PIXEL ALPHA: of a field's line.
near() { awk -v i="$3" -v l="$2" -v want="$4" '$1 == i && $2 == l { d = $6 - want; good = d < 1e-6 && d > -1e-6 } END { exit !good }' "$1"; }
check "nothing is clear" near b0 0 0 0
check "two surfaces of glass are as clear as both" near b0 10 5 0.75
check "a block is opaque" near b0 3 27 1
check "and cut by what holds out" near b0 6 29 0

# lies_over OPTION..: filter(A over B) = filter(A) + (1 - alpha) B.
lies_over()
{
    exits 0 weft "${render[@]}" --samples 16 "$@" --alpha-out -o key.####.exr &&
        exits 0 weft "${render[@]}" --samples 16 "$@" --set alpha=1 -o over.####.exr || return 1
    for n in 0 1; do
        values key.000$n.exr >key.txt
        values over.000$n.exr >over.txt
        python3 - <<'END' || return 1
held = lambda i, l: 26 <= i and 3 <= l <= 9  # where B is cut, too
rows = [[[float(v) for v in line.split()] for line in open(name)] for name in ("key.txt", "over.txt")]
assert len(rows[0]) == len(rows[1]) == 32 * 12
worst = max(abs(k[2 + c] + (1 - k[5]) * (.5, .25, 2)[c] - o[2 + c]) for k, o in zip(*rows) if not held(k[0], k[1]) for c in range(3))
raise SystemExit(0 if worst < 1e-6 else f"{worst}")
END
    done
}
check "through the box" lies_over
check "through shaped" lies_over --aperture shaped --temporal-width 3/2
check "through notch, of tiles that stand still" lies_over --aperture notch --set speed=0
check "through diamond, with skew" lies_over --aperture diamond --scan-skew 1

# ---- What alpha is without being written, and in mirrors ----

weft "${render[@]}" --samples 16 -o black.####.exr
weft "${render[@]}" --samples 16 --alpha-out -o key.####.exr
check "color is the same" eval "oiiotool key.0000.exr --ch R,G,B black.0000.exr --fail 0 --diff >diff.log"
check "for any number of threads" eval "weft ${render[*]} --samples 16 --alpha-out --threads 1 -o one.####.exr && cmp one.0001.exr key.0001.exr"
check "and without skipping" eval "weft ${render[*]} --samples 16 --alpha-out --skip off -o one.####.exr && oiiotool one.0001.exr key.0001.exr --fail 1e-6 --diff >diff.log"
cat >mirror.lua <<'END'
camera{eye={0, 0, 100}, look_at={0, 0, 0}, ortho_height=24}
background{1, 0.5, 0.25, alpha=0}
add(box{min={-16, -12, -3}, max={16, 12, -2}}:material{color=0, reflect=0.5, ambient=0, diffuse=0})
END
check "a mirror" exits 0 weft render mirror.lua --raster 32x24@25p --samples 4 -q --alpha-out -o m.exr
check "is opaque, and shows what is behind the camera" eval "oiiotool m.exr --cut 1x1+5+5 --printstats | grep -q 'Stats Avg: 0.500000 0.250000 0.125000 1.000000'"
check "no alpha is said" exits 0 weft render "$WEFT_SOURCE/examples/scenes/still.lua" --raster 32x24@25p --frames 0 --samples 4 -q --alpha-out -o n.exr
check "so that all is opaque" eval "oiiotool n.exr --ch A --printstats | grep -q 'Stats Min: 1.000000'"
if has_libav; then
    check "fill and key" exits 0 weft "${render[@]/separate/woven}" --samples 4 --key k.mkv -o f.mkv
fi

# ---- What is refused ----

# refused TEXT STATUS SCENE OPTION..
refused()
{
    local word=$1
    echo "camera{eye={0, 1, -5}, look_at={0, 0, 0}} $3" >no.lua
    local status=$2
    shift 3
    exits "$status" weft render no.lua --raster 32x24@25p -o no.exr "$@" && says "$word"
}
check "an alpha of 2" refused "from 0 to 1, not 2" 1 "background{1, 1, 1, alpha=2}"
check "another key" refused "did you mean alpha" 1 "background{1, 1, 1, alhpa=0}"
check "a holdout of text" refused "true or false" 1 "add(sphere{radius=1, center={0, 0, 0}}:material{holdout='yes'})"
check "a goal of error" refused "give --samples" 2 "background{alpha=0}" --alpha-out --error 0.01
check "samples" exits 2 weft trace scene.lua --raster 32x24@25p --alpha-out -o no.####.exr

finish
