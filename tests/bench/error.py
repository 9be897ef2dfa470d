#!/usr/bin/env python3
"""Whether `--error E` keeps what it says, on scenes that were made to fool it and on those that ship.

    tests/bench/error.py BUILD [--scenes a,b] [--errors .02,.005] [--apertures box,shaped] [--small] [--out DIR]

Truth is the mean of two renders of many samples that know nothing of each other, and is kept in DIR for
the next run, as are renders of fixed numbers of samples, which say what an error costs without
--error. A row for each scene, aperture and error: true RMS of display-encoded values, the estimate, the
share of pixels within E (three times the truth's own error allowed), the light beside the truth's, and
samples and CPU time beside what as large an RMS takes with a fixed number of samples a cell.
"""
import argparse
import glob
import json
import math
import os
import resource
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
RASTER = "64x48@30i,tff,par=1:1"
FRAME = 3
MOST_TRUTH = 65536
LEAST_CPU = .1  # seconds; what takes less is start-up
FIXED = (2, 4, 8, 16, 32, 64, 128, 256, 512, 1024)
SET = {"csg_grid": "n=300", "many_spheres": "n=1000"}


def scene_files():
    found = {}
    for folder in ("scenes", "../../examples/scenes"):
        for path in sorted(glob.glob(os.path.join(HERE, folder, "*.lua"))):
            found[os.path.basename(path)[:-4]] = path
    return found


def children_cpu():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Case:
    """A scene through one aperture."""

    def __init__(self, options, name, path, aperture):
        self.build, self.name, self.aperture = options.build, f"{name}-{aperture}", aperture
        self.out, self.truth_samples = options.out, options.truth
        set_to = ["--set", SET[name]] if name in SET else []
        self.job = [path, "--raster", options.raster, "--frames", str(FRAME), "--aperture", aperture, *set_to]
        self.truth, self.costs = None, {}

    def render(self, name, *how):
        """(picture, report, exit status)"""
        path = os.path.join(self.out, f"{self.name}-{name}")
        report = path + ".json"
        ran = subprocess.run([os.path.join(self.build, "weft"), "render", *self.job, *map(str, how), "-q",
                              "--threads", "1", "--overwrite", "--report", report, "-o", path + ".####.exr"],
                             capture_output=True, text=True)
        if ran.returncode not in (0, 3):
            sys.exit(f"{self.name}: {ran.stderr}")
        with open(report) as f:
            return f"{path}.{FRAME:04}.exr", json.load(f), ran.returncode

    def cost(self, *how):
        """CPU seconds of a run that writes video, which has hardly a start-up: the less of two."""
        runs = []
        for _ in range(2):
            before = children_cpu()
            subprocess.run([os.path.join(self.build, "weft"), "render", *self.job, *map(str, how), "-q",
                            "--threads", "1", "--overwrite", "-o", os.path.join(self.out, "cost.y4m")],
                           capture_output=True)
            runs.append(children_cpu() - before)
        return min(runs)

    def fixed_cost(self, count):
        if count not in self.costs:
            self.costs[count] = self.cost("--samples", count, "--seed", 5)
        return self.costs[count]

    def compare(self, picture, bound):
        """RMSE, share within, truth's uncertainty, light, share within and three of those"""
        said = subprocess.run([os.path.join(self.build, "tests/bench-compare"), self.truth, picture, str(bound)],
                              check=True, capture_output=True, text=True).stdout
        return tuple(map(float, said.split()))

    def find_truth(self, samples):
        pictures = []
        for seed in (101, 102):
            name = f"truth{seed}-{samples}"
            path = os.path.join(self.out, f"{self.name}-{name}.{FRAME:04}.exr")
            if not os.path.exists(path):
                self.render(name, "--samples", samples, "--seed", seed)
            pictures.append(path)
        self.truth = ",".join(pictures)
        return self.compare(pictures[0], 1)[2]

    def converge(self, least):
        """With as many samples as it takes to tell errors of a third of the least asked for."""
        samples = self.truth_samples
        while self.find_truth(samples) > least / 6 and samples < MOST_TRUTH:
            samples *= 4

    def fixed(self):
        """[(RMSE, samples, samples a cell)] of fixed numbers of samples"""
        path = os.path.join(self.out, f"{self.name}-fixed.json")
        if not os.path.exists(path):
            rows = []
            for count in FIXED:
                picture, report, _ = self.render("fixed-picture", "--samples", count, "--seed", 5)
                rows.append((self.true_rms(self.compare(picture, 1)), report["tracer"]["samples"], count))
            with open(path, "w") as f:
                json.dump(rows, f)
        with open(path) as f:
            return json.load(f)

    @staticmethod
    def true_rms(found):
        return math.sqrt(max(found[0] ** 2 - found[2] ** 2, 1e-16))


def at_rms(rows, rms, cost):
    """What a fixed number of samples takes for an RMS, between points on logarithmic scales."""
    if rms >= rows[0][0]:
        return cost(rows[0])
    for a, b in zip(rows, rows[1:]):
        if b[0] <= rms <= a[0] or b is rows[-1]:
            share = math.log(a[0] / rms) / math.log(a[0] / b[0]) if b[0] < a[0] else 1
            return cost(a) * (cost(b) / cost(a)) ** share
    return cost(rows[-1])


def judge(case, error, seed, costs):
    rows = case.fixed() if costs else [(1, 1, 1)] * 2
    picture, report, status = case.render(f"error", "--error", error, "--seed", seed)
    found = case.compare(picture, error)
    rms, says = case.true_rms(found), report["tracer"]["error_estimate"]
    samples = report["tracer"]["samples"]
    width, lines = map(int, case.job[2].split("@")[0].split("x"))
    cells = 2 * width * lines  # in each of two fields
    faults = []
    if found[4] < .99:
        faults.append("outside")
    if rms > error:
        faults.append("RMS")
    if costs and rms < error / 4 and samples > 9 * cells:
        faults.append("fine")
    if says < .95 * rms:
        faults.append("says")
    if abs(found[3] - 1) > .003:
        faults.append("light")
    dear, slow, cpu = samples / at_rms(rows, rms, lambda row: row[1]), 0, 0
    if costs:
        cpu = case.cost("--error", error, "--seed", seed)
        slow = cpu / at_rms(rows, rms, lambda row: case.fixed_cost(row[2]))
    if costs and dear > 1.1 and samples > 9 * cells:
        faults.append("dear")
    if costs and slow > 1.1 and cpu > LEAST_CPU:
        faults.append("slow")
    if status:
        faults.append(f"exit{status}")
    ratios = (f"x{dear:5.2f}", f"x{slow:5.2f}") if costs else ("", "")
    print(f"{case.name:24}{error:<8g}rms/E {rms / error:5.2f}  says/rms {says / rms:5.2f}  within {100 * found[4]:6.2f}  "
          f"light {100 * (found[3] - 1):+6.2f} %  samples {samples / cells:7.1f} {ratios[0]}  "
          f"cpu {cpu:6.3f} {ratios[1]}  {' '.join(faults)}", flush=True)
    return faults


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("build", type=os.path.abspath)
    ask.add_argument("--scenes")
    ask.add_argument("--errors", default=".04,.02,.01,.005,.0025")
    ask.add_argument("--apertures", default="box,shaped")
    ask.add_argument("--raster", default=RASTER)
    ask.add_argument("--truth", type=int, default=4096, help="samples a cell of the truth, at least")
    ask.add_argument("--small", action="store_true", help="what is kept alone, not what it costs")
    ask.add_argument("--seed", type=int, default=7)
    ask.add_argument("--out", default="/tmp/weft-error")
    options = ask.parse_args()
    os.makedirs(options.out, exist_ok=True)
    files, bad = scene_files(), 0
    for name in options.scenes.split(",") if options.scenes else files:
        for aperture in options.apertures.split(","):
            case = Case(options, name, files[name], aperture)
            errors = list(map(float, options.errors.split(",")))
            case.converge(min(errors))
            for error in errors:
                bad += bool(judge(case, error, options.seed, not options.small))
    print(f"{bad} rows with faults")
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
