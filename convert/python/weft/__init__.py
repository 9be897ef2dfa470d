"""weft: oversampled progressive renders to interlaced broadcast video, from Python.

>>> import numpy as np, weft
>>> moving = np.linspace(0, 1, 16)[:, None, None, None] * np.ones((16, 24, 36, 3))
>>> clip = weft.convert(moving, raster="36x24@30i,tff", subframe_rate=240)
>>> clip.rgb().shape
(2, 24, 36, 3)
>>> weft.measure(clip)["frames"]
2

Each command of the program is a function: `convert`, `render`, `trace`, `plan`, `measure`, `verify`,
`info`, `filters`, `composite`, `page`, `plot`, `rasters`, `manual`, `completion`; `compare` makes a page of one job
done in several ways. Video comes and goes as files or as NumPy arrays, finished
video as a `Clip`; `read` makes one of a file. `Job` is one run with its progress and its canceling; `Fields`
takes samples from a renderer and hands back finished fields; `apertures`, `aperture_response`, `raster`,
`profiles` and `options` tell what there is. What goes wrong is a `weft.Error`, with the program's message.

libweft is looked for at $WEFT_LIBRARY, then beside this package in a build or an installation, then
where the system's loader looks.

Threads: libweft works without Python's lock, with as many threads as the option `threads` says.
Callbacks come in the thread that called, which holds the lock while they run. A Job or Fields is
used by one thread at a time; different ones are independent.
"""
from ._version import VERSION as __version__
from ._library import library_path
from .clip import Clip, read
from .errors import (Canceled, Error, Failed, NoMemory, UsageError, WeftError, WeftWarning)
from .fields import Field, Fields
from .job import Job, Progress, jobs_in
from .questions import (compare, completion, composite, convert, filters, info, manual, measure, page, plan, plot,
                        profiles, render, trace, verify)
from .report import Report, Reports
from .tables import (Option, Raster, aperture_response, apertures, options, raster, rasters)

__all__ = ["Canceled", "Clip", "Error", "Failed", "Field", "Fields", "Job", "NoMemory", "Option", "Progress",
           "Raster", "Report", "Reports", "UsageError", "WeftError", "WeftWarning", "aperture_response",
           "apertures", "compare", "completion", "composite", "convert", "filters", "info", "jobs_in", "library_path", "manual", "measure", "options",
           "page", "plan", "plot", "profiles", "raster", "rasters", "read", "render", "trace", "verify"]
