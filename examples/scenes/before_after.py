#!/usr/bin/env python3
"""Makes the picture at the top of the README: the two fields of one frame, made in three ways.

    before_after.py [WEFT] [OUT.png]

A frame that stands still goes through ffmpeg's interlace filter, through the paper's aperture `shaped`, and to the
nearest picture to the sharp one that flickers no more (RMS over the frame) than the calmer of these. The rows are the
frame, and four times the difference of its fields as a display shows them that fills in lines. It prints the
flicker of each and its distance from the sharp frame in light. ffmpeg has to be installed."""

import os
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
RASTER = "720x486@30000/1001psf,bff,par=10:11,601-525"
LEFT, TOP, WIDTH, LINES = 206, 108, 300, 88  # the gable of the temple, in pixels and frame lines
ZOOM, GAP = 2, 8  # pixels
AMPLIFIED = 4
WEIGHTS = (0.2124, 0.7011, 0.0866)  # of R, G and B of 525 lines in luminance
LIMIT = 0.03  # of white; the weight is what makes the flicker's RMS equal


def picture(path):
    """The luminance that a display shows of a frame of Y4M 444, [lines][width], and its R'G'B' bytes."""
    with open(path, "rb") as file:
        head, data = file.read().split(b"FRAME\n", 1)
    words = dict((w[0], w[1:]) for w in head.decode().split()[1:])
    width, lines = int(words["W"]), int(words["H"])
    bits = 16 if "p16" in words["C"] else 8
    planes = numpy.frombuffer(data[: 3 * width * lines * bits // 8], "<u2" if bits == 16 else numpy.uint8)
    y, u, v = planes.reshape(3, lines, width).astype(float) / (1 << (bits - 8))
    y, u, v = (y - 16) / 219, (u - 128) / 224, (v - 128) / 224
    colors = numpy.stack([y + 1.402 * v, y - 0.344136 * u - 0.714136 * v, y + 1.772 * u], axis=-1)
    luminance = numpy.clip(colors, 0, 1) ** 2.4 @ WEIGHTS  # what is brighter than white is shown as white
    return luminance, numpy.clip(255 * colors + 0.5, 0, 255).astype(numpy.uint8)


def write_png(path, picture):
    lines, width, _ = picture.shape
    raw = b"".join(b"\0" + picture[y].tobytes() for y in range(lines))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", width, lines, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head))
        file.write(chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def cropped(frame):
    part = frame[TOP : TOP + LINES, LEFT : LEFT + WIDTH]
    return numpy.repeat(numpy.repeat(part, ZOOM, axis=0), ZOOM, axis=1)


def flicker(light):
    """Half the difference of both fields, each with the lines between its own filled in."""
    above, below = numpy.vstack([light[1:2], light[:-1]]), numpy.vstack([light[1:], light[-2:-1]])
    return numpy.abs(light - (above + below) / 2) / 2


def rms(values):
    return float(numpy.sqrt(numpy.mean(values**2)))


class Frame:
    """A way of making fields: the picture it gives."""

    def __init__(self, path):
        self.light, self.colors = picture(path)
        self.flicker = rms(flicker(self.light))


class Maker:
    def __init__(self, weft, folder, samples=64):
        self.weft, self.folder, self.samples = weft, folder, samples
        self.sharp_path = self.render("sharp.exr", "--aperture", "line")
        self.sharp = Frame(self.render("sharp.y4m", "--aperture", "line", *CODES))

    def path(self, name):
        return os.path.join(self.folder, name)

    def render(self, name, *options):
        subprocess.run([self.weft, "render", os.path.join(HERE, "panorama.lua"), "--raster", RASTER, "--frames", "0",
                        "--temporal-width", "0", "--samples", str(self.samples), "--overwrite", "-q", "-o", self.path(name),
                        *options],
                       check=True)
        return self.path(name)

    def ffmpeg(self):
        """Today's practice: finished lines (1/4, 1/2, 1/4) in gamma space, from two pictures that are the same."""
        chain = "format=yuv444p,loop=3:1,interlace=lowpass=linear:scan=bff"
        subprocess.run(["ffmpeg", "-nostdin", "-v", "error", "-y", "-i", self.render(
            "eight.y4m", "--aperture", "line", "--bits", "8", "--chroma", "444"), "-vf", chain, "-frames:v", "1",
                        "-strict", "-1", self.path("ffmpeg.y4m")], check=True)
        return Frame(self.path("ffmpeg.y4m"))

    def nearest(self, weight):
        subprocess.run([self.weft, "convert", self.sharp_path, "--subframe-rate", "30000/1001", "--raster", RASTER,
                        "--temporal-width", "0", "--aperture", "line", "--flicker-weight", f"{weight:.6g}",
                        "--flicker-limit", str(LIMIT), "--timecode", "00:00:00:00", "--overwrite", "-q", "-o",
                        self.path("nearest.y4m"), *CODES], check=True)
        return Frame(self.path("nearest.y4m"))

    def as_calm(self, wanted):
        """The weight whose flicker is what is wanted, by halving."""
        low, high = 0.01, 100.0
        for _ in range(12):
            middle = (low * high) ** 0.5
            low, high = (middle, high) if self.nearest(middle).flicker > wanted else (low, middle)
        return self.nearest(high)


    def ways(self):
        """By name, the picture of each."""
        ways = {"ffmpeg": self.ffmpeg(), "shaped": Frame(self.render("shaped.y4m", "--aperture", "shaped", *CODES))}
        return {**ways, "nearest": self.as_calm(min(frame.flicker for frame in ways.values()))}


def told(frame, sharp):
    """RMS and the 99.9th percentile of its flicker, and its distance from the sharp frame."""
    return frame.flicker, float(numpy.quantile(flicker(frame.light), 0.999)), rms(frame.light - sharp.light)


CODES = ("--bits", "16", "--chroma", "444")


def column_of(frame):
    map_of = AMPLIFIED * flicker(frame.light)
    gray = 255 * numpy.clip(map_of, 0, 1) ** (1 / 2.4) + 0.5
    return cropped(frame.colors), cropped(numpy.repeat(gray[:, :, None], 3, axis=2).astype(numpy.uint8))


def main():
    weft = sys.argv[1] if len(sys.argv) > 1 else "weft"
    out = sys.argv[2] if len(sys.argv) > 2 else os.path.join(HERE, "pictures", "before_after.png")
    with tempfile.TemporaryDirectory() as folder:
        make = Maker(weft, folder)
        ways = make.ways()
    for name, frame in ways.items():
        calm, worst, distance = told(frame, make.sharp)
        print(f"{name}: flicker {calm:.5f} RMS, {worst:.4f} at 99.9 %, distance from the sharp frame {distance:.5f}")
    columns = [column_of(frame) for frame in ways.values()]
    lines, width, _ = columns[0][0].shape
    sheet = numpy.full((2 * lines + GAP, len(columns) * (width + GAP) - GAP, 3), 255, numpy.uint8)
    for x, column in enumerate(columns):
        for y, part in enumerate(column):
            sheet[y * (lines + GAP) :, x * (width + GAP) :][:lines, :width] = part
    write_png(out, sheet)


if __name__ == "__main__":
    main()
