#!/usr/bin/env python3
"""Mitsuba 3 as a renderer of samples for weft: for every field, pictures at jittered instants, pushed as tiles.

  mitsuba.py SCENE.xml OUT.mov [--raster 1080i50] [--frames 100] [--instants 8] [--samples 32]

Written from the documentation of Mitsuba 3 (mi.load_file, mi.render, film, rfilter, shutter) and not run here.
The scene reads the time as a parameter: <default name="time" value="0"/>, in seconds, and uses it in its
<transform>s or in the names of files. Its film is an hdrfilm whose rfilter is a box,
so that a pixel's value is the mean over the pixel: <integer name="width" value="$width"/>,
<integer name="height" value="$height"/>, <rfilter type="box"/>. The camera's shutter stays closed to an
instant (shutter_open = shutter_close): weft averages over time.

A field of `--instants` pictures at `--samples` each has the noise of one frame at their product.
"""
import argparse
import random

import mitsuba as mi
import numpy as np

import weft


def picture(scene, seconds, width, height, samples, seed):
    """Scene-linear float32 [height][width][3] at an instant."""
    loaded = mi.load_file(scene, time=f"{seconds:.9f}", width=width, height=height)
    light = np.array(mi.render(loaded, spp=samples, seed=seed), dtype=np.float32)
    return np.ascontiguousarray(light[:, :, :3])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("output")
    parser.add_argument("--raster", default="1080i50")
    parser.add_argument("--frames", type=int, default=100)
    parser.add_argument("--instants", type=int, default=8)
    parser.add_argument("--samples", type=int, default=32)
    asked = parser.parse_args()
    mi.set_variant("llvm_ad_rgb")
    dice, tau = random.Random(1), 0.5
    with weft.Job(output=asked.output, raster=asked.raster, temporal_width=tau) as job:
        raster = job.raster
        period = float(1 / raster.rate / raster.fields_per_frame)
        size = (raster.width_px, 2 * raster.lines)  # two rows a line: apertures tell lines apart by them
        with weft.Fields(job, asked.frames) as fields:
            for n in range(asked.frames * raster.fields_per_frame):
                for i in range(asked.instants):
                    t = tau * (i + dice.random()) / asked.instants
                    light = picture(asked.scene, (n + t) * period, *size, asked.samples, n * asked.instants + i)
                    fields.push_tile(n, light, t=t)
                fields.until(n + 1)
            fields.finish()


if __name__ == "__main__":
    main()
