#!/bin/bash
# weft plan as its users run it: formats, times and sizes in closed form, its scripts by Python, and the
# video of what POV-Ray renders by one.
source "$(dirname "$0")/../program/script.sh"

plan() { weft plan --raster 1080i50 --frames 3-4 --subframe-rate 400 "$@"; }

check "for people" shows "frames 3-4: 16 subframes of the 28 that there are at 400 a second" plan --raster 1080i50 --frames 3-4 \
    --subframe-rate 400
check "says how to convert" prints "--frames 0-75 --subframe-rate 400 --output-frames 3-4"
check "JSON" exits 0 plan --format json --size 1920x2160
check "its keys" value "list(d) == ['raster', 'rate', 'size', 'pixel_aspect', 'region', 'subframes']"
check "its size" value "d['size'] == [1920, 2160] and d['pixel_aspect'] == [2, 1]"
check "its region" value "d['region'] == [-1, -3, 1921, 2163]"
check "its subframes" value "d['subframes'][4] == {'number': 56, 'time': '7/50'} and len(d['subframes']) == 16"
check "CSV" exits 0 plan --format csv --scene-fps 24
check "a row" grep -qx '49,49/400,0.1225,147/50,0,0,1920,1080' out
for script in blender houdini; do
    check "for $script" exits 0 plan --format $script
    check "it is Python" python3 -c 'import ast; ast.parse(open("out").read())'
done
check "a size that will not do is told" exits 0 plan --size 1920x1000
check "what would" says "planned is 1920x1080"
check "quietly" shows "size: 1920x1080" plan --raster 1080i50 --frames 0-0 --subframe-rate 400 --size 1920x1000 -q
check "an input" refuses "needs no input" plan in --raster 1080i50 --frames 0-0 --subframe-rate 400
check "a format" refuses "did you mean json" plan --raster 1080i50 --frames 0-0 --subframe-rate 400 --format jason
check "a width of nothing" exits 0 plan --temporal-width 0
check "is told of" says "--subframe-rate 50 would number them one after the other"
check "an option of others" refuses "unknown option" plan --codec prores

python_plan()
{
    PYTHONPATH=$WEFT_BUILD/lib/python3/dist-packages /usr/bin/python3 - <<'END'
import weft
plan = weft.Job(raster="1080i50", frames="3-4", subframe_rate=400).plan()
assert [s["number"] for s in plan["subframes"]] == [48 + 8 * f + k for f in range(4) for k in range(4)]
assert "Antialias=Off" in weft.Job(raster="1080i50", frames="0-0", subframe_rate=400).plan("povray")
try:
    weft.Job(raster="1080i50", frames="0-0", subframe_rate=40).plan()
except weft.UsageError as error:
    assert "400" in str(error)
else:
    raise SystemExit("a rate below the field rate was taken")
END
}
if ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    skip_part "no Python with NumPy (package python3-numpy)"
elif is_sanitized; then
    skip_part "Python does not load a library with sanitizers"
else
    check "from Python" python_plan
fi

# What is planned, and all there is, rendered by POV-Ray: one video.
povray_video()
{
    local options="--raster 48x36@25i,tff --frames 1-1 --subframe-rate 200"
    cat >shot.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { right x*48/36 location <0, 0, -5> look_at 0 }
light_source { <5, 5, -9> rgb 1 }
plane { -z, -3 pigment { checker rgb .1 rgb .8 scale .37 } }
sphere { <clock * 12 - 1, 0, 0>, 1 pigment { rgb <.9, .4, .1> } }
END
    weft plan $options --format povray >plan.ini || return 1
    mkdir -p all planned
    local k
    for ((k = 0; k < 16; k++)); do
        python3 -c "print('[0]\nClock=%.12g\nOutput_File_Name=all/shot.%04d.exr' % ($k / 200, $k))" >one.ini
        povray +Ishot.pov plan.ini "one.ini[0]" Width=48 Height=36 Output_File_Type=E Antialias=Off -D +WT1 Verbose=Off \
            >povray.log 2>&1 || { cat povray.log; return 1; }
    done
    for k in $(grep -o '^\[[0-9]*' plan.ini | tr -d '['); do
        (cd planned && povray +I../shot.pov "../plan.ini[$k]" +WT1 Verbose=Off >../povray.log 2>&1) ||
            { cat povray.log; return 1; }
    done
    for k in all planned; do
        weft convert $k --raster 48x36@25i,tff --frames 0-15 --output-frames 1-1 --subframe-rate 200 -q -o $k.y4m || return 1
    done
    [ "$(ls planned | wc -l)" = 4 ] && cmp all.y4m planned.y4m
}
if has povray; then check "POV-Ray renders what is planned" povray_video; fi

finish
