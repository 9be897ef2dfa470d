#!/usr/bin/env python3
"""Renders by a plan on many machines: one lists what is wanted, many render their parts of it.

  plan.py list FOLDER PLAN_OPTION...         writes FOLDER/wanted/list.json: what `weft plan` wants now
  plan.py render I N FOLDER COMMAND...       renders the I-th of N parts of it

COMMAND is called with NUMBER SECONDS WIDTH HEIGHT X0 Y0 X1 Y1 FILE behind it, and renders pixels X0 to X1
and Y0 to Y1 (not included) of subframe NUMBER, the moment SECONDS ("3/400"), into the EXR FILE of WIDTH x
HEIGHT. With --error in the list, FOLDER/shot.NNNN.exr says then which part of it exists. A file stands at
its name when it is whole, and what a list wants and is there since is not rendered again: whatever ends a
part, it can be run again.
"""
import json
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import planned  # noqa: E402


def list_wanted(folder, *options):
    os.makedirs(os.path.join(folder, "wanted"), exist_ok=True)
    path = os.path.join(folder, "wanted", "list.json")
    text, plan = planned.plan(options, folder)
    with open(path + ".part", "wb") as file:
        file.write(text)
    os.replace(path + ".part", path)
    print(len(plan["subframes"]), "subframes are wanted")


def render_one(folder, listed, wanted, size, command):
    path, part = planned.path(folder, wanted), planned.unfinished(folder, wanted)
    if os.path.exists(path) and ("region" not in wanted or os.stat(path).st_mtime_ns > listed):
        return
    words = [wanted["number"], wanted["time"], *size, *planned.region(wanted, size), part]
    done = subprocess.run([*command, *map(str, words)], check=False)
    if done.returncode or not os.path.exists(part):
        sys.exit(f"subframe {wanted['number']}: {command[0]} ended with {done.returncode}"
                 + ("" if os.path.exists(part) else " and left no file"))
    planned.finish(folder, wanted)


def render(index, parts, folder, *command):
    path = os.path.join(folder, "wanted", "list.json")
    listed = os.stat(path).st_mtime_ns
    with open(path, encoding="utf-8") as file:
        plan = json.load(file)
    for wanted in plan["subframes"][int(index) - 1::int(parts)]:
        render_one(folder, listed, wanted, plan["size"], command)


def main():
    words = sys.argv[1:]
    if len(words) > 2 and words[0] == "list":
        list_wanted(*words[1:])
    elif len(words) > 4 and words[0] == "render":
        render(*words[1:])
    else:
        sys.exit(__doc__.strip())


if __name__ == "__main__":
    main()
