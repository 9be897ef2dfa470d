#!/bin/bash
# Alpha that is written: through the aperture as color is, as each kind of file has it, and by the law of
# fill and key.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh writes alpha"
needs oiiotool python3

# Noise with alpha, premultiplied, that is different in every subframe.
mkdir noise shot
for i in 0 1 2 3 4 5 6 7; do
    oiiotool --pattern noise:type=uniform:seed=$i:min=0:max=1 80x60 4 --premult -d float -o noise/s.000$i.exr
    oiiotool --create 96x64 4 --fill:color=0.5,0.25,0.1,1:size=60x40+$((8 + i))+8 60x40+$((8 + i))+8 \
        --fill:color=0.25,0.125,0.05,0.5 16x30+76+20 -d float -o shot/s.000$i.exr
done

# lies_over APERTURE RASTER: filter(A over B) = filter(A) + (1 - alpha) B within 1e-6, frame by frame.
lies_over()
{
    local n=0
    rm -f a.*.exr over.*.exr
    exits 0 weft convert noise --subframe-rate 120 --raster "$2" --fit stretch --aperture "$1" -q --alpha-out -o a.####.exr || return 1
    exits 0 weft convert noise --subframe-rate 120 --raster "$2" --fit stretch --aperture "$1" -q --background .2,.4,3 \
        -o over.####.exr || return 1
    while [ -e over.000$n.exr ]; do
        oiiotool a.000$n.exr --create "$(oiiotool --info a.000$n.exr | sed 's/.*: *\([0-9]*\) x *\([0-9]*\),.*/\1x\2/')" 4 \
            --fill:color=.2,.4,3,1 "$(oiiotool --info a.000$n.exr | sed 's/.*: *\([0-9]*\) x *\([0-9]*\),.*/\1x\2/')" \
            --over --ch R,G,B over.000$n.exr --fail 1e-6 --diff >diff.log || { cat diff.log; return 1; }
        n=$((n + 1))
    done
    [ $n -gt 0 ]
}
check "box, interlaced" lies_over box 48x40@25i,tff
check "shaped, interlaced" lies_over shaped 64x50@29.97i,bff
check "notch, whole frames" lies_over notch 80x60@30p

# ---- Kinds of files ----

# at FILE X Y VALUES: a pixel as it is stored is this within .002.
at()
{
    oiiotool -i:unpremult=0:autocc=0 "$1" --cut "1x1+$2+$3" --printstats | sed -n 's/.*Stats Avg: \([-0-9. ]*\).*/\1/p' >have
    python3 -c "
have, want = open('have').read().split(), '$4'.split()
raise SystemExit(len(have) != len(want) or any(abs(float(a) - float(b)) > .002 for a, b in zip(have, want)))" || { cat have; return 1; }
}
made_of()
{
    exits 0 weft convert shot --subframe-rate 192 --raster 96x64@24p --aperture line --temporal-width 0 -q --overwrite --alpha-out "$@"
}
check "EXR" made_of -o e.exr
check "is premultiplied" at e.exr 84 30 ".25 .125 .05 .5"
check "and clear where nothing is" at e.exr 2 2 "0 0 0 0"
check "PNG" made_of -o p.png
# oiiotool multiplies what it reads by alpha: .5^(1/2.4) .5 is .3746.
check "is straight" at p.png 84 30 ".3746 .2806 .1916 .5"
check "TIFF" made_of -o t.tif
check "is premultiplied in codes" at t.tif 84 30 ".5612 .4204 .2870 .5"
check "and says so" eval "! oiiotool --info -v t.tif | grep -q UnassociatedAlpha"
check "straight TIFF" made_of --fill straight -o s.tif
check "says so, too" eval "oiiotool --info -v s.tif | grep -q 'UnassociatedAlpha: 1'"
check "and is" at s.tif 84 30 ".3746 .2806 .1916 .5"
check "DPX" made_of -o d.dpx
check "is premultiplied in codes of 10 bits" at d.dpx 84 30 ".5612 .4204 .2870 .5"
made_of -o back.png --bits 16
check "weft reads it back" exits 0 weft convert back.png --subframe-rate 24 --raster 96x64@24p --aperture line --temporal-width 0 \
    --from rec709 -q --alpha-out --overwrite -o back.exr
check "as it was" at back.exr 84 30 ".25 .125 .05 .5"
check "fields apart" exits 0 weft convert shot --subframe-rate 192 --raster 96x64@24i,tff --fit stretch -q --alpha-out --fields separate -o f.####.png
check "have alpha" eval "oiiotool --info -v f.0001.png | grep -q 'R, G, B, A'"

# ---- The law of codes ----

check "the law of codes" made_of --key-law encoded --fill premultiplied -o k.tif --report k.json
# The K and F of three channels whose largest error over all backgrounds is least, by trying all of them.
check "is the best there is" python3 - <<'END'
import json, subprocess
light, alpha, steps = (.25, .125, .05), .5, 400
def code(v): return max(v, 0) ** (1 / 2.4)
def span(a, m):
    rest = [code(a + (1 - alpha) * (i / steps) ** 2.4) - m * i / steps for i in range(steps + 1)]
    return min(rest), max(rest)
worst, m = min((max(hi - lo for lo, hi in (span(a, k / 2000) for a in light)), k / 2000) for k in range(600, 1400))
want = [sum(span(a, m)) / 2 for a in light] + [1 - m]
have = subprocess.run(["oiiotool", "-i:unpremult=0", "k.tif", "--cut", "1x1+84+30", "--printstats"], capture_output=True, text=True).stdout
have = [float(x) for x in have.split("Stats Avg:")[1].split("(")[0].split()]
report = json.load(open("k.json"))["alpha"]
assert report == {"fill": "premultiplied", "law": "encoded", "clipped_share": 0}, report
raise SystemExit(any(abs(a - b) > .002 for a, b in zip(have, want)) and f"{have} {want}")
END
check "what hides everything stays" at k.tif 40 30 ".7492 .5612 .3831 1"

# ---- Samples ----

# Samples whose alpha is their red: what is written is equal, too.
check "samples" exits 0 weft trace "$WEFT_SOURCE/examples/scenes/still.lua" --raster 48x36@25i --samples 4 --frames 0-1 -q -o traced.####.exr
for n in 0 1; do oiiotool traced.000$n.exr --ch R,G,B,A=R,sample.t,sample.x,sample.y -o deep.000$n.exr; done
check "with alpha" exits 0 weft convert deep.####.exr --raster 48x36@25i -q --alpha-out -o keyed.####.exr
check "are gathered with it" eval "oiiotool keyed.0001.exr --ch R keyed.0001.exr --ch A --fail 0 --diff >diff.log"
weft convert traced.####.exr --raster 48x36@25i -q -o color.####.exr
check "beside color as it was" eval "oiiotool keyed.0001.exr --ch R,G,B color.0001.exr --fail 0 --diff >diff.log"
weft convert traced.####.exr --raster 48x36@25i -q --alpha-out -o opaque.####.exr
check "and where they have none are opaque" eval "oiiotool opaque.0001.exr --ch A --printstats | grep -q 'Stats Avg: 1.000000'"

# ---- What is refused ----

# refused TEXT OPTION..
refused()
{
    local word=$1
    shift
    exits 2 weft convert shot --subframe-rate 192 --raster 96x64@24p "$@" && says "$word"
}
check "Y4M" refused "holds no alpha" --alpha-out -o no.y4m
check "premultiplied PNG" refused "always straight" --alpha-out --fill premultiplied -o no.####.png
check "straight EXR" refused "always premultiplied" --alpha-out --fill straight -o no.####.exr
check "a law of codes for light" refused "holds light" --alpha-out --key-law encoded -o no.####.exr
check "a fill of nothing" refused "--alpha-out too" --fill straight -o no.####.png
check "a background" refused "--background fills it" --alpha-out --background 1,1,1 -o no.####.png
check "samples that are stored" exits 2 weft trace "$WEFT_SOURCE/examples/scenes/still.lua" --alpha-out -o no.####.exr

finish
