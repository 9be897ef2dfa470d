#!/bin/bash
# Which channels, part and layer of a file are taken, what alpha means, and where that is told:
# `weft info`, --dry-run, the report. Files that change on the way are refused.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_source.c reads such files"
needs oiiotool python3

raster=(--raster 16x12@24p --subframe-rate 24 --aperture box --temporal-width 0 --overwrite)

# picture FILE NAMES COLOR: a picture of one color, with these channels.
picture()
{
    local count
    count=$(tr ',' '\n' <<<"$2" | wc -l)
    oiiotool --pattern "constant:color=$3" 16x12 "$count" -d half --chnames "$2" -o "$1"
}

# color FILE: the color of a picture that has one, five digits each.
color()
{
    oiiotool --stats "$1" | awk '/Stats Avg/ { printf "%.5f %.5f %.5f", $3, $4, $5 }'
}

# gives COLOR ARGUMENT..: what convert makes of the arguments is a frame of that color.
gives()
{
    local should=$1 k
    shift
    rm -f out.*.exr
    exits 0 weft convert "$@" "${raster[@]}" -q -o out.####.exr || return 1
    k=$(color out.0000.exr)
    python3 -c "import sys; a, b = (list(map(float, s.split())) for s in sys.argv[1:]); \
sys.exit(any(abs(x - y) > 4e-4 for x, y in zip(a, b)) or len(a) != 3)" "$k" "$should" ||
        { echo "$k, not $should"; return 1; }
}

# ---- What is taken ----

picture rgba.exr N.X,N.Y,N.Z,RGBA.R,RGBA.G,RGBA.B,RGBA.A .1,.1,1,.5,.5,.5,1
picture ci.exr Ci.r,Ci.g,Ci.b,a .5,.25,.1,1
picture words.exr red,green,blue .5,.25,.1
picture normals.exr X,Y,Z .1,.2,.3
picture two.exr diffuse.R,diffuse.G,diffuse.B,glow.R,glow.G,glow.B .5,.25,.1,.1,.1,.2
picture crypto.exr CryptoObject00.R,CryptoObject00.G,CryptoObject00.B .5,.25,.1
check "a layer named rgba" gives ".5 .5 .5" rgba.exr
check "Ci in lower case" gives ".5 .25 .1" ci.exr
check "red green blue" gives ".5 .25 .1" words.exr
check "the layer asked for" gives ".1 .1 .2" two.exr --layer glow
check "normals are no picture" exits 1 weft convert normals.exr "${raster[@]}" -o no.exr
check "normals are listed" says "it has X Y Z"
check "one of two layers" exits 1 weft convert two.exr "${raster[@]}" -o no.exr
check "both are listed" says "--layer; it has diffuse (R G B), glow (R G B)"
check "Cryptomatte is no picture" exits 1 weft convert crypto.exr "${raster[@]}" -o no.exr
check "nothing was written" test ! -e no.exr

picture named.exr rgba.R,rgba.G,rgba.B,beauty.R,beauty.G,beauty.B .5,.25,.1,.1,.1,.2
check "two beauties" exits 0 weft convert named.exr "${raster[@]}" -o out.####.exr
check "the other one is told" says "'beauty' is named as the beauty too"

# ---- Parts ----

part() { oiiotool "$1" --attrib oiio:subimagename "$2" -o "$2.part.exr"; }
picture n.exr N.X,N.Y,N.Z .1,.2,.3 && part n.exr N
picture b.exr R,G,B,A .5,.25,.1,1 && part b.exr rgba
picture d.exr diffuse.R,diffuse.G,diffuse.B .2,.3,.4 && part d.exr diffuse
oiiotool N.part.exr rgba.part.exr --siappend diffuse.part.exr --siappend -o parts.exr
check "the part with a picture" gives ".5 .25 .1" parts.exr
check "a layer in another part" gives ".2 .3 .4" parts.exr --layer diffuse
check "a part by number" gives ".2 .3 .4" parts.exr --part 2
oiiotool N.part.exr --attrib:type=float framesPerSecond 24 rgba.part.exr --siappend -o rate.exr
check "a rate that the first part alone has" exits 0 weft convert rate.exr --raster 16x12@24p --overwrite -o out.####.exr
check "a part in any case" gives ".5 .25 .1" parts.exr --part RGBA
check "a layer that is not there" exits 1 weft convert parts.exr --layer specular "${raster[@]}" -o no.exr
check "all parts and layers are listed" \
    says "part 0 'N': N (X Y Z); part 1 'rgba': R G B A; part 2 'diffuse': diffuse (R G B)"

# ---- Where it is told ----

check "info tells the choice" exits 0 weft info parts.exr
check "info has the part" prints "part              rgba (file)"
check "info lists the others" prints "part 2 'diffuse': diffuse (R G B)"
oiiotool rgba.part.exr --attrib:type=string weft:time 0/1 --attrib oiio:subimagename a \
    rgba.part.exr --attrib:type=string weft:time 1/24 --attrib oiio:subimagename b --siappend -o timed.exr
check "info on parts that are subframes" exits 0 weft info timed.exr
check "tells of a sequence" prints "sequence"
check "and its rate" prints "24 (file)"
check "info as JSON" exits 0 weft info --json parts.exr
check "info has the same rows" value "d['files'][0]['input'] == {
    'part': {'value': 'rgba', 'reason': 'file'}, 'layer': {'value': '', 'reason': 'default'},
    'channels': {'value': 'R G B', 'reason': 'default'},
    'space': {'value': 'lin_rec709', 'reason': 'default'},
    'transfer': {'value': 'linear', 'reason': 'default'},
    'alpha': {'value': 'premultiplied', 'reason': 'default'}} and
    [l['layer'] for l in d['files'][0]['layers']] == ['N', '', 'diffuse'] and
    d['files'][0]['layers'][1]['channels'] == 'R G B A'"
check "info lists what has no picture" exits 1 weft info normals.exr
check "its layers all the same" prints "(X Y Z)"
check "a dry run" exits 0 weft convert parts.exr --layer diffuse "${raster[@]}" --dry-run -o no.exr
check "a dry run tells" prints "input layer: diffuse (option)"
weft convert rgba.exr "${raster[@]}" -q -o out.####.exr --report report.json
cp report.json out
check "the report tells" value "d['input']['layer'] == {'value': 'RGBA', 'reason': 'file'} and
    d['input']['part'] == {'value': '0', 'reason': 'default'} and
    d['input']['alpha'] == {'value': 'premultiplied', 'reason': 'default'}"

# ---- Alpha ----

picture half.exr R,G,B,A .8,.4,.2,.5
white=(--background 1)
check "EXR is premultiplied" gives "1.3 .9 .7" half.exr "${white[@]}"
check "unless it is said to be straight" gives ".9 .7 .6" half.exr "${white[@]}" --alpha straight
check "straight over black" gives ".4 .2 .1" half.exr --alpha straight
check "alpha that is ignored" gives ".8 .4 .2" half.exr "${white[@]}" --alpha ignore
oiiotool half.exr -d float -o assoc.tif
oiiotool half.exr -d float --attrib oiio:UnassociatedAlpha 1 -o straight.tif
stored=$(OIIO_UNASSOCIATEDALPHA=1 color assoc.tif)
check "TIFF says that it is premultiplied" exits 0 weft info --json assoc.tif
check "by the file" value "d['files'][0]['input']['alpha'] == {'value': 'premultiplied', 'reason': 'file'}"
check "TIFF is as it is stored" gives "$stored" assoc.tif
check "TIFF says that it is straight" exits 0 weft info --json straight.tif
check "by the file too" value "d['files'][0]['input']['alpha'] == {'value': 'straight', 'reason': 'file'}"
# An extra sample of no stated meaning (ExtraSamples 0) is no alpha.
python3 - <<'PATCH'
import struct
data = bytearray(open('assoc.tif', 'rb').read())
order = '<' if data[:2] == b'II' else '>'
at = struct.unpack(order + 'I', data[4:8])[0]
for entry in range(at + 2, at + 2 + 12 * struct.unpack(order + 'H', data[at:at + 2])[0], 12):
    if struct.unpack(order + 'H', data[entry:entry + 2])[0] == 338:
        data[entry + 8:entry + 10] = b'\0\0'
open('other.tif', 'wb').write(data)
PATCH
check "TIFF with another fourth channel" exits 0 weft info --json other.tif
check "has no alpha" value "d['files'][0]['input']['alpha'] == {'value': 'none', 'reason': 'file'}"
oiiotool half.exr -d uint16 -o half.png
check "PNG is straight" exits 0 weft info --json half.png
check "as its format is" value "d['files'][0]['input']['alpha'] == {'value': 'straight', 'reason': 'default'}"
check "unless it is said to be premultiplied" exits 0 weft convert half.png --alpha premultiplied \
    "${raster[@]}" --dry-run -o no.exr
check "which is told" prints "input alpha: premultiplied (option)"
check "another word" refuses "straight|premultiplied|ignore" convert half.png --alpha none -o no.exr

# ---- Files that change on the way ----

# changes TEXT SECOND: a sequence of rgb.exr and the second file is refused with the text.
changes()
{
    cp rgb.exr seq.0001.exr && cp "$2" seq.0002.exr
    exits 1 weft convert seq.####.exr "${raster[@]}" -o out.####.exr && says "seq.0002.exr: " && says "$1"
}
picture rgb.exr R,G,B .5,.25,.1
picture rgba2.exr R,G,B,A .4,.2,.1,.5
picture gray.exr Y .5
oiiotool rgb.exr --attrib PixelAspectRatio 2.0 -o wide.exr
check "another layer" changes "its picture is layer 'Ci', the sequence began with layer ''" ci.exr
check "another kind" changes "its picture is Y, the sequence began with R G B" gray.exr
check "another shape of pixels" changes "its pixels are 2 times as wide as high" wide.exr
cp rgb.exr seq.0001.exr && cp rgba2.exr seq.0002.exr
check "alpha of later files counts" exits 0 weft convert seq.####.exr "${white[@]}" "${raster[@]}" -o out.####.exr
check "the first has none" same "$(color out.0000.exr)" "0.50000 0.25000 0.09998"
check "the second has its own" same "$(color out.0001.exr)" "0.89990 0.69995 0.59998"

# ---- Given samples ----

cases=${WEFT_SHARED:-}/data/cases/inputs
if [ -n "${WEFT_SHARED:-}" ] && [ -d "$cases" ]; then
    check "case: multipart" gives ".5 .25 .1" "$cases/multipart_normals_first.0001.exr"
    check "case: three parts" gives ".5 .25 .1" "$cases/multipart_three_parts.0001.exr"
    check "case: luminance and chroma" gives ".8008 .1997 .1001" "$cases/luminance_chroma.0001.exr"
    check "case: a mask of half the size" gives ".5 .5 .5" "$cases/subsampled_extra_channel.0001.exr"
    check "case: still being written" exits 1 weft convert "$cases/still_being_written.0001.exr" "${raster[@]}" -o no.exr
    check "case: which is said" says "may still be being written"
else
    skip_part "no sample data (WEFT_SHARED is not set)"
fi

finish
