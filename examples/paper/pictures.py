"""PNG and EXR files from lists of numbers, and the ways pictures are cut and colored."""
import base64
import struct
import zlib

from program import GAMMA


SIZES = [min(k, 256 - k) for k in range(256)]  # of bytes as signed numbers


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(rows, color=False, filtered=False):
    """A PNG of 8 bits. Rows are bytes: gray or R G B."""
    step = 3 if color else 1
    kind = 2 if color else 0
    head = struct.pack(">IIBBBBB", len(rows[0]) // step, len(rows), 8, kind, 0, 0, 0)
    if filtered:
        body = b"".join(smallest(above, row, step) for above, row in zip([bytes(len(rows[0]))] + rows, rows))
    else:
        body = b"".join(b"\0" + row for row in rows)
    return b"".join([b"\x89PNG\r\n\x1a\n", chunk(b"IHDR", head), chunk(b"IDAT", zlib.compress(body, 9)),
                     chunk(b"IEND", b"")])


def smallest(above, row, step):
    """The row as it is, less what is a pixel before it, or less what is above it, whichever has the smallest
    bytes: a PNG's filters 0, 1 and 2."""
    before = bytes(step) + row[:-step]
    ways = [row] + [bytes((a - b) & 255 for a, b in zip(row, other)) for other in (before, above)]
    sizes = [sum(map(SIZES.__getitem__, way)) for way in ways]
    kind = sizes.index(min(sizes))
    return bytes([kind]) + ways[kind]


def uri(data, kind="image/png"):
    return f"data:{kind};base64," + base64.b64encode(data).decode()


# ---- From video ----

GRAY = {}


def gray_table(bits):
    if bits not in GRAY:
        step = 1 << (bits - 8)
        GRAY[bits] = bytes(min(255, max(0, round((code / step - 16) * 255 / 219)))
                           for code in range(1 << bits))
    return GRAY[bits]


def gray_rows(clip, frame, lines, x0=0, x1=None):
    """The luma of those lines as bytes, black 0 and white 255, as the display is given it."""
    table, luma = gray_table(clip.bits), clip.frames[frame][0]
    x1 = clip.width if x1 is None else x1
    return [bytes(table[code] for code in luma[y * clip.width + x0:y * clip.width + x1])
            for y in lines]


def color_rows(clip, frame, lines, x0=0, x1=None):
    """R'G'B' bytes of those lines, by the matrix of Rec. 601. The clip has 8 bits."""
    y_plane, u_plane, v_plane = clip.frames[frame]
    x1 = clip.width if x1 is None else x1
    luma = [(code - 16) * 255 / 219 for code in range(256)]
    red, blue = [[k * (code - 128) * 255 / 224 for code in range(256)] for k in (1.402, 1.772)]
    green_u, green_v = [[k * (code - 128) * 255 / 224 for code in range(256)]
                        for k in (-0.344136, -0.714136)]
    rows = []
    for line in lines:
        row, at = bytearray(), line * clip.width
        for y, u, v in zip(y_plane[at + x0:at + x1], u_plane[at + x0:at + x1],
                           v_plane[at + x0:at + x1]):
            y = luma[y]
            for value in (y + red[v], y + green_u[u] + green_v[v], y + blue[u]):
                row.append(0 if value < 0 else 255 if value > 255 else int(value + 0.5))
        rows.append(bytes(row))
    return rows


def enlarge(rows, across, down, step=1):
    """Every pixel a rectangle."""
    out = []
    for row in rows:
        wide = b"".join(row[k:k + step] * across for k in range(0, len(row), step))
        out += [wide] * down
    return out


def display_bytes(rows, top=1.0):
    """Light, 0 to `top`, as bytes for the display."""
    scale = 1 / top if top else 0
    return [bytes(min(255, int(255 * max(0.0, value * scale) ** (1 / GAMMA) + 0.5))
                  for value in row) for row in rows]


# ---- EXR, for weft to read ----

def exr(path, rows):
    """One channel Y, float, not compressed."""
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data
    width, lines = len(rows[0]), len(rows)
    window = struct.pack("<4i", 0, 0, width - 1, lines - 1)
    channels = b"Y\0" + struct.pack("<iB3xii", 2, 0, 1, 1) + b"\0"
    head = struct.pack("<ii", 20000630, 2) + b"".join([
        attribute(b"channels", b"chlist", channels), attribute(b"compression", b"compression", b"\0"),
        attribute(b"dataWindow", b"box2i", window), attribute(b"displayWindow", b"box2i", window),
        attribute(b"lineOrder", b"lineOrder", b"\0"),
        attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))]) + b"\0"
    first, size = len(head) + 8 * lines, 8 + 4 * width
    with open(path, "wb") as out:
        out.write(head + struct.pack(f"<{lines}Q", *(first + size * y for y in range(lines))))
        for y, row in enumerate(rows):
            out.write(struct.pack("<ii", y, 4 * width) + struct.pack(f"<{width}f", *row))
