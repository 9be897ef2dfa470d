"""weft: oversampled progressive renders to interlaced broadcast video, from Python.

>>> import weft
>>> report = weft.Job("shot.####.exr", output="shot.y4m", subframe_rate=240).run()
>>> report["frames"]
48

`Job` is one run of the program; `Fields` takes samples from a renderer as NumPy arrays and hands
back finished fields; `apertures`, `aperture_response`, `rasters`, `raster` and `options` tell what
there is. What goes wrong is a `WeftError`.

libweft is looked for at $WEFT_LIBRARY, then beside this package in a build or an installation, then
where the system's loader looks.

Threads: libweft works without Python's lock, with as many threads as the option `threads` says.
Callbacks come in the thread that called, which holds the lock while they run. A Job or Fields is
used by one thread at a time; different ones are independent.
"""
from ._version import VERSION as __version__
from ._library import library_path
from .errors import (Canceled, Failed, NoMemory, UsageError, WeftError, WeftWarning)
from .fields import Field, Fields
from .job import Job, Progress
from .tables import (Option, Raster, aperture_response, apertures, options, raster, rasters)

__all__ = ["Canceled", "Failed", "Field", "Fields", "Job", "NoMemory", "Option", "Progress", "Raster",
           "UsageError", "WeftError", "WeftWarning", "aperture_response", "apertures",
           "library_path", "options", "raster", "rasters"]
