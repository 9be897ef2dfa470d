"""The panel among the output properties, and the entry of the Render menu."""
import bpy

ROWS = (("raster", "aperture", "shutter"), ("subframes", "error", "oversampling", "divide_samples", "alpha", "as_seen"),
        ("first", "last"), ("folder", "output", "codec"))


class RENDER_PT_interlaced_video(bpy.types.Panel):
    """Interlaced video, by weft"""

    bl_label = "Interlaced Video"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "output"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.interlaced_video
        layout.use_property_split = True
        for row in ROWS:
            column = layout.column(align=True)
            for name in row:
                column.prop(settings, name)
        layout.operator("render.interlaced_video", icon="RENDER_ANIMATION")


def menu(self, _):
    self.layout.separator()
    self.layout.operator("render.interlaced_video", icon="RENDER_ANIMATION")
