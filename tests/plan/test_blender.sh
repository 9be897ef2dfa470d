#!/bin/bash
# The Blender add-on, without a window: what it renders is what the plan says, of every engine; the video is that of all
# subframes; ranges of farms fit together; the scene is put back; and what goes wrong is told.
. "$(dirname "$0")/blend.sh"
make_shot "
scene.frame_start, scene.frame_end = 11, 13
scene.render.fps, scene.render.fps_base = 24, 1.001
scene.cycles.seed = 3
for frame, x in (11, -2), (13, 2):
    cube.location.x = x
    cube.keyframe_insert('location', frame=frame)
camera = scene.camera
for frame, z in (11, 4.9), (13, 5.3):
    camera.location.z = z
    camera.keyframe_insert('location', frame=frame)
bpy.ops.object.text_add(location=(0, -2, 1))
bpy.context.object.data.body = 'NEWS'"
small="raster='96x64@25i,tff', subframes=4, shutter='1/2', oversampling=1"

check "a video" blend "v.run($small, output='//shot.y4m')"
planned=$(weft plan --raster 96x64@25i,tff --temporal-width 1/2 --subframe-rate 200 --frames 0-2 --format csv -q | grep -c '^[0-9]')
check "it renders what is planned and no more" test "$planned" = "$(ls subframes/*.exr | wc -l)"
check "that is half" test "$planned" = 12
check "the video is there" test -s shot.y4m
check "a run more renders nothing" blend "v.run($small, output='//again.y4m')"
check "nothing was rendered" bash -c "! grep -q '^subframe ' said"
check "the video is the same" cmp shot.y4m again.y4m

check "all subframes" blend "
s.interlaced_video.folder, s.interlaced_video.output = '//every', '//every.y4m'
for name, value in dict($small).items(): setattr(s.interlaced_video, name, value)
all_of = shot.Shot(s, s.interlaced_video, program.find())
plan = all_of.plan()
plan['subframes'] = [{'number': k, 'time': f'{k}/200'} for k in range(24)]
all_of.prepare()
with all_of.prepared(plan):
    for one in all_of.missing(plan): all_of.render(one)
all_of.convert(plan)"
check "twice as many" test 24 = "$(ls every/*.exr | wc -l)"
check "the same video" cmp shot.y4m every.y4m

# The script that a plan makes sets what the add-on does.
check "a script" exits 0 weft plan --raster 96x64@25i,tff --temporal-width 1/2 --subframe-rate 200 --frames 0-2 \
    --samples-a-pixel 4 --format blender -q
cp out scripted.py
check "renders" exits 0 blender -b shot.blend --python-exit-code 9 -P scripted.py -- scripted
by_hand() { weft convert "$1" --raster 96x64@25i,tff --subframe-rate 200 --output-frames 0-2 -q -o "$1.hand.y4m"; }
check "video of it" by_hand scripted
check "video of the add-on's" by_hand subframes
check "is the same" cmp scripted.hand.y4m subframes.hand.y4m

check "the last frame alone" blend "v.run($small, folder='//part', output='//part.y4m', first=2, last=2)"
check "it is the third of all" python3 - <<'END'
whole, part = (open(name, "rb").read().split(b"FRAME\n") for name in ("shot.y4m", "part.y4m"))
assert len(part) == 2 and part[1] == whole[3], (len(part), len(whole))
END

check "the scene is put back" blend "
before = [s.render.resolution_x, s.render.filter_size, s.cycles.pixel_filter_type, s.cycles.samples, s.frame_current,
          s.render.filepath, s.render.image_settings.file_format, s.render.use_motion_blur, s.render.film_transparent]
v.run($small, folder='//back', output='//back.mov', codec='prores-4444', alpha=True, first=0, last=0)
after = [s.render.resolution_x, s.render.filter_size, s.cycles.pixel_filter_type, s.cycles.samples, s.frame_current,
         s.render.filepath, s.render.image_settings.file_format, s.render.use_motion_blur, s.render.film_transparent]
assert before == after, (before, after)"
for engine in BLENDER_EEVEE BLENDER_WORKBENCH; do
    if blend "s.render.engine = '$engine'
v.run($small, folder='//$engine', output='//$engine.y4m', first=0, last=0)"; then
        check "$engine" test -s $engine.y4m
    else
        skip_part "$engine does not run here"
    fi
done

# ---- What goes wrong ----

touch file
check "a folder that cannot be" wrong "folder='//file/sub'" "file/sub: Not a directory; choose another folder"
check "a range that is not there" wrong "first=7" "frames 7 to 2 of video are asked for, and the scene's range has 0 to 2"
check "a shutter that is none" wrong "shutter='wide'" "wide"
check "an output of no kind" wrong "folder='//subframes', output='//shot.gif'" "shot.gif"
check "alpha that has no place" wrong "folder='//early', output='//early.y4m', alpha=True" "Y4M holds no alpha"
check "before more than one is rendered" test 1 = "$(ls early/*.exr | wc -l)"
check "a scene that is too short" blend "
s.frame_end, s.render.fps = s.frame_start, 30
try: v.run($small)
except (SystemExit, RuntimeError): pass
else: raise AssertionError"
check "which is told" says "the scene's range lasts 0.033 s, less than one frame of 96x64@25i,tff"
check "no program" blend "
os.environ['WEFT'] = '/nowhere'; os.environ['PATH'] = '/nowhere'
try: v.run($small, folder='//none')
except (SystemExit, RuntimeError): pass
else: raise AssertionError"
check "which is told" says "weft was not found; say in the add-on's preferences where it is, or set WEFT"
check "nothing was begun" test ! -e none

# Killed in the middle of the sixth: what is whole is kept, nothing half counts, and the next run goes on.
blend "
import signal
begun = []
def kill_at_six(*_):
    begun.append(1)
    if len(begun) == 6: os.kill(os.getpid(), signal.SIGKILL)
bpy.app.handlers.render_pre.append(kill_at_six)
v.run($small, folder='//stopped', output='//stopped.y4m')" && echo "it was not killed"
check "five are kept" test 5 = "$(ls stopped/*.exr | wc -l)"
check "the next run goes on" blend "v.run($small, folder='//stopped', output='//stopped.y4m')"
check "to the same video" cmp shot.y4m stopped.y4m

if [ "$(id -u)" = 0 ] && mkdir full && mount -t tmpfs -o size=256k none full 2>/dev/null; then
    check "a full disk" wrong "folder='//full/sub', oversampling=2" "full"
    check "leaves nothing half" bash -c '! ls full/sub/*.part 2>/dev/null'
    umount full
else
    skip_part "a full disk: no file system may be mounted"
fi
finish
