#!/usr/bin/env python3
"""cuts.py WEFT FILE COUNT [OFFSET..]: cuts a file at COUNT places that lie evenly, and at OFFSETs, which count
from its end, and has `weft verify` look at what is left. No cut may be taken for a whole file; says which is."""
import json, os, subprocess, sys

weft, name, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
data = open(name, "rb").read()
places = {len(data) * (i + 1) // (count + 1) for i in range(count)}
places |= {len(data) + int(offset) for offset in sys.argv[4:]} | {len(data) - 1}
places = sorted(p for p in places if 0 < p < len(data))
stem, ending = os.path.splitext(name)
os.makedirs("cuts", exist_ok=True)
cuts = [f"cuts/{stem}.{place}{ending}" for place in places]
for cut, place in zip(cuts, places):
    with open(cut, "wb") as out:
        out.write(data[:place])
found = json.loads(subprocess.run([weft, "verify", "--json", *cuts], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
for cut in cuts:
    os.remove(cut)
telling = {"reading", "whole", "header", "durations", "frames"}
passed = [v["file"] for v in found if not any(c["verdict"] == "wrong" and c["check"] in telling for c in v["checks"])]
if len(found) != len(cuts) or passed:
    sys.exit(f"{len(found)} of {len(cuts)} looked at; taken for whole: {passed}")
