"""Conversions as the command line has them."""
from __future__ import annotations

import ctypes
import json
import math
import operator
import os
import sys
import warnings
import weakref
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any, Optional, Union

from ._interrupt import CancelOnInterrupt
from ._library import PRINT_FN, PROGRESS_FN, WARNING_FN, lib
from .errors import DEGRADED, INTERRUPTED, Canceled, NoMemory, UsageError, WeftWarning, call
from .tables import Option, Raster, options, raster

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Progress:
    """How far a run is."""

    frames_done: int
    frames_total: int
    seconds: float  #: since the run began
    stage: str  #: what the job does
    frame_part: float = 0.0  #: of the frame that is being made, 0 to 1
    frames_made: float = 0.0  #: frames_done, and parts of all frames that are being made together


class Calls:
    """The Python functions of a handle. What one of them raises waits here until libweft is back,
    since nothing may be raised through it; until then no function is called any more."""

    def __init__(self):
        self.raised: Optional[BaseException] = None

    def guard(self, function: Callable, *arguments) -> None:
        if self.raised is not None:
            return
        try:
            function(*arguments)
        except BaseException as error:  # KeyboardInterrupt as well
            self.raised = error

    def release(self) -> None:
        """Raises what waits."""
        raised, self.raised = self.raised, None
        if raised is not None:
            raise raised


def option_text(option: Optional[Option], value: Any) -> Optional[str]:
    """A value as the command line would write it; None for a flag that is set."""
    if isinstance(value, bool):
        if option is not None and option.takes is not None:
            return "on" if value else "off"
        return None
    if isinstance(value, Raster):
        return value.name
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, Fraction):
        return f"{value.numerator}/{value.denominator}"
    if isinstance(value, float) and math.isfinite(value):
        return format(Decimal(repr(float(value))), "f")  # without an exponent
    if isinstance(value, (list, tuple)):
        return ",".join(option_text(option, part) or "" for part in value)
    return str(value)


class Job:
    """One run of weft: inputs, an output and options.

    Job(*inputs, output=None, command="convert", progress=None, warning=None, **options)

    Inputs are files, patterns ("shot.####.exr") or directories; command is "convert", "render" or
    "trace". Options are those of the command line, with underscores for dashes and a last one where
    Python reserves the word: Job("in.####.exr", output="out.y4m", subframe_rate="480000/1001",
    from_="ACEScg", overwrite=True, background=(0, 0, 0)). `weft.options()` lists them. A mapping
    stands for an option that is given once for each entry: set={"rpm": 75}.

    progress(Progress) is called between frames and within long ones, warning(str) for messages that do not stop the job;
    without it they are warnings of the category WeftWarning. What either raises ends the run and
    comes out of `run`. What a scene prints goes to sys.stderr.

    A Job is freed with its last reference, or at the end of a `with` statement.
    """

    def __init__(self, *inputs: Path, output: Optional[Path] = None, command: str = "convert",
                 progress: Optional[Callable[[Progress], None]] = None,
                 warning: Optional[Callable[[str], None]] = None, **options_: Any):
        handle = lib.weft_job_new()
        if not handle:
            raise NoMemory("no memory for a job")
        self._handle: Optional[int] = handle
        self._free = weakref.finalize(self, lib.weft_job_free, handle)
        self._calls = calls = Calls()
        self._busy = False
        self._fields: Optional[Callable[[], Any]] = None  # reference to the Fields that are open
        self._raster: Raster = raster("525i")
        self._output: Optional[str] = None
        #: whether the last run was degraded: frames held, samples mended
        self.degraded = False
        self._listen(handle, calls, progress, warning)
        if command != "convert":
            call(lib.weft_job_set_command, handle, os.fsencode(command))
        for path in inputs:
            self.add_input(path)
        if output is not None:
            self.output = output
        for name, value in options_.items():
            self.set(name, value)

    def _listen(self, handle, calls, progress, warning) -> None:
        def tell_progress(pointer, _user):
            p = pointer.contents
            told = Progress(p.frames_done, p.frames_total, p.seconds, (p.stage or b"").decode(),
                            p.frame_part, p.frames_made)
            calls.guard(progress, told)
            if calls.raised is not None:
                lib.weft_job_cancel(handle)

        def tell_warning(text, _user):
            calls.guard(warning or (lambda said: warnings.warn(said, WeftWarning, stacklevel=5)),
                        text.decode("utf-8", "replace"))
            if calls.raised is not None:
                lib.weft_job_cancel(handle)

        def tell_print(line, _user):
            calls.guard(lambda text: print(text, file=sys.stderr), line.decode("utf-8", "replace"))

        # Kept for as long as libweft may call them.
        self._functions = (PROGRESS_FN(tell_progress), WARNING_FN(tell_warning),
                           PRINT_FN(tell_print))
        if progress is not None:
            lib.weft_job_on_progress(handle, self._functions[0], None)
        lib.weft_job_on_warning(handle, self._functions[1], None)
        lib.weft_job_on_print(handle, self._functions[2], None)

    # ---- What it is to do ----

    def _idle(self) -> int:
        """The handle, for changes."""
        if self._handle is None:
            raise UsageError("this job is closed")
        if self._busy:
            raise UsageError("this job is running")
        if self._fields is not None and self._fields() is not None:
            raise UsageError("this job belongs to Fields that are open; close them first")
        return self._handle

    def add_input(self, path: Path) -> None:
        """Adds a file, a pattern or a directory; to render and trace, one scene."""
        call(lib.weft_job_add_input, self._idle(), os.fsencode(path))

    @property
    def output(self) -> Optional[str]:
        """Where the video goes; None: nowhere."""
        return self._output

    @output.setter
    def output(self, path: Path) -> None:
        call(lib.weft_job_set_output, self._idle(), os.fsencode(path))
        self._output = os.fspath(path)

    @property
    def raster(self) -> Raster:
        """What the option raster says."""
        return self._raster

    def set(self, name: str, value: Any = True) -> None:
        """Sets an option. Flags take True or False, of which False changes nothing; numbers may be
        Fractions; lists are joined with commas; None changes nothing."""
        if value is None:
            return
        if isinstance(value, Mapping):
            for key, one in value.items():
                self.set(name, f"{key}={option_text(None, one)}")
            return
        name = name.rstrip("_").replace("_", "-")
        option = next((o for o in options() if o.name == name), None)
        text = option_text(option, value)
        if text is None and value is False:
            return
        call(lib.weft_job_set, self._idle(), os.fsencode(name),
             None if text is None else os.fsencode(text))
        if name == "raster":
            self._raster = raster(text)

    def load(self, path: Path, number: int = 0) -> None:
        """Sets what a job file says (JSON; see `weft convert --help`). Paths in it are relative to its
        folder; what is set later wins. Of a file with a list of jobs (`weft.jobs_in`) number says which,
        from 1. UsageError names file, line and column, after which the job is good for nothing but
        `close`.

        >>> import json
        >>> shots = [{"inputs": "scene.lua", "output": f"shot{n}.y4m", "frames": n} for n in (0, 1)]
        >>> with open("list.json", "w") as out:
        ...     json.dump({"raster": "36x24@30i,tff", "samples": 1, "command": "render", "jobs": shots}, out)
        >>> for number in range(1, weft.jobs_in("list.json") + 1):
        ...     job = weft.Job()
        ...     job.load("list.json", number)
        ...     print(job.output, job.run()["frames"])
        shot0.y4m 1
        shot1.y4m 1
        """
        if os.fspath(path) == "-":
            raise UsageError("a job is loaded from a file here, not from standard input")
        number = operator.index(number)
        if not 0 <= number < 2**63:
            raise UsageError(f"there is no job {number}; the first of a list is 1")
        call(lib.weft_job_load_nth, self._idle(), os.fsencode(path), number)
        with open(path, encoding="utf-8-sig") as file:
            said = json.load(file)
        if number:
            shared, jobs = ({}, said) if isinstance(said, list) else (said, said["jobs"])
            said = {**shared, **jobs[number - 1]}
        if "raster" in said:
            self._raster = raster(said["raster"])
        if "output" in said:
            self._output = os.path.join(os.path.dirname(os.fspath(path)), said["output"])

    # ---- Running ----

    def run(self) -> dict[str, Any]:
        """Runs the job to its end and returns the report (`weft convert --report`).

        A run in which frames were held or samples mended is no failure: `degraded` and
        report["degraded"] say so. Failures are raised as WeftError, with no file at the output's
        name that was not there before; so is Canceled. Ctrl-C ends the run soon and leaves as
        KeyboardInterrupt. A job that was canceled does not run again.
        """
        self.degraded = self.work(lib.weft_job_run) == DEGRADED
        return self.report

    def work(self, function: Any, *arguments: Any) -> int:
        """Calls a function of libweft that works for long, with the job; what run() says of failures,
        functions that raise and Ctrl-C holds."""
        handle = self._idle()
        self._busy, self.degraded = True, False
        interrupt = CancelOnInterrupt(handle)
        try:
            with interrupt:
                status = call(function, handle, *arguments)
        except Canceled:
            # By a function that raised, or by Ctrl-C, which Python may have told to one already.
            if self._calls.raised is None:
                if interrupt.came:
                    raise KeyboardInterrupt from None
                raise
            status = INTERRUPTED
        except BaseException:
            self._calls.raised = None
            raise
        finally:
            self._busy = False
        self._calls.release()
        return status

    def plan(self, format: str = "json") -> Any:
        """What a renderer has to make for these options, before there is any of it: `weft plan`.

        Job(raster="1080i50", frames="0-99", subframe_rate=400).plan() is the dict of its JSON; of
        other formats the text comes back.
        """
        text = ctypes.c_char_p()
        call(lib.weft_job_plan, self._idle(), os.fsencode(format), ctypes.byref(text))
        self._calls.release()
        told = (text.value or b"").decode()
        return json.loads(told) if format == "json" else told

    def cancel(self) -> None:
        """Asks a running job to stop soon. From any thread."""
        if self._handle is not None:
            lib.weft_job_cancel(self._handle)

    @property
    def report(self) -> dict[str, Any]:
        """The report of the last run, also of one that failed; {} before."""
        if self._handle is None:
            raise UsageError("this job is closed")
        return json.loads(lib.weft_job_report(self._handle))

    # ---- Life ----

    def close(self) -> None:
        """Frees the job now. It cannot be used any more."""
        if self._handle is None:
            return
        self._idle()
        self._handle = None
        self._free()

    def __enter__(self) -> "Job":
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()


def jobs_in(path: Path) -> int:
    """How many jobs a job file holds as a list; 0 of a file that is one job."""
    count = ctypes.c_size_t()
    call(lib.weft_jobs_in, os.fsencode(path), ctypes.byref(count))
    return count.value
