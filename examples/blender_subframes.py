"""Renders a Blender scene as high-rate EXR subframes for weft.

    blender -b shot.blend -P examples/blender_subframes.py -- DIRECTORY [SUBFRAMES_PER_FRAME]

The scene keeps its speed, frame range and camera. Time is stretched so that Blender renders
SUBFRAMES_PER_FRAME pictures (default 16: eight a field) where it would have rendered one. The
picture is 1440x972 at the display aspect of 525-line video: two samples a pixel and two a line.
"""
import sys
from fractions import Fraction

import bpy

arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
if not 1 <= len(arguments) <= 2:
    sys.exit(__doc__)
directory = arguments[0]
per_frame = int(arguments[1]) if len(arguments) > 1 else 16

scene = bpy.context.scene
render = scene.render

# weft filters in time and space itself. A blurred exposure or a soft pixel filter would be filtered
# a second time.
render.use_motion_blur = False
scene.cycles.pixel_filter_type = "BOX"
scene.cycles.filter_width = 1.0

render.resolution_x, render.resolution_y, render.resolution_percentage = 1440, 972, 100
render.pixel_aspect_x, render.pixel_aspect_y = 1.0, 1.1

# One frame of the scene becomes per_frame frames.
render.frame_map_old, render.frame_map_new = 1, per_frame
scene.frame_end = (scene.frame_end + 1) * per_frame - 1
scene.frame_start *= per_frame
scene.frame_step = 1

# EXR is written scene-linear, whatever the view transform is.
image = render.image_settings
image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "16", "ZIP"
render.filepath = directory + "/subframe.######"
bpy.ops.render.render(animation=True)

# Blender writes no rate into its files.
rate = Fraction(render.fps) / Fraction(render.fps_base).limit_denominator(1001) * per_frame
print(f"weft convert {directory} --subframe-rate {rate} --input-par 10:11 -o shot.y4m")
