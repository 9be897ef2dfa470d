"""The player's clips: fields under each other in one picture for each clip and aperture."""
import json

import pictures

SIZE, QUICK_SIZE = (720, 486), (240, 162)
LABELS = {"line": "line: one line high", "box": "box: two lines", "notch": "notch: the quadratic",
          "shaped": "shaped: the cut-out", "diamond": "diamond", "crisp": "crisp: designed to be sharp",
          "calm": "calm: designed to be calm", "frames": "box, both fields at one instant"}
CLIPS = (
    {"id": "plate", "title": "Zone plate, still", "scene": "zoneplate", "frames": 1, "tau": 0,
     "apertures": ("line", "box", "notch", "shaped")},
    {"id": "letters", "title": "Captions, still", "scene": "lettering", "frames": 1, "tau": 0,
     "apertures": ("line", "box", "notch", "shaped")},
    {"id": "edges", "title": "Edges, sinking 30 lines a second", "scene": "stripes", "frames": 12, "tau": 0,
     "values": {"period": 12},
     "apertures": ("line", "box", "notch", "shaped"), "designs": False},
    {"id": "carousel", "title": "Carousel, to and fro", "scene": "carousel", "frames": 6, "tau": 0,
     "values": {"rpm": 20},
     "apertures": ("line", "box", "shaped", "frames"), "color": True, "bounce": True},
)


def sprite(clip, fields, color):
    """All fields' own lines under each other."""
    rows = []
    cut = pictures.color_rows if color else pictures.gray_rows
    for n in range(fields):
        rows += cut(clip, n // 2, clip.own_lines(n))
    return pictures.uri(pictures.png(rows, color=color, filtered=True))


def size(ctx):
    return QUICK_SIZE if ctx.quick else SIZE


def variant(ctx, clip, name):
    scan = "psf" if name == "frames" else "i"
    width, lines = size(ctx)
    raster = f"{width}x{lines}@30000/1001{scan},bff,par=10:11"
    aperture = "box" if name == "frames" else name
    made = ctx.weft.clip(clip["scene"], raster, aperture, clip["frames"], 8, tau=clip["tau"],
                         samples=4 if ctx.quick else 64, **clip.get("values", {}))
    if name == "frames":
        made.scan = "b"  # its lines are still shown bottom field first
    return {"name": name, "label": LABELS.get(name, name),
            "sprite": sprite(made, 2 * clip["frames"], clip.get("color", False))}


def apertures(ctx, clip):
    return clip["apertures"] + (ctx.designs if clip.get("designs", not clip.get("color")) else ())


def run(ctx):
    """The data of the player, as JSON that may stand in HTML."""
    clips = [{"id": clip["id"], "title": clip["title"], "width": size(ctx)[0], "lines": size(ctx)[1],
              "fields": 2 * clip["frames"], "first": 1, "bounce": clip.get("bounce", False),
              "variants": [variant(ctx, clip, name) for name in apertures(ctx, clip)]}
             for clip in CLIPS]
    return json.dumps({"clips": clips}).replace("</", "<\\/")
