#!/bin/bash
# Primaries are those that files say, and are kept where light is written; what is taken is told;
# spaces of other configurations are decoded before apertures.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/input/pictures.sh"
not_sanitized "test_file_colors.c and test_ocio.c do this"
needs oiiotool python3

# told KEY VALUE REASON: the report has it.
told()
{
    python3 -c "import json, sys; r = json.load(open('r.json'))['input'][sys.argv[1]]
sys.exit([r['value'], r['reason']] != sys.argv[2:] and bool(print(r)) is False)" "$@"
}

png plain.png 128
png cicp.png 128 cICP:01010001
picture density.dpx .5,.5,.5 -d uint10
python3 -c "f = open('density.dpx', 'r+b'); f.seek(801); f.write(bytes([1, 1]))"

# ---- Primaries ----

ap1=.713,.293,.165,.83,.128,.044,.32168,.33767
picture ap1.exr .8,.1,.1 -d float --attrib:type=float[8] chromaticities $ap1
check "chromaticities" exits 0 weft convert ap1.exr "${raster[@]}" --bits 8 -o a.####.png
check "--from ACEScg" exits 0 weft convert ap1.exr --from ACEScg "${raster[@]}" --bits 8 -o b.####.png
check "are one" cmp a.0000.png b.0000.png
check "they are kept" light ".8 .1 .1" ap1.exr
check "and said" eval 'oiiotool --info -v out.0000.exr | grep -q "chromaticities: 0.713, 0.293, 0.165"'
check "by name too" eval 'oiiotool --info -v out.0000.exr | grep -q "weft:colorSpace: \"ACEScg\""'
picture odd.exr .8,.1,.1 -d float --attrib:type=float[8] chromaticities .65,.33,.28,.61,.16,.05,.3127,.329
check "any are kept" light ".8 .1 .1" odd.exr
check "and any are said" eval 'oiiotool --info -v out.0000.exr | grep -q "chromaticities: 0.65, 0.33, 0.28"'
picture interop.exr .8,.1,.1 -d float --attrib colorInteropID lin_ap1_scene
check "colorInteropID" exits 0 weft convert interop.exr "${raster[@]}" --bits 8 -o b.####.png
check "is the same" cmp a.0000.png b.0000.png
mkdir mixed && picture mixed/m.0.exr .8,.1,.1 && cp ap1.exr mixed/m.1.exr
check "primaries that change" exits 1 weft convert mixed "${raster[@]}" -o no.y4m
check "are refused" says "--from"

# ---- Exposure ----

check "a stop more" light "1.6 .2 .2" ap1.exr --exposure 1
check "with its sign" light "1.6 .2 .2" ap1.exr --exposure +1
check "half a stop less" light ".5656854 .0707107 .0707107" ap1.exr --exposure -0.5
check "of codes" luma "$(python3 -c "print(64 + 876 * (((128/255 + .055) / 1.055) ** 2.4 / 2) ** (1 / 2.4))")" .6 plain.png --exposure -1
check "no number" exits 2 weft convert ap1.exr --exposure bright "${raster[@]}" -o no.y4m

# ---- What is told ----

check "a report" exits 0 weft convert plain.png "${raster[@]}" -o o.y4m --report r.json
check "space" told space sRGB default
check "transfer" told transfer sRGB default
exits 0 weft convert ap1.exr "${raster[@]}" -o o.y4m --report r.json
check "space of the file" told space ACEScg file
exits 0 weft convert ap1.exr "${raster[@]}" --from lin_rec2020 -o o.y4m --report r.json
check "space by option" told space lin_rec2020 option
check "info" exits 0 weft info cicp.png density.dpx
check "info has it" prints "rec709 (file)"
check "info tells what it cannot know" prints "printing density"
exits 0 weft convert ap1.exr "${raster[@]}" --from rec2100-pq -o o.y4m --report r.json
check "transfer by option" told transfer PQ option
check "no such space, EXR" exits 2 weft convert ap1.exr --from nix "${raster[@]}" -o no.####.exr
check "no such space, Y4M" exits 2 weft convert ap1.exr --from nix "${raster[@]}" -o no.y4m
check "an encoded scene" eval 'echo "camera{eye={0, 0, 10}, look_at={0, 0, 0}}" >s.lua
    exits 2 weft render s.lua --from rec709 --raster 32x24@24p -o no.y4m'
check "says why" says "must be linear"
check "nothing was written" eval '! ls no.* 2>/dev/null'

# ---- Other configurations ----

config=${WEFT_SHARED:-}/data/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio
if [ -r "$config" ]; then
    mkdir turns
    for i in 0 1 2 3 4 5 6 7; do png "turns/s.$i.png" $((i % 2 * 255)); done
    aces=(--ocio "$config" --to "Rec.1886 Rec.709 - Display")
    check "sRGB - Texture" luma 526 1 plain.png "${aces[@]}" --from "sRGB - Texture"
    check "a picture's own space" luma 526 1 plain.png "${aces[@]}"
    check "primaries" exits 0 weft convert ap1.exr "${raster[@]}" --bits 8 -o b.####.png "${aces[@]}"
    # view DISPLAY: R'G'B' of 709 that ACES's view for that display becomes.
    view()
    {
        exits 0 weft convert odd.exr --from ACEScg --ocio "$config" --display "$1" --view "ACES 1.0 - SDR Video" \
            "${raster[@]}" --bits 16 -o v.####.png || return 1
        oiiotool --stats v.0000.png | awk '/Stats Avg/ { print $3 / 65535, $4 / 65535, $5 / 65535 }'
    }
    check "an sRGB display and the raster's" python3 -c "
import sys; a, b = (list(map(float, s.split())) for s in sys.argv[1:])
sys.exit(max(abs(x ** 2.4 - y ** 2.4) for x, y in zip(a, b)) > 1e-4 or len(a) != 3)" \
        "$(view 'sRGB - Display')" "$(view 'Rec.1886 Rec.709 - Display')"
    check "no such space" exits 2 weft convert plain.png --ocio "$config" --from nix "${raster[@]}" -o no.####.exr
    check "black and white in turn" exits 0 weft convert turns/s.*.png --raster 32x24@24p "${aces[@]}" \
        --from "sRGB - Texture" --subframe-rate 48 --temporal-width 1 --aperture box --bits 10 --overwrite -o o.y4m
    check "are half the light" python3 -c "
import struct; d = open('o.y4m', 'rb').read(); y = struct.unpack_from('<H', d, d.index(b'FRAME\n') + 6)[0]
raise SystemExit(abs(y - 720) > 1 and bool(print(y)) is False)"
else
    skip_part "WEFT_SHARED has no data/ocio"
fi

finish
