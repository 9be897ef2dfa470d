"""Hands samples and tiles to the Python package, for same_output.sh: the fields that come back are
written to fields.raw as floats; its tables, reports and mistakes are printed.
"""
import json
import warnings

import numpy as np

import weft

RASTER, WIDTH, LINES, EACH = "48x32@30i,tff", 48, 32, 8


def samples(rng, field):
    """x, y, t, rgb and weight of one field's samples."""
    cell = np.arange(EACH * WIDTH * LINES) // EACH
    x, y, t = cell % WIDTH + rng.random(cell.size), cell // WIDTH + rng.random(cell.size), rng.random(cell.size)
    light = np.where(np.hypot(x - 16 - field - t, y - 16) < 9, 0.9, 0.05)
    return x, y, t, light[:, None] * (1, 0.8, 0) + (0, 0, 0.3), 0.5 + rng.random(cell.size)


def push(out, frames=2, **options):
    rng = np.random.default_rng(1)
    tile = np.linspace(0, 1, 20 * 30 * 3, dtype=np.float32).reshape(20, 30, 3)
    with weft.Job(raster=RASTER, **options) as job, weft.Fields(job, frames) as fields:
        for n in range(2 * frames):
            x, y, t, rgb, weight = samples(rng, n)
            fields.push(n, x, y, t, rgb, **({"weight": weight} if n % 2 else {}))
            fields.push_tile(n, tile, (4, 3, 40, 20), t=0.25)
            tell(out, fields.until(n))
        tell(out, fields.finish())


def tell(out, fields):
    for field in fields or ():
        print("field", field.index, field.rgb.shape)
        out.write(np.ascontiguousarray(field.rgb).tobytes())


def attempt(what, *arguments, **options):
    try:
        print(what(*arguments, **options))
    except (weft.WeftError, TypeError, ValueError) as error:
        print(type(error).__name__, error)


def run(**options):
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        report = weft.Job("in/small", raster=RASTER, **options).run()
    print(*(str(w.message) for w in said), json.dumps(report), sep="\n")


with open("fields.raw", "wb") as raw:
    push(raw)
    push(raw, aperture="diamond", output="out.y4m")
run(output="job.y4m", aperture="box")
run(output="job.####.png", frames="0-7", dither="tpdf")
attempt(run, output="job.y4m")
attempt(weft.Job, rastr="525i")
attempt(weft.Job, raster="524i")
attempt(weft.Job("none.####.exr", output="none.y4m").run)
print(weft.__version__, weft.apertures(), weft.raster("625i-wide"), *weft.rasters(), *weft.options(), sep="\n")
for name in ("box", "notch", "shaped", "diamond", "mitchell:0,0.5"):
    print(name, *(repr(weft.aperture_response(name, fx=0.1 * k, fy=0.07 * k, ft=0.2 * k)) for k in range(6)))
