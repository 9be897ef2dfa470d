"""Refines a scene by plans until nothing is wanted, and prints what came of it as JSON.

refine.py WEFT SCENE EXAMPLES RASTER TAU ERROR LAST [TRACE OPTION..]: frames 0 to LAST. What a plan asks for is taken from
subframes that `weft trace` has made of all times; beside its region a file is spoiled, so that whoever
looks there is found out.
"""
import json
import os
import shutil
import struct
import subprocess
import sys

weft, scene, examples, raster, tau, error, last = sys.argv[1:8]
sys.path.insert(0, examples)
from stamp_exr import attributes, stamp  # noqa: E402

error, last, frames = float(error), int(last), f"0-{last}"


def run(*words):
    return subprocess.run([weft, *map(str, words)], check=True, stdout=subprocess.PIPE).stdout


def spoil(path, region):
    """Makes what lies beside the region white: files of `weft trace` are without compression here."""
    with open(path, "rb") as file:
        data = bytearray(file.read())
    found, end = attributes(data)
    x0, y0, x1, y1 = struct.unpack("<4i", found["dataWindow"][2])
    width, lines = x1 - x0 + 1, y1 - y0 + 1
    offsets = struct.unpack_from(f"<{lines}Q", data, end + 1)
    white = struct.pack("<f", 9.0)
    rx0, ry0, rx1, ry1 = region
    for y, at in enumerate(offsets):
        spans = [(0, rx0), (rx1, width)] if ry0 <= y < ry1 else [(0, width)]
        for channel in range(3):
            for first, past in spans:
                place = at + 8 + channel * width * 4
                data[place + 4 * first:place + 4 * past] = white * (past - first)
    with open(path, "wb") as file:
        file.write(data)


def luma(path):
    """The codes of Y', of 16 bits, of all frames, 1 being white."""
    with open(path, "rb") as file:
        head = file.readline().split()
        width, height = (int(next(w[1:] for w in head if w[:1] == k)) for k in (b"W", b"H"))
        found, size = [], width * height
        whole = size * 3 * 2 if b"C444p16" in head else size * 2 * 2
        while file.readline():
            found.extend(code / (219 * 256) for code in struct.unpack(f"<{size}H", file.read(2 * size)))
            file.seek(whole - 2 * size, 1)
    return found


def trace(times, name):
    run("trace", scene, "--raster", raster, "--oversample", f"1x1x{times}", "--frames", f"0-{last + 1}",
        "-o", f"{name}.####.exr", "-q", *sys.argv[8:])


looks = ["--raster", raster, "--temporal-width", tau, "--aperture", "line"]
video = [*looks, "--bits", 16, "--chroma", 444, "--output-frames", frames, "-q", "--overwrite"]
trace(8, "all")
trace(32, "fine")
os.mkdir("some")
area, rounds, asked = 0, 0, 0
while True:
    plan = json.loads(run("plan", *looks, "--subframe-rate", 480, "--frames", frames, "--format", "json",
                          "--refine", "some", "--error", error))
    if not plan["subframes"]:
        break
    rounds += 1
    for wanted in plan["subframes"]:
        number, region = wanted["number"], wanted["region"]
        path = f"some/shot.{number:04d}.exr"
        subprocess.run(["oiiotool", f"all.{number:04d}.exr", "--compression", "none", "-o", path], check=True)
        spoil(path, region)
        stamp(path, wanted["time"], region)
        area += (region[2] - region[0]) * (region[3] - region[1])
        asked += 1
whole = plan["size"][0] * plan["size"][1] * 8 * 2 * (last + 1)
run("convert", "all.####.exr", *video, "-o", "all.y4m")
run("convert", "fine.####.exr", *video, "-o", "fine.y4m")
run("convert", "some", *video, "-o", "some.y4m")
all_, fine, some = luma("all.y4m"), luma("fine.y4m"), luma("some.y4m")


def rms(a, b):
    return (sum((x - y) ** 2 for x, y in zip(a, b)) / len(a)) ** 0.5


print(json.dumps({"share": area / whole, "rounds": rounds, "asked": asked,
                  "within": sum(abs(x - y) <= error for x, y in zip(some, all_)) / len(all_),
                  "some": rms(some, fine), "all": rms(all_, fine), "apart": rms(some, all_)}))
shutil.rmtree("some")
