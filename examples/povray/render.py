#!/usr/bin/env python3
"""Renders with POV-Ray what the fields of interlaced video need, and nothing else.

  render.py SHOT.pov FOLDER --raster 625i --frames 0-24 --subframe-rate 400 [--error 0.005] [PLAN OPTION..]
  render.py SHOT.pov --push OUT.y4m --raster 625i --frames 0-24 [--instants 8] [--temporal-width 1/2 ..]

The first asks `weft plan` for the subframes and renders them into FOLDER, shot.NNNN.exr each; with --error
it refines: a whole subframe or two a field, and then only rectangles of others, until nothing is wanted.
What is there already is kept, so that a render that was ended goes on when it is asked for again. --chunk
I/N renders the I-th of N parts of what is wanted now, for farms; with --error that is one round, and when all
parts have rendered theirs there may be another. Then: weft convert FOLDER --output-frames
0-24 --subframe-rate 400 --raster 625i -o shot.mov

The second stores nothing: in each field so many instants, jittered within the window, are rendered and
pushed into weft as tiles. It needs the Python package weft, and NumPy.

In the scene `clock` is the time in seconds, and the camera's right vector gives the picture's shape. POVRAY
and WEFT name the programs, POVRAY_OPTIONS adds options such as "+WT4 Quality=9".
"""
import argparse
import os
import random
import shlex
import subprocess
import sys
import tempfile
from fractions import Fraction

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import planned  # noqa: E402

POVRAY = os.environ.get("POVRAY", "povray")


def povray(scene, output, seconds, size, kind, region=None):
    """One picture. Rows and columns are counted from 1, the last included; beside them it is black."""
    words = [POVRAY, f"+I{scene}", f"+O{output}", f"+K{float(seconds):.12g}", f"+W{size[0]}", f"+H{size[1]}",
             f"Output_File_Type={kind}", "Antialias=Off", "-D", "Verbose=Off"]
    if region and tuple(region) != (0, 0, *size):
        words += [f"+SC{region[0] + 1}", f"+EC{region[2]}", f"+SR{region[1] + 1}", f"+ER{region[3]}"]
    done = subprocess.run(words + shlex.split(os.environ.get("POVRAY_OPTIONS", "")), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, check=False)
    if done.returncode or not os.path.exists(output):
        sys.exit(f"{scene} at {seconds} s: POV-Ray failed\n" + done.stdout.decode(errors="replace")[-2000:])


# ---- By a plan ----

def render(scene, folder, wanted, size):
    """A subframe, under its name when it is whole."""
    if "region" not in wanted and os.path.exists(planned.path(folder, wanted)):
        return
    povray(scene, planned.unfinished(folder, wanted), Fraction(wanted["time"]), size, "E", planned.region(wanted, size))
    planned.finish(folder, wanted)


def by_plan(asked, options):
    os.makedirs(os.path.join(asked.folder, "unfinished"), exist_ok=True)
    index, parts = asked.chunk
    options += ["--error", asked.error] if asked.error else []
    while True:
        _, now = planned.plan(options, asked.folder)
        for wanted in planned.share(now["subframes"], index, parts):
            render(asked.scene, asked.folder, wanted, now["size"])
        if not asked.error or parts > 1 or not now["subframes"]:
            return


# ---- By pushing ----

def radiance(path):
    """A picture of Radiance's format, scene-linear float32 [lines][width][3]."""
    import numpy as np
    with open(path, "rb") as file:
        while file.readline().strip():
            pass
        _, lines, _, width = file.readline().split()
        data = np.frombuffer(file.read(), np.uint8)
    lines, width, at = int(lines), int(width), 0
    codes = np.zeros((lines, 4, width), np.uint8)
    for line in codes:
        if tuple(data[at:at + 2]) != (2, 2):  # a line that is not run-length coded
            line[:] = data[at:at + 4 * width].reshape(width, 4).T
            at += 4 * width
            continue
        at += 4
        for channel in line:
            x = 0
            while x < width:
                count = int(data[at])
                if count > 128:
                    count -= 128
                    channel[x:x + count] = data[at + 1]
                    at += 2
                else:
                    channel[x:x + count] = data[at + 1:at + 1 + count]
                    at += 1 + count
                x += count
    scale = np.ldexp(1.0, codes[:, 3].astype(int) - 136) * (codes[:, 3] > 0)
    return np.ascontiguousarray((codes[:, :3] * scale[:, None]).transpose(0, 2, 1), np.float32)


def by_pushing(asked, options):
    import weft
    pairs = dict(zip((name[2:].replace("-", "_") for name in options[::2]), options[1::2]))
    first, last = map(int, pairs.pop("frames").split("-"))
    width = Fraction(pairs.get("temporal_width", "1/2"))
    with weft.Job(output=asked.push, **pairs) as job, tempfile.TemporaryDirectory() as folder:
        raster, dice = job.raster, random.Random(1)
        period = 1 / raster.rate / raster.fields_per_frame
        size = (2 * raster.width_px, 2 * raster.lines)  # apertures tell lines apart by samples between
        begins = first * raster.fields_per_frame
        with weft.Fields(job, last - first + 1) as fields:
            for n in range((last - first + 1) * raster.fields_per_frame):
                for i in range(asked.instants):
                    t = float(width) * (i + dice.random()) / asked.instants
                    picture = os.path.join(folder, "tile.hdr")
                    povray(asked.scene, picture, float((begins + n) * period) + t * float(period), size, "H")
                    fields.push_tile(n, radiance(picture), t=t)
                    os.remove(picture)
                fields.until(n + 1)
            fields.finish()


def chunk(text):
    index, parts = map(int, text.split("/"))
    if not 1 <= index <= parts:
        raise argparse.ArgumentTypeError("I/N, such as 1/4")
    return index, parts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("folder", nargs="?")
    parser.add_argument("--error", help="what pixels may be off by, such as 0.005")
    parser.add_argument("--chunk", type=chunk, default=(1, 1), help="I/N")
    parser.add_argument("--push", metavar="OUTPUT")
    parser.add_argument("--instants", type=int, default=8)
    asked, options = parser.parse_known_args()
    if bool(asked.folder) == bool(asked.push):
        parser.error("give the folder for subframes, or --push OUTPUT")
    (by_pushing if asked.push else by_plan)(asked, options)


if __name__ == "__main__":
    main()
