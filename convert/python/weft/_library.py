"""libweft itself: where it is, its structures and its functions as weft.h declares them."""
from __future__ import annotations

import ctypes
import os
from ctypes import (CFUNCTYPE, POINTER, c_bool, c_char, c_char_p, c_double, c_float, c_int, c_int64,
                    c_size_t, c_void_p)
from pathlib import Path

from ._version import VERSION

FLOATS = POINTER(c_float)
SONAME = "libweft.so." + VERSION.split(".", maxsplit=1)[0]


# ---- Structures: names and order of the members are those of weft.h ----

class Error(ctypes.Structure):
    _fields_ = [("text", c_char * 1024)]


class ProgressStruct(ctypes.Structure):
    _fields_ = [("frames_done", c_int64), ("frames_total", c_int64), ("seconds", c_double),
                ("stage", c_char_p), ("frame_part", c_double), ("frames_made", c_double)]


class Samples(ctypes.Structure):
    _fields_ = [("count", c_size_t), ("x", FLOATS), ("y", FLOATS), ("t", FLOATS), ("field", c_int64),
                ("red", FLOATS), ("green", FLOATS), ("blue", FLOATS), ("weight", FLOATS),
                ("alpha", FLOATS)]


class Tile(ctypes.Structure):
    _fields_ = [("x0", c_double), ("y0", c_double), ("x1", c_double), ("y1", c_double),
                ("t", c_double), ("field", c_int64), ("width", c_int), ("height", c_int),
                ("rgb", FLOATS), ("alpha", FLOATS)]


class FieldStruct(ctypes.Structure):
    _fields_ = [("index", c_int64), ("first_line", c_int), ("line_step", c_int), ("lines", c_int),
                ("width_px", c_int), ("rgb", FLOATS), ("alpha", FLOATS)]


class OptionStruct(ctypes.Structure):
    _fields_ = [("name", c_char_p), ("takes", c_char_p), ("preset", c_char_p), ("help", c_char_p),
                ("group", c_char_p)]


class RasterStruct(ctypes.Structure):
    _fields_ = [("name", c_char * 64), ("width_px", c_int), ("lines", c_int), ("rate_num", c_int64),
                ("rate_den", c_int64), ("interlaced", c_bool), ("segmented", c_bool),
                ("top_first", c_bool), ("pixel_aspect_num", c_int64), ("pixel_aspect_den", c_int64),
                ("matrix", c_char_p), ("line1", c_int), ("line2", c_int), ("total_lines", c_int)]


def _asked(*names):
    """A structure that can grow: its size, then texts."""
    class Asked(ctypes.Structure):
        _fields_ = [("size", c_size_t)] + [(name, c_char_p) for name in names]
    return Asked


ProfileStruct = _asked("name", "about", "rasters", "not_checked")
Measure = _asked("raster", "chart", "display", "view_distance", "peak", "against", "limit", "heatmap",
                 "heat")
Verify = _asked("profile", "raster")
Filters = _asked("name", "input_lines", "plot", "frontier")
Composite = _asked("system", "encoder", "decoder", "raster", "audio")
Compare = _asked("ways", "title")
Page = _asked("raster", "frames", "title", "max_size", "labels", "preview", "preview_frame")

class VideoInfo(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("format", c_char_p), ("layout", c_char_p), ("width_px", c_int),
                ("lines", c_int), ("bits", c_int), ("across", c_int), ("down", c_int),
                ("full_range", c_bool), ("scan_known", c_bool), ("frames", c_int64),
                ("raster", RasterStruct)]


class Picture(ctypes.Structure):
    _fields_ = [("size", c_size_t), ("index", c_int64), ("plane", FLOATS * 3),
                ("width_px", c_int * 3), ("lines", c_int * 3)]


STRUCTURES = {"weft_error": Error, "weft_progress": ProgressStruct, "weft_samples": Samples,
              "weft_tile": Tile, "weft_field": FieldStruct, "weft_option": OptionStruct,
              "weft_raster": RasterStruct, "weft_profile": ProfileStruct, "weft_measure": Measure,
              "weft_verify": Verify, "weft_filters": Filters, "weft_composite": Composite, "weft_page": Page,
              "weft_compare": Compare,
              "weft_video_info": VideoInfo, "weft_picture": Picture}

# ---- Functions ----

PROGRESS_FN = CFUNCTYPE(None, POINTER(ProgressStruct), c_void_p)
WARNING_FN = CFUNCTYPE(None, c_char_p, c_void_p)
PRINT_FN = CFUNCTYPE(None, c_char_p, c_void_p)
FIELD_FN = CFUNCTYPE(None, POINTER(FieldStruct), c_void_p)

_STATUS, _HANDLE, _ERROR = c_int, c_void_p, POINTER(Error)
FUNCTIONS = {
    "weft_version": (c_char_p,),
    "weft_job_new": (_HANDLE,),
    "weft_job_free": (None, _HANDLE),
    "weft_job_set_command": (_STATUS, _HANDLE, c_char_p, _ERROR),
    "weft_job_add_input": (_STATUS, _HANDLE, c_char_p, _ERROR),
    "weft_job_set_output": (_STATUS, _HANDLE, c_char_p, _ERROR),
    "weft_job_set": (_STATUS, _HANDLE, c_char_p, c_char_p, _ERROR),
    "weft_job_load": (_STATUS, _HANDLE, c_char_p, _ERROR),
    "weft_jobs_in": (_STATUS, c_char_p, POINTER(c_size_t), _ERROR),
    "weft_job_load_nth": (_STATUS, _HANDLE, c_char_p, c_size_t, _ERROR),
    "weft_job_on_progress": (None, _HANDLE, PROGRESS_FN, c_void_p),
    "weft_job_on_warning": (None, _HANDLE, WARNING_FN, c_void_p),
    "weft_job_on_print": (None, _HANDLE, PRINT_FN, c_void_p),
    "weft_job_run": (_STATUS, _HANDLE, _ERROR),
    "weft_job_cancel": (None, _HANDLE),
    "weft_job_report": (c_char_p, _HANDLE),
    "weft_job_plan": (_STATUS, _HANDLE, c_char_p, POINTER(c_char_p), _ERROR),
    "weft_job_measure": (_STATUS, _HANDLE, POINTER(Measure), _ERROR),
    "weft_job_verify": (_STATUS, _HANDLE, POINTER(Verify), _ERROR),
    "weft_profile_at": (c_bool, c_size_t, POINTER(ProfileStruct)),
    "weft_job_info": (_STATUS, _HANDLE, _ERROR),
    "weft_job_filters": (_STATUS, _HANDLE, POINTER(Filters), _ERROR),
    "weft_job_composite": (_STATUS, _HANDLE, POINTER(Composite), _ERROR),
    "weft_job_page": (_STATUS, _HANDLE, POINTER(Page), _ERROR),
    "weft_job_compare": (_STATUS, _HANDLE, POINTER(Compare), _ERROR),
    "weft_plot": (_STATUS, c_char_p, c_char_p, _ERROR),
    "weft_fields_new": (_STATUS, _HANDLE, c_int64, FIELD_FN, c_void_p, POINTER(_HANDLE), _ERROR),
    "weft_fields_free": (None, _HANDLE),
    "weft_fields_push": (_STATUS, _HANDLE, POINTER(Samples), _ERROR),
    "weft_fields_push_tile": (_STATUS, _HANDLE, POINTER(Tile), _ERROR),
    "weft_fields_until": (_STATUS, _HANDLE, c_int64, _ERROR),
    "weft_fields_finish": (_STATUS, _HANDLE, _ERROR),
    "weft_option_at": (c_bool, c_size_t, POINTER(OptionStruct)),
    "weft_aperture_name": (c_char_p, c_size_t),
    "weft_aperture_response": (_STATUS, c_char_p, c_double, c_double, c_double, c_double,
                               POINTER(c_double), _ERROR),
    "weft_video_open": (_STATUS, c_char_p, c_char_p, POINTER(_HANDLE), _ERROR),
    "weft_video_close": (None, _HANDLE),
    "weft_video_tell": (None, _HANDLE, POINTER(VideoInfo)),
    "weft_video_next": (_STATUS, _HANDLE, POINTER(Picture), _ERROR),
    "weft_raster_at": (c_bool, c_size_t, POINTER(RasterStruct)),
    "weft_raster_parse": (_STATUS, c_char_p, POINTER(RasterStruct), _ERROR),
}

# ---- Finding and loading ----


def _candidates():
    """Where libweft may be, best first."""
    named = os.environ.get("WEFT_LIBRARY")
    if named:
        yield named
        return
    # PREFIX/lib/python3/dist-packages/weft in an installation, and so in the build directory.
    for directory in list(Path(__file__).absolute().parents)[1:5]:
        for pattern in (SONAME, "lib/" + SONAME, "lib/*/" + SONAME):
            yield from sorted(str(path) for path in directory.glob(pattern))
    yield SONAME


def _load():
    tried = []
    for path in _candidates():
        try:
            return ctypes.CDLL(path), path
        except OSError as error:
            tried.append(str(error))
    raise ImportError("libweft cannot be loaded (" + "; ".join(tried)
                      + "); set WEFT_LIBRARY to the path of " + SONAME)


def _declare(loaded, path):
    for name, (result, *arguments) in FUNCTIONS.items():
        try:
            function = getattr(loaded, name)
        except AttributeError:
            raise ImportError(f"{path} has no {name}: it is not version {VERSION}") from None
        function.restype, function.argtypes = result, arguments
    version = loaded.weft_version().decode()
    if version != VERSION:
        raise ImportError(f"{path} is version {version}, this package is for {VERSION}")


lib, library_path = _load()
_declare(lib, library_path)
