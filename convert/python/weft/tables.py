"""What there is: apertures, rasters, options."""
from __future__ import annotations

import ctypes
import os
from dataclasses import dataclass
from fractions import Fraction
from typing import Optional, Union

import numpy as np

from ._library import OptionStruct, RasterStruct, lib
from .errors import call


def _text(value: Optional[bytes]) -> Optional[str]:
    return None if value is None else value.decode("utf-8", "replace")


def apertures() -> list[str]:
    """The names of the apertures: "line", "shaped", ..."""
    names: list[str] = []
    while (name := lib.weft_aperture_name(len(names))) is not None:
        names.append(name.decode())
    return names


def aperture_response(aperture: str, fx=0.0, fy=0.0, ft=0.0, tau: Optional[float] = None):
    """The frequency response of an aperture ("box", "mitchell:1.5,-0.25"): 1 at 0, and real, since
    every aperture is symmetric.

    fx (cycles a pixel), fy (cycles a frame line) and ft (cycles a field period) are numbers or
    arrays that go together as NumPy's do; the result is a float64 number or array of that shape.
    tau is the temporal width in field periods; None takes the aperture's own.
    """
    fx, fy, ft = np.broadcast_arrays(*(np.asarray(f, dtype=np.float64) for f in (fx, fy, ft)))
    name, width = os.fsencode(aperture), -1.0 if tau is None else float(tau)
    if width < 0 and tau is not None:
        raise ValueError(f"a temporal width is 0 or more field periods, not {tau}")
    out = np.empty(fx.shape)
    one = ctypes.c_double()
    for at in np.ndindex(fx.shape):
        call(lib.weft_aperture_response, name, width, float(fx[at]), float(fy[at]), float(ft[at]),
             ctypes.byref(one))
        out[at] = one.value
    return out if out.shape else float(out)


@dataclass(frozen=True)
class Raster:
    """A raster: what is sent, line by line."""

    name: str
    width_px: int
    lines: int  #: of a whole frame
    rate: Fraction  #: frames a second
    interlaced: bool
    segmented: bool
    top_first: bool  #: means something when interlaced
    pixel_aspect: Fraction
    matrix: str  #: "601-525", "601-625", "709", "2020"
    line1: int  #: analogue line map; 0 where there is none
    line2: int
    total_lines: int

    @property
    def fields_per_frame(self) -> int:
        return 2 if self.interlaced else 1


def _raster(r: RasterStruct) -> Raster:
    return Raster(r.name.decode(), r.width_px, r.lines, Fraction(r.rate_num, r.rate_den), r.interlaced,
                  r.segmented, r.top_first, Fraction(r.pixel_aspect_num, r.pixel_aspect_den),
                  r.matrix.decode(), r.line1, r.line2, r.total_lines)


def rasters() -> list[Raster]:
    """The named rasters."""
    found: list[Raster] = []
    one = RasterStruct()
    while lib.weft_raster_at(len(found), ctypes.byref(one)):
        found.append(_raster(one))
    return found


def raster(text: Union[str, Raster]) -> Raster:
    """The raster of a name ("525i") or description ("180x122@30i,tff"); UsageError for no other."""
    if isinstance(text, Raster):
        return text
    one = RasterStruct()
    call(lib.weft_raster_parse, os.fsencode(text), ctypes.byref(one))
    return _raster(one)


@dataclass(frozen=True)
class Option:
    """An option of Job."""

    name: str  #: as on the command line: "temporal-width"
    takes: Optional[str]  #: "T", "start|center|end"; None for a flag
    preset: Optional[str]  #: the default, for people
    help: str
    group: str


def options() -> list[Option]:
    """The options that a Job takes."""
    found: list[Option] = []
    one = OptionStruct()
    while lib.weft_option_at(len(found), ctypes.byref(one)):
        found.append(Option(*(_text(getattr(one, name)) for name, _ in one._fields_)))
    return found
