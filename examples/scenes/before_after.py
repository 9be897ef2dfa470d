#!/usr/bin/env python3
"""Makes the picture at the top of the README: the two fields of one frame, before and after.

    before_after.py [WEFT] [OUT.png]

On the left is today's practice: a sharp frame of which each field takes every other line. On the
right are the fields that weft filters. The rows are the first field, the second, 1/60 second
later, each with the lines between its own interpolated, and four times their difference: what
flickers."""

import os
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
FRAME = "40"  # of panorama.lua
COLUMNS = (("--aperture", "line", "--temporal-width", "0"), ("--aperture", "shaped"))
LEFT, TOP, WIDTH, LINES = 206, 108, 300, 88  # the gable of the temple, in pixels and frame lines
ZOOM, GAP = 2, 8  # pixels
AMPLIFIED = 4


def read_dpx(path, width):
    """The R'G'B' codes of an 8-bit DPX as weft writes it, [lines][width][3]."""
    data = open(path, "rb").read()
    offset = struct.unpack(">I", data[4:8])[0]
    return numpy.frombuffer(data[offset:], numpy.uint8).reshape(-1, width, 3)


def write_png(path, picture):
    lines, width, _ = picture.shape
    raw = b"".join(b"\0" + picture[y].tobytes() for y in range(lines))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    head = struct.pack(">IIBBBBB", width, lines, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head))
        file.write(chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def between(field, first_line):
    """A field on the lines of the frame, with the lines between interpolated."""
    lines = len(field)
    at = (numpy.arange(2 * lines) - first_line) / 2
    low = numpy.clip(numpy.floor(at), 0, lines - 1).astype(int)
    high = numpy.minimum(low + 1, lines - 1)
    share = numpy.clip(at - low, 0, 1)[:, None, None]
    return field[low] * (1 - share) + field[high] * share


def cropped(frame):
    part = frame[TOP : TOP + LINES, LEFT : LEFT + WIDTH]
    return numpy.repeat(numpy.repeat(part, ZOOM, axis=0), ZOOM, axis=1)


def column_of(weft, options, folder):
    """First field, second field and their difference; 525i begins with the field of line 1."""
    subprocess.run(
        [weft, "render", os.path.join(HERE, "panorama.lua"), "--raster", "525i", "--frames", FRAME,
         "--samples", "64", "--bits", "8", "--fields", "separate", "--overwrite", "-q",
         "-o", os.path.join(folder, "field.####.dpx"), *options], check=True)
    numbers = (2 * int(FRAME), 2 * int(FRAME) + 1)
    fields = [read_dpx(os.path.join(folder, "field.%04d.dpx" % n), 720) for n in numbers]
    frames = [between(field, 1 - n) for n, field in enumerate(fields)]
    difference = AMPLIFIED * numpy.abs(frames[0] - frames[1])
    return [cropped(frame) for frame in (*frames, numpy.minimum(difference, 255))]


def main():
    weft = sys.argv[1] if len(sys.argv) > 1 else "weft"
    out = sys.argv[2] if len(sys.argv) > 2 else os.path.join(HERE, "pictures", "before_after.png")
    with tempfile.TemporaryDirectory() as folder:
        columns = [column_of(weft, options, folder) for options in COLUMNS]
    lines, width, _ = columns[0][0].shape
    sheet = numpy.full((3 * lines + 2 * GAP, 2 * width + GAP, 3), 255, numpy.uint8)
    for x, column in enumerate(columns):
        for y, field in enumerate(column):
            sheet[y * (lines + GAP) :, x * (width + GAP) :][:lines, :width] = field
    write_png(out, sheet)


if __name__ == "__main__":
    main()
