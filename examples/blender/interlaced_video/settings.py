"""What the panel asks for. Its choices are kept with the scene."""
import bpy

# What is offered; any other name that weft knows may be typed, such as 720x576@25i,tff.
RASTERS = ("525i", "525i-dv", "525i-wide", "625i", "625i-dv", "625i-wide", "1080i50", "1080i59.94", "1080psf25",
           "1080psf29.97")
APERTURES = ("shaped", "box", "notch", "line", "crisp", "calm", "least:4")
CODECS = ("v210", "prores", "prores-4444", "ffv1", "h264")


def offer(names):
    """Names that have what was typed so far."""
    return lambda _settings, _context, typed: [name for name in names if typed.lower() in name]


class InterlacedVideo(bpy.types.PropertyGroup):
    """Settings of a scene."""

    raster: bpy.props.StringProperty(
        name="Raster", default="1080i50", search=offer(RASTERS), search_options={"SUGGESTION"},
        description="What is broadcast, by weft's name: `weft rasters` lists them")
    aperture: bpy.props.StringProperty(
        name="Aperture", default="shaped", search=offer(APERTURES), search_options={"SUGGESTION"},
        description="How a pixel of a field looks at the picture: `weft filters` lists them")
    shutter: bpy.props.StringProperty(
        name="Shutter", default="1/2", description="How long each field sees, in field periods: 1/2 is 180 degrees, "
        "0 an instant")
    subframes: bpy.props.IntProperty(
        name="Subframes", default=8, min=1, max=64, description="Instants a field; those that no field sees are "
        "not rendered")
    error: bpy.props.FloatProperty(
        name="Error", default=0.0, min=0.0, max=1.0, precision=4, step=0.1, description="Refines until pixels are off by "
        "no more than this, white being 1: one or two whole subframes a field, and of the others what moves. 0.005 is "
        "seldom seen; 0 renders all that fields see")
    oversampling: bpy.props.IntProperty(
        name="Oversampling", default=2, min=1, max=4, description="Rendered pixels and lines a pixel of the raster")
    divide_samples: bpy.props.BoolProperty(
        name="Divide samples", default=True, description="Gives each subframe its share of the scene's samples, so "
        "that a field has the noise of a finished frame and costs what it does. With an error only pixels share: what stands still "
        "is seen by one subframe alone")
    alpha: bpy.props.BoolProperty(
        name="Alpha", default=False, description="Renders the film transparent and keeps alpha, for outputs that "
        "hold it (prores-4444, ffv1, EXR)")
    as_seen: bpy.props.BoolProperty(
        name="As seen", default=True, description="Gives the video the scene's view transform, look and exposure, as "
        "Blender's own videos have them; without, light up to white is shown as it is, and what is brighter is white")
    first: bpy.props.IntProperty(
        name="First", default=0, min=0, description="The first frame of video, from 0; a farm gives each machine a "
        "part of its own")
    last: bpy.props.IntProperty(name="Last", default=-1, min=-1, description="The last frame of video; -1 is all")
    folder: bpy.props.StringProperty(name="Subframes", default="//subframes", subtype="DIR_PATH")
    output: bpy.props.StringProperty(
        name="Video", default="//shot.mov", subtype="FILE_PATH", description="What is written: .mov, .mxf, .y4m, .mkv "
        "or pictures such as shot.####.exr")
    codec: bpy.props.StringProperty(
        name="Codec", default="", search=offer(CODECS), search_options={"SUGGESTION"},
        description="Empty: the one that the video's name stands for; `weft convert --help` lists them")


class Preferences(bpy.types.AddonPreferences):
    """Where weft is."""

    bl_idname = __package__
    program: bpy.props.StringProperty(name="weft", default="", subtype="FILE_PATH",
                                      description="The program; empty: what lies on the path")

    def draw(self, _):
        self.layout.prop(self, "program")


def program_of(context):
    """What the preferences say; empty where the add-on is not enabled but only registered."""
    addon = context.preferences.addons.get(__package__)
    return addon.preferences.program if addon and addon.preferences else ""
