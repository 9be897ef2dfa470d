#!/usr/bin/env python3
"""Which aperture a raster should have where none is named: ways to make fields, on pictures that move, after displays.

    tests/bench/defaults.py BUILD [--rasters a,b] [--scenes a,b] [--ways "a;b"] [--out DIR] [--resume]
    tests/bench/defaults.py BUILD --small       # seconds: two scenes on a raster of 80 lines
    tests/bench/defaults.py BUILD --publish     # what DIR has, into results/ and README.md
    tests/bench/defaults.py BUILD --check       # whether README.md, the program and the published figures agree

Each scene is traced once, a subframe a field, and its fields are made from there through every aperture that has a
name, with weights and limits of flicker, and by ffmpeg. Of each way: the flicker that `weft measure` finds and how
much of it is seen, the distance (RMS of Y', Cb and Cr) of the fields from those of `line`, and how far the picture is
from the progressive one at its fields' instants, on a tube, which shows a field's own lines, and after three
deinterlacers. The displays of 525i get it through composite, of a cheap encoder and a notch. Wants numpy and ffmpeg.

The rule (`chosen`): of the apertures that have a name, those whose flicker is not seen in half of the scenes or more
(99.9 % of it below a just noticeable difference, on a bob display at the usual distance) are candidates; the nearest
of them after the displays, in the mean over displays and scenes, is what the figures speak for.
"""
import argparse
import csv
import json
import math
import multiprocessing
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
PUBLISHED = os.path.join(HERE, "results", "defaults.csv")
SPANS = (876, 896, 896)  # codes of 10 bits of Y', Cb and Cr
DISPLAYS = {"bwdif": "bwdif=mode=send_field", "yadif": "yadif=mode=send_field", "w3fdif": "w3fdif"}
SEEN = 1.0  # JND: flicker below it is not
STILL = 1e-3  # RMS of white: less is there where next to nothing stands still
SCENES = ("still", "panorama", "carousel", "slow_edges", "wheel", "lettering", "credits", "siding", "branches",
          "scoreboard", "fence", "far_checker")
FOLDERS = ("flicker", "scenes", "../../examples/scenes", "../../examples/paper")
OVERSAMPLE = (2, 4)  # samples a pixel and a frame line
FRAMES = 3


class Raster:
    """A raster of the bench; its size may be the middle of each line."""

    def __init__(self, name, size, described, composite):
        self.name, self.size, self.composite = name, size, composite
        self.described = described.format(*size)
        self.order = "tff" if "tff" in described else "bff"
        self.rate = described.split("@")[1].split("i")[0]
        self.rest = described.split(",", 2)[2]

    def progressive(self, across=1, down=1):
        """A frame a field, of more samples if asked."""
        over, _, under = self.rate.partition("/")
        rate = f"{2 * int(over)}" + (f"/{under}" if under else "")
        return f"{self.size[0] * across}x{self.size[1] * down}@{rate}p,{self.rest}"


RASTERS = (
    Raster("525i", (720, 486), "{}x{}@30000/1001i,bff,par=10:11,601-525", True),
    Raster("625i", (240, 576), "{}x{}@25i,tff,par=12:11,601-625", False),  # the middle of each line
    Raster("1080i50", (320, 1080), "{}x{}@25i,tff,709", False),  # the same
    Raster("small", (96, 80), "{}x{}@25i,tff,709", False),
)
SMALL = ("small", "still,credits", "line;box;shaped;least:1;least:4;limit 0.05;ffmpeg linear;ffmpeg linear, in light")


# ---- Ways to make fields ----

NAMED = ("line", "rotated", "box", "ccd", "notch", "shaped", "diamond", "crisp", "calm")
HELD = {f"least:{w}": ("--aperture", f"least:{w}") for w in (1, 2, 4)}
HELD |= {f"limit {e}": ("--flicker-limit", str(e)) for e in (0.05, 0.02)}
HELD |= {"limit visible:1": ("--flicker-limit", "visible:1"),
         "weight 2, limit 0.03": ("--flicker-weight", "2", "--flicker-limit", "0.03")}
KERNELS = {name: ("--aperture", name) for name in (*NAMED, "mitchell:1/3,1/3")}
# From progressive pictures of the raster's size, or larger ones that ffmpeg scales; in light if told so.
SCALED = "framestep=1,scale={1}:{2}:flags=bicubic,interlace=scan={0}:lowpass=linear"
FFMPEG = {"ffmpeg linear": ("interlace=scan={0}:lowpass=linear", False, False),
          "ffmpeg complex": ("interlace=scan={0}:lowpass=complex", False, False),
          "ffmpeg linear, in light": ("interlace=scan={0}:lowpass=linear", False, True),
          "ffmpeg scaled, linear": (SCALED, True, False), "ffmpeg scaled, linear, in light": (SCALED, True, True)}
WAYS = (*KERNELS, *HELD, *FFMPEG)


def run(words, **more):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, check=False, **more)
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout


def lit(filters, raster):
    """The same filters on displayed light, of 12 bits."""
    matrix = {"601-525": "170m", "601-625": "470bg", "709": "709"}[raster.rest.split(",")[-1]]
    same = f"min={matrix}:m={matrix}:pin=709:p=709:rin=tv:r=tv"  # primaries stay what they are
    return f"zscale=tin=709:t=linear:{same},format=yuv422p12,{filters},zscale=tin=linear:t=709:{same}"


class Scene:
    """A scene on a raster: its subframes, the progressive truth, and what ways make of it."""

    def __init__(self, weft, folder, raster, name):
        self.weft, self.folder, self.raster, self.name = weft, folder, raster, name
        self.subframes = self.path("sub.####.exr")
        run([weft, "trace", scene_file(name), "--raster", raster.described, "--frames", f"0-{FRAMES - 1}",
             "--oversample", "{}x{}x1".format(*OVERSAMPLE), "-q", "-o", self.subframes])
        self.truth = self.convert("truth.y4m", raster.progressive(), "--aperture", "line")
        self.large = None
        self.line = planes(self.convert("line.y4m", raster.described, "--aperture", "line"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def convert(self, name, raster, *words):
        run([self.weft, "convert", self.subframes, "--raster", raster, "-q", "--overwrite", "-o", self.path(name),
             *words])
        return self.path(name)

    def ffmpeg(self, filters, scaled, in_light):
        source = self.truth
        if scaled:
            self.large = self.large or self.convert("large.y4m", self.raster.progressive(*OVERSAMPLE), "--aperture",
                                                    "line")
            source = self.large
        filters = filters.format(self.raster.order, *self.raster.size)
        if in_light:
            filters = lit(filters, self.raster)
        run(["ffmpeg", "-nostdin", "-v", "error", "-y", "-i", source, "-vf", filters + ",format=yuv422p10", "-strict",
             "-1", self.path("way.y4m")])
        return self.path("way.y4m")

    def made(self, way):
        if way in FFMPEG:
            return self.ffmpeg(*FFMPEG[way])
        return self.convert("way.y4m", self.raster.described, *{**KERNELS, **HELD}[way])

    def measure(self, path, *words):
        said = json.loads(run([self.weft, "measure", path, "--raster", self.raster.described, "--json", *words]))
        return said[0] if isinstance(said, list) else said

    def shown(self, path):
        """What the displays get."""
        if not self.raster.composite:
            return path
        run([self.weft, "composite", path, "--raster", self.raster.name, "-q", "--overwrite", "-o",
             self.path("shown.y4m")])
        return self.path("shown.y4m")

    def row(self, way):
        path = self.made(way)
        told, shown = self.measure(path), self.shown(path)
        row = {"raster": self.raster.name, "scene": self.name, "way": way, "rms": told["flicker"]["rms"],
               "p999": told["flicker"]["p999"], "jnd": told["flicker"]["visible"]["jnd_p999"],
               "crawl": told["crawl"]["jnd_p999"], "cross_color": told["cross_color"]["rms"],
               "distance": distance(planes(path), self.line), "crt": distance(planes(shown), self.line)}
        row = {key: math.nan if value is None else value for key, value in row.items()}
        return row | deinterlaced(shown, self.truth)


def scene_file(name):
    for folder in FOLDERS:
        path = os.path.join(HERE, folder, name + ".lua")
        if os.path.exists(path):
            return path
    return sys.exit(f"defaults.py: there is no scene {name}")


def deinterlaced(path, truth):
    """Distance and SSIM of what deinterlacers make of fields, by ffmpeg's own filters,
    whose figures are those of `weft measure --display .. --against ..`, at a tenth of the time."""
    each, graph = range(len(DISPLAYS)), []
    graph.append(f"[0]split={len(DISPLAYS)}" + "".join(f"[field{n}]" for n in each))
    graph.append(f"[1]split={2 * len(DISPLAYS)}" + "".join(f"[p{n}][s{n}]" for n in each))
    for n, (name, filters) in enumerate(DISPLAYS.items()):
        graph.append(f"[field{n}]{filters},split[a{n}][b{n}];[a{n}][p{n}]psnr@{name};[b{n}][s{n}]ssim@{name}")
    said = subprocess.run(["ffmpeg", "-nostdin", "-hide_banner", "-i", path, "-i", truth, "-lavfi", ";".join(graph),
                           "-f", "null", "-"], capture_output=True, text=True, check=True).stderr
    found = {}
    for name in DISPLAYS:
        psnr = re.search(rf"psnr@{name} .*PSNR y:(\S+) u:(\S+) v:(\S+)", said).groups()
        found[name] = math.hypot(*(10 ** (-float(db) / 20) * 1023 / span for db, span in zip(psnr, SPANS)))
        found[name + "_ssim"] = float(re.search(rf"ssim@{name} .*SSIM Y:(\S+)", said).group(1))
    return found


def planes(path):
    """Y', Cb and Cr of all frames of Y4M 422p10 in shares of their spans, each [frames][lines][samples]."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.index(b"\n")
    words = {w[0]: w[1:] for w in data[:end].decode().split()[1:][::-1]}
    width, lines = int(words["W"]), int(words["H"])
    samples = np.frombuffer(b"".join(frame for frame in frames_of(data, end + 1, 4 * width * lines)), "<u2")
    samples = samples.reshape(-1, 2 * width * lines)
    luma, blue, red = np.split(samples, (width * lines, 3 * width * lines // 2), axis=1)
    return [plane.reshape(-1, lines, plane.shape[1] // lines) / span for plane, span in zip((luma, blue, red), SPANS)]


def frames_of(data, at, size):
    while at < len(data):
        at = data.index(b"\n", at) + 1
        yield data[at:at + size]
        at += size


def distance(a, b):
    """Of pictures as `planes` has them: the RMS of what differs in Y', Cb and Cr."""
    return float(math.hypot(*(np.sqrt(np.mean((p - q) ** 2)) for p, q in zip(a, b))))


# ---- What the figures speak for ----

SHOWN = ("crt", *DISPLAYS)


def mean(values):
    values = list(values)
    return sum(values) / len(values) if values else math.nan


def median(values):
    values = sorted(values)
    return (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2 if values else math.nan


def after(row):
    """The mean distance after the displays."""
    return mean(row[display] for display in SHOWN)


def of_way(rows, raster, way):
    """By scene."""
    return {row["scene"]: row for row in rows if row["raster"] == raster and row["way"] == way}


def seen(rows, raster, way):
    return median(row["jnd"] if row["jnd"] == row["jnd"] else 0 for row in of_way(rows, raster, way).values())


def chosen(rows, raster):
    ways = [way for way in NAMED if of_way(rows, raster, way)]
    calm = [way for way in ways if seen(rows, raster, way) < SEEN]
    return min(calm or ways, key=lambda way: mean(after(row) for row in of_way(rows, raster, way).values()))


def nearer(rows, raster, a, b):
    """By what share a is nearer than b after the displays, in the mean over scenes, and two standard errors of it."""
    ours, theirs = of_way(rows, raster, a), of_way(rows, raster, b)
    shares = [1 - after(ours[scene]) / after(theirs[scene]) for scene in ours if scene in theirs]
    middle = mean(shares)
    spread = math.sqrt(sum((s - middle) ** 2 for s in shares) / max(1, len(shares) - 1))
    return middle, 2 * spread / math.sqrt(max(1, len(shares)))


def beside_least(rows, raster, way, key):
    """Flicker of a way, beside that of `least` at the same distance from `line`: the median over scenes that have some."""
    ratios = []
    for scene, row in of_way(rows, raster, way).items():
        curve = sorted((r["distance"], r[key]) for r in rows if r["raster"] == raster and r["scene"] == scene and
                       (r["way"] == "line" or r["way"].startswith("least:")))
        for (d0, f0), (d1, f1) in zip(curve, curve[1:]):
            if d0 <= row["distance"] <= d1 and d1 > d0 and min(f0, f1) > STILL:
                share = (row["distance"] - d0) / (d1 - d0)
                ratios.append(row[key] / (f0 ** (1 - share) * f1 ** share))
    return median(ratios)


# ---- Telling ----

BEGIN, END = "<!-- defaults -->", "<!-- defaults end -->"
KEPT = "shaped"  # the default of every raster that has fields


def ways_table(rows, raster):
    scenes = sorted({row["scene"] for row in rows if row["raster"] == raster})
    lines = [f"{raster}, {len(scenes)} scenes ({', '.join(scenes)}):", "",
             "| way | flicker RMS | p99.9 | seen, JND | distance | tube | bwdif | yadif | w3fdif | SSIM, bwdif | "
             "RMS beside `least` |", "|---|---|---|---|---|---|---|---|---|---|---|"]
    for way in WAYS:
        own = of_way(rows, raster, way).values()
        if not own:
            continue
        cells = [f"{mean(r[k] for r in own):.4f}" for k in ("rms", "p999")] + [f"{seen(rows, raster, way):.2f}"]
        cells += [f"{mean(r[k] for r in own):.4f}" for k in ("distance", *SHOWN)]
        ratio = beside_least(rows, raster, way, "rms")
        cells += [f"{mean(r['bwdif_ssim'] for r in own):.3f}", "" if math.isnan(ratio) else f"x {ratio:.2f}"]
        lines.append(f"| {way if way in FFMPEG else '`' + way + '`'} | " + " | ".join(cells) + " |")
    return lines


def verdicts(rows):
    lines = ["| raster | scenes | the figures speak for | nearer than `shaped` by | seen, JND: it, `shaped` | default |",
             "|---|---|---|---|---|---|"]
    for raster in dict.fromkeys(row["raster"] for row in rows):
        way = chosen(rows, raster)
        share, error = nearer(rows, raster, way, KEPT)
        lines.append(f"| {raster} | {len(of_way(rows, raster, way))} | `{way}` | {100 * share:.0f} +- {100 * error:.0f} % "
                     f"| {seen(rows, raster, way):.2f}, {seen(rows, raster, KEPT):.2f} | `{KEPT}` |")
    return lines


def told(rows):
    lines = verdicts(rows)
    for raster in dict.fromkeys(row["raster"] for row in rows):
        lines += ["", *ways_table(rows, raster)]
    return lines


def draw(weft, rows, raster, path):
    """Flicker that is seen over distance after the displays."""
    items, least = [], []
    for way in WAYS:
        own = of_way(rows, raster, way).values()
        if own:
            at = [mean(after(row) for row in own), mean(row["rms"] for row in own)]
            least += [at] if way == "line" or way.startswith("least:") else []
            items.append({"kind": "points", "points": [at], "series": 2 if way in FFMPEG else 1, "radius": 2.5})
            items.append({"kind": "label", "at": at, "text": way, "series": 2 if way in FFMPEG else 0})
    items.append({"kind": "line", "points": least, "series": 3, "name": "least:MU"})
    plot = {"title": f"{raster}: flicker against distance after displays", "width": 760, "height": 520,
            "x": {"label": "distance after displays, RMS of Y', Cb, Cr"},
            "y": {"label": "flicker, RMS of white", "low": 0}, "items": items}
    run([weft, "plot", "-", "-o", path], input=json.dumps(plot))


def published(text, rows):
    """The page, with the tables of these rows between its marks."""
    head, rest = text.split(BEGIN + "\n")
    return head + BEGIN + "\n" + "\n".join(told(rows)) + "\n" + END + rest.split(END)[1]


def publish(options, rows):
    page = os.path.join(HERE, "README.md")
    with open(page, encoding="utf-8") as file:
        text = published(file.read(), rows)
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)
    write_csv(PUBLISHED, rows)
    for raster in dict.fromkeys(row["raster"] for row in rows):
        draw(os.path.join(options.build, "weft"), rows, raster, os.path.join(HERE, "results", f"defaults_{raster}.svg"))
    return 0


def is_default(weft, raster, folder):
    """Whether a raster's pixels without --aperture are those of KEPT, and not those of `line`."""
    made = {}
    for name, words in {"none": (), KEPT: ("--aperture", KEPT), "line": ("--aperture", "line")}.items():
        path = os.path.join(folder, name + ".y4m")
        run([weft, "render", scene_file("zoneplate"), "--raster", raster, "--frames", "0", "--samples", "1", "-q",
             "--overwrite", "-o", path, *words])
        with open(path, "rb") as file:
            made[name] = file.read()
    return made["none"] == made[KEPT] != made["line"]


def check(options):
    rows, failures = read_csv(PUBLISHED), []
    with open(os.path.join(HERE, "README.md"), encoding="utf-8") as file:
        text = file.read()
    if published(text, rows) != text:
        failures.append("README.md is not what results/defaults.csv gives")
    with tempfile.TemporaryDirectory() as folder:
        failures += [f"{raster}: the default is not {KEPT}" for raster in dict.fromkeys(row["raster"] for row in rows)
                     if not is_default(os.path.join(options.build, "weft"), raster, folder)]
    print("\n".join(failures) or "they agree")
    return 1 if failures else 0


# ---- Running ----

def scene_rows(job):
    """All rows of a scene on a raster. It is a process of its own."""
    weft, raster, scene, ways = job
    with tempfile.TemporaryDirectory() as folder:
        made = Scene(weft, folder, next(r for r in RASTERS if r.name == raster), scene)
        return [made.row(way) for way in ways]


def write_csv(path, rows):
    with open(path + ".part", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items()})
    os.replace(path + ".part", path)


def read_csv(path):
    def value(key, text):
        return text if key in ("raster", "scene", "way") else float(text) if text else math.nan
    with open(path, encoding="utf-8", newline="") as file:
        return [{k: value(k, v) for k, v in row.items()} for row in csv.DictReader(file)]


def gather(options, path):
    jobs = [(os.path.join(options.build, "weft"), raster, scene, options.ways) for scene in options.scenes
            for raster in options.rasters]
    rows = read_csv(path) if options.resume and os.path.exists(path) else []
    done = {(row["scene"], row["raster"]) for row in rows}
    jobs = [job for job in jobs if (job[2], job[1]) not in done]
    with multiprocessing.Pool(options.jobs) as pool:
        for found in pool.imap_unordered(scene_rows, jobs):
            rows += found
            write_csv(path, rows)
            print(f"{found[0]['scene']} on {found[0]['raster']}", file=sys.stderr, flush=True)
    return rows


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("build")
    parser.add_argument("--rasters", default="525i,625i,1080i50")
    parser.add_argument("--scenes", default=",".join(SCENES))
    parser.add_argument("--ways")
    parser.add_argument("--out")
    parser.add_argument("--resume", action="store_true", help="only what DIR has no figures of yet")
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--publish", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    options.out = options.out or os.path.join(options.build, "defaults")
    os.makedirs(options.out, exist_ok=True)
    if options.small:
        options.rasters, options.scenes, options.ways = SMALL
    options.rasters, options.scenes = options.rasters.split(","), options.scenes.split(",")
    options.ways = options.ways.split(";") if options.ways else WAYS
    return options


def main():
    options = arguments()
    path = os.path.join(options.out, "defaults.csv")
    if options.check:
        return check(options)
    if options.publish:
        return publish(options, read_csv(path))
    rows = gather(options, path)
    print("\n".join(told(rows)))
    for raster in options.rasters:
        draw(os.path.join(options.build, "weft"), rows, raster, os.path.join(options.out, f"defaults_{raster}.svg"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
