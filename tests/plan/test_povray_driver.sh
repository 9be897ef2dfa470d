#!/bin/bash
# examples/povray/render.py: what it renders by a plan and by refining is the video of all subframes; what was
# ended goes on; parts of a farm are together the whole; and jittered instants go to weft as tiles.
source "$(dirname "$0")/../program/script.sh"
not_sanitized never
needs povray
export WEFT POVRAY_OPTIONS="+WT1"
driver=$WEFT_SOURCE/examples/povray/render.py
looks="--raster 48x36@25i,tff --frames 1-2 --subframe-rate 200"

cat >shot.pov <<'END'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { right x*48/36 location <0, 0, -5> look_at 0 }
light_source { <5, 5, -9> rgb 1 }
plane { -z, -3 pigment { checker rgb .1 rgb .8 scale .37 } }
sphere { <clock * 4 - .5, .3, 0>, .5 pigment { rgb <.9, .4, .1> } }
END
video() { exits 0 weft convert "$1" --raster 48x36@25i,tff --subframe-rate 200 --output-frames 1-2 -q --bits 16 -o "$2"; }

check "by a plan, in two parts" exits 0 python3 "$driver" shot.pov planned $looks --chunk 1/2
check "the other part" exits 0 python3 "$driver" shot.pov planned $looks --chunk 2/2
check "half of what there is" same "$(ls planned/*.exr | wc -l)" 8
touch -d 2001-01-01 planned/*.exr
rm planned/shot.0009.exr
check "again" exits 0 python3 "$driver" shot.pov planned $looks
check "only what is absent is rendered" same "$(find planned -name '*.exr' -newermt 2002-01-01)" planned/shot.0009.exr
check "video of it" video planned planned.y4m
check "refined" exits 0 python3 "$driver" shot.pov refined $looks --error 0.002
check "video of that" video refined refined.y4m
check "they are alike" exits 0 weft measure refined.y4m --against planned.y4m --json
check "within the error" value "d['difference']['rmse'] < 0.0005"
check "rectangles were enough" bash -c "grep -l weft:region refined/*.exr | wc -l | grep -qx 8"
# Parts of a farm that refine: one has ended when the other asks for its list, and nothing is left out or done twice.
for round in 1 2 3 4 5 6 7 8; do
    for part in 2/2 1/2; do
        check "part $part of round $round" exits 0 python3 "$driver" shot.pov parts $looks --error 0.002 --chunk $part
    done
    exits 0 "$WEFT" plan $looks --refine parts --error 0.002 --format json
    value "d['subframes'] == []" >/dev/null 2>&1 && break
done
check "parts end" value "d['subframes'] == []"
check "video of parts" video parts parts.y4m
check "it is that of one machine" exits 0 weft measure parts.y4m --against planned.y4m --json
check "within the error too" value "d['difference']['rmse'] < 0.0005"
check "a scene that is none" fails "POV-Ray failed" python3 "$driver" none.pov failed $looks
check "leaves nothing" same "$(ls failed)" unfinished
check "a plan that is none" exits 2 python3 "$driver" shot.pov failed --raster 48x36@25i,tff --frames 1-2
check "says so" says "--subframe-rate"

pushed()
{
    PYTHONPATH=$WEFT_BUILD/lib/python3/dist-packages /usr/bin/python3 "$driver" shot.pov --push pushed.y4m \
        --raster 48x36@25i,tff --frames 1-1 --instants 6 --aperture box >out 2>&1 || { cat out; return 1; }
    exits 0 python3 "$driver" shot.pov fine --raster 48x36@25i,tff --frames 1-1 --subframe-rate 200 --size 96x72 &&
        exits 0 weft convert fine --raster 48x36@25i,tff --subframe-rate 200 --output-frames 1-1 --aperture box -q \
            -o box.y4m && exits 0 weft measure pushed.y4m --against box.y4m --json &&
        value "d['difference']['rmse'] < 0.01"
}
if /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    check "jittered instants" pushed
else
    skip_part "no Python with NumPy (package python3-numpy)"
fi

finish
