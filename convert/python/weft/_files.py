"""Pictures as files that libweft reads: EXR without compression, PNG, Y4M."""
from __future__ import annotations

import struct
import zlib

import numpy as np


def _attribute(name: str, kind: str, data: bytes) -> bytes:
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def write_exr(path: str, rgb: np.ndarray) -> None:
    """Writes (lines, width, 3) as floats, scene-linear."""
    lines, width, _ = rgb.shape
    window, one = struct.pack("<4i", 0, 0, width - 1, lines - 1), struct.pack("<f", 1)
    channels = b"".join(name + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in (b"B", b"G", b"R"))
    head = (struct.pack("<ii", 20000630, 2) + _attribute("channels", "chlist", channels + b"\0")
            + _attribute("compression", "compression", b"\0") + _attribute("dataWindow", "box2i", window)
            + _attribute("displayWindow", "box2i", window) + _attribute("lineOrder", "lineOrder", b"\0")
            + _attribute("pixelAspectRatio", "float", one) + _attribute("screenWindowWidth", "float", one)
            + _attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)) + b"\0")
    row = np.dtype([("y", "<i4"), ("bytes", "<i4"), ("bgr", "<f4", (3, width))])
    body = np.empty(lines, row)
    body["y"], body["bytes"] = np.arange(lines), 12 * width
    body["bgr"] = rgb[:, :, ::-1].transpose(0, 2, 1)
    offsets = len(head) + 8 * lines + row.itemsize * np.arange(lines, dtype="<u8")
    with open(path, "wb") as out:
        out.write(head + offsets.tobytes() + body.tobytes())


def png(codes: np.ndarray) -> bytes:
    """(lines, width, 3) of uint8 or uint16 as a PNG file."""
    lines, width, _ = codes.shape
    bits = 8 * codes.dtype.itemsize
    rows = codes.astype(codes.dtype.newbyteorder(">")).reshape(lines, -1).view(np.uint8)
    body = np.hstack([np.zeros((lines, 1), np.uint8), rows]).tobytes()

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, lines, bits, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(body, 6)) + chunk(b"IEND", b""))


CHROMA = {(1, 1): "444", (2, 1): "422", (2, 2): "420mpeg2", (4, 1): "411"}


def write_y4m(path: str, clip) -> None:
    """Writes a clip of Y' Cb Cr with the codes that it was read from."""
    raster, bits = clip.raster, clip.bits
    chroma = CHROMA[clip.across, clip.down]
    if bits > 8:  # Readers know no siting beside a depth: 420mpeg2p10 is taken for 8 bits.
        chroma = f"{chroma[:3]}p{bits}"
    scan = ("t" if raster.top_first else "b") if raster.interlaced else "p"
    aspect = raster.pixel_aspect
    full = " XCOLORRANGE=FULL" if clip.full_range else ""
    head = (f"YUV4MPEG2 W{clip.width_px} H{clip.lines} F{raster.rate.numerator}:{raster.rate.denominator} "
            f"I{scan} A{aspect.numerator}:{aspect.denominator} C{chroma}{full}\n")
    planes = [clip.codes(plane) for plane in range(3)]
    with open(path, "wb") as out:
        out.write(head.encode())
        for frame in range(len(clip)):
            out.write(b"FRAME\n")
            for plane in planes:
                out.write(plane[frame].astype("<u2" if bits > 8 else "u1").tobytes())
