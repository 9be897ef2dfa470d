#!/bin/bash
# The Blender add-on with an error: what it renders of subframes is what is still wanted, in its place; the video is
# within the error of that of all subframes; what was ended goes on; ranges fit together; and Escape stops.
. "$(dirname "$0")/blend.sh"
make_shot "
scene.frame_start, scene.frame_end = 1, 2
scene.render.fps = 25
cube.scale = (.3, .3, .3)
for frame, x in (1, -1), (3, 1):
    cube.location.x = x
    cube.keyframe_insert('location', frame=frame)
for curve in cube.animation_data.action.fcurves:
    for key in curve.keyframe_points: key.interpolation = 'LINEAR'
bpy.ops.mesh.primitive_plane_add(size=30, location=(0, 0, -1))"
small="raster='96x64@25i,tff', subframes=8, shutter='1/2', oversampling=1, divide_samples=False"

# The noise of all is that of the refined, or they could not be compared.
check "all that fields see" blend "
s.interlaced_video.folder = '//every'
for name, value in dict($small).items(): setattr(s.interlaced_video, name, value)
every = shot.Shot(s, s.interlaced_video, program.find())
plan = every.plan()
every.prepare()
with every.prepared(plan):
    s.cycles.use_animated_seed = False
    for one in every.wanted(plan): every.render(one)"
check "refined" blend "
v.run($small, error=0.005, folder='//refined', output='//refined.y4m')
assert not s.render.use_border and s.render.border_max_x == 1"
check "it took several rounds" bash -c '[ "$(grep -c "^subframe " said)" -gt "$(ls refined/*.exr | wc -l)" ]'
check "the video is there" test -s refined.y4m

# Of all files the region is what it was rendered for, and there they are the whole ones to the bit.
cat >regions.py <<'END_OF_REGIONS'
import glob, os, struct, subprocess, sys
sys.path.insert(0, os.environ["WEFT_SOURCE"] + "/examples")
from stamp_exr import attributes
area, parts = 0, 0
for path in sorted(glob.glob("refined/*.exr")):
    with open(path, "rb") as file:
        x0, y0, x1, y1 = struct.unpack("<4i", attributes(file.read())[0]["weft:region"][2])
    area += (x1 - x0 + 1) * (y1 - y0 + 1)
    parts += (x1 - x0, y1 - y0) != (95, 63)
    crop = ["--crop", f"{x0},{y0},{x1},{y1}"]
    subprocess.run(["oiiotool", path, *crop, path.replace("refined", "every"), *crop, "--fail", "0", "--hardfail", "0",
                    "--diff"], check=True, stdout=subprocess.PIPE)
share = area / (96 * 64 * 8 * 4)
assert parts >= 8 and share < 0.45, (parts, share)
print(f"{share:.3f} of eight whole subframes a field")
END_OF_REGIONS
if has oiiotool; then check "rectangles are the pixels of whole subframes" python3 regions.py; fi
video() { weft convert "$1" --raster 96x64@25i,tff --subframe-rate 400 --output-frames 0-1 --bits 16 -q -o "$1.wide.y4m"; }
check "of all" video every
check "of the refined" video refined
check "the difference" exits 0 weft measure refined.wide.y4m --against every.wide.y4m --json
check "is far below the error" value "d['difference']['rmse'] < 0.002"
check "a run more renders nothing" blend "v.run($small, error=0.005, folder='//refined', output='//again.y4m')"
check "nothing was rendered" bash -c "! grep -q '^subframe ' said"
check "the video is the same" cmp refined.y4m again.y4m

# Killed in the middle of the ninth; a part of the range, then the other: the same files in the end.
blend "
import signal
begun = []
def kill_at_nine(*_):
    begun.append(1)
    if len(begun) == 9: os.kill(os.getpid(), signal.SIGKILL)
bpy.app.handlers.render_pre.append(kill_at_nine)
v.run($small, error=0.005, folder='//stopped', output='//stopped.y4m')" && echo "it was not killed"
check "nothing half is there" test "$(ls stopped/*.exr | wc -l)" = 8
check "it goes on" blend "v.run($small, error=0.005, folder='//stopped', output='//stopped.y4m')"
check "to the same video" cmp refined.y4m stopped.y4m
check "a range" blend "v.run($small, error=0.005, folder='//parts', first=1, last=1, convert=False)
v.run(first=0, last=0, convert=False)
v.run(first=0, last=-1, output='//parts.y4m')"
check "another, and all" exits 0 weft measure parts.y4m --against refined.y4m --json
check "are as good" value "d['difference']['rmse'] < 0.003"

# Of samples each subframe gets its share; of noise its own, unless it is refined.
check "samples" blend "
s.cycles.samples = 256
for error, samples, moves in (0, 16, True), (0.005, 64, False):
    for name, value in {**dict($small), 'error': error, 'divide_samples': True, 'oversampling': 2}.items():
        setattr(s.interlaced_video, name, value)
    of = shot.Shot(s, s.interlaced_video, program.find())
    with of.prepared(of.plan()):
        assert (s.cycles.samples, s.cycles.use_animated_seed) == (samples, moves), (s.cycles.samples, error)
assert s.cycles.samples == 256 and not s.cycles.use_animated_seed"

# With a window there are ticks of a timer and keys; here they are made up.
cat >window.py <<'END_OF_WINDOW'
from types import SimpleNamespace as Is
class Window:
    """The operator, as Blender would call it."""
    def report(self, kind, text): print("said", kind, text)
for name, part in operators.RENDER_OT_interlaced_video.__dict__.items():
    if callable(part) or name == "convert": setattr(Window, name, part)
Window.convert = True
nothing = lambda *_, **__: None
context = Is(scene=s, preferences=bpy.context.preferences, window=None, workspace=Is(status_text_set=nothing),
             window_manager=Is(progress_begin=nothing, progress_update=nothing, progress_end=nothing,
                               modal_handler_add=nothing, event_timer_add=nothing, event_timer_remove=nothing))
def settle(**settings):
    for name, value in settings.items(): setattr(s.interlaced_video, name, value)
END_OF_WINDOW
check "Escape in the middle" blend "
exec(open('window.py').read())
settle($small, folder='//escaped', output='//escaped.y4m')
before = s.render.resolution_x
w = Window()
assert w.invoke(context, None) == {'RUNNING_MODAL'}
for _ in range(3): assert w.modal(context, Is(type='TIMER')) == {'RUNNING_MODAL'}
assert w.modal(context, Is(type='MOUSEMOVE')) == {'PASS_THROUGH'}
assert w.modal(context, Is(type='ESC')) == {'CANCELLED'}
assert s.render.resolution_x == before
w = Window()
w.invoke(context, None)
assert w.count == 13, w.count
shot.bpy = Is(ops=Is(render=Is(render=lambda **_: {'CANCELLED'})))  # Escape in Blender's own window of the render
assert w.modal(context, Is(type='TIMER')) == {'CANCELLED'}
shot.bpy = bpy
assert s.render.resolution_x == before"
check "what is there is told" says "stopped; 3 of 16 subframes are kept, and the next run goes on from there"
check "and is kept" test "$(ls escaped/*.exr | wc -l)" = 3
check "no part is left" bash -c '! ls escaped/*.part 2>/dev/null'
check "a window to the end" blend "
exec(open('window.py').read())
settle($small, error=0.005, folder='//stopped', output='//window.y4m')
w = Window()
w.invoke(context, None)
while w.modal(context, Is(type='TIMER')) == {'RUNNING_MODAL'}: pass"
check "makes the video" cmp window.y4m refined.y4m

# ---- What goes wrong ----

check "a folder of another size" wrong "error=0.005, folder='//refined'); v.run(oversampling=2" "is 96x64, and subframes of this plan are 192x128"
check "a folder of another rate" wrong "error=0.005, folder='//refined'); v.run(subframes=16" "its weft:time is not that of its number"
finish
