#!/bin/bash
# weft plan --refine: scenes refined until nothing is wanted, held against all subframes and against four
# times as many; what it costs; and folders that will not do.
source "$(dirname "$0")/../program/script.sh"
not_sanitized never
needs oiiotool

refined()
{
    local scene=$1
    shift
    rm -rf refining && mkdir refining
    (cd refining && python3 "$WEFT_SOURCE/tests/plan/refine.py" "$WEFT" "$WEFT_SOURCE/examples/scenes/$scene" \
        "$WEFT_SOURCE/examples" 96x64@30i,tff "$@" >../out) && cat out
}

check "a shot that is mostly still" refined one_mover.lua 1/2 0.005 5
check "99 % of its pixels are within the error" value "d['within'] >= 0.99"
check "it is as near to the truth as all subframes" value "d['some'] <= 1.02 * d['all'] + 1e-5"
check "at a fifth of the cost" value "d['share'] <= 0.2 and d['rounds'] >= 2"
check "the wheel" refined wheel.lua 1/2 0.005 2
check "99 % of its pixels are" value "d['within'] >= 0.99"
check "as near to the truth" value "d['some'] <= 1.02 * d['all'] + 1e-5"
check "at six tenths of the cost" value "d['share'] <= 0.6"
if is_long; then
    check "a whole field's width, and coarse" refined wheel.lua 1 0.02 1
    check "99 % of its pixels are too" value "d['within'] >= 0.99"
    # It turns once a field, and looks the same at every field's instant.
    check "a wheel that seems to stand still" refined wheel.lua 1/2 0.005 2 --set rpm=3600 --set speed=0 --set beats=0.001
    check "is seen to turn" value "d['within'] >= 0.99 and d['some'] <= 1.02 * d['all'] + 1e-5"
fi


# ---- Folders that will not do ----

plan() { weft plan --raster 96x64@30i,tff --frames 0-1 --subframe-rate 480 --refine "$@"; }
mkdir empty foreign other half
check "an empty one wants the first pass" exits 0 plan empty --error 0.01 --format json
check "a whole one a field, and two in the first and the last" value \
    "[s['number'] for s in d['subframes']] == [0, 3, 8, 16, 24, 27] and d['subframes'][0]['region'] == [0, 0, 96, 64]"
check "of more fields" exits 0 weft plan --raster 96x64@30i,tff --frames 0-8 --subframe-rate 480 --refine empty --error 0.01 --format json
check "in every eighth" value "[s['number'] for s in d['subframes'] if s['number'] % 8] == [3, 67, 131, 139]"
check "without an error" refuses "--error 0.005" plan --raster 96x64@30i,tff --frames 0-1 --subframe-rate 480 --refine empty
check "none there" fails "may be empty" plan nowhere --error 0.01
weft trace "$WEFT_SOURCE/examples/scenes/one_mover.lua" --raster 96x64@30i,tff --oversample 1x1x8 --frames 0-1 \
    -o "other/shot.####.exr" -q
check "of another size" fails "is 96x64, and subframes of this plan are 192x64; give --size 96x64" \
    plan other --error 0.01 --size 192x64
for k in 0 8; do cp other/shot.000$k.exr foreign/shot.9$k.exr; done
mkdir lone
cp other/shot.0000.exr lone/beauty.exr
check "a picture without a number" fails "none of its files has a number of this plan" plan lone --error 0.01
check "of a size that no plan has" fails "shot.0000.exr: it is 96x64, and subframes of this plan are 96x60; render it again, or" \
    "$WEFT" plan --raster 96x60@30i,tff --frames 0-1 --subframe-rate 480 --refine other --error 0.01
check "a file in the place of a folder" fails "Not a directory; give the folder that the subframes are rendered into" plan said --error 0.01
check "an error without a folder" refuses "give --refine DIR too" plan --raster 96x64@30i,tff --frames 0-1 --subframe-rate 480 --error 0.01
check "of other numbers" fails "none of" plan foreign --error 0.01
cp other/shot.0000.exr other/shot.0003.exr half
head -c 3000 other/shot.0008.exr >half/shot.0008.exr
check "a file that is half written" fails "shot.0008.exr.*being written" plan half --error 0.01
rm half/shot.0008.exr
stamp() { python3 "$WEFT_SOURCE/examples/stamp_exr.py" "$@"; }
mkdir rates later
for k in 0 3; do cp other/shot.000$k.exr rates; stamp rates/shot.000$k.exr --time $k/960 --region 0,0,96,64; done
check "of another rate" fails "shot.0003.exr: its weft:time is not that of its number at 480 subframes a second; give the --subframe-rate" \
    plan rates --error 0.01
cp other/shot.0008.exr later/shot.0800.exr
stamp later/shot.0800.exr --time 800/480
check "of later frames of the same shot" exits 0 plan later --error 0.01 --format json
check "which want the first pass" value "len(d['subframes']) == 6"
echo '{}' >empty/job.json
check "a folder that holds a job alone" exits 0 plan empty --error 0.01 --format json
check "is empty too" value "len(d['subframes']) == 6"
head -c 2000 other/shot.0008.exr >cut.exr
check "a stamp on a file that is cut off" exits 1 stamp cut.exr --region 0,0,9,9
check "is refused" says "cut.exr: it is cut off, or not finished"
check "and on none" exits 1 stamp said --time 1/2
check "as well" says "said: "
# A window beyond all pixels does not hide the region behind it.
mkdir far
for k in 0 8; do cp other/shot.000$k.exr far; done
stamp far/shot.0008.exr --region 0,0,9,9
python3 - <<'END'
data = bytearray(open("far/shot.0008.exr", "rb").read())
at = data.index(b"displayWindow\0box2i\0") + len(b"displayWindow\0box2i\0") + 4
data[at + 8:at + 12] = (2 ** 30).to_bytes(4, "little")
open("far/shot.0008.exr", "wb").write(data)
END
check "a window that is too far" exits 1 weft convert far --subframe-rate 480 --raster 96x64@30i,tff -o far.y4m
check "is told" says "shot.0008.exr"

check "a script of rectangles" refuses "stamp them with weft:region" plan --raster 96x64@30i,tff --frames 0-1 \
    --subframe-rate 480 --refine half --error 0.01 --format blender
check "the first pass, half done" exits 0 plan half --error 0.01 --format json
check "wants the other half" value "[s['number'] for s in d['subframes'] if s['region'] == [0, 0, 96, 64]] == [8, 16, 24, 27]"
check "all of it" exits 0 plan other --error 0.01 --format json
check "wants nothing" value "d['subframes'] == []"
check "and says so" exits 0 plan other --error 0.01
check "to people" prints "nothing more is wanted"

finish
