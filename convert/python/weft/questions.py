"""Each command of the program by a call: convert(), render(), measure() and so on."""
from __future__ import annotations

import ctypes
import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Mapping
from typing import Any, Optional, Union

import numpy as np

from . import _files
from ._library import Compare, Composite, Filters, Measure, Page, ProfileStruct, Verify, lib, library_path
from .clip import Clip, read
from .errors import Failed, UsageError, WeftError, call, whole_text
from .job import Job, Path, option_text
from .report import Report, Reports, wrap
from .tables import raster

Source = Union[Path, Clip, np.ndarray]


class _Folder:
    """A folder, in memory where there is some, for pictures that come as arrays."""

    def __init__(self) -> None:
        self._made = tempfile.TemporaryDirectory(
            prefix="weft-", dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
        self.name = self._made.name
        self._count = 0

    def __enter__(self) -> "_Folder":
        return self

    def __exit__(self, *_: Any) -> None:
        self._made.cleanup()

    def place(self, source: Source) -> Path:
        """The path of a file, or where an array or a clip is written."""
        if not isinstance(source, (Clip, np.ndarray)):
            return source
        self._count += 1
        name = os.path.join(self.name, f"frames{self._count}")
        if isinstance(source, Clip) and source.layout == "ycbcr":
            _files.write_y4m(name + ".y4m", source)
            return name + ".y4m"
        if isinstance(source, Clip):
            rgb = np.stack(source.planes, axis=-1)
        else:
            rgb = _light(source)
        display = isinstance(source, Clip) and source.layout == "rgb"
        for number, picture in enumerate(rgb):
            path = f"{name}.{number:06d}.{'png' if display else 'exr'}"
            if display:
                with open(path, "wb") as out:
                    out.write(_files.png(np.rint(65535 * np.clip(picture, 0, 1)).astype(np.uint16)))
            else:
                _files.write_exr(path, picture)
        return f"{name}.######.{'png' if display else 'exr'}"

    def strip(self, told: Any) -> Any:
        """A report that names what is in the folder without it."""
        if isinstance(told, dict):
            return {key: self.strip(value) for key, value in told.items()}
        if isinstance(told, list):
            return [self.strip(value) for value in told]
        return told.replace(self.name + "/", "") if isinstance(told, str) else told


def _light(frames: np.ndarray) -> np.ndarray:
    if frames.dtype.kind in "iu":
        raise UsageError(f"frames of {frames.dtype} are codes, and light is of floats, in which 1 is "
                         "white: decode them, or give the files that they are from")
    if frames.ndim != 4 or frames.shape[3] != 3 or not frames.size or frames.dtype.kind != "f":
        raise UsageError("frames are an array (frames, lines, width, 3) of scene-linear light, not "
                         f"{frames.shape} of {frames.dtype}")
    return frames.astype(np.float32)


def _split(structure: Any, options: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
    """A structure of what is asked, and the options that are the job's."""
    asked = structure(size=ctypes.sizeof(structure))
    names = [name for name, _ in structure._fields_[1:]]
    rest = {}
    for key, value in options.items():
        if key.rstrip("_") not in names:
            rest[key] = value
        elif value is not None:
            if isinstance(value, Mapping):
                value = [f"{one}={limit}" for one, limit in value.items()]
            setattr(asked, key.rstrip("_"), whole_text(os.fsencode(option_text(None, value) or "")))
    return asked, rest


def _ask(function: Any, structure: Any, inputs: tuple, options: dict[str, Any]) -> Any:
    """Asks about inputs; what was found goes with the error too, if there is one."""
    with _Folder() as folder:
        if isinstance(options.get("against"), (Clip, np.ndarray)):
            options["against"] = folder.place(options["against"])
        given = [source.raster for source in inputs if isinstance(source, Clip)]
        if given and structure:
            options.setdefault("raster", given[0])
        asked, rest = _split(structure, options) if structure else (None, options)
        with Job(*[folder.place(source) for source in inputs], **rest) as job:
            try:
                job.work(function, *([ctypes.byref(asked)] if structure else []))
            except WeftError as error:
                error.report = wrap(folder.strip(job.report))
                error.args = tuple(folder.strip(list(error.args)))
                raise
            return wrap(folder.strip(job.report))


def _made(work: Any, output: Optional[Path], folder: _Folder, job: Job) -> Any:
    """What a job has made: the report, or a Clip that has it where there is no output of the caller's."""
    if output is None:
        job.output = os.path.join(folder.name, "made.y4m")
    report = wrap(folder.strip(work()))
    if output is not None or not os.path.exists(os.path.join(folder.name, "made.y4m")):
        return report
    clip = read(os.path.join(folder.name, "made.y4m"))
    clip.raster = raster(report["raster"]["name"])
    clip.report = report
    return clip


def _run(command: str, inputs: tuple, output: Optional[Path], options: dict[str, Any]) -> Any:
    with _Folder() as folder, Job(*[folder.place(source) for source in inputs], output=output,
                                  command=command, **options) as job:
        return _made(job.run, output, folder, job)


# ---- What makes video ----

def convert(*inputs: Source, output: Optional[Path] = None, **options: Any) -> Any:
    """`weft convert`: subframes or sample buffers to interlaced video.

    Inputs are files, patterns or directories, or an array (subframes, lines, width, 3) of scene-linear
    light. Options are those of Job, of which progress and warning are functions. Without an output a
    Clip comes back, with one the report.

    >>> subframes = np.linspace(0, 1, 16)[:, None, None, None] * np.ones((16, 24, 36, 3))
    >>> clip = weft.convert(subframes, raster="36x24@30i,tff", subframe_rate=240)
    >>> clip
    Clip(2 frames of 36x24, 36x24@30i,tff, ycbcr 4:2:2, 10 bits)
    >>> clip.report["fields"]
    4
    """
    return _run("convert", inputs, output, options)


def render(scene: Path, output: Optional[Path] = None, **options: Any) -> Any:
    """`weft render`: a scene straight to interlaced video; a Clip without an output.

    >>> weft.render("scene.lua", raster="36x24@30i,tff", frames=0, samples=4)
    Clip(1 frame of 36x24, 36x24@30i,tff, ycbcr 4:2:2, 10 bits)
    """
    return _run("render", (scene,), output, options)


def trace(scene: Path, output: Path, **options: Any) -> Report:
    """`weft trace`: subframes or sample buffers of a scene.

    >>> weft.trace("scene.lua", "traced.####.exr", raster="36x24@30i,tff", frames=0, samples=2)["frames"]
    1
    """
    return _run("trace", (scene,), output, options)


def composite(source: Source, output: Optional[Path] = None, **options: Any) -> Any:
    """`weft composite`: what an NTSC or PAL television would show of video; a Clip without an output.

    Options are system, encoder, decoder, raster and audio, and of Job those of the output.

    >>> clip = weft.Clip([np.full((1, 486, 720), 0.5)] + 2 * [np.zeros((1, 486, 360))])
    >>> weft.composite(clip, decoder="comb3")
    Clip(1 frame of 720x486, 525i, ycbcr 4:2:2, 10 bits)
    """
    if isinstance(source, Clip):
        options.setdefault("raster", source.raster)
    asked, rest = _split(Composite, options)
    with _Folder() as folder, Job(folder.place(source), output=output, **rest) as job:
        def work() -> Any:
            job.work(lib.weft_job_composite, ctypes.byref(asked))
            return job.report
        return _made(work, output, folder, job)


# ---- What asks ----

def plan(format: str = "json", **options: Any) -> Any:
    """`weft plan`: which subframes a renderer has to make; a dict, or of other formats the text.

    >>> told = weft.plan(raster="1080i50", frames="0-1", subframe_rate=400)
    >>> told["raster"], len(told["subframes"])
    ('1080i50', 16)
    """
    with Job(**options) as job:
        return wrap(job.plan(format))


def measure(*files: Source, **options: Any) -> Any:
    """`weft measure`: figures of video, of one file a dict, of several a list of them.

    Files are paths, Clips, or arrays (frames, lines, width, 3) of scene-linear light. Options are
    raster, chart, display, view_distance, peak, against, heat, heatmap, and limit, which may be a dict:
    Failed is raised if a limit is exceeded, and its `report` has the figures all the same.

    >>> bars = np.zeros((1, 486, 720, 3)); bars[:, ::2] = 1
    >>> weft.measure(bars, raster="525i")["flicker"]["rms"]
    0.5
    >>> weft.measure(bars, raster="525i", limit={"flicker.rms": 0.1})
    Traceback (most recent call last):
    weft.errors.Failed: frames1.######.exr: flicker.rms is 0.5, and --limit allows no more than 0.1
    """
    return _ask(lib.weft_job_measure, Measure, files, options)


def verify(*files: Path, **options: Any) -> Reports:
    """`weft verify`: whether delivered files say and hold what a raster or profile demands.

    A list with a dict for each file, whose "right" says whether no check found it wrong: that is no
    error here. Options are profile (`weft.profiles()` lists them) and raster.

    >>> weft.render("scene.lua", output="small.y4m", raster="36x24@30i,tff", frames=0, samples=1)["frames"]
    1
    >>> [one["right"] for one in weft.verify("small.y4m")]
    [True]
    """
    try:
        return _ask(lib.weft_job_verify, Verify, files, options)
    except Failed as error:
        if isinstance(error.report, Reports):
            return error.report
        raise


def info(*files: Path) -> Any:
    """`weft info`: what files and sequences say of themselves, and what they would be taken for.

    >>> weft.plot({"x": {"low": 0, "high": 1}, "y": {"low": 0, "high": 1}, "items": []}, "empty.png")
    >>> weft.info("empty.png")["kind"]
    'picture'
    >>> weft.info("scene.lua")
    Traceback (most recent call last):
    weft.errors.Failed: scene.lua: it is text, which weft does not read; 'weft render IN' makes video of a scene
    """
    told = _ask(lib.weft_job_info, None, files, {})["files"]
    return Report(told[0]) if len(files) == 1 else Reports(Report(one) for one in told)


def filters(name: Optional[str] = None, **options: Any) -> Report:
    """`weft filters`: all apertures, or the responses of one.

    Options are input_lines, plot and frontier (PNG files that are written), raster, temporal_width.

    >>> [round(row["vertical"], 6) for row in weft.filters("line")["response"] if row["frequency"] == 0.5]
    [0.63662]
    >>> "shaped" in [one["name"] for one in weft.filters()["apertures"]]
    True
    """
    return _ask(lib.weft_job_filters, Filters, (), {"name": name, **options})


def page(*clips: Source, output: Optional[Path] = None, labels: Any = None, **options: Any) -> None:
    """`weft page`: one page of HTML that shows finished video field by field, or with preview a PNG of a
    frame.

    Clips are files or Clips, labels a list. Options are raster, frames, title, max_size, preview and
    preview_frame, and of Job overwrite, progress, warning and max_memory.

    >>> weft.render("scene.lua", output="shown.y4m", raster="36x24@30i,tff", frames="0-1", samples=1)["frames"]
    2
    >>> weft.page("shown.y4m", output="look.html", labels=["carousel"], raster="36x24@30i,tff")
    """
    if labels is not None:
        options["labels"] = labels if isinstance(labels, str) else "\n".join(labels)
    given = [clip.raster for clip in clips if isinstance(clip, Clip)]
    if given:
        options.setdefault("raster", given[0])
    asked, rest = _split(Page, options)
    with _Folder() as folder, Job(*[folder.place(clip) for clip in clips], output=output, **rest) as job:
        job.work(lib.weft_job_page, ctypes.byref(asked))


def compare(*inputs: Source, ways: Any, output: Path, title: Optional[str] = None, **options: Any) -> None:
    """`weft convert --compare`, and of a scene `weft render --compare`: one page of HTML that shows the same job
    done in several ways.

    Ways are a list of apertures and what is held with them, "line+limit=.06", or a text with commas. Options are
    those of Job, of which command says "render" of a scene.

    >>> weft.compare("scene.lua", ways=["box", "shaped"], output="ways.html", command="render",
    ...              raster="36x24@30i,tff", frames="0-1", samples=1)
    """
    asked = Compare(size=ctypes.sizeof(Compare))
    asked.ways = whole_text(os.fsencode(ways if isinstance(ways, str) else ",".join(ways)))
    asked.title = None if title is None else whole_text(os.fsencode(title))
    with _Folder() as folder, Job(*[folder.place(source) for source in inputs], output=output, **options) as job:
        job.work(lib.weft_job_compare, ctypes.byref(asked))


def plot(data: Union[Path, Mapping[str, Any]], output: Path) -> None:
    """`weft plot`: draws a JSON file, or what one would hold, as .svg or .png.

    >>> weft.plot({"x": {"low": 0, "high": 1}, "y": {"low": 0, "high": 1},
    ...            "items": [{"kind": "line", "points": [[0, 0], [1, 1]]}]}, "line.svg")
    """
    with _Folder() as folder:
        path = data
        if isinstance(data, Mapping):
            path = os.path.join(folder.name, "plot.json")
            with open(path, "w", encoding="utf-8") as out:
                json.dump(data, out)
        call(lib.weft_plot, os.fsencode(path), os.fsencode(output))


def profiles() -> Reports:
    """`weft verify --profiles`: the delivery profiles.

    >>> "xdcamhd422-1080i50" in [one["name"] for one in weft.profiles()]
    True
    """
    found = Reports()
    one = ProfileStruct(size=ctypes.sizeof(ProfileStruct))
    while lib.weft_profile_at(len(found), ctypes.byref(one)):
        found.append(Report((name, (getattr(one, name) or b"").decode() or None)
                            for name, _ in one._fields_[1:]))
    return found


# ---- What the program says of itself ----

def _program() -> str:
    """The path of the program that came with libweft: $WEFT, beside the library, or as a shell finds it."""
    library = os.path.dirname(os.path.realpath(library_path))
    beside = [os.path.join(library, *up, "weft") for up in ((), ("..", "bin"), ("..", "..", "bin"))]
    for path in [os.environ.get("WEFT"), *beside, shutil.which("weft")]:
        if path and os.path.isfile(path) and os.access(path, os.X_OK):
            return path
    raise Failed("the program weft is not found; install the package weft, or name it in $WEFT")


def _said(*words: str) -> str:
    done = subprocess.run([_program(), *words], stdin=subprocess.DEVNULL, capture_output=True, check=False, text=True)
    if done.returncode:
        error = UsageError if done.returncode == 2 else Failed
        raise error(done.stderr.strip().removeprefix("weft: ") or f"weft ended with status {done.returncode}")
    return done.stdout


def manual() -> str:
    """`weft manual`: the manual page, as troff formats it. Wants the program.

    >>> weft.manual().splitlines()[0].split()[:3]
    ['.TH', 'WEFT', '1']
    """
    return _said("manual")


def completion(shell: str) -> str:
    """`weft completion`: what bash, zsh or fish complete. Wants the program.

    >>> "weft" in weft.completion("bash")
    True
    """
    return _said("completion", shell)
