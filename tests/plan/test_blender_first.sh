#!/bin/bash
# A first video of a .blend, in the two ways that the pages tell: the zip is installed and its button pressed; one
# command makes it. The video has the look that Blender shows, and what goes wrong is told.
. "$(dirname "$0")/blend.sh"
make_shot "
scene.frame_end, scene.render.fps = 2, 25
scene.view_settings.view_transform, scene.view_settings.look = 'Filmic', 'High Contrast'
scene.view_settings.exposure = .5
for frame, angle in (1, 0), (25, 3):
    cube.rotation_euler.z = angle
    cube.keyframe_insert('rotation_euler', frame=frame)"
[ -s "$WEFT_BUILD/interlaced_video.zip" ] || { echo "FAILED: no interlaced_video.zip"; exit 1; }
one() { exits 0 blender -b shot.blend -P "$WEFT_SOURCE/examples/blender/render.py" -- "$@"; }
script_fails() { ! blender -b "$1" -P "$WEFT_SOURCE/examples/blender/render.py" -- "${@:2}" >out 2>said; }

# ---- Three clicks: install, tick, Render > Interlaced Video ----

blender -b --factory-startup --python-exit-code 9 --python-expr "
import bpy
bpy.ops.preferences.addon_install(filepath='$WEFT_BUILD/interlaced_video.zip')
bpy.ops.preferences.addon_enable(module='interlaced_video')
bpy.ops.wm.save_userpref()" >said 2>&1
check "the zip is installed" grep -q "Modules Installed" said
mkdir bin && ln -s "$WEFT" bin/weft
click() { (unset WEFT; export PATH=$work/bin:$PATH; blender -b shot.blend --python-exit-code 9 --python-expr "
import bpy
s = bpy.context.scene.interlaced_video
assert (s.raster, s.output, s.error) == ('1080i50', '//shot.mov', 0)
s.raster, s.subframes, s.oversampling = '96x64@25i', 2, 1
assert bpy.ops.render.interlaced_video() == {'FINISHED'}") >said 2>&1; }
check "the button" click
check "time that is left is told" says "subframe 1 of 4, "
check "made a video" exits 0 weft info shot.mov --json
check "of two frames" grep -q '"frames": *2' out

# ---- One command ----

small=(--raster 96x64@25i --subframes 2 --oversampling 1)
check "one command" one "${small[@]}" --output one.y4m --folder one
check "made a video, where it was asked for" test -s one.y4m
check "as seen" one "${small[@]}" --output again.y4m --folder one --as-seen yes
check "is what it is unless told" cmp one.y4m again.y4m
check "plain" one "${small[@]}" --output plain.y4m --folder one --as-seen no
check "is another look" bash -c '! cmp -s one.y4m plain.y4m'
config=$(blender -b --python-expr "import bpy; print('AT', bpy.utils.system_resource('DATAFILES', path='colormanagement'))" 2>/dev/null | sed -n 's/^AT //p')
check "by hand" exits 0 weft convert one --raster 96x64@25i --subframe-rate 100 --output-frames 0-1 -o hand.y4m -q \
    --ocio "$config/config.ocio" --from Linear --display sRGB --view Filmic --look "High Contrast" --exposure 0.5
check "the same look" cmp one.y4m hand.y4m
check "frames alone" one "${small[@]}" --folder alone --only-render --last 0
check "no video" test ! -e shot.y4m -a "$(ls alone/*.exr | wc -l)" = 2
check "help" exits 0 blender -b shot.blend -P "$WEFT_SOURCE/examples/blender/render.py" -- --help
check "tells of settings" prints "--divide-samples yes|no"

# ---- What goes wrong ----

check "a raster that is none" script_fails shot.blend --raster 1080i51
check "is told of" grep -q "1080i5" said out
check "a setting that is none" script_fails shot.blend --rastor 625i
check "is told of" says "--rastor"
check "a blend that is none" script_fails none.blend "${small[@]}" --last 0 --folder none
blender -b shot.blend --python-expr "
import bpy
bpy.context.scene.camera = None
bpy.ops.wm.save_as_mainfile(filepath='$work/blind.blend')" >/dev/null 2>&1
check "a scene without a camera" script_fails blind.blend "${small[@]}" --folder blind
check "is told of" grep -qi "no camera" said out
check "a scene that was never saved" bash -c "! blender -b --factory-startup --python-exit-code 9 -P '$WEFT_SOURCE/examples/blender/render.py' \
    >out 2>said"
check "is told of" grep -q "which is not saved yet; save it" said out
check "a folder that must not be written" script_fails shot.blend "${small[@]}" --folder /proc/none
check "is told of" grep -q "choose another folder for subframes" said out
finish
