#!/bin/bash
# Blender renders subframes of a cube that moves, by examples/blender_subframes.py, and weft makes video of
# them whose fields are in order.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
weft=${WEFT_BUILD:-$source_dir/build}/weft
command -v blender >/dev/null || { echo "skipped: no blender"; exit 77; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
cd "$out"
cat >shot.py <<'END'
import bpy, os
scene, cube = bpy.context.scene, bpy.data.objects["Cube"]
scene.frame_start, scene.frame_end = 1, 3
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
scene.render.fps, scene.render.fps_base = 30, 1.001
for frame, x in (1, -2), (3, 2):
    cube.location.x = x
    cube.keyframe_insert("location", frame=frame)
bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath("shot.blend"))
END
blender -b -P shot.py >blender.log 2>&1 && [ -s shot.blend ] || { cat blender.log; exit 1; }
blender -b shot.blend -P "$source_dir/examples/blender_subframes.py" -- shot 16 >blender.log 2>&1 ||
    { cat blender.log; exit 1; }
"$weft" convert shot --subframe-rate 480000/1001 --raster 360x244@29.97i,bff --fit stretch -q -o shot.y4m
"$weft" measure shot.y4m --limit order.verdict=bff
