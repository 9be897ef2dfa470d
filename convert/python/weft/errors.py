"""What goes wrong, by weft_status."""
from __future__ import annotations

import ctypes
from typing import Any

from ._library import Error as _ErrorStruct

OK, FAILED, USAGE, DEGRADED, NO_MEMORY, INTERRUPTED = range(6)


class WeftError(Exception):
    """What libweft said: what was wrong, with which file, frame or line, and what would be right.

    `status` is the number of the weft_status.
    """

    status = FAILED
    #: of calls that ask about files, what was found all the same; else None
    report: Any = None


Error = WeftError


class Failed(WeftError):
    """An input or output is at fault."""


class UsageError(WeftError, ValueError):
    """The request makes no sense."""

    status = USAGE


class NoMemory(WeftError, MemoryError):
    """An allocation failed, or the option max_memory would not do."""

    status = NO_MEMORY


class Canceled(WeftError):
    """`Job.cancel` was called; nothing half-written is left."""

    status = INTERRUPTED


class WeftWarning(UserWarning):
    """A message that does not stop a job, where the job has no warning callback."""


_KINDS = {kind.status: kind for kind in (Failed, UsageError, NoMemory, Canceled)}


def check(status: int, error: _ErrorStruct) -> int:
    """Raises what a status that is a failure stands for; returns OK or DEGRADED."""
    if status in (OK, DEGRADED):
        return status
    text = error.text.decode("utf-8", "replace") or "libweft gave no reason"
    raise _KINDS.get(status, WeftError)(text)


def int64(value: int) -> int:
    """The value, which libweft can hold; ctypes would drop its upper bits without a word."""
    if not -2**63 <= value < 2**63:
        raise UsageError(f"{value} is beyond 64 bits; give a smaller number")
    return value


def whole_text(value: bytes) -> bytes:
    """The value, all of which libweft gets: text ends at a NUL byte there."""
    if b"\0" in value:
        raise UsageError(f"{value!r} has a NUL byte, at which text ends; leave it out")
    return value


def _check_argument(kind, value) -> None:
    if kind is ctypes.c_char_p and isinstance(value, bytes):
        whole_text(value)
    if kind is ctypes.c_int64 and isinstance(value, int):
        int64(value)


def call(function, *arguments) -> int:
    """Calls a function of libweft that returns a weft_status and takes a weft_error last."""
    error = _ErrorStruct()
    for kind, value in zip(function.argtypes, arguments):
        _check_argument(kind, value)
    return check(function(*arguments, ctypes.byref(error)), error)
