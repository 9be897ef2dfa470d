#!/usr/bin/env python3
"""A renderer in few lines that hands its samples to weft as NumPy arrays, field by field: a ring
that grows, drawn at random places and times. Nothing is stored but the video; the fields come back
as arrays too, here to say how bright each is.

  push_samples.py out.y4m [FRAMES]
"""
import sys

import numpy as np

import weft

EACH = 8  # samples a pixel and field


def render(rng, field, raster):
    """x, y, t and rgb of one field's samples."""
    count = EACH * raster.width_px * raster.lines
    cell = np.arange(count) // EACH
    x = cell % raster.width_px + rng.random(count)
    y = cell // raster.width_px + rng.random(count)
    t = 0.5 * rng.random(count)  # the box looks for half a field period
    across = (x - raster.width_px / 2) * float(raster.pixel_aspect)
    radius = np.hypot(across, y - raster.lines / 2) - 4 * (field + t)
    light = np.where(np.abs(radius - 60) < 12, 0.9, 0.05)
    return x, y, t, light[:, None] * (1, 0.8, 0) + (0, 0, 0.3)


def main(output, frames=15):
    rng = np.random.default_rng(1)
    with weft.Job(output=output, raster="525i", aperture="box") as job, weft.Fields(job, frames) as fields:
        for n in range(frames * job.raster.fields_per_frame):
            fields.push(n, *render(rng, n, job.raster))
            for field in fields.until(n + 1):  # all before the next instant is there
                print(f"field {field.index}: mean {field.rgb.mean():.4f}")
        fields.finish()


try:
    main(sys.argv[1], *map(int, sys.argv[2:]))
except weft.WeftError as error:
    sys.exit(f"push_samples.py: {error}")
