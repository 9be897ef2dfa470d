"""Samples from a renderer, as NumPy arrays."""
from __future__ import annotations

import ctypes
import weakref
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from ._library import FIELD_FN, FLOATS, Samples, Tile, lib
from .errors import UsageError, call, int64
from .job import Calls, Job


@dataclass(frozen=True, eq=False)
class Field:
    """A finished field."""

    index: int  #: from 0
    first_line: int  #: its line l is line first_line + l * line_step of the frame
    line_step: int
    rgb: np.ndarray  #: (lines, width, 3) float32, scene-linear; a copy of its own
    alpha: Optional[np.ndarray] = None  #: (lines, width) float32; None unless the job writes alpha


def _floats(name: str, value: Any, shape: tuple) -> np.ndarray:
    """A C-contiguous float32 array of a shape in which None stands for any length."""
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} must hold real numbers, not {array.dtype}")
    fits = array.ndim == len(shape) and all(w in (None, n) for n, w in zip(array.shape, shape))
    if not fits:
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        raise ValueError(f"{name} must have the shape ({wanted}{',' * (len(shape) == 1)}), "
                         f"not {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float32)


def _pointer(array: Optional[np.ndarray]):
    return FLOATS() if array is None else array.ctypes.data_as(FLOATS)


def _field(f: Any) -> Field:
    # libweft's memory is lent for the call only.
    shape = (f.lines, f.width_px)
    rgb = np.ctypeslib.as_array(f.rgb, (*shape, 3)).copy()
    alpha = np.ctypeslib.as_array(f.alpha, shape).copy() if f.alpha else None
    return Field(f.index, f.first_line, f.line_step, rgb, alpha)


class Fields:
    """Fields that gather samples as a renderer makes them.

    Fields(job, frames, on_field=None)

    How they look is what the job's options say; if it has an output, finished frames are written
    there. Finished fields come back from `until` and `finish`, or go to on_field(Field) if there is
    one; what that raises comes out of the call that finished the field. Memory is that of the
    fields in hand: `until` says which are done with. The job must not be changed before `close`,
    which is at the end of a `with` statement: an output that was not finished is taken back there.

        with weft.Job(raster="525i", aperture="box") as job, weft.Fields(job, frames=15) as fields:
            for n in range(30):
                fields.push(n, x, y, t, rgb)
                for field in fields.until(n + 1):
                    show(field.rgb)
            fields.finish()
    """

    def __init__(self, job: Job, frames: int, on_field: Optional[Callable[[Field], None]] = None):
        handle = ctypes.c_void_p()
        self._job, self._calls = job, Calls()
        self._finished: list[Field] = []
        calls, take = self._calls, on_field or self._finished.append

        def tell(pointer, _user):
            calls.guard(lambda: take(_field(pointer.contents)))

        self._function = FIELD_FN(tell)
        call(lib.weft_fields_new, job._idle(), int(frames), self._function, None,
             ctypes.byref(handle))
        self._handle: Optional[int] = handle.value
        # The finalizer holds the job and the function, which must outlive the fields.
        self._free = weakref.finalize(self, _free, handle.value, job, self._function)
        job._fields = weakref.ref(self)

    def _open(self) -> int:
        if self._handle is None:
            raise UsageError("these fields are closed")
        return self._handle

    def push(self, field: int, x: Any, y: Any, t: Any, rgb: Any, weight: Any = None,
             alpha: Any = None) -> None:
        """Adds n samples, in any order.

        x, y (n,): raster coordinates, pixels and frame lines from the upper left corner.
        t (n,), or one number for all: field periods after the instant of `field`, from 0.
        rgb (n, 3): scene-linear. weight (n,): None lets all count alike.
        alpha (n,): rgb is multiplied by it already; None: 1. What it leaves open shows the job's
        background, or stays open where alpha_out or key is set.
        Arrays of other real types are converted to float32. UsageError if a sample belongs to a
        field that is finished, or is not finite.
        """
        x = _floats("x", x, (None,))
        n = len(x)
        y = _floats("y", y, (n,))
        t = _floats("t", np.broadcast_to(t, (n,)) if np.ndim(t) == 0 else t, (n,))
        planes = np.ascontiguousarray(_floats("rgb", rgb, (n, 3)).T)
        weights = None if weight is None else _floats("weight", weight, (n,))
        opaque = None if alpha is None else _floats("alpha", alpha, (n,))
        samples = Samples(n, _pointer(x), _pointer(y), _pointer(t), int64(int(field)),
                          *(_pointer(plane) for plane in planes),
                          _pointer(weights), _pointer(opaque))
        call(lib.weft_fields_push, self._open(), ctypes.byref(samples))

    def push_tile(self, field: int, rgb: Any, rect: Optional[tuple] = None, t: float = 0.0,
                  alpha: Any = None) -> None:
        """Adds a grid of samples at one instant: rgb (height, width, 3), scene-linear, and alpha
        (height, width) as `push` takes it.

        They fill rect = (x0, y0, x1, y1), raster coordinates (None: the whole raster), each in the
        middle of its cell, t field periods after the instant of `field`.
        """
        rgb = _floats("rgb", rgb, (None, None, 3))
        height, width, _ = rgb.shape
        if not height or not width:
            raise ValueError(f"rgb must hold samples; its shape is {rgb.shape}")
        opaque = None if alpha is None else _floats("alpha", alpha, (height, width))
        if rect is None:
            rect = (0, 0, self._job.raster.width_px, self._job.raster.lines)
        x0, y0, x1, y1 = (float(edge) for edge in rect)
        tile = Tile(x0, y0, x1, y1, float(t), int64(int(field)), width, height, _pointer(rgb),
                    _pointer(opaque))
        call(lib.weft_fields_push_tile, self._open(), ctypes.byref(tile))

    def _take(self) -> list[Field]:
        self._calls.release()
        taken = self._finished[:]
        self._finished.clear()
        return taken

    def until(self, field: int) -> list[Field]:
        """Promises that no sample before the instant of `field` comes any more, and returns the
        fields that are finished by that, in order."""
        call(lib.weft_fields_until, self._open(), int(field))
        return self._take()

    def finish(self) -> list[Field]:
        """Finishes all fields and the output; returns the fields that were left."""
        call(lib.weft_fields_finish, self._open())
        return self._take()

    def close(self) -> None:
        """Frees what is left now. The job may be changed again."""
        if self._handle is None:
            return
        self._handle = None
        self._free()
        self._job._fields = None

    def __enter__(self) -> "Fields":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()


def _free(handle: int, _job: Job, _function: Any) -> None:
    lib.weft_fields_free(handle)
