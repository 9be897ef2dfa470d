#!/usr/bin/env python3
"""Run time against error, and every target of speed, measured in one run.

    tests/bench/run.py BUILD                     everything that is installed takes part
    tests/bench/run.py BUILD --small             minutes less: ratios and counts only
    tests/bench/run.py BUILD --only tracer       one of: converter, tracer, targets, compressions,
                                                 startup, crowds, peers
    tests/bench/run.py BUILD --before WEFT       an older program, which must not have been faster
    tests/bench/run.py BUILD --rounds N          how often what is compared takes turns [5]
    tests/bench/run.py BUILD --publish           writes the results into README.md; crowds,
                                                 compressions and startup alone have tables
                                                 there of their own, and of the tracer alone
                                                 rows take those of before
    tests/bench/run.py BUILD --out DIR           where CSV and plots go [BUILD/bench]

WEFT_SHARED names a directory of sample data; without its wheel/ some targets are skipped, and
said to be. Ratios are of things that took turns. --small exits with 1 if a ratio or count that
does not depend on the machine is not met.
"""
import argparse
import csv
import glob
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time

import crowds
import plot
import reading
import scenes
import videos

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "examples", "scenes")
APERTURES = ["line", "rotated", "box", "ccd", "notch", "shaped", "diamond", "mitchell:1/3,1/3"]
THREADS = "2"


class Bench:
    """Where things are, and what has been found."""

    def __init__(self, options):
        self.build = os.path.abspath(options.build)
        self.out = os.path.abspath(options.out or os.path.join(self.build, "bench"))
        self.small = options.small
        self.work = tempfile.mkdtemp()
        self.rows = []  # targets: (what, measured, target, met or None, note)
        shared = os.environ.get("WEFT_SHARED", "")
        self.wheel = sorted(glob.glob(os.path.join(shared, "data/wheel/*.exr"))) if shared else []
        self.rounds = options.rounds or (3 if self.small else 5)
        self.before = options.before and os.path.abspath(options.before)
        os.makedirs(self.out, exist_ok=True)

    def program(self, name):
        return os.path.join(self.build, name if name == "weft" else "tests/bench-" + name)

    def text(self, name, *arguments):
        return subprocess.run([self.program(name), *map(str, arguments)], check=True,
                              capture_output=True, text=True).stdout

    def weft(self, *arguments):
        """Runs weft; returns its report, with the seconds of the whole process."""
        report = os.path.join(self.work, "report.json")
        started = time.perf_counter()
        subprocess.run([self.program("weft"), *map(str, arguments), "-q", "--threads", THREADS,
                        "--overwrite", "--report", report], check=True)
        seconds = time.perf_counter() - started
        with open(report) as f:
            found = json.load(f)
        found["process_s"] = seconds
        return found

    def path(self, name):
        return os.path.join(self.work, name)

    def save(self, name, header, rows):
        with open(os.path.join(self.out, name), "w", newline="") as f:
            csv.writer(f).writerows([header, *rows])

    def target(self, what, measured, most=None, least=None, unit="x", note=None, timed=True):
        """Notes a figure and whether it keeps what was asked; measured None: left out. Where times
        are short they may be half as far off again."""
        if self.small and timed and unit != "%":
            most, least = most and 1.5 * most, least and least / 1.5
        asked = f"<= {most:g}" if most is not None else f">= {least:g}"
        met = None if measured is None else \
            (measured <= most if most is not None else measured >= least)
        says = "skipped" if measured is None else f"{measured:.3g} {unit}".strip()
        self.rows.append((what, says, f"{asked} {unit}".strip(), met, note))
        mark = {None: "-", True: "ok", False: "MISSED"}[met]
        print(f"{mark:7}{what}: {says} ({asked}) {note or ''}", flush=True)


def median(values):
    return sorted(values)[len(values) // 2]


def take_turns(rounds, ways):
    """The median seconds of each of several functions, that take turns."""
    times = {name: [] for name in ways}
    for _ in range(rounds):
        for name, way in ways.items():
            started = time.perf_counter()
            way()
            times[name].append(time.perf_counter() - started)
    return {name: median(list_) for name, list_ in times.items()}


# ---- Converter: error and time of every aperture and size ----

def converter(bench):
    sizes = [480, 720] if bench.small else [480, 720, 1080, 1440, 2160]
    rows = []
    for aperture in APERTURES:
        for lines in sizes:
            ms, ns, error = map(float, bench.text("precision", lines, aperture).split())
            rows.append((aperture, lines, ms, ns, error))
            print(f"{aperture:18}{lines:5} lines  {ms:8.2f} ms a field  {ns:.3f} ns a sample  "
                  f"error {error:.2g}", flush=True)
    bench.save("converter.csv", ("aperture", "lines", "ms_a_field", "ns_a_sample", "error"), rows)
    plot.log_log(bench.program("weft"), os.path.join(bench.out, "converter.svg"),
                 "Filtering one field, one thread", "frame lines", "milliseconds a field",
                 [(a, [(r[1], r[2]) for r in rows if r[0] == a]) for a in APERTURES])
    bench.target("largest error against float64, of sum |W c|/sum W", max(r[4] for r in rows),
                 most=1e-6, unit="", timed=False)


# ---- Targets of subframes to fields ----

def oiio_fields(bench, files):
    for n in range(0, len(files) - 7, 8):
        command = ["oiiotool", "--threads", THREADS, files[n]]
        for name in files[n + 1:n + 8]:
            command += [name, "--add"]
        subprocess.run([*command, "--divc", "8", "--resize", "720x486", "-o",
                        bench.path("field.exr")], check=True)


def ffmpeg_way(bench, files):
    listing = bench.path("list")
    with open(listing, "w") as f:
        f.writelines(f"file '{name}'\n" for name in files)
    subprocess.run(
        ["ffmpeg", "-nostdin", "-v", "error", "-y", "-threads", THREADS, "-f", "concat", "-safe",
         "0", "-r", "480000/1001", "-i", listing, "-vf",
         "zscale=720:486:filter=bilinear:matrixin=gbr:rangein=full:matrix=170m:range=limited,"
         "format=yuv422p10,tmix=frames=8,framestep=8,interlace=lowpass=complex:scan=bff",
         "-c:v", "v210", "-f", "rawvideo", bench.path("a.v210")], check=True)


def subframes(bench):
    files = bench.wheel
    rate = ("--subframe-rate", "480000/1001")
    if not files:
        for what in ("wheel", "tau 0", "identical subframes", "data window"):
            bench.target(f"convert: {what}", None, most=1, note="WEFT_SHARED has no wheel/")
        return
    same, part = bench.path("same"), bench.path("part")
    os.makedirs(same)
    os.makedirs(part)
    for n in range(len(files)):
        os.symlink(files[0], os.path.join(same, f"{n:04}.exr"))

    def convert(*more, of=files):
        return bench.weft("convert", *of, *rate, *more, "-o", bench.path("a.y4m"))

    ways = {"floor": lambda: bench.text("floor", THREADS, *files),
            "whole": lambda: convert("--temporal-width", "1"),
            "instant": lambda: convert("--temporal-width", "0"),
            "same": lambda: convert("--temporal-width", "1",
                                    of=sorted(glob.glob(same + "/*.exr")))}
    if shutil.which("oiiotool"):
        for n, name in enumerate(files):
            subprocess.run(["oiiotool", name, "--crop", "322x217+500+300", "--compression", "zip",
                            "-o", os.path.join(part, f"{n:04}.exr")], check=True)
        ways["part"] = lambda: convert("--temporal-width", "1",
                                       of=sorted(glob.glob(part + "/*.exr")))
    if shutil.which("ffmpeg"):
        ways["ffmpeg"] = lambda: ffmpeg_way(bench, files)
    seconds = take_turns(bench.rounds, ways)
    whole = seconds["whole"]
    print("  seconds: " + ", ".join(f"{k} {v:.3f}" for k, v in seconds.items()))
    bench.target("convert wheel, beside inflating alone", whole / seconds["floor"], most=1.1)
    bench.target("convert wheel, beside ffmpeg", seconds["ffmpeg"] / whole
                 if "ffmpeg" in seconds else None, least=4, unit="x faster")
    oiio = None
    if shutil.which("oiiotool"):
        oiio = take_turns(1, {"": lambda: oiio_fields(bench, files)})[""] / whole
    bench.target("convert wheel, beside oiiotool", oiio, least=15, unit="x faster")
    opened = convert("--temporal-width", "0")
    each = opened["input"]["opened"] / opened["fields"]
    bench.target("tau 0: subframes opened a field", each if each else math.inf, most=1, unit="",
                 timed=False)
    # The whole takes less than it may, since chunks that do not change are inflated once.
    may = 1.1 * seconds["floor"]
    for what, way, most in (("tau 0", "instant", 0.25), ("128 identical subframes", "same", 0.15),
                            ("a data window of 5 %", "part", 0.1)):
        found = seconds.get(way)
        bench.target(what, found and found / may, most=most, unit="x what the whole may take",
                     note=found and f"{found / whole:.2f} x what it takes")


def stages(bench):
    """What filters and colors alone take, beside zimg."""
    add = {line.split()[0]: float(line.split("add")[1].split()[0])
           for line in bench.text("resample").splitlines()}
    zimg = None
    if shutil.which("ffmpeg"):
        def run(filters):
            command = ["ffmpeg", "-nostdin", "-v", "error", "-threads", "1", "-filter_threads", "1",
                       "-f", "rawvideo", "-pixel_format", "gbrpf32le", "-video_size", "1440x972",
                       "-i", "/dev/zero", "-frames:v", "200", "-vf", filters, "-f", "null", "-"]
            subprocess.run(command, check=True)
        try:
            seconds = take_turns(3, {"with": lambda: run("zscale=720:486:filter=bicubic"),
                                     "none": lambda: run("null")})
            zimg = 1e3 * (seconds["with"] - seconds["none"]) / 200
        except subprocess.CalledProcessError:
            pass
    bench.target("filter and field alone, box, beside zimg", zimg / add["box"] if zimg else None,
                 least=1.5, unit="x faster",
                 note=f"{add['box']:.2f} ms a subframe; zimg {zimg:.2f}" if zimg else "no zscale")
    color = [float(line.split("together")[1].split()[0])
             for line in bench.text("color").splitlines() if line.startswith("lin_rec709 to")]
    bench.target("1920x540 field: color, 4:2:2, codes; slowest shipped space", max(color),
                 most=8, unit="ms")


def memory(bench):
    bench.weft("trace", os.path.join(SCENES, "still.lua"), "--raster", "1080i59.94",
               "--oversample", "2x2x4", "--frames", "0-1", "-o", bench.path("uhd.####.exr"))
    files = sorted(glob.glob(bench.path("uhd.*.exr")))
    report = bench.weft("convert", *files, "--raster", "1080i59.94", "-o", bench.path("uhd.y4m"))
    bench.target("memory, 1080i from 3840x2160", report["peak_memory_bytes"] / 2**20, most=256,
                 unit="MB", note=f"{len(files)} subframes")
    for name in files:
        os.remove(name)


# ---- Targets of scenes to fields ----

def skipping(bench):
    samples = ("--samples", "16" if bench.small else "64")

    def render(scene, *more):
        return lambda: bench.weft("render", os.path.join(SCENES, scene + ".lua"), *samples,
                                  "--frames", "0", *more, "-o", bench.path("a.y4m"))

    ways = {f"still {tau}": render("still", "--temporal-width", tau) for tau in "0 1/2 1 4".split()}
    ways["mover"] = render("one_mover", "--temporal-width", "1/2")
    ways["few"] = render("csg_grid", "--set", "n=100")
    ways["many"] = render("csg_grid", "--set", "n=10000")
    seconds = take_turns(bench.rounds, ways)
    print("  seconds: " + ", ".join(f"{k} {v:.3f}" for k, v in seconds.items()))
    still = max(seconds[f"still {tau}"] for tau in "1/2 1 4".split())
    bench.target("still scene, the slowest of tau 1/2, 1, 4", still / seconds["still 0"],
                 most=1.05, unit="x tau 0")
    bench.target("one mover", seconds["mover"] / seconds["still 1/2"],
                 most=1.2, unit="x still")
    bench.target("10,000 solids", seconds["many"] / seconds["few"], most=1.5, unit="x 100 solids")
    traced = [ways[f"still {tau}"]()["tracer"]["samples"] for tau in "0 1/2 1 4".split()]
    bench.target("still scene: samples at tau 4", traced[3] / traced[0], most=1, unit="x tau 0",
                 timed=False)
    if not bench.small:
        empty_fields(bench)


def empty_fields(bench):
    """Nothing is seen in any of them, so that the third is like the first."""
    scene = bench.path("empty.lua")
    with open(scene, "w") as f:
        f.write("camera{eye={0, 0, 9}, look_at={0, 0, 0}}\nduration(9)\n"
                "add(sphere{}:translate{0, 90, 0}:velocity{1, 0, 0})\n")
    fields = 200
    report = bench.weft("render", scene, "--frames", f"0-{fields // 2 - 1}", "-o",
                        bench.path("a.y4m"))
    ms = 1e3 * (report["seconds"]["trace"] + report["seconds"]["resample"]) / fields
    bench.target("empty field, of 200 alike: sampling and gathering, both threads' time", ms,
                 most=1, unit="ms")
    bench.target("empty field: samples", report["tracer"]["samples"], most=0, unit="",
                 timed=False)


def targets(bench):
    skipping(bench)
    if bench.small:
        return
    subframes(bench)
    stages(bench)
    memory(bench)
    videos.video(bench)


# ---- Results ----

def machine():
    with open("/proc/cpuinfo") as f:
        model = next((line.split(":")[1].strip() for line in f if line.startswith("model name")),
                     "unknown processor")
    return f"{THREADS} threads of {model}"


def rows_of(bench):
    marks = {None: "skipped", True: "met", False: "**missed**"}
    rows = [(what, says, asked, marks[met] + ("; " + note if note else ""))
            for what, says, asked, met, note in bench.rows]
    return ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]


def table(bench):
    text = "\n".join(["| target | measured | asked | |", "|---|---|---|---|", *rows_of(bench)]) + "\n"
    with open(os.path.join(bench.out, "table.md"), "w") as f:
        f.write(text)
    return text


def publish_part(name, ran):
    """Has a run of one part alone written into README.md, where it has a table; ran: on what."""
    def write(bench, text):
        page = os.path.join(HERE, "README.md")
        with open(page) as f:
            before, rest = f.read().split(f"<!-- {name} -->\n")
        after = rest.split(f"<!-- {name} end -->")[1]
        with open(page, "w") as f:
            f.write(f"{before}<!-- {name} -->\n{time.strftime('%Y-%m-%d')}, {ran()}.\n\n{text}"
                    f"<!-- {name} end -->{after}")
    return write


def one_thread():
    return f"one thread of {machine().split(' of ')[1]}"


def with_load():
    """Other work takes seconds of a clock and caches, and of the processor's seconds a few."""
    return f"{machine()}, while {os.getloadavg()[2]:.0f} other processes or so were at work"


def copy_plots(bench):
    plots, pictures = sorted(glob.glob(os.path.join(bench.out, "*.svg"))), os.path.join(HERE, "results")
    os.makedirs(pictures, exist_ok=True)
    for path in plots:
        shutil.copy(path, pictures)
    return plots


def publish_tracer(bench, text):
    """Puts the rows of a run of the tracer alone in the place of those of before, with their day."""
    page = os.path.join(HERE, "README.md")
    with open(page) as f:
        before, rest = f.read().split("<!-- results -->\n")
    lines = rest.split("\n")
    for row in rows_of(bench):
        name, dated = row.split(" | ")[0], f"{row[:-2]}; {time.strftime('%Y-%m-%d')} |"
        at = next((n for n, line in enumerate(lines) if line.split(" | ")[0] == name), None)
        if at is None:
            print(f"no row before: {row}")
        else:
            lines[at] = dated
    with open(page, "w") as f:
        f.write(before + "<!-- results -->\n" + "\n".join(lines))
    copy_plots(bench)


def publish(bench, text):
    """Writes the results into README.md, and the plots beside it."""
    page = os.path.join(HERE, "README.md")
    with open(page) as f:
        before, rest = f.read().split("<!-- results -->\n")
    after = rest.split("<!-- end -->")[1]
    plots = copy_plots(bench)
    images = "\n".join(f"![](results/{os.path.basename(path)})" for path in plots)
    found = (f"<!-- results -->\n## Measured\n\n{time.strftime('%Y-%m-%d')}, {machine()}.\n\n"
             f"{text}\n{images}\n<!-- end -->")
    with open(page, "w") as f:
        f.write(before + found + after)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--only", default="converter,tracer,targets,compressions,startup,crowds,peers")
    parser.add_argument("--before")
    parser.add_argument("--rounds", type=int)
    parser.add_argument("--publish", action="store_true")
    parser.add_argument("--out")
    options = parser.parse_args()
    bench = Bench(options)
    parts = {"converter": converter, "tracer": lambda b: scenes.curves(b, SCENES),
             "targets": targets, "compressions": lambda b: reading.compressions(b, ffmpeg_way),
             "startup": reading.startup, "crowds": crowds.crowds,
             "peers": lambda b: scenes.peers(b, SCENES)}
    chosen = options.only.split(",")
    publishers = {"crowds": publish_part("crowds", one_thread), "tracer": publish_tracer,
                  "compressions": publish_part("compressions", with_load),
                  "startup": publish_part("startup", with_load), ",".join(parts): publish}
    if options.publish and (options.small or options.only not in publishers):
        parser.error("--publish is of a whole run, or of one of crowds, tracer, compressions and startup: "
                     "without --small")
    unknown = [name for name in chosen if name not in parts]
    if unknown:
        parser.error(f"no part named {unknown[0]}: {', '.join(parts)}")
    try:
        for name in chosen:
            print(f"==== {name}", flush=True)
            parts[name](bench)
    finally:
        shutil.rmtree(bench.work)
    text = table(bench)
    if options.publish:
        publishers[options.only](bench, text)
    missed = [row for row in bench.rows if row[3] is False]
    print(f"{len(bench.rows) - len(missed)} of {len(bench.rows)} targets met or skipped; see "
          f"{bench.out}")
    return 1 if missed and bench.small else 0


if __name__ == "__main__":
    sys.exit(main())
