"""A Blender scene made ready for subframes, and put back as it was."""
import contextlib

# Whose pixels are points once these are set: weft filters in time and space itself, and what is blurred
# before would be blurred twice. A row: where, the property, what it is set to.
SAMPLING = (
    ("render", "use_motion_blur", False),
    ("render", "filter_size", 0.0),         # EEVEE and Workbench: pixels are not mixed
    ("eevee", "use_motion_blur", False),
    ("cycles", "pixel_filter_type", "BOX"),
    ("cycles", "filter_width", 1.0),
)
WRITING = (
    ("image", "file_format", "OPEN_EXR"),
    ("image", "color_depth", "32"),
    ("image", "exr_codec", "ZIP"),
    ("image", "use_preview", False),
    ("render", "resolution_percentage", 100),
    ("render", "use_border", False),
    ("render", "use_file_extension", False),
    ("render", "use_overwrite", True),
    ("render", "use_placeholder", False),
    ("render", "use_stamp", False),
)


def owner(scene, name):
    """The part of a scene that has a property; None where this Blender has no such part."""
    if name == "image":
        return scene.render.image_settings
    return getattr(scene, name, None) if name != "render" else scene.render


def wishes(plan, alpha, samples):
    """What a plan sets: size, pixel aspect, alpha and the share of samples of each subframe."""
    width, lines = plan["size"]
    over, under = plan["pixel_aspect"]
    # Blender takes 1 and more: the smaller one is 1.
    across, down = (over / under, 1.0) if over >= under else (1.0, under / over)
    rows = [("render", "resolution_x", width), ("render", "resolution_y", lines),
            ("render", "pixel_aspect_x", across), ("render", "pixel_aspect_y", down),
            ("image", "color_mode", "RGBA" if alpha else "RGB"), ("render", "film_transparent", alpha)]
    if samples:
        rows += [("cycles", "samples", samples), ("eevee", "taa_render_samples", samples)]
    return rows


@contextlib.contextmanager
def prepared(scene, plan, alpha=False, samples=0):
    """A scene whose every render is a subframe of the plan. Whatever happens within, it is put back."""
    kept, frame = [], (scene.frame_current, scene.frame_subframe)
    path = scene.render.filepath
    try:
        for place, name, value in (*SAMPLING, *WRITING, *wishes(plan, alpha, samples)):
            part = owner(scene, place)
            if part is None or not hasattr(part, name):
                continue
            kept.append((part, name, getattr(part, name)))
            setattr(part, name, value)
        yield
    finally:
        for part, name, value in reversed(kept):
            setattr(part, name, value)
        scene.render.filepath = path
        scene.frame_set(frame[0], subframe=frame[1])
