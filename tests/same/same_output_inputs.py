"""Inputs of same_output.sh that no program at hand makes: EXR files of unusual channels, windows,
attributes and values, deep ones with weights, and files that are cut short. Written as bytes, without
compression.

  same_output_inputs.py DIRECTORY
"""
import os
import struct
import sys

import numpy as np

WIDTH, LINES, COUNT = 96, 64, 16
PRIMARIES = np.array([(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (0, 1, 1), (1, 0, 1), (1, 1, 1), (0, 0, 0)],
                     np.float32)


# ---- EXR ----

def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def rational(name, num, den):
    return attribute(name, "rational", struct.pack("<iI", num, den))


def header(planes, data, display, more=b"", pixel_aspect=1):
    """Attributes to their end; planes are pairs of a name and an array, windows x0, y0, x1, y1 with x1 and
    y1 inside."""
    channels = b"".join(n.encode() + b"\0" + struct.pack("<iB3xii", 1 if p.dtype == np.float16 else 2, 0, 1, 1)
                        for n, p in planes)
    return (attribute("channels", "chlist", channels + b"\0") + attribute("compression", "compression", b"\0")
            + attribute("dataWindow", "box2i", struct.pack("<4i", *data))
            + attribute("displayWindow", "box2i", struct.pack("<4i", *display))
            + attribute("lineOrder", "lineOrder", b"\0")
            + attribute("pixelAspectRatio", "float", struct.pack("<f", pixel_aspect))
            + attribute("screenWindowWidth", "float", struct.pack("<f", 1))
            + attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)) + more + b"\0")


MAGIC = 20000630


def scanlines(planes, y0, before=b""):
    """A chunk for each line."""
    lines = len(planes[0][1])
    return [before + struct.pack("<ii", y0 + j, sum(p[j].nbytes for _, p in planes))
            + b"".join(p[j].tobytes() for _, p in planes) for j in range(lines)]


def put(path, version, heads, parts):
    """The file: headers, where each chunk of each part is, chunks."""
    start = struct.pack("<ii", MAGIC, version) + b"".join(heads)
    at = len(start) + 8 * sum(map(len, parts))
    with open(path, "wb") as out:
        out.write(start)
        for chunk in (c for chunks in parts for c in chunks):
            out.write(struct.pack("<Q", at))
            at += len(chunk)
        out.write(b"".join(c for chunks in parts for c in chunks))


def ordered(channels, half=()):
    """Planes in the order of names; the names in half, or all if it is True, as 16-bit floats."""
    return [(n, channels[n].astype("<f2" if half is True or half is not False and n in half else "<f4"))
            for n in sorted(channels)]


def write(path, channels, origin=(0, 0), display=None, half=False, **rest):
    """A picture of scanlines; channels are arrays of [lines][width] by their names."""
    planes = ordered(channels, half)
    lines, width = planes[0][1].shape
    data = (*origin, origin[0] + width - 1, origin[1] + lines - 1)
    put(path, 2, [header(planes, data, display or data, **rest)], [scanlines(planes, origin[1])])


def named(name, kind, chunks):
    return (attribute("name", "string", name.encode()) + attribute("type", "string", kind)
            + attribute("chunkCount", "int", struct.pack("<i", chunks)))


def write_parts(path, parts):
    """Several pictures in a file: pairs of channels and more attributes."""
    heads, bodies = [], []
    for k, (channels, more) in enumerate(parts):
        planes = ordered(channels, True)
        lines, width = planes[0][1].shape
        window = (0, 0, width - 1, lines - 1)
        heads.append(header(planes, window, window, named(f"part{k}", b"scanlineimage", lines) + more))
        bodies.append(scanlines(planes, 0, struct.pack("<i", k)))
    put(path, 0x1002, heads + [b"\0"], bodies)


def write_deep(path, channels, each, width, lines):
    """Deep scanlines of `each` samples a pixel; channels are arrays of [lines][width * each]."""
    planes = ordered(channels)
    window = (0, 0, width - 1, lines - 1)
    more = named("samples", b"deepscanline", lines) + attribute("version", "int", struct.pack("<i", 1))
    table = struct.pack(f"<{width}i", *range(each, each * (width + 1), each))
    data_bytes = 4 * len(planes) * each * width
    chunks = [struct.pack("<iQQQ", j, len(table), data_bytes, data_bytes) + table
              + b"".join(p[j].tobytes() for _, p in planes) for j in range(lines)]
    put(path, 0x802, [header(planes, window, window, more)], [chunks])


# ---- Pictures ----

def grid(width=WIDTH, lines=LINES):
    y, x = np.mgrid[0:lines, 0:width].astype(np.float32)
    return x, y


def rgb(picture):
    return dict(zip("RGB", np.moveaxis(picture, -1, 0)))


def disc(k, width=WIDTH, lines=LINES):
    """A disc that moves with subframe k over a gradient, and how much it covers."""
    x, y = grid(width, lines)
    cover = np.clip(14.5 - np.hypot(x - 30 - 1.5 * k, y - 32 - 0.4 * k), 0, 1)
    under = np.stack((0.2 * y / lines, 0.3 * x / width, 0.4 + 0 * x), -1)
    return under + cover[..., None] * ((0.9, 0.5, 0.1) - under), cover


def bright(k):
    x, y = grid()
    return 10 * PRIMARIES[((x + k) // 13 + y // 17).astype(int) % 8]


def thin(k):
    x, y = grid()
    return 10 * PRIMARIES[((x + k) // (1 + y // 25)).astype(int) % 8]


def holes(k):
    """Some pixels are no numbers, and one block is nothing else."""
    rng = np.random.default_rng(k)
    picture = disc(k)[0]
    hit = rng.random(picture.shape) < 0.02
    picture[hit] = rng.choice((np.nan, np.inf, -np.inf, 1e30), hit.sum())
    picture[20:28, 40:50] = np.nan
    return picture


def sequence(directory, make):
    os.makedirs(directory)
    for k in range(COUNT):
        make(os.path.join(directory, f"s.{k:04d}.exr"), k)


def pictures(to):
    plain = {"bright": bright, "thin": thin, "holes": holes}
    for name, look in plain.items():
        sequence(f"{to}/{name}", lambda path, k, look=look: write(path, rgb(look(k))))
    sequence(f"{to}/rgba", rgba)
    sequence(f"{to}/over", overscan)
    sequence(f"{to}/labeled", labeled)
    sequence(f"{to}/layers", layers)
    sequence(f"{to}/kinds", lambda path, k: write(path, rgb(disc(k)[0][:, :95]), half="RB"))
    sequence(f"{to}/gray", lambda path, k: write(path, {"Y": disc(k)[1]}, half=True))
    sequence(f"{to}/wide", lambda path, k: write(path, rgb(disc(k)[0]), half=True, pixel_aspect=2,
                                                 more=rational("framesPerSecond", 240, 1)))


def rgba(path, k):
    """Covered in part, and a data window that is smaller than the display window."""
    picture, cover = disc(k)
    channels = {**rgb(picture * cover[..., None]), "A": cover}
    write(path, {n: p[10:50, 8:90] for n, p in channels.items()}, origin=(8, 10),
          display=(0, 0, WIDTH - 1, LINES - 1))


def overscan(path, k):
    """A data window that is larger than the display window, neither of which begins at 0."""
    write(path, rgb(disc(k, 128, 90)[0]), origin=(-20, 5), display=(-4, 16, -4 + WIDTH - 1, 16 + LINES - 1), half=True)


def labeled(path, k):
    """With a rate, and timecode of 24 frames a second from 10:00:00:12 on."""
    label = 0x10000012 if k < 8 else 0x10000013
    more = rational("framesPerSecond", 24, 1) + attribute("timeCode", "timecode", struct.pack("<II", label, 0))
    write(path, rgb(disc(k)[0]), half=True, more=more)


def layers(path, k):
    picture, cover = disc(k)
    x, y = grid()
    named = {f"diffuse.{n}": p for n, p in rgb(picture[::-1]).items()}
    write(path, {**rgb(picture), **named, "N.X": x / WIDTH, "N.Y": y / LINES, "N.Z": cover, "Z": cover}, half=True)


def timed(to):
    """Subframes as parts of a file, not in order of time, and two of one time."""
    parts = [(rgb(disc(k)[0]), rational("weft:time", k, 240)) for k in range(16)]
    write_parts(f"{to}/timed.exr", parts[8:] + parts[:8])
    write_parts(f"{to}/twice.exr", parts[:4] + parts[3:4])


# ---- Sample buffers ----

def deep(to, width=48, lines=32, each=24):
    """Two frames with alpha and weights."""
    for frame in range(2):
        rng = np.random.default_rng(frame)
        x, y, t = (rng.random((lines, width * each)) for _ in range(3))
        x = np.minimum(x, 0.9999) + np.arange(width * each) // each
        y += np.arange(lines)[:, None]
        t *= 2
        cover = np.hypot(x - 12 - 3 * (2 * frame + t), y - 16) < 8
        write_deep(f"{to}/weighted.{frame:04d}.exr",
                   {"R": 0.9 * cover, "G": 0.4 * cover, "B": 0.1 * cover, "A": 1.0 * cover, "sample.x": x,
                    "sample.y": y, "sample.t": t, "sample.w": 0.5 + rng.random(t.shape)}, each, width, lines)


def changed(path, to, at, data):
    """A copy with other bytes at a place, which counts from the end if it is negative."""
    whole = bytearray(open(path, "rb").read())
    at = at if at >= 0 else len(whole) + at
    whole[at:at + len(data)] = data
    open(to, "wb").write(whole)


def damaged(to):
    """EXR files that are cut or changed, and no EXR at all."""
    os.makedirs(f"{to}/damaged")
    whole = open(f"{to}/bright/s.0000.exr", "rb").read()
    for name, data in {"cut": whole[:5000], "header": whole[:100], "text": b"no picture\n", "empty": b""}.items():
        open(f"{to}/damaged/{name}.0000.exr", "wb").write(data)
    changed(f"{to}/bright/s.0000.exr", f"{to}/damaged/broken.0000.exr", 40, b"\x55")
    os.makedirs(f"{to}/damaged-deep")
    deep_file = f"{to}/weighted.0000.exr"
    begin = open(deep_file, "rb").read().index(struct.pack("<iQ", 0, 4 * 48))
    for name, at, data in (("line", begin, b"\x07"), ("sizes", begin + 4, b"\x01"), ("counts", begin + 28, b"\xff\xff"),
                           ("values", -4, struct.pack("<f", 99)), ("nan", -4, struct.pack("<f", np.nan))):
        changed(deep_file, f"{to}/damaged-deep/{name}.0000.exr", at, data)
    open(f"{to}/damaged-deep/cut.0000.exr", "wb").write(open(deep_file, "rb").read()[:20000])


if __name__ == "__main__":
    pictures(sys.argv[1])
    timed(sys.argv[1])
    deep(sys.argv[1])
    damaged(sys.argv[1])
