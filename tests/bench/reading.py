"""What reading EXR and starting take: weft beside ffmpeg, OpenEXRCore alone and an older weft."""
import os
import resource
import shutil
import subprocess
import time

RATE = ("--subframe-rate", "480000/1001", "--temporal-width", "1", "--raster", "525i")
ASKED = {"piz": 2, "dwaa": 4, "dwab": 4, "zips": 3, "zip": 3, "pxr24": 3, "rle": 2}
KEPT = 1.05  # what never was slow may take of an older program's time: turns differ by as much


def busy_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def seconds_of(way):
    """What the processor gives children of this process while `way` runs, and seconds of a clock."""
    before, began = busy_s(), time.perf_counter()
    way()
    return busy_s() - before, time.perf_counter() - began


def in_turn(rounds, ways):
    """Medians of both for functions that take turns; of one that fails, None."""
    found = {name: [] for name in ways}
    for _ in range(rounds):
        for name, way in ways.items():
            try:
                found[name].append(seconds_of(way))
            except subprocess.CalledProcessError:
                found[name] = None
        ways = {name: way for name, way in ways.items() if found[name] is not None}
    return {name: times and [sorted(t)[rounds // 2] for t in zip(*times)] for name, times in found.items()}


def older_weft(bench, *arguments):
    subprocess.run([bench.before, *arguments, "-q", "--threads", "2", "--overwrite"], check=True)


# ---- Compressions ----

def noisy(bench, how):
    """48 subframes of which no chunk is like another, made by one process."""
    folder = bench.path(how)
    os.makedirs(folder)
    files = [os.path.join(folder, f"{n:04}.exr") for n in range(48)]
    command = ["oiiotool", "--nosoftwareattrib"]  # whose lines would be longer than ffmpeg reads
    for n, name in enumerate(files):
        plain = bench.path(f"none/{n:04}.exr")
        command += [bench.wheel[n], f"--noise:type=gaussian:stddev=.03:seed={n}", "--clamp:min=0"] if how == "none" else [plain]
        command += ["-d", "half", "--compression", how, "-o", name, "--pop"]
    subprocess.run(command, check=True)
    return files


def ways_to_read(bench, files, ffmpeg, older):
    ways = {"weft": lambda: bench.weft("convert", *files, *RATE, "-o", bench.path("a.y4m"))}
    if ffmpeg:
        ways["ffmpeg"] = lambda: ffmpeg(bench, files)
    ways["core"] = lambda: subprocess.run([bench.program("core"), "2", *files], check=True)
    if older and bench.before:
        ways["older"] = lambda: older_weft(bench, "convert", *files, *RATE, "-o", bench.path("b.y4m"))
    return ways


def keep(bench, what, found):
    """That what was fast before stays so."""
    now, older = found["weft"][0], found.get("older")
    bench.target(f"{what}, beside an older weft", older and now / older[0], most=KEPT, unit="x its time",
                 note=f"{now:.2f} and {older[0]:.2f} s of the processor" if older else "--before names none")


def compressions(bench, ffmpeg):
    """48 noisy subframes in the compressions of other renderers, and the wheel as it is."""
    if bench.small:
        return
    ready = len(bench.wheel) >= 48 and shutil.which("oiiotool") and shutil.which("ffmpeg")
    if ready:
        noisy(bench, "none")
    for how, least in ASKED.items():
        what = f"48 noisy subframes of {how.upper()}"
        if not ready:
            bench.target(f"{what}, beside ffmpeg", None, least=least, note="wants wheel/, oiiotool, ffmpeg")
            continue
        found = in_turn(bench.rounds, ways_to_read(bench, noisy(bench, how), ffmpeg, how == "zip"))
        weft, peer, core = found["weft"][0], found["ffmpeg"][0], found["core"]
        alone = f"OpenEXRCore alone {core[0]:.2f}" if core else "OpenEXRCore does not read it"
        bench.target(f"{what}, beside ffmpeg", peer / weft, least=least, unit="x faster",
                     note=f"{weft:.2f} and {peer:.2f} s of the processor; {alone}")
        if how == "zip":
            keep(bench, what, found)
        shutil.rmtree(bench.path(how))
    if bench.wheel:
        keep(bench, "the wheel", in_turn(bench.rounds, ways_to_read(bench, bench.wheel, None, True)))


# ---- Starting ----

def startup(bench):
    """One small frame of one sphere: what is left is to start, to load libraries, and to end."""
    if bench.small:
        return
    scene = bench.path("sphere.lua")
    with open(scene, "w") as f:
        f.write("camera{eye={0, 0, 9}, look_at={0, 0, 0}}\nlight{point={5, 5, 5}}\nadd(sphere{})\n")
    small = ("--raster", "96x64@30i", "--frames", "0", "--samples", "1")
    outputs = {"Y4M": "a.y4m", "EXR": "a.####.exr", "PNG": "a.####.png"}
    ways = {kind: lambda name=name: subprocess.run(
        [bench.program("weft"), "render", scene, *small, "-q", "--threads", "2", "--overwrite", "-o", bench.path(name)],
        check=True) for kind, name in outputs.items()}
    if bench.before:
        ways |= {f"older {kind}": lambda name=name: older_weft(bench, "render", scene, *small, "-o", bench.path(name))
                 for kind, name in outputs.items()}
    found = in_turn(5 * bench.rounds, ways)
    for kind in outputs:
        busy, clock = (1e3 * s for s in found[kind])
        older = found.get(f"older {kind}")
        note = f"{clock:.0f} ms of a clock" + (f"; an older weft {1e3 * older[0]:.0f} and {1e3 * older[1]:.0f}" if older else "")
        bench.target(f"one sphere to {kind}, from start to end", busy, most=40, unit="ms of the processor", note=note)
