#!/usr/bin/env python3
"""Flicker against sharpness: every named aperture, and weighed and bounded flicker, on pictures.

    tests/bench/frontier.py BUILD [--scenes a,b] [--out DIR] [--samples 36]
    tests/bench/frontier.py BUILD --plot lettering [--out DIR]

Frame 0 of each scene stands still on 525 lines, taken through `line` and each aperture at one instant. Of each
picture: the RMS and the 99.9th percentile of its flicker as `weft measure` has it, and d, the RMS distance of
its luminance from that of `line`: what sharpness it cost. Beside each aperture stand `least` of equal flicker,
whose distance is the least there can be, and the weight and limit that have no more flicker and no more distance
and the lowest 99.9th percentile. Reads with numpy.
"""
import argparse
import csv
import json
import math
import os
import struct
import subprocess
import sys
import zlib

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../../examples/scenes"))
from before_after import flicker, rms  # noqa: E402
RASTER = "720x486@30000/1001psf,bff,par=10:11,601-525"
FOLDERS = ("flicker", "scenes", "../../examples/scenes", "../../examples/paper")
SCENES = ("still", "panorama", "carousel", "slow_edges", "wheel", "lettering", "credits", "siding", "branches",
          "scoreboard", "fence", "far_checker", "stars")
BESIDE = ("box", "shaped", "calm")
ASKED = {"box": 0.7, "shaped": 0.85, "calm": 0.85}  # of their 99.9th percentile
KERNELS = ("line", "box", "notch", "shaped", "crisp", "calm", "mitchell:1/3,1/3")


def scene_file(name):
    for folder in FOLDERS:
        path = os.path.join(HERE, folder, name + ".lua")
        if os.path.exists(path):
            return path
    sys.exit(f"frontier.py: there is no scene {name}")


# ---- Pictures ----

def text_of(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header(data):
    """The attributes of an EXR file, and where they end."""
    found, at = {}, 8
    while data[at]:
        name, at = text_of(data, at)
        _, at = text_of(data, at)
        size, = struct.unpack_from("<i", data, at)
        found[name], at = data[at + 4:at + 4 + size], at + 4 + size
    return found, at + 1


def unzip(block, size):
    """A chunk of ZIP, its two interleaved halves and differences undone."""
    if len(block) == size:
        return np.frombuffer(block, np.uint8)
    raw = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    raw[1:] -= 128
    raw = (np.cumsum(raw) & 255).astype(np.uint8)
    out, half = np.empty(size, np.uint8), (size + 1) // 2
    out[0::2], out[1::2] = raw[:half], raw[half:]
    return out


def luminance(path):
    """Rec. 709 luminance of an EXR of float R, G, B that weft wrote: [lines][pixels]."""
    with open(path, "rb") as file:
        data = file.read()
    found, at = header(data)
    x0, y0, x1, y1 = struct.unpack("<4i", found["dataWindow"])
    width, lines, names, c = x1 - x0 + 1, y1 - y0 + 1, [], 0
    while found["channels"][c]:
        name, c = text_of(found["channels"], c)
        names.append(name)
        c += 16
    picture = np.empty((lines, len(names), width), np.float32)
    for offset in struct.unpack_from(f"<{(lines + 15) // 16}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        rows = min(16, lines - (y - y0))
        block = unzip(data[offset + 8:offset + 8 + size], rows * len(names) * width * 4)
        picture[y - y0:y - y0 + rows] = block.view("<f4").reshape(rows, len(names), width)
    weights = {"R": 0.2126390058715103, "G": 0.7151686787677559, "B": 0.0721923153607337}
    return sum(picture[:, names.index(name), :].astype(float) * w for name, w in weights.items())


class Figures:
    """What a picture measures."""

    def __init__(self, light, sharp):
        seen = flicker(light)
        self.rms, self.p999 = rms(seen), float(np.quantile(seen, 0.999))
        self.d = rms(light - sharp)
        self.peak = float(seen.max())


# ---- Scenes ----

class Still:
    """A scene's frame 0, and what weft makes of it."""

    def __init__(self, options, name):
        self.weft, self.out = os.path.join(options.build, "weft"), options.out
        self.name, self.kept, self.runs = name, {}, 0
        self.job = ["render", scene_file(name), "--frames", "0", "--temporal-width", "0", "--samples",
                    str(options.samples)]
        self.sharp_path = self.run(self.job, "line", "--aperture", "line")
        self.sharp = luminance(self.sharp_path)

    def run(self, job, name, *words):
        path = os.path.join(self.out, f"{self.name}-{name}")
        ran = subprocess.run([self.weft, *job, "--raster", RASTER, *map(str, words), "-q", "--overwrite", "-o",
                              path + ".#.exr"], capture_output=True, text=True)
        if ran.returncode:
            sys.exit(f"{self.name}, {' '.join(map(str, words))}: {ran.stderr}")
        self.runs += 1
        return path + ".0000.exr"

    def kernel(self, aperture):
        if aperture not in self.kept:
            path = self.run(self.job, "kernel", "--aperture", aperture)
            self.kept[aperture] = Figures(luminance(path), self.sharp)
            self.hold(path, self.kept[aperture])
        return self.kept[aperture]

    def hold(self, path, mine):
        """What is reckoned here has to be what `weft measure` says."""
        said = json.loads(subprocess.run([self.weft, "measure", path, "--json"], capture_output=True, text=True,
                                         check=True).stdout)
        said = said[0] if isinstance(said, list) else said
        for key in ("rms", "p999"):
            theirs, ours = said["flicker"][key], getattr(mine, key)
            if abs(theirs - ours) > 1e-2 * ours + 1e-5:
                sys.exit(f"{self.name}: flicker {key} is {ours:.6f} here and {theirs:.6f} by weft measure")

    def least(self, weight, limit=math.inf):
        """The nearest picture to `line` whose flicker is weighed and bounded."""
        key = (weight, limit)
        if key not in self.kept:
            bound = ["--flicker-limit", f"{limit:.6g}"] if limit < math.inf else []
            job = ["convert", self.sharp_path, "--subframe-rate", "30000/1001", "--aperture", "line",
                   "--temporal-width", "0", "--timecode", "00:00:00:00"]
            path = self.run(job, "least", "--flicker-weight", f"{weight:.6g}", *bound)
            self.kept[key] = Figures(luminance(path), self.sharp)
        return self.kept[key]

    def weight_of(self, rms, limit=math.inf, steps=9):
        """The smallest weight whose flicker is at most rms, to a thousandth of its logarithm."""
        low, high = 0.0, 1.0
        if self.least(0.0, limit).rms <= rms:
            return 0.0
        while self.least(high, limit).rms > rms and high < 1e4:
            low, high = high, 4 * high
        for _ in range(steps):
            middle = (low + high) / 2 if low == 0 else math.sqrt(low * high)
            if self.least(middle, limit).rms > rms:
                low = middle
            else:
                high = middle
        return high

    def lowest_limit(self, beside, steps=11):
        """The smallest limit for which a weight has flicker and distance no worse: (limit, weight). Of the weights that
        have no more flicker the smallest is the nearest."""
        low, high, best = 0.2 * beside.p999, beside.peak, None
        for step in range(steps):
            limit = math.sqrt(low * high)
            weight = self.weight_of(beside.rms, limit, 7 if step < 6 else 11)
            if self.least(weight, limit).d <= beside.d:
                high, best = limit, (limit, weight)
            else:
                low = limit
        return best


def least_distance(nearest, weight, flicker_rms):
    """What no picture of that flicker is nearer than: d^2 + MU (rms^2 - R^2), the dual's value at the weight MU, is at
    most d^2 of every picture whose flicker's RMS is R or less, whatever the weight, for the program is convex."""
    return math.sqrt(max(nearest.d**2 + weight * (nearest.rms**2 - flicker_rms**2), 0))


def out_of_reach(still, kernel, asked):
    """What distance, over the aperture's, no picture goes below whose flicker is nowhere above the share `asked` of the
    aperture's 99.9th percentile and has no more RMS: above 1 there is none that is no worse."""
    limit = asked * kernel.p999
    weight = still.weight_of(kernel.rms, limit, 12)
    return least_distance(still.least(weight, limit), weight, kernel.rms) / kernel.d


def pair(still, name):
    """A row: an aperture, `least` of equal flicker, and weight with limit, beside it."""
    kernel = still.kernel(name)
    equal = still.weight_of(kernel.rms, steps=14)
    nearest = still.least(equal)
    found = still.lowest_limit(kernel)
    bounded = still.least(found[1], found[0]) if found else None
    ratio = bounded.p999 / kernel.p999 if found else math.nan
    return {"scene": still.name, "beside": name, "rms": kernel.rms, "p999": kernel.p999, "d": kernel.d,
            "least_weight": equal, "least_rms": nearest.rms, "least_d_ratio": nearest.d / kernel.d,
            "least_d_bound": least_distance(nearest, equal, kernel.rms) / kernel.d,
            "limit": found[0] if found else math.nan, "weight": found[1] if found else math.nan,
            "limit_rms": bounded.rms if found else math.nan, "limit_d": bounded.d if found else math.nan,
            "limit_p999_ratio": ratio,
            "asked_d_bound": math.nan if ratio <= ASKED[name] else out_of_reach(still, kernel, ASKED[name])}


def median(values):
    values = sorted(values)
    return values[len(values) // 2] if values else math.nan


# ---- Plots ----

WEIGHTS = (0.25, 0.5, 1, 2, 4, 8, 16, 32)
LIMITS = (0.5, 0.35, 0.25, 0.18, 0.13, 0.09, 0.06, 0.04)  # of the peak through `line`


def draw(still, path, key, label):
    """Flicker over distance: dots for kernels, lines for weights, for limits, and for both."""
    peak = still.kernel("line").peak
    curves = (("least:MU", [(w, math.inf) for w in WEIGHTS]), ("limit", [(0.0, e * peak) for e in LIMITS]),
              ("weight 1 with limit", [(1.0, e * peak) for e in LIMITS]))
    items = []
    for k, (name, pairs) in enumerate(curves, 1):
        points = [[f.d, getattr(f, key)] for f in (still.least(*pair) for pair in pairs)]
        items.append({"kind": "line", "points": points, "series": k, "name": name})
        items.append({"kind": "points", "points": points, "series": k, "radius": 2.2})
    for name in KERNELS:
        figures = still.kernel(name)
        items.append({"kind": "label", "at": [figures.d, getattr(figures, key)], "text": name, "series": 0})
    plot = {"title": f"{still.name}: flicker against what sharpness is lost", "width": 640, "height": 400,
            "x": {"label": "distance of luminance from line, RMS of white", "low": 0},
            "y": {"label": label + ", of white", "low": 0}, "items": items}
    subprocess.run([still.weft, "plot", "-", "-o", path], input=json.dumps(plot), text=True, check=True)


def told(rows):
    """The table, and what misses what was asked for."""
    lines = ["| scene | beside | flicker RMS | p99.9 | d | `least` of equal RMS: d | weight and limit: p99.9 | "
             "(weight, limit) |", "|---|---|---|---|---|---|---|---|"]
    for r in rows:
        lines.append(f"| {r['scene']} | `{r['beside']}` | {r['rms']:.4f} | {r['p999']:.3f} | {r['d']:.4f} | "
                     f"x {r['least_d_ratio']:.2f} | x {r['limit_p999_ratio']:.2f} | {r['weight']:.2g}, "
                     f"{r['limit']:.3f} |")
    short = [f"{r['scene']} beside {r['beside']}: d x {r['least_d_ratio']:.3f}; no picture of that flicker has less than "
             f"x {r['least_d_bound']:.3f} (dual bound)" for r in rows
             if not r["least_d_ratio"] <= 0.92]
    short += [f"{r['scene']} beside {r['beside']}: p99.9 x {r['limit_p999_ratio']:.3f}; no picture whose flicker is nowhere "
              f"above x {ASKED[r['beside']]:.2f} has d less than x {r['asked_d_bound']:.3f} (dual bound)" for r in rows
              if not r["limit_p999_ratio"] <= ASKED[r["beside"]]]
    middle = median([r["limit_p999_ratio"] for r in rows if r["limit_p999_ratio"] == r["limit_p999_ratio"]])
    return lines, short, middle


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build")
    parser.add_argument("--scenes", default=",".join(SCENES))
    parser.add_argument("--out")
    parser.add_argument("--plot", help="scenes to draw instead")
    parser.add_argument("--samples", type=int, default=36)
    options = parser.parse_args()
    options.out = options.out or os.path.join(options.build, "frontier")
    os.makedirs(options.out, exist_ok=True)
    return options


def main():
    options, rows = arguments(), []
    if options.plot:
        return plots(options)
    for name in options.scenes.split(","):
        still = Still(options, name)
        rows += [pair(still, beside) for beside in BESIDE]
        print("\n".join(told(rows[-3:])[0][2:]), flush=True)
    lines, short, middle = told(rows)
    with open(os.path.join(options.out, "frontier.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    print("\n".join(lines))
    print(f"p99.9, median over all pairs: x {middle:.2f}")
    for line in short:
        print("not reached: " + line)
    return 0


def plots(options):
    for name in options.plot.split(","):
        still = Still(options, name)
        for key, label in (("rms", "flicker, RMS"), ("p999", "flicker, 99.9 % below")):
            draw(still, os.path.join(options.out, f"frontier_{name}_{key}.svg"), key, label)
    return 0


if __name__ == "__main__":
    sys.exit(main())
