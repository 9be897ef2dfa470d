"""Jobs of every kind, in each of which one call fails: memory, threads, files opened, read, written, synced, named and closed, a
full disk, a process that is killed. See README.md.

    campaign.py --folder NEW [--every | --few N] [--who weft|far] [--faults alloc,read] [--jobs NAME,..] [--resumes N]

Without --every N calls of each kind are tried, else all (no more than MOST of a job and kind). Prints a line of counts for
each job and what went wrong, and ends with 1 if anything did."""
import argparse
import concurrent.futures
import hashlib
import os
import random
import re
import shutil
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

BUILD = Path(os.environ["WEFT_BUILD"])
SOURCE = Path(os.environ["WEFT_SOURCE"])
WEFT = os.environ["WEFT"]
FAULTS = ["alloc", "thread", "open", "read", "write", "sync", "name", "close", "disk", "kill"]
MOST, HANG_S = 2000, 10
RASTER = "48x36@30i,tff"
SCENE = SOURCE / "examples/scenes/carousel.lua"
SMALL = ["--raster", RASTER, "-q"]
# What the message of a run that failed must say of each kind.
SAYS = {"alloc": "memory|allocat", "open": "Too many open files", "read": "Input/output error", "write": "No space left",
        "sync": "Input/output error", "name": "Input/output error", "close": "Input/output error", "disk": "No space left"}


def convert(*more):
    return [WEFT, "convert", "in.####.exr", "--fit", "stretch", *SMALL, *more]


def python_job():
    return [sys.executable, "-P", "-c", "import sys, weft\ntry: weft.Job('in.####.exr', output=sys.argv[1], raster='" + RASTER
            + "', fit='stretch').run()\nexcept weft.WeftError as e: sys.exit(f'weft: {e}')\n"
            "except MemoryError as e: sys.exit(f'weft: out of memory: {e}')", "run/o.y4m"]


def python_questions():
    """A host that asks what the commands tell, and goes on after a failure."""
    return [sys.executable, "-P", "-c", """
import sys, weft
wrong = 0
def right(v):
    if not v['right']: raise ZeroDivisionError(str(v))
for ask in (lambda: weft.measure('video.y4m'), lambda: right(weft.verify('video.y4m', raster='%s')[0]),
            lambda: weft.info('video.y4m'), lambda: weft.filters('box'), lambda: weft.read('video.y4m', frames=1)):
    try:
        ask()
    except (weft.Error, MemoryError, ZeroDivisionError) as e:
        print('weft: memory:' if isinstance(e, (MemoryError, ZeroDivisionError)) else 'weft:', e, file=sys.stderr)
        wrong = 1
sys.exit(wrong)""" % RASTER]


def jobs():
    """Name, command, and how it is resumed where it can be."""
    found = {
        "exr-y4m": convert("-o", "run/o.y4m", "--report", "run/report.json"),
        "exr-exr": convert("-o", "run/o.####.exr"),
        "exr-png": convert("-o", "run/o.####.png"),
        "exr-dpx": convert("-o", "run/o.####.dpx", "--fields", "separate"),
        "exr-mxf": convert("--codec", "uyvy", "--audio", "silent:2", "-o", "run/o.mxf"),
        "exr-key": convert("--alpha-out", "--key", "run/key.y4m", "-o", "run/o.####.tif"),
        "exr-calm": convert("--flicker-limit", ".02", "--legalize", "r103", "-o", "run/o.y4m"),
        "exr-ocio": convert("--ocio", str(SOURCE / "color/weft.ocio"), "--from", "ACEScg", "--to", "rec709", "-o", "run/o.y4m"),
        "deep-y4m": [WEFT, "convert", "deep.####.exr", *SMALL, "-o", "run/o.y4m"],
        "png-y4m": [WEFT, "convert", "p.####.png", "--subframe-rate", "60", *SMALL, "-o", "run/o.y4m"],
        "y4m-y4m": [WEFT, "convert", "pictures.y4m", "--raster", "48x36@25i,tff", "-q", "-o", "run/o.y4m"],
        "job-file": [WEFT, "convert", "--job", "job.json"],
        "job-list": [WEFT, "convert", "--job", "list.json", "--report", "run/report.json"],
        "render": [WEFT, "render", str(SCENE), *SMALL, "--samples", "2", "--frames", "0-1", "-o", "run/o.y4m"],
        "render-error": [WEFT, "render", str(SCENE), *SMALL, "--error", ".1", "--frames", "0", "-o", "run/o.y4m"],
        "trace-deep": [WEFT, "trace", str(SCENE), *SMALL, "--samples", "2", "--frames", "0-1", "-o", "run/o.####.exr"],
        "trace": [WEFT, "trace", str(SCENE), *SMALL, "--samples", "1", "--frames", "0", "--oversample", "1x1x2", "-o",
                  "run/o.####.exr"],
        "measure": [WEFT, "measure", "video.y4m", "--json", "--heatmap", "run/heat.png"],
        "against": [WEFT, "measure", "video.y4m", "--against", "video.y4m"],
        "verify": [WEFT, "verify", "video.y4m", "--raster", RASTER],
        "composite": [WEFT, "composite", "sd.y4m", "-o", "run/o.y4m", "--decoder", "comb3"],
        "plan": [WEFT, "plan", "--raster", "525i", "--frames", "0-9", "--subframe-rate", "240"],
        "design": [WEFT, "filters", "design", "sharp=0.7,support=3", "--json"],
        "filters": [WEFT, "filters", "shaped", "--input-lines", "1080", "--plot", "run/shaped.png"],
        "info": [WEFT, "info", "--json", "in.####.exr", "video.y4m"],
        "push": [str(BUILD / "tests/hard-push"), "run/o.y4m"],
        "python": python_job(),
        "python-questions": python_questions(),
    }
    if list(BUILD.glob("**/weft-libav.so")):
        found |= {"exr-mov": convert("--codec", "prores", "--audio", "silent:2", "-o", "run/o.mov"),
                  "mov-y4m": [WEFT, "convert", "pictures.mov", "--raster", "48x36@25i,tff", "-q", "-o", "run/o.y4m"],
                  "verify-mov": [WEFT, "verify", "video.mov", "--raster", RASTER]}
    return found


def run_plain(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        sys.exit(f"{command}: {done.returncode}\n{done.stderr}")


def make_inputs(folder):
    """What the jobs read, made by weft itself."""
    for command in (
            [WEFT, "trace", str(SCENE), *SMALL, "--samples", "1", "--frames", "0-1", "--oversample", "1x1x4", "-o", "in.####.exr"],
            [WEFT, "trace", str(SCENE), *SMALL, "--samples", "2", "--frames", "0-1", "-o", "deep.####.exr"],
            [WEFT, "convert", "in.####.exr", "--fit", "stretch", *SMALL, "-o", "video.y4m"],
            [WEFT, "convert", "in.####.exr", "--fit", "stretch", "--raster", "48x36@60p", "-q", "-o", "p.####.png"],
            [WEFT, "convert", "in.####.exr", "--fit", "stretch", "--raster", "48x36@60p", "-q", "-o", "pictures.y4m"],
            [WEFT, "render", str(SCENE), "--raster", "525i", "-q", "--samples", "1", "--frames", "0", "-o", "sd.y4m"]):
        run_plain(command, folder)
    if list(BUILD.glob("**/weft-libav.so")):
        for raster, codec, name in ((RASTER, "v210", "video.mov"), ("48x36@60p", "prores", "pictures.mov")):
            run_plain([WEFT, "convert", "in.####.exr", "--fit", "stretch", "--raster", raster, "-q", "--codec", codec, "--audio",
                       "silent:2", "-o", name], folder)
    (folder / "job.json").write_text('{"inputs": ["in.####.exr"], "output": "run/o.y4m", "fit": "stretch", "raster": "'
                                     + RASTER + '"}')
    (folder / "list.json").write_text('{"inputs": "in.####.exr", "fit": "stretch", "raster": "' + RASTER
                                      + '", "jobs": [{"output": "run/o.y4m"}, {"output": "run/p.#.png"}]}')


class Place:
    """A directory that has the inputs, and an empty folder for what a run makes."""

    def __init__(self, top, number):
        self.folder = top / f"place{number}"
        self.folder.mkdir()
        for path in (top / "inputs").iterdir():
            shutil.copy(path, self.folder / path.name)
        self.run = self.folder / "run"
        self.log = top / f"log{number}"

    def clear(self):
        shutil.rmtree(self.run, ignore_errors=True)
        self.run.mkdir()

    def made(self):
        """Names and digests of what stands there; of reports only that they do."""
        return {p.name: "report" if p.name == "report.json" else hashlib.sha256(p.read_bytes()).hexdigest()
                for p in self.run.iterdir()}

    def do(self, command, fault, who, limit_s):
        env = os.environ | {"LD_PRELOAD": str(BUILD / "tests/libfaults.so"), "WEFT_FAULT": fault, "WEFT_FAULT_WHO": who,
                            "WEFT_FAULT_LOG": str(self.log), "PYTHONPATH": str(BUILD / "lib/python3/dist-packages"),
                            "WEFT_LIBRARY": str(BUILD / "lib/libweft.so"), "ASAN_OPTIONS": "verify_asan_link_order=0"}
        self.log.unlink(missing_ok=True)
        try:
            done = subprocess.run(command, cwd=self.folder, env=env, capture_output=True, timeout=limit_s, check=False)
        except subprocess.TimeoutExpired:
            return "hang", b"", ""
        return done.returncode, done.stdout, done.stderr.decode(errors="replace")

    def counted(self):
        words = self.log.read_text().split() if self.log.exists() else []
        return [int(w) for w in words[:2]] + words[2:]


def judge(kind, result, whole, place):
    """What is wrong with how a run ended; None if nothing is."""
    (code, out, said), (good_code, good_out, _, good_made) = result, whole
    if code == "hang":
        return "it hangs"
    made, told = place.made(), out.decode(errors="replace")
    if code == good_code:
        if kind in SAYS and out != good_out and re.search(SAYS[kind], told):
            return None  # info and verify tell of what they could not read, and go on
        if made != good_made:
            return f"exit {code}, but {sorted(made)} are not what they should be"
        return None if out == good_out or kind.startswith("python") else f"exit {code}, but it prints something else"
    if kind == "kill" and code == -9:
        wrong = [n for n, digest in made.items() if not n.endswith(".tmp") and digest != good_made.get(n)]
        return f"half-written after SIGKILL: {wrong}" if wrong else None
    if code < 0 or code > 3 or code == 0:
        return f"ended by {code}: {said[-300:]}"
    if kind in ("alloc", "thread") and code == 2:
        return f"no memory is told as a fault of the request: {said.strip()[:300]}"
    if not re.search("weft: .", said):
        return f"exit {code} without a message"
    wrong = [n for n, digest in made.items() if n.endswith(".tmp") or digest != good_made.get(n)]
    if wrong:
        return f"exit {code}, and {wrong} left: {said.strip()[:300]}"
    if kind in SAYS and not re.search(SAYS[kind], said + told, re.IGNORECASE):
        return f"its message does not tell why: {said.strip()[:300]}"
    return None


def places_to_fail(kind, total, written, options):
    """Which calls: all, or a few of them, always the first and the last."""
    if kind == "disk":
        return list(range(1, written + 1, 4096 if options.every else max(written // options.few, 1)))
    most = MOST if options.every else options.few
    ends = {1, total} if total else set()
    between = range(2, total)
    return sorted(ends.union(random.sample(between, min(max(most - 2, 0), len(between)))))


def try_one(task):
    name, command, kind, number, tail, who, whole, pool = task
    place = pool.pop()
    fault = f"{kind}:{number}{tail}"
    try:
        place.clear()
        result = place.do(command, fault, who, HANG_S)
        if result[0] == "hang":  # a loaded machine is slow too
            place.clear()
            result = place.do(command, fault, who, 6 * HANG_S)
        wrong = judge(kind, result, whole, place)
        met = place.counted()[2:] or [who]
        return name, kind, fault, result[0], wrong, met[0]
    finally:
        pool.append(place)


def resumes(command, place, whole):
    """After SIGKILL at any moment, the same job with --resume makes what an undisturbed one does."""
    place.clear()
    began = time.monotonic()
    subprocess.run(command, cwd=place.folder, capture_output=True, check=False)
    took = time.monotonic() - began
    place.clear()
    child = subprocess.Popen(command, cwd=place.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(random.uniform(0, took))
    child.kill()
    child.wait()
    left = len(place.made())
    done = subprocess.run([*command, "--resume"], cwd=place.folder, capture_output=True, text=True, check=False)
    made = {n: d for n, d in place.made().items() if not n.endswith(".tmp")}
    if done.returncode or made != whole[3]:
        return f"killed with {left} files, then --resume: {done.returncode}, {done.stderr.strip()}, {sorted(made)}"
    return None


def undisturbed(command, place):
    place.clear()
    code, out, said = place.do(command, "alloc", "weft", 120)
    if code not in (0, 1, 3):
        sys.exit(f"{command}: {code}\n{said}")
    return code, out, said, place.made()


def count_calls(command, place, kind, who):
    place.clear()
    place.do(command, kind, who, 120)
    return place.counted()


def tasks_of(name, command, options, whole, place, pool):
    for kind in options.faults:
        if kind == "kill" and whole[0] != 0:
            continue
        total, written, *_ = count_calls(command, place, kind, options.who) or (0, 0)
        tails = ("", ":more") if kind == "alloc" else ("",)
        for number in places_to_fail(kind, total, written, options):
            for tail in tails:
                yield name, command, kind, number, tail, options.who, whole, pool


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--every", action="store_true")
    parser.add_argument("--who", default="weft", choices=["weft", "far"])
    parser.add_argument("--faults", default=FAULTS, type=lambda text: text.split(","))
    parser.add_argument("--jobs", default=None, type=lambda text: text.split(","))
    parser.add_argument("--few", default=3, type=int)
    parser.add_argument("--resumes", default=0, type=int)
    parser.add_argument("--parallel", default=2, type=int)
    parser.add_argument("--folder", type=Path, required=True)
    return parser.parse_args()


def main():
    options = parse()
    random.seed(1)
    (options.folder / "inputs").mkdir(parents=True)
    make_inputs(options.folder / "inputs")
    pool = [Place(options.folder, n) for n in range(options.parallel + 1)]
    runs = faults = ended = 0
    for name, command in jobs().items():
        if options.jobs and name not in options.jobs:
            continue
        place = pool.pop()
        whole = undisturbed(command, place)
        tasks = list(tasks_of(name, command, options, whole, place, pool))
        with concurrent.futures.ThreadPoolExecutor(options.parallel) as threads:
            results = list(threads.map(try_one, tasks))
        wrong = [r for r in results if r[4]]
        if options.who == "far":
            print(f"{name:14}", *(f"{met}: {n}" for met, n in Counter(r[5] for r in wrong).items()), flush=True)
            runs, ended = runs + len(results), ended + len(wrong)
            pool.append(place)
            continue
        if "####" in command[-1] and "--key" not in command and whole[0] == 0:
            for _ in range(options.resumes):
                runs += 1
                why = resumes(command, place, whole)
                if why:
                    wrong.append((name, "resume", "resume", 0, why, "weft"))
        pool.append(place)
        counts = {k: sum(r[1] == k for r in results) for k in options.faults}
        print(f"{name:14}", " ".join(f"{k} {n}" for k, n in counts.items() if n), f"wrong {len(wrong)}", flush=True)
        shown = {}
        for _, kind, fault, _code, why, met in wrong:
            shown.setdefault((kind, met, why), []).append(fault)
        for (kind, met, why), which in shown.items():
            print(f"    {met}: {which[0]} (and {len(which) - 1} more): {why}", flush=True)
        runs, faults = runs + len(results), faults + len(wrong)
    print(f"{runs} runs, {faults} faults" if options.who == "weft" else
          f"{runs} runs in which a library's call failed, {ended} ended badly in that library")
    return faults > 0


if __name__ == "__main__":
    sys.exit(main())
