#!/usr/bin/env python3
"""A renderer in few lines that writes a sample buffer: a disc that moves over a gradient, 16
samples a pixel and frame at random, in a deep EXR file that weft converts. Needs Python alone.
  write_samples.py disc.0000.exr 0 180 122 && weft convert disc.0000.exr --raster 180x122@30i ..
"""
import random
import struct
import sys

NAMES = ["B", "G", "R", "sample.t", "sample.x", "sample.y"]
EACH = 64


def look(x, y, t, width, lines):
    """What is seen at x, y (pixels and lines) at t (field periods from the first field)."""
    u, v = x / width - 0.3 - 0.01 * t, (y / lines - 0.5) * lines / width
    if u * u + v * v < 0.02:
        return 0.9, 0.3, 0.1
    return 0.2 * y / lines, 0.3 * y / lines, 0.5


def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def header(width, lines):
    channels = b"".join(n.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for n in NAMES)
    window = struct.pack("<4i", 0, 0, width - 1, lines - 1)
    one = struct.pack("<f", 1)
    return (struct.pack("<ii", 20000630, 0x802) + attribute("channels", "chlist", channels + b"\0")
            + attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", window)
            + attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0")
            + attribute("pixelAspectRatio", "float", one) + attribute("screenWindowWidth", "float", one)
            + attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
            + attribute("type", "string", b"deepscanline") + attribute("name", "string", b"samples")
            + attribute("version", "int", struct.pack("<i", 1))
            + attribute("chunkCount", "int", struct.pack("<i", lines)) + b"\0")


def main(path, frame, width, lines):
    head = header(width, lines)
    table = struct.pack("<%di" % width, *range(EACH, EACH * (width + 1), EACH))  # cumulative
    data_bytes = 4 * len(NAMES) * EACH * width
    chunk_bytes = 28 + len(table) + data_bytes
    with open(path, "wb") as out:
        first = len(head) + 8 * lines
        out.write(head + struct.pack("<%dQ" % lines, *(first + j * chunk_bytes for j in range(lines))))
        for j in range(lines):
            rows = [[] for _ in NAMES]
            for k in range(width * EACH):
                x, y, t = k // EACH + random.random(), j + random.random(), 2 * random.random()
                red, green, blue = look(x, y, 2 * frame + t, width, lines)
                for row, value in zip(rows, (blue, green, red, t, x, y)):
                    row.append(min(value, k // EACH + 0.999999) if row is rows[4] else value)
            out.write(struct.pack("<iQQQ", j, len(table), data_bytes, data_bytes) + table)
            out.write(b"".join(struct.pack("<%df" % len(row), *row) for row in rows))


main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]))
