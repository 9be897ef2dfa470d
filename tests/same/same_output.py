"""Compares the results of same_output.sh: two directories with one for each job, in which are `files`,
`stdout`, `stderr` and `exit`. Names of jobs come on standard input.

  same_output.py OLD NEW <NAMES
"""
import difflib
import json
import os
import re
import shutil
import stat
import sys
from pathlib import Path

MOST_LINES = 12  # of a job's diff
TIMED_OUT = {"124", "137"}
# Keys of JSON that the new program may have where the old one has none.
ADDED = {"touched_share", "outside_share", "worst_frame_share"}
# What depends on the clock or on processes, in what is printed for people.
MASKS = [(re.compile(pattern, re.M), to) for pattern, to in (
    (rb"\bin \d+\.\d+ s\b", b"in T s"),
    (rb"\d+\.\d+ a second$", b"R a second"),
    (rb"(?:\r[^\r\n]* left)+", b"\r<progress>"),
    (rb"(: line \d+:) +\d+ ", rb"\1 PID "),
)]


# ---- What is in a file ----

def masked(data):
    for pattern, to in MASKS:
        data = pattern.sub(to, data)
    return data


def timeless(value):
    """JSON without what a run takes of time and memory."""
    if isinstance(value, list):
        return [timeless(v) for v in value]
    if not isinstance(value, dict):
        return value
    dropped = {"seconds", "peak_memory_bytes"}
    if "stage" in value:  # progress
        dropped |= {"frames_per_second", "frame_part"}
    return {k: timeless(v) for k, v in value.items() if k not in dropped}


def unfinished(value):
    """Progress comes at intervals of time; only its end is sure to."""
    return isinstance(value, dict) and "stage" in value and value.get("frames_done") != value.get("frames_total")


def parts(text):
    """Text, and the JSON that begins a line of it, in order."""
    decoder, found, at = json.JSONDecoder(), [], 0
    for begin in re.finditer(r"^[\[{]", text, re.M):
        if begin.start() < at:
            continue
        try:
            value, end = decoder.raw_decode(text, begin.start())
        except ValueError:
            continue
        found.append(text[at:begin.start()])
        if not unfinished(value):
            found.append(timeless(value))
        at = end
    found.append(text[at:])
    return [p for p in found if not isinstance(p, str) or p.strip()]


def shown(part):
    return part if isinstance(part, str) else json.dumps(part, indent=1, sort_keys=True)


def without_added(old, new):
    """The new value without keys that it may have and the old one lacks."""
    if isinstance(old, dict) and isinstance(new, dict):
        return {k: without_added(old.get(k), v) for k, v in new.items() if k in old or k not in ADDED}
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        return [without_added(a, b) for a, b in zip(old, new)]
    return new


def text_diff(old, new):
    lines = difflib.unified_diff(old.splitlines(), new.splitlines(), "old", "new", n=0, lineterm="")
    return [line[:200] for line in list(lines)[2:]]


def compare_text(old, new):
    """Differences of two texts that may hold JSON; none if there are none that count."""
    if old == new:
        return []
    a, b = parts(old), parts(new)
    if len(a) == len(b):
        b = [without_added(x, y) for x, y in zip(a, b)]
    if a == b:
        return []
    return text_diff("\n".join(map(shown, a)), "\n".join(map(shown, b))) or ["the kinds or orders of values differ"]


def compare_bytes(old, new):
    differing = sum(x != y for x, y in zip(old, new))
    if not differing:
        return [f"{len(old)} bytes, now {len(new)}; the shorter begins the longer"]
    first = next(i for i, (x, y) in enumerate(zip(old, new)) if x != y)
    size = f"{len(old)} bytes" if len(old) == len(new) else f"{len(old)} bytes, now {len(new)}"
    return [f"{size}; {differing} of them differ, the first at {first}: {old[first]:02x}, now {new[first]:02x}"]


def compare_data(old, new):
    if old == new:
        return []
    try:
        return compare_text(masked(old).decode(), masked(new).decode())
    except UnicodeDecodeError:
        return compare_bytes(old, new)


# ---- Jobs ----

def listing(root):
    """What is in a directory: kinds and modes by names."""
    found = {}
    for folder, folders, files in os.walk(root):
        for name in folders + files:
            path = Path(folder, name)
            mode = stat.filemode(path.lstat().st_mode)
            found[str(path.relative_to(root))] = mode + (" -> " + os.readlink(path) if path.is_symlink() else "")
    return found


def compare_files(old, new):
    a, b = listing(old), listing(new)
    differences = [f"{name}: {'is gone' if name not in b else 'is new'}" for name in sorted(a.keys() ^ b.keys())]
    for name in sorted(a.keys() & b.keys()):
        if a[name] != b[name]:
            differences.append(f"{name}: was {a[name]}, is {b[name]}")
        elif a[name][0] == "-" and (old / name).stat().st_size + (new / name).stat().st_size:
            found = compare_data((old / name).read_bytes(), (new / name).read_bytes())
            differences += [f"{name}: {line}" for line in found]
    return differences


def compare_job(old, new):
    codes = [(d / "exit").read_text().strip() for d in (old, new)]
    differences = [f"{side}: took too long" for side, code in zip(("old", "new"), codes) if code in TIMED_OUT]
    if codes[0] != codes[1]:
        differences.append(f"exit code {codes[0]}, now {codes[1]}")
    for stream in ("stdout", "stderr"):
        data = [(d / stream).read_bytes() for d in (old, new)]
        differences += [f"{stream}: {line}" for line in compare_data(*data)]
    return differences + compare_files(old / "files", new / "files")


def tell(name, differences):
    print(f"{name}: {len(differences)} differences" if len(differences) > 1 else f"{name}: {differences[0]}")
    if len(differences) > 1:
        print(*("    " + line for line in differences[:MOST_LINES]), sep="\n")
    if len(differences) > MOST_LINES:
        print("    ..")


def main(old, new):
    failed = passed = 0
    for name in sys.stdin.read().split():
        a, b = old / name, new / name
        differences = compare_job(a, b)
        if differences:
            failed += 1
            tell(name, differences)
        else:
            passed += 1
            shutil.rmtree(b)
        if (a / "exit").read_text().strip() in TIMED_OUT:
            shutil.rmtree(a)
    if failed:
        print(f"what they made: {old}, {new}")
    print(f"{passed} passed, {failed} failed")
    return failed > 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])))
