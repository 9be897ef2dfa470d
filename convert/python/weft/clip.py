"""Finished video as NumPy arrays."""
from __future__ import annotations

import base64
import ctypes
import html
import os
from typing import Any, Optional, Sequence, Union

import numpy as np

from . import _files
from ._library import Picture, VideoInfo, lib
from .errors import UsageError, call
from .report import Report
from .tables import Raster, _raster, raster as find_raster

_LUMA = {"601-525": (0.299, 0.114), "601-625": (0.299, 0.114), "709": (0.2126, 0.0722),
         "2020": (0.2627, 0.0593)}


class Clip:
    """Frames of finished video: planes as they are coded, in signals.

    Clip(planes, raster="525i", layout="ycbcr", bits=10, full_range=False)

    planes are three arrays (frames, lines, width) of float32. Of the layout "ycbcr" they are Y' from 0
    (black) to 1 (white), Cb and Cr from -1/2 to 1/2, which may have half the width or half the lines;
    of "rgb" R' G' B' from 0 to 1; of "linear" scene-linear light. Both fields of a frame are woven.
    bits and full_range say what codes they stand for.

    >>> gray = weft.Clip([np.full((2, 486, 720), 0.5), np.zeros((2, 486, 360)), np.zeros((2, 486, 360))])
    >>> gray
    Clip(2 frames of 720x486, 525i, ycbcr 4:2:2, 10 bits)
    >>> int(gray.codes(0)[0, 0, 0]), gray.rgb().shape
    (502, (2, 486, 720, 3))
    """

    def __init__(self, planes: Sequence[Any], raster: Union[str, Raster] = "525i", layout: str = "ycbcr",
                 bits: int = 10, full_range: bool = False):
        self.planes = [np.ascontiguousarray(plane, dtype=np.float32) for plane in planes]
        if len(self.planes) != 3 or any(plane.ndim != 3 for plane in self.planes):
            raise UsageError("a clip has three planes, each an array (frames, lines, width)")
        if layout not in ("ycbcr", "rgb", "linear"):
            raise UsageError(f"'{layout}' is no layout of a clip; it is one of ycbcr, rgb, linear")
        if layout != "linear" and bits not in range(8, 17):
            raise UsageError(f"bits is {bits}; a clip's codes have 8 to 16 bits")
        self.raster: Raster = find_raster(raster)
        self.layout, self.bits, self.full_range = layout, bits, full_range
        #: of the run that made it, where there was one
        self.report: Optional[Report] = None
        self._check()

    def _check(self) -> None:
        frames, lines, width = self.planes[0].shape
        shapes = {plane.shape for plane in self.planes[1:]}
        allowed = {(1, 1)} if self.layout != "ycbcr" else set(_files.CHROMA)
        if not self.planes[0].size or len(shapes) != 1 or not any(
                shapes == {(frames, -(-lines // down), -(-width // across))} for across, down in allowed):
            raise UsageError("planes do not go together: " + ", ".join(str(p.shape) for p in self.planes))
        if (width, lines) != (self.raster.width_px, self.raster.lines):
            raise UsageError(f"these are frames of {width}x{lines}, and raster {self.raster.name} is "
                             f"{self.raster.width_px}x{self.raster.lines}")

    @property
    def width_px(self) -> int:
        return self.planes[0].shape[2]

    @property
    def lines(self) -> int:
        return self.planes[0].shape[1]

    @property
    def across(self) -> int:
        """Luma samples to a chroma sample along the line."""
        return -(-self.width_px // self.planes[1].shape[2])

    @property
    def down(self) -> int:
        """Lines of luma to one of chroma."""
        return -(-self.lines // self.planes[1].shape[1])

    def __len__(self) -> int:
        return self.planes[0].shape[0]

    def __repr__(self) -> str:
        names = {(1, 1): " 4:4:4", (2, 1): " 4:2:2", (2, 2): " 4:2:0", (4, 1): " 4:1:1"}
        chroma = names[self.across, self.down] if self.layout == "ycbcr" else ""
        return (f"Clip({len(self)} frame{'s' * (len(self) != 1)} of {self.width_px}x{self.lines}, {self.raster.name}, "
                f"{self.layout}{chroma}, {self.bits} bits)")

    def codes(self, plane: int) -> np.ndarray:
        """A plane's codes, uint16: narrow range of Rec. ITU-R BT.601 unless the clip is full_range."""
        if self.layout == "linear":
            raise UsageError("linear light has no codes")
        one = 2 ** (self.bits - 8)
        chroma = self.layout == "ycbcr" and plane > 0
        gain = 2 ** self.bits - 1 if self.full_range else (224 if chroma else 219) * one
        zero = 128 * one if chroma else 0 if self.full_range else 16 * one
        values = np.rint(self.planes[plane].astype(np.float64) * gain + zero)
        return np.clip(values, 0, 2 ** self.bits - 1).astype(np.uint16)

    def rgb(self) -> np.ndarray:
        """R'G'B' (frames, lines, width, 3) from 0 to 1, to look at: chroma is repeated, linear light
        encoded by Rec. ITU-R BT.709."""
        first, second, third = self.planes
        if self.layout == "ycbcr":
            kr, kb = _LUMA[self.raster.matrix]
            second, third = (np.repeat(np.repeat(p, self.down, 1), self.across, 2)
                             [:, :self.lines, :self.width_px] for p in (second, third))
            red, blue = first + 2 * (1 - kr) * third, first + 2 * (1 - kb) * second
            light = np.stack([red, (first - kr * red - kb * blue) / (1 - kr - kb), blue], axis=-1)
        else:
            light = np.stack([first, second, third], axis=-1)
        if self.layout == "linear":
            light = np.maximum(light, 0)
            light = np.where(light < 0.018, 4.5 * light, 1.099 * light ** 0.45 - 0.099)
        return np.clip(light, 0, 1)

    def fields(self) -> np.ndarray:
        """`rgb` field by field in their order in time: (fields, lines of one, width, 3); frames, of a
        raster that is not interlaced."""
        rgb = self.rgb()
        if not self.raster.interlaced:
            return rgb
        first = 0 if self.raster.top_first else 1
        both = np.stack([rgb[:, first::2], rgb[:, 1 - first::2]], axis=1)
        return both.reshape(-1, *both.shape[2:])

    def write(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a clip of Y' Cb Cr as Y4M, replacing what is there."""
        if self.layout != "ycbcr":
            raise UsageError(f"a clip that is written as Y4M is of the layout ycbcr, not {self.layout}")
        _files.write_y4m(os.fspath(path), self)

    def _repr_html_(self) -> str:
        rgb = self.rgb()[0]
        image = base64.b64encode(_files.png(np.rint(255 * rgb).astype(np.uint8))).decode()
        wide = round(self.width_px * float(self.raster.pixel_aspect))
        return (f"<figure><img alt='its first frame' style='width:{min(wide, 720)}px;max-width:100%' "
                f"src='data:image/png;base64,{image}'><figcaption>{html.escape(repr(self)[5:-1])}"
                "</figcaption></figure>")


def read(path: Union[str, "os.PathLike[str]"], raster: Union[None, str, Raster] = None,
         frames: Optional[int] = None) -> Clip:
    """Finished video as a Clip: Y4M, raw v210 and uyvy, pictures and sequences, and what libav reads.

    raster says what it is where it does not say so; frames, how many are read at most.

    >>> weft.render("scene.lua", output="ring.y4m", frames="0-1", samples=1, raster="36x24@30i,tff")["frames"]
    2
    >>> weft.read("ring.y4m", raster="36x24@30i,tff", frames=1)
    Clip(1 frame of 36x24, 36x24@30i,tff, ycbcr 4:2:2, 10 bits)
    """
    name = None if raster is None else os.fsencode(raster.name if isinstance(raster, Raster) else raster)
    handle = ctypes.c_void_p()
    call(lib.weft_video_open, os.fsencode(path), name, ctypes.byref(handle))
    try:
        info = VideoInfo(size=ctypes.sizeof(VideoInfo))
        lib.weft_video_tell(handle, ctypes.byref(info))
        planes = _read_planes(handle, frames)
        clip = Clip(planes, _raster(info.raster), info.layout.decode(), info.bits, info.full_range)
    finally:
        lib.weft_video_close(handle)
    return clip


def _read_planes(handle, most: Optional[int]) -> list:
    planes: list = [[], [], []]
    picture = Picture(size=ctypes.sizeof(Picture))
    while most is None or len(planes[0]) < most:
        call(lib.weft_video_next, handle, ctypes.byref(picture))
        if not picture.plane[0]:
            break
        for p in range(3):
            shape = (picture.lines[p], picture.width_px[p]) if picture.plane[p] else planes[0][0].shape
            planes[p].append(np.ctypeslib.as_array(picture.plane[p], shape).copy() if picture.plane[p]
                             else np.zeros(shape, np.float32))
    if not planes[0]:
        raise UsageError("no frame was read")
    return [np.stack(plane) for plane in planes]
