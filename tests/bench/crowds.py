"""What rays cost among many solids, beside Embree and POV-Ray."""
import os
import re
import shutil
import struct
import subprocess

import scenes as curves

HERE = os.path.dirname(os.path.abspath(__file__))
PEERS = os.path.join(HERE, "..", "peers")
RASTER = ("--raster", "360x243@30p", "--temporal-width", "0", "--aperture", "line", "--frames", "0")


def scene(name):
    return os.path.join(HERE, "many", name + ".lua")


def crowd(bench, name, samples, *params):
    """What bench-crowd prints, as numbers; of three runs the least time of tracing."""
    runs = []
    for _ in range(1 if "n=1000000" in params else 3):
        words = bench.text("crowd", scene(name), samples, *params).split()
        runs.append({k: float(v) for k, v in zip(words[::2], words[1::2])})
    return min(runs, key=lambda r: r["trace"])


# ---- The table of N ----

def embree(bench, count):
    """Seconds of tracing by Embree; None: it is not built."""
    peer = os.path.join(bench.build, "tests", "peer-embree")
    if not os.path.exists(peer):
        return None
    balls = subprocess.run([bench.program("crowd"), scene("spheres"), "spheres", f"n={count}"],
                           check=True, capture_output=True).stdout
    said = [subprocess.run([peer, "4"], input=balls, check=True, capture_output=True).stdout
            for _ in range(3)]
    return min(float(text.split()[3]) for text in said)


def many(bench):
    before, rows = None, []
    for count in (10**3, 10**4, 10**5) if bench.small else (10**3, 10**4, 10**5, 10**6):
        found = crowd(bench, "spheres", 4, f"n={count}")
        peer = embree(bench, count)
        rows.append((count, found["load"], found["build"], found["trace"], found["peak_mb"],
                     peer or ""))
        note = f"{found['trace']:.3f} s"
        if before:
            bench.target(f"{count:,} spheres, beside a tenth as many", found["trace"] / before,
                         most=2, note=note)
        bench.target(f"{count:,} spheres, beside Embree", peer and found["trace"] / peer, most=4,
                     note=note + (f" and {peer:.3f} s" if peer else "; no Embree"))
        before = found["trace"]
    bench.save("crowds.csv", ("spheres", "load_s", "build_s", "trace_s", "peak_mb", "embree_s"),
               rows)
    if not bench.small:
        bench.target("a million spheres: loading, building and tracing", sum(rows[-1][1:4]),
                     most=10, unit="s of one thread")
        bench.target("a million spheres: memory", rows[-1][4], most=4096, unit="MB")


def secondary(bench):
    """Nanoseconds of a ray and what it asks of others, beside one from the camera."""
    for count in (1000, 100000):
        plain = crowd(bench, "spheres", 4, f"n={count}")
        each = plain["trace"] / plain["rays"]
        for what in ("reflect", "refract"):
            found = crowd(bench, "spheres", 4, f"n={count}", what + "=0.5")
            extra = (found["trace"] - plain["trace"]) / (found["rays"] - plain["rays"])
            bench.target(f"rays that {count:,} spheres {what}, beside those before them",
                         extra / each, most=2, note=f"{1e9 * extra:.0f} and {1e9 * each:.0f} ns")


# ---- POV-Ray, to equal error ----

def write_balls(bench, folder):
    data = subprocess.run([bench.program("crowd"), scene("spheres"), "spheres", "n=1000"],
                          check=True, capture_output=True).stdout
    with open(os.path.join(folder, "balls.inc"), "w") as f:
        f.writelines("Ball(" + ", ".join(f"{v:.9g}" for v in ball) + ")\n"
                     for ball in struct.iter_unpack("7f", data))


def pov(folder, name, across, to, scale=1):
    """CPU seconds of tracing by POV-Ray, on one thread."""
    said = subprocess.run(["povray", f"+I{name}.pov", "-D", "-J", "+WT1", f"+W{360 * scale}",
                           f"+H{243 * scale}", "+AM1", "+A0.0", f"+R{across}", "+FE", "+O" + to],
                          cwd=folder, check=True, capture_output=True, text=True)
    text = (said.stdout + said.stderr).replace("\r", "\n")
    return float(re.findall(r"Trace Time:.*?([\d.]+) CPU-seconds", text, re.S)[-1])


def their_points(bench, folder, name):
    fine, truth = bench.path("pov-fine.exr"), bench.path("pov-truth.exr")
    pov(folder, name, 8, fine, scale=4)
    subprocess.run(["oiiotool", fine, "--resize:filter=box", "360x243", "-d", "float", "-o", truth],
                   check=True)
    points = []
    for across in (2, 3, 4, 6, 9):
        path = bench.path("pov.exr")
        seconds = pov(folder, name, across, path)
        points.append((seconds, float(bench.text("compare", truth, path).split()[0])))
    return points


def our_points(bench, name):
    curve = curves.Curve(bench, scene(name), RASTER[1], 0, *RASTER[2:6])
    curve.converge(1024)
    points = []
    for samples in (4, 8, 16, 32, 64):
        rmse = curve.point("--samples", samples)[1]
        points.append((crowd(bench, name, samples)["trace"], rmse))
    return points


def beside_pov(bench):
    folder = bench.path("crowds")
    shutil.copytree(PEERS, folder)
    write_balls(bench, folder)
    rows = []
    for name, what in (("spheres", "1,000 spheres"), ("dice", "set operations"),
                       ("mirrors", "mirrors")):
        theirs, ours = their_points(bench, folder, name), our_points(bench, name)
        rows += [("POV-Ray", name, *p) for p in theirs] + [("weft", name, *p) for p in ours]
        for rmse in (0.02, 0.01):
            mine, other = curves.time_to(ours, rmse), curves.time_to(theirs, rmse)
            bench.target(f"{what} to {rmse:g}, beside POV-Ray", mine and other and other / mine,
                         least=5, unit="x faster", note=mine and other and
                         f"{mine:.3f} s and {other:.2f} s of one thread")
    bench.save("crowd_peers.csv", ("program", "scene", "seconds", "rmse"), rows)


def crowds(bench):
    many(bench)
    secondary(bench)
    if bench.small or not shutil.which("povray") or not shutil.which("oiiotool"):
        for what in ("1,000 spheres", "set operations", "mirrors"):
            bench.target(f"{what} to 0.02 and 0.01, beside POV-Ray", None, least=5,
                         note="--small" if bench.small else "no povray or oiiotool")
    else:
        beside_pov(bench)
