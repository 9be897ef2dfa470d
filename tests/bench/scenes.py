"""Error against time of the tracer, and beside POV-Ray."""
import glob
import math
import os
import re
import shutil
import subprocess

import plot

SMALL_RASTER = "180x122@30i,bff,par=10:11"
ASPECT = 10 / 11
FRAME = 10
PEER_FRAME = 20  # of 525i


class Curve:
    """A scene through one aperture, held against a truth."""

    def __init__(self, bench, scene, raster, frame, *how):
        self.bench, self.name = bench, os.path.basename(scene)[:-4]
        self.arguments = [scene, "--raster", raster, "--frames", frame, *how]
        self.truth, self.frame = None, frame

    def render(self, name, *how):
        report = self.bench.weft("render", *self.arguments, *how, "-o",
                                 self.bench.path(name + ".####.exr"))
        return self.bench.path(f"{name}.{self.frame:04}.exr"), report

    def converge(self, samples):
        """The mean of two renders that know nothing of each other."""
        self.truth = ",".join(self.render(f"truth-{self.name}-{seed}", "--samples", samples,
                                          "--seed", seed)[0] for seed in (101, 102))

    def point(self, *how, bound=1):
        """(seconds of tracing, RMSE, share of pixels within the bound, the truth's own error,
        estimate, samples)"""
        path, report = self.render("point", "--seed", 5, *how)
        rmse, share, unsure = map(float, self.bench.text("compare", self.truth, path,
                                                         bound).split()[:3])
        return (report["seconds"]["trace"], rmse, share, unsure,
                report["tracer"]["error_estimate"], report["tracer"]["samples"])


def truth_of(bench, curve, samples):
    if curve.name == "zoneplate":
        width, lines = map(int, re.match(r"(\d+)x(\d+)", SMALL_RASTER).groups())
        curve.truth = bench.path("zoneplate.exr")
        bench.text("zoneplate", width, lines, ASPECT, "box", curve.truth)
    else:
        curve.converge(samples)


def curve_of(bench, scene):
    """Rows of one scene: (scene, how, setting, seconds, RMSE, ...)."""
    still = os.path.basename(scene) == "zoneplate.lua"
    curve = Curve(bench, scene, SMALL_RASTER, 0 if still else FRAME, "--aperture", "box",
                  "--temporal-width", "0" if still else "1/2", "--set", "n=300")
    truth_of(bench, curve, 512 if bench.small else 4096)
    counts = [4, 16, 64] if bench.small else [4, 16, 64, 256]
    errors = [0.04, 0.02, 0.01] if bench.small else [0.04, 0.02, 0.01, 0.005, 0.0025]
    rows = [(curve.name, sampler, n, *curve.point("--sampler", sampler, "--samples", n))
            for sampler in ("jitter", "grid", "sobol") for n in counts]
    rows += [(curve.name, "error", e, *curve.point("--error", e, bound=e)) for e in errors]
    for row in rows:
        print("{:12}{:8}{:<8g}{:8.3f} s  RMSE {:.2e}  within {:.4f}  truth known to {:.1e}".format(
            *row[:7]), flush=True)
    return rows


def known(rows):
    """Points where the truth is known three times as well as what is held against it."""
    return [(r[3], r[4]) for r in rows if r[4] > 3 * r[6] and r[4] > 0]


def curves(bench, scenes):
    files = sorted(glob.glob(os.path.join(scenes, "*.lua")))
    if bench.small:
        files = [f for f in files if os.path.basename(f) in ("carousel.lua", "zoneplate.lua")]
    rows = []
    for scene in files:
        mine = curve_of(bench, scene)
        rows += mine
        plot.log_log(bench.program("weft"), os.path.join(bench.out, f"{mine[0][0]}.svg"),
                     f"{mine[0][0]}: error against time", "seconds of two threads together",
                     "RMSE, display-encoded",
                     [(how, known([r for r in mine if r[1] == how]))
                      for how in ("jitter", "grid", "sobol", "error")])
    bench.save("tracer.csv", ("scene", "sampler", "setting", "seconds", "rmse", "share_within",
                              "truth_error", "estimate", "samples"), rows)
    asked = [r for r in rows if r[1] == "error" and r[4] > 3 * r[6]]
    least = min(asked, key=lambda r: r[5])
    bench.target("adaptive: pixels within the error asked for", 100 * least[5], least=99, unit="%",
                 note=f"least of all: {least[0]} to {least[2]}")
    worst = max(asked, key=lambda r: r[4] / r[2])
    bench.target("adaptive: RMSE beside the error asked for", worst[4] / worst[2], most=1,
                 note=f"{worst[0]} to {worst[2]}", timed=False)
    bold = max(asked, key=lambda r: r[4] / r[7])
    bench.target("adaptive: RMSE beside the estimate", bold[4] / bold[7], most=1,
                 note=f"{bold[0]} to {bold[2]}", timed=False)
    if not bench.small:
        slopes(bench, scenes)


SLOPE_ERRORS = (0.05, 0.02, 0.01, 0.005, 0.0025)


def whole_raster(bench, scenes, scene, aperture):
    """Points (seconds, RMSE, share within the error asked for, ...) over the whole of 525i."""
    curve = Curve(bench, os.path.join(scenes, scene + ".lua"), "525i", PEER_FRAME,
                  "--aperture", aperture, "--temporal-width", "1/2")
    curve.converge(2048)
    points = [curve.point("--error", e, bound=e) for e in SLOPE_ERRORS]
    for seconds, rmse, share, unsure, *_ in points:
        print(f"{scene}, {aperture}, 525i: {seconds:.2f} s  RMSE {rmse:.2e}  within {share:.4f}  "
              f"truth known to {unsure:.1e}", flush=True)
    return points


def slopes(bench, scenes):
    """Of what an error asked for costs."""
    series = []
    for scene, most in (("carousel", -1.0), ("still", -1.4)):
        points = whole_raster(bench, scenes, scene, "box")
        fitted = [(p[0], p[1]) for p in points if p[1] > 3 * p[3]]
        series.append((scene, fitted))
        bench.target(f"slope of error against time, {scene}, 525i", plot.slope(fitted), most=most,
                     unit="")
    points = whole_raster(bench, scenes, "carousel", "shaped")
    bench.target("adaptive, shaped, carousel, 525i: pixels within the error asked for",
                 100 * min(p[2] for p in points), least=99, unit="%")
    plot.log_log(bench.program("weft"), os.path.join(bench.out, "slopes.svg"),
                 "errors asked for, 525i", "seconds of two threads together", "RMSE, display-encoded", series)


# ---- POV-Ray ----

class Pov:
    """Fields of tests/peers/carousel.pov: the mean of slices of time, each of 243 lines twice as
    high, which is the box aperture; R x R samples a pixel and slice."""

    def __init__(self, bench):
        self.bench, self.folder = bench, bench.path("pov")
        os.makedirs(self.folder)
        source = os.path.join(os.path.dirname(__file__), "..", "peers", "carousel.pov")
        shutil.copy(source, self.folder)

    def run(self, *arguments):
        said = subprocess.run(["povray", "+Icarousel.pov", "-D", "+WT2", "-J", *arguments],
                              cwd=self.folder, check=True, capture_output=True, text=True)
        return (said.stdout + said.stderr).replace("\r", "\n")

    def field(self, name, slices, across, wide=1):
        """(seconds of tracing alone, its picture)"""
        field, lasts = 2 * PEER_FRAME * 1001 / 60000, 0.5 * 1001 / 60000
        first, last = (field + lasts * (k / slices) for k in (0.5, slices - 0.5))
        said = self.run(f"+W{720 * wide}", f"+H{243 * wide}", "+FE", "+KFI1", f"+KFF{slices}",
                        f"+KI{first:.12f}", f"+KF{last:.12f}", "+AM1", "+A0.0", f"+R{across}",
                        "+Oslice_.exr", "Declare=Lines=-0.5")
        seconds = sum(map(float, re.findall(r"Trace Time:.*\(([\d.]+) seconds\)", said)))
        parts = sorted(glob.glob(os.path.join(self.folder, "slice_*.exr")))
        command = ["oiiotool", parts[0]]
        for part in parts[1:]:
            command += [part, "--add"]
        path = self.bench.path(name + ".exr")
        subprocess.run([*command, "--divc", str(slices), "--resize:filter=box", "720x243", "-d",
                        "float", "-o", path], check=True)
        for part in parts:
            os.remove(part)
        return seconds, path


def rays_a_second(bench, scenes, pov):
    """Camera and shadow rays of one picture, 60 samples a pixel and more."""
    report = bench.weft("render", os.path.join(scenes, "carousel.lua"), "--raster",
                        "720x486@30p,par=10:11", "--aperture", "line", "--temporal-width", "0",
                        "--samples", "60", "--frames", "0", "-o", bench.path("rays.y4m"))
    ours = report["tracer"]["rays"] / report["seconds"]["wall"]
    said = pov.run("+Orays.png", "+W720", "+H486", "+AM1", "+A0.0", "+R8")
    rays = sum(int(n) for n in re.findall(r"(?:^Rays:|Shadow Ray Tests:)\s+(\d+)", said, re.M))
    theirs = rays / float(re.findall(r"Trace Time:.*\(([\d.]+) seconds\)", said)[0])
    bench.target("rays a second, beside POV-Ray", ours / theirs, least=1,
                 note=f"{ours / 1e6:.1f} and {theirs / 1e6:.1f} million")


def time_to(points, rmse):
    """Seconds at which the lower hull of (seconds, RMSE) reaches an error, between points on
    logarithmic scales; None: it does not."""
    best = []
    for seconds, error in sorted(points):
        if not best or error < best[-1][1]:
            best.append((seconds, error))
    if best[0][1] <= rmse:
        return best[0][0]
    for (s0, e0), (s1, e1) in zip(best, best[1:]):
        if e1 <= rmse:
            share = math.log(e0 / rmse) / math.log(e0 / e1)
            return s0 * (s1 / s0) ** share
    return None


def our_points(bench, scenes):
    curve = Curve(bench, os.path.join(scenes, "carousel.lua"), "525i", PEER_FRAME, "--aperture",
                  "box", "--temporal-width", "1/2")
    curve.converge(1024)
    points = [curve.point("--samples", n) for n in (2, 4, 8, 16)]
    points += [curve.point("--error", e) for e in (0.04, 0.02, 0.01, 0.007, 0.005)]
    return [(p[0] / 2, p[1]) for p in points]  # both threads' time; two fields


def their_points(bench, pov):
    finest, truth = pov.field("pov-truth", 8, 9, wide=2)
    points = []
    for slices, across in ((2, 2), (4, 2), (4, 3), (4, 4), (4, 6), (8, 9)):
        seconds, path = pov.field("pov", slices, across)
        rmse = float(bench.text("compare", truth, path).split()[0])
        points.append((2 * seconds, rmse))
        print(f"POV-Ray, {slices} slices of {across * across}: {2 * seconds:.2f} s a frame, "
              f"RMSE {rmse:.2e}", flush=True)
    return points, 2 * finest


def peers(bench, scenes):
    if not shutil.which("povray") or not shutil.which("oiiotool"):
        for what in ("1e-2", "1e-3"):
            bench.target(f"carousel to {what}, beside POV-Ray", None, least=10,
                         note="no povray or oiiotool")
        return
    pov = Pov(bench)
    rays_a_second(bench, scenes, pov)
    if bench.small:
        return
    ours = our_points(bench, scenes)
    theirs, finest = their_points(bench, pov)
    rows = [("weft", *p) for p in ours] + [("POV-Ray", *p) for p in theirs]
    bench.save("peers.csv", ("program", "seconds_a_frame", "rmse"), rows)
    plot.log_log(bench.program("weft"), os.path.join(bench.out, "peers.svg"),
                 "carousel, a frame of 525i, two threads", "seconds a frame", "RMSE, display-encoded", [("weft", ours), ("POV-Ray", theirs)])
    for rmse, least in ((1e-2, 10), (1e-3, 50)):
        mine, other = time_to(ours, rmse), time_to(theirs, rmse)
        note = "" if other else (f"at least: POV-Ray does not reach it, so its finest picture, 8 "
                                 f"slices of 324 samples, {finest:.0f} s a frame, is taken")
        other = other or finest
        bench.target(f"carousel to {rmse:g}, beside POV-Ray", other / mine if mine else None,
                     least=least, unit="x faster",
                     note=note or f"{mine:.2f} s and {other:.1f} s a frame")
