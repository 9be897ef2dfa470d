#!/bin/bash
# Views of other configurations: what a view makes for its display is that display's light, and the raster
# shows the same; held against oiiotool's own use of OpenColorIO. Gray stays gray.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/input/pictures.sh"
not_sanitized "test_ocio.c goes through views"
needs oiiotool python3

# Colors from 0 to 4 above grays.
oiiotool --pattern fill:topleft=0,0,0:topright=4,.2,.05:bottomleft=.1,.8,1.5:bottomright=.3,.05,.9 32x12 3 \
    -d float -o colors.exr
oiiotool --pattern fill:left=0,0,0:right=3,3,3 32x12 3 -d float -o grays.exr
oiiotool colors.exr grays.exr --mosaic 1x2 -d float -o in.exr

before=() # what oiiotool does to the picture before the view

# view CONFIG SPACE DISPLAY VIEW CURVE PRIMARIES RASTER: light of the raster is the light of the display, by
# its curve and primaries, to 1e-4 of its white (of 10000 cd/m2 for PQ).
view()
{
    local config=$1 space=$2 display=$3 name=$4 shows=$5
    shift 5
    exits 0 weft convert in.exr --ocio "$config" --from "$space" --display "$display" --view "$name" "${raster[@]}" \
        --aperture line --bits 16 -o v.####.png "$@" || return 1
    oiiotool --colorconfig "$config" in.exr "${before[@]}" --ociodisplay:from="$space" "$display" "$name" \
        -d float -o own.exr >log 2>&1 ||
        { cat log; return 1; }
    oiiotool --dumpdata own.exr >own && oiiotool --dumpdata v.0000.png >got || return 1
    python3 - "$shows" "${*: -1}" <<'COMPARE'
import re, sys
shows, raster = sys.argv[1:]
def read(name, scale):
    return [[float(v) / scale for v in m.group(1).split()[:3]] for m in
            re.finditer(r'Pixel \([^)]*\): ([-+.0-9e ]+)', open(name).read())]
def clip(v): return min(max(v, 0), 1)
def pq(v): return (max(v ** (32 / 2523) - .8359375, 0) / (18.8515625 - 18.6875 * v ** (32 / 2523))) ** (16384 / 2610)
curves = {'srgb': lambda v: v / 12.92 if v <= .04045 else ((v + .055) / 1.055) ** 2.4, '1886': lambda v: v ** 2.4,
          '2.6': lambda v: v ** 2.6, 'pq': pq, 'as it is': lambda v: v}
p3_to_709 = [[1.2249401762805598, -.2249401762805598, 0], [-.0420569547096881, 1.0420569547096881, 0],
             [-.0196375545903344, -.0786360455506319, 1.0982736001409663]]
p3_to_2020 = [[.7538330343617078, .1985973690526163, .0475695965856762], [.0457438489653582, .9417772198116936, .0124789312229484],
              [-.0012103403545184, .0176017173010898, .983608623053429]]
def mix(m, c): return [sum(a * b for a, b in zip(row, c)) for row in m]
curve = curves[shows.split(',')[0]]
own, got = read('own', 1), read('got', 65535)
assert len(own) == len(got) == 768, (len(own), len(got))
worst = gray = 0
for i, (a, b) in enumerate(zip(own, got)):
    a = [curve(v) if v > 0 else 0 for v in (a if 'p3' in shows else map(clip, a))]
    if 'p3' in shows: a = mix(p3_to_2020 if 'pq' in shows else p3_to_709, a)
    inverse = curves['pq'] if 'pq' in shows else curves['as it is'] if 'as it is' in shows else curves['1886']
    b = [inverse(v) for v in b]
    worst = max([worst] + [abs(clip(x) - y) for x, y in zip(a, b)])
    if i >= 384: gray = max(gray, max(b) - min(b))
if worst > 1e-4 or gray > 1e-4: print('off by', worst, 'gray by', gray)
sys.exit(worst > 1e-4 or gray > 1e-4)
COMPARE
}

# ---- Blender's ----

blender=/usr/share/blender/datafiles/colormanagement/config.ocio
if [ -r $blender ]; then
    for name in Standard Filmic "Filmic Log"; do
        check "Blender's $name" view $blender Linear sRGB "$name" srgb
    done
    check "data is left alone" view $blender Linear sRGB Raw "as it is"
    before=(--ociolook:from=Linear:to=Linear "High Contrast")
    check "a look" view $blender Linear sRGB Filmic srgb --look "High Contrast"
    before=(--mulc 2)
    check "--exposure is before it all" view $blender Linear sRGB Filmic srgb --exposure 1
    before=()
    check "another raster keeps gray" exits 0 weft convert in.exr --ocio $blender --display sRGB --view Filmic --aperture line \
        --raster 32x24@24p,601-625 --subframe-rate 24 --temporal-width 0 --bits 16 --overwrite -o v.####.png
    check "to 1e-4" python3 -c "
import re, subprocess, sys
text = subprocess.run(['oiiotool', '--dumpdata', 'v.0000.png'], capture_output=True, text=True).stdout
rows = [list(map(float, m.split()[:3])) for m in re.findall(r'Pixel \([^)]*\): ([-+.0-9e ]+)', text)][384:]
sys.exit(len(rows) != 384 or max(max((v / 65535) ** 2.4 for v in r) - min((v / 65535) ** 2.4 for v in r) for r in rows) > 1e-4)"
else
    skip_part "no Blender, whose configuration has Filmic"
fi

# ---- One made here: a curve in a file, and displays of both ranges ----

python3 - <<'MAKE'
with open('curve.spi1d', 'w') as f:
    n = 4096
    f.write('Version 1\nFrom 0.0 4.0\nLength %d\nComponents 1\n{\n' % n)
    for i in range(n):
        x = 4 * i / (n - 1)
        f.write('%.9f\n' % ((x * 1.2 / (x + .2) / (4 * 1.2 / 4.2)) ** (1 / 2.2)))
    f.write('}\n')
open('made.ocio', 'w').write('''ocio_profile_version: 2
search_path: "."
roles: {default: lin, scene_linear: lin, aces_interchange: ap0, cie_xyz_d65_interchange: xyz}
displays:
  sRGB: [!<View> {name: Soft, colorspace: soft}]
  default: [!<View> {name: sRGB, colorspace: soft sRGB}]
  Rec.2100-PQ - Display: [!<View> {name: Plain, view_transform: plain, display_colorspace: pq}]
  Rec.2100-HLG - Display: [!<View> {name: Plain, view_transform: plain, display_colorspace: hlg}]
view_transforms:
  - !<ViewTransform> {name: plain, from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}}
display_colorspaces:
  - !<ColorSpace> {name: xyz, isdata: false}
  - !<ColorSpace> {name: pq, isdata: false, from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.2100-PQ}}
  - !<ColorSpace> {name: hlg, isdata: false, from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.2100-HLG-1000nit}}
colorspaces:
  - !<ColorSpace> {name: ap0, isdata: false}
  - !<ColorSpace> {name: lin, isdata: false, to_scene_reference: !<MatrixTransform> {matrix: [0.4395756842, 0.3839125893, 0.1765117265, 0, 0.0896003829, 0.8147141542, 0.0956854629, 0, 0.0174154827, 0.1087343522, 0.8738501650, 0, 0, 0, 0, 1]}}
  - !<ColorSpace> {name: soft, isdata: false, from_scene_reference: !<GroupTransform> {children: [!<ColorSpaceTransform> {src: ap0, dst: lin}, !<FileTransform> {src: curve.spi1d, interpolation: linear}]}}
  - !<ColorSpace> {name: soft sRGB, isdata: false, from_scene_reference: !<GroupTransform> {children: [!<ColorSpaceTransform> {src: ap0, dst: lin}, !<FileTransform> {src: curve.spi1d, interpolation: linear}]}}
''')
MAKE
check "a curve in a file" view "$work/made.ocio" lin sRGB Soft srgb
check "a display that only its view's space tells" view "$work/made.ocio" lin default sRGB srgb
check "PQ" view "$work/made.ocio" lin "Rec.2100-PQ - Display" Plain pq --raster 32x24@24p,2020
check "HLG" view "$work/made.ocio" lin "Rec.2100-HLG - Display" Plain "as it is" --raster 32x24@24p,2020

# ---- ACES's ----

config=${WEFT_SHARED:-}/data/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio
if [ -r "$config" ]; then
    sdr="ACES 1.0 - SDR Video"
    check "ACES on sRGB" view "$config" ACEScg "sRGB - Display" "$sdr" srgb
    check "ACES on BT.1886" view "$config" ACEScg "Rec.1886 Rec.709 - Display" "$sdr" 1886
    check "ACES in a cinema" view "$config" ACEScg "P3-D65 - Display" "ACES 1.0 - SDR Cinema" 2.6,p3
    check "ACES in PQ" view "$config" ACEScg "Rec.2100-PQ - Display" "ACES 1.1 - HDR Video (1000 nits & Rec.2020 lim)" pq \
        --raster 32x24@24p,2020
    check "ACES in PQ of P3" view "$config" ACEScg "ST2084-P3-D65 - Display" "ACES 1.1 - HDR Video (1000 nits & P3 lim)" pq,p3 \
        --raster 32x24@24p,2020
else
    skip_part "WEFT_SHARED has no data/ocio"
fi

finish
