#!/usr/bin/env python3
"""cuts.py WEFT FILE COUNT [OFFSET..]: cuts a file at COUNT places that lie evenly, and at OFFSETs, which count
from its end, and has `weft verify` look at what is left. No cut may be taken for a whole file: something is wrong with
it, or it is open whether it is whole, as it is of streams that do not say where they end. An offset `every:N` is every
N bytes instead; RASTER in the environment is what raw files are of."""
import json, os, subprocess, sys

weft, name, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
data = open(name, "rb").read()
places = {len(data) * (i + 1) // (count + 1) for i in range(count)} | {len(data) - 1}
for offset in sys.argv[4:]:
    step = offset.removeprefix("every:")
    places |= set(range(0, len(data), int(step))) if step != offset else {len(data) + int(offset)}
raster = ["--raster", os.environ["RASTER"]] if "RASTER" in os.environ else []
places = sorted(p for p in places if 0 < p < len(data))
stem, ending = os.path.splitext(name)
os.makedirs("cuts", exist_ok=True)
cuts = [f"cuts/{stem}.{place}{ending}" for place in places]
for cut, place in zip(cuts, places):
    with open(cut, "wb") as out:
        out.write(data[:place])
found = json.loads(subprocess.run([weft, "verify", "--json", *raster, *cuts], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
for cut in cuts:
    os.remove(cut)
telling = {"reading", "whole", "header", "durations", "frames", "sound"}


def passes(checks):
    verdicts = {c["check"]: c["verdict"] for c in checks}
    return not any(verdicts.get(name) == "wrong" for name in telling) and verdicts.get("whole") != "open"


passed = [v["file"] for v in found if passes(v["checks"])]
if len(found) != len(cuts) or passed:
    sys.exit(f"{len(found)} of {len(cuts)} looked at; taken for whole: {passed}")
