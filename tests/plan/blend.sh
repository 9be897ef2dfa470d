# shellcheck shell=bash
# A shot for Blender, and the add-on run in it without a window; for the scripts that source this in the place of
# script.sh, which it sources.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
command -v blender >/dev/null || skip "no blender (tests/run.sh all installs it)"
needs python3
# Blender has a Python of its own, which must not meet that of the tests.
unset PYTHONPATH PYTHONHOME
export PYTHONDONTWRITEBYTECODE=1 HOME=$work

# make_shot PYTHON: saves shot.blend, of what Blender begins with and what the lines make of it.
make_shot()
{
    { echo "import bpy"
      echo "scene, cube = bpy.context.scene, bpy.data.objects['Cube']"
      echo "scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = 'CYCLES', 4, False"
      printf '%s\n' "$1"
      echo "bpy.ops.wm.save_as_mainfile(filepath='$work/shot.blend')"; } >make.py
    blender -b --factory-startup -P make.py >blender.log 2>&1
    [ -s shot.blend ] || { cat blender.log; skip "this blender saves nothing"; }
}

# blend PYTHON: runs the add-on in the shot; what it prints is in `said`.
cat >head.py <<'END_OF_HEAD'
import sys, os
sys.path.append(os.environ["WEFT_SOURCE"] + "/examples/blender")
import bpy
import interlaced_video as v
from interlaced_video import operators, program, scene, shot
v.register()
s = bpy.context.scene
END_OF_HEAD
blend()
{
    { cat head.py; printf '%s\n' "$1"; } >run.py
    timeout 250 blender -b shot.blend --python-exit-code 9 -P run.py >said 2>&1
}

# wrong SETTINGS TEXT: a run with these fails and says so.
wrong() { ! blend "v.run($small, $1)" && says "$2"; }
