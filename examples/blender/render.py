"""Interlaced video of a .blend, in one command:

    blender -b SHOT.blend -P render.py -- [--raster 1080i50] [--output SHOT.mov] [--error 0.005] [SETTING VALUE..]

What is not given is as the scene has it; `-- --help` lists the settings. The add-on need not be installed: it lies
beside this script. weft is looked for on the path, or in $WEFT.
"""
import argparse
import os
import sys
import traceback

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import interlaced_video  # noqa: E402
from interlaced_video.operators import KEYS  # noqa: E402


def words():
    """How each setting is read, by what it is in the panel."""
    settings = bpy.context.scene.interlaced_video.bl_rna.properties
    yes_or_no = {"yes": True, "no": False}
    kinds = {"INT": int, "FLOAT": float, "BOOLEAN": lambda text: yes_or_no[text.lower()]}
    parser = argparse.ArgumentParser(prog="blender -b SHOT.blend -P render.py --")
    for name in KEYS:
        of = settings[name]
        parser.add_argument("--" + name.replace("_", "-"), type=kinds.get(of.type, str), help=of.description.replace(
            "%", "%%"), metavar="yes|no" if of.type == "BOOLEAN" else of.type)
    parser.add_argument("--only-render", action="store_true", help="makes no video")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else [])


def main():
    if not hasattr(bpy.types.Scene, "interlaced_video"):
        interlaced_video.register()
    asked = {name: value for name, value in vars(words()).items() if value is not None}
    interlaced_video.run(convert=not asked.pop("only_render"), **asked)


if __name__ == "__main__":
    try:
        main()
    except SystemExit:
        raise
    except RuntimeError as error:  # what the operator says
        sys.exit(str(error).strip())
    except Exception:
        traceback.print_exc()
        sys.exit(1)
