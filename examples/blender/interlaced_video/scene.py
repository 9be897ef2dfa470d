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
    ("render", "use_crop_to_border", False),  # a rectangle of a picture keeps its place in it
    ("render", "border_min_x", 0.0),
    ("render", "border_max_x", 1.0),
    ("render", "border_min_y", 0.0),
    ("render", "border_max_y", 1.0),
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


def wishes(plan, alpha, samples, noise_moves):
    """What a plan sets: size, pixel aspect, alpha, the share of samples of each subframe, and whether each has noise
    of its own, which is averaged then."""
    width, lines = plan["size"]
    over, under = plan["pixel_aspect"]
    # Blender takes 1 and more: the smaller one is 1.
    across, down = (over / under, 1.0) if over >= under else (1.0, under / over)
    rows = [("render", "resolution_x", width), ("render", "resolution_y", lines),
            ("render", "pixel_aspect_x", across), ("render", "pixel_aspect_y", down),
            ("image", "color_mode", "RGBA" if alpha else "RGB"), ("render", "film_transparent", alpha),
            ("cycles", "use_animated_seed", noise_moves)]
    if samples:
        rows += [("cycles", "samples", samples), ("eevee", "taa_render_samples", samples)]
    return rows


def show_only(scene, size, region):
    """The next render is of a rectangle, x0, y0, x1, y1 from the upper left corner; None is all of it. Blender cuts
    the fractions of its borders off, so that half a pixel more on each side has all pixels in it."""
    render = scene.render
    render.use_border = region is not None and tuple(region) != (0, 0, *size)
    if not render.use_border:
        return
    (width, lines), (x0, y0, x1, y1) = size, region
    render.border_min_x, render.border_max_x = max(x0 - 0.5, 0) / width, min(x1 + 0.5, width) / width
    render.border_min_y, render.border_max_y = max(lines - y1 - 0.5, 0) / lines, min(lines - y0 + 0.5, lines) / lines


@contextlib.contextmanager
def prepared(scene, plan, alpha=False, samples=0, noise_moves=True):
    """A scene whose every render is a subframe of the plan. Whatever happens within, it is put back."""
    kept, frame = [], (scene.frame_current, scene.frame_subframe)
    path = scene.render.filepath
    try:
        for place, name, value in (*SAMPLING, *WRITING, *wishes(plan, alpha, samples, noise_moves)):
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
