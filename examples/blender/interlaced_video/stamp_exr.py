#!/usr/bin/env python3
"""Says in the header of EXR files when they are of, and which part of them exists.

    stamp_exr.py FILE.exr [--time 3/400] [--region x0,y0,x1,y1]

Renderers that write no attributes of one's own leave that open: weft:time is in seconds, weft:region
in pixels from the display window's upper left corner, its last ones not included, as `weft plan` has
them. The file is written anew and put in its own place; what is there of these attributes already is
replaced. Scanline and tiled files of one part.
"""
import argparse
import os
import struct


def attributes(data):
    """Where each attribute begins and ends, by its name, and where the header does."""
    at, found = 8, {}
    while data[at]:
        name_end = data.index(b"\0", at)
        type_end = data.index(b"\0", name_end + 1)
        size, = struct.unpack_from("<i", data, type_end + 1)
        end = type_end + 5 + size
        found[data[at:name_end].decode()] = (at, end, data[type_end + 5:end])
        at = end
    return found, at


def chunks(found):
    """How many chunks the table of offsets behind the header has."""
    x0, y0, x1, y1 = struct.unpack("<4i", found["dataWindow"][2])
    width, lines = x1 - x0 + 1, y1 - y0 + 1
    if "tiles" in found:
        across, down, mode = struct.unpack("<IIB", found["tiles"][2])
        if mode & 15:
            raise ValueError("tiles of several levels are not for subframes")
        return -(-width // across) * -(-lines // down)
    rows = [1, 1, 1, 16, 32, 16, 32, 32, 32, 256][found["compression"][2][0]]
    return -(-lines // rows)


def stamp(path, time=None, region=None):
    """ValueError if it is no such file, OSError if it cannot be written."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        made = stamped(data, time, region)
    except (struct.error, IndexError, KeyError):
        raise ValueError(f"{path}: its header is cut off or damaged") from None
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    try:
        with open(path + ".part", "wb") as file:
            file.write(made)
        os.replace(path + ".part", path)
    except OSError:
        if os.path.exists(path + ".part"):
            os.remove(path + ".part")
        raise


def stamped(data, time, region):
    """A file's bytes with the attributes."""
    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630 or version & 0x1000:
        raise ValueError("no EXR of one part")
    try:
        found, end = attributes(data)
    except ValueError:
        raise IndexError from None
    new = {}
    if time is not None:
        new["weft:time"] = (b"string", str(time).encode())
    if region is not None:
        x, y, _, _ = struct.unpack("<4i", found["displayWindow"][2])
        x0, y0, x1, y1 = region
        new["weft:region"] = (b"box2i", struct.pack("<4i", x0 + x, y0 + y, x1 + x - 1, y1 + y - 1))
    header = data[:8]
    for name, (first, last, _) in found.items():
        if name not in new:
            header += data[first:last]
    for name, (kind, value) in new.items():
        header += name.encode() + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    count, moved = chunks(found), len(header) - (end + 1)
    offsets = struct.unpack_from(f"<{count}Q", data, end + 1)
    if not all(end < offset < len(data) for offset in offsets):
        raise ValueError("it is cut off, or not finished")
    table = struct.pack(f"<{count}Q", *(offset + moved for offset in offsets))
    return header + table + data[end + 1 + 8 * count:]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file")
    parser.add_argument("--time", help="seconds, such as 3/400")
    parser.add_argument("--region", help="x0,y0,x1,y1", type=lambda text: tuple(map(int, text.split(","))))
    asked = parser.parse_args()
    try:
        stamp(asked.file, asked.time, asked.region)
    except (ValueError, OSError) as error:
        raise SystemExit(str(error)) from None


if __name__ == "__main__":
    main()
