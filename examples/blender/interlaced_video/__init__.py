"""A Blender add-on: renders the instants that interlaced video needs, and no others, and has weft make the video."""
import bpy

from .operators import RENDER_OT_interlaced_video, run
from .panel import RENDER_PT_interlaced_video, menu
from .settings import InterlacedVideo, Preferences

bl_info = {
    "name": "Interlaced Video",
    "description": "Renders subframes by plan and makes broadcast video of them with weft",
    "author": "weft",
    "version": (0, 2, 0),
    "blender": (3, 4, 0),
    "location": "Render > Interlaced Video, Output Properties",
    "category": "Render",
}
CLASSES = (InterlacedVideo, Preferences, RENDER_OT_interlaced_video, RENDER_PT_interlaced_video)


def register():
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.Scene.interlaced_video = bpy.props.PointerProperty(type=InterlacedVideo)
    bpy.types.TOPBAR_MT_render.append(menu)


def unregister():
    bpy.types.TOPBAR_MT_render.remove(menu)
    del bpy.types.Scene.interlaced_video
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)
