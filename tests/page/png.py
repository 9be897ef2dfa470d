"""Reads PNG of 8 bits of R'G'B' without weft, as ISO/IEC 15948 has it."""
import struct
import zlib


def nearest(a, b, c):
    """Of the left, the upper and the upper left neighbor the one that is nearest to a + b - c."""
    left, up, both = abs(b - c), abs(a - c), abs(a + b - 2 * c)
    return a if left <= up and left <= both else b if up <= both else c


GUESSES = (lambda a, b, c: 0, lambda a, b, c: a, lambda a, b, c: b, lambda a, b, c: (a + b) // 2, nearest)


def read(path):
    """Its width, its lines, and of each line the bytes. Sums of chunks are checked."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    width, lines, bits, kind = struct.unpack(">IIBB", data[16:26])
    assert (bits, kind) == (8, 2), (bits, kind)
    at, body = 8, b""
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        assert zlib.crc32(data[at + 4:at + 8 + size]) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]
        body += data[at + 8:at + 8 + size] if name == b"IDAT" else b""
        at += 12 + size
    raw, rows, above = zlib.decompress(body), [], bytes(3 * width)
    assert len(raw) == lines * (3 * width + 1)
    for y in range(lines):
        line, row = raw[y * (3 * width + 1):(y + 1) * (3 * width + 1)], bytearray()
        guess = GUESSES[line[0]]
        for x, value in enumerate(line[1:]):
            a, c = (row[x - 3], above[x - 3]) if x > 2 else (0, 0)
            row.append((value + guess(a, above[x], c)) & 255)
        rows.append(row)
        above = row
    return width, lines, rows
