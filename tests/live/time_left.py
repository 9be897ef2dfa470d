"""time_left.py WEFT ARGUMENT..: runs the program with --progress json, and prints when the first line came (first_s), how
long all took (all_s), lines of from a fifth of that on (lines), and how many of these say a time left that is
more than 30 % (and .3 s, in which a machine does other things) from what was left (wrong)."""
import json
import subprocess
import sys
import time

begin = time.monotonic()
process = subprocess.Popen([*sys.argv[1:], "--progress", "json"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                           text=True)
told = []
for line in process.stderr:
    if line.startswith("{"):
        told.append((time.monotonic() - begin, json.loads(line)))
status = process.wait()
all_s = time.monotonic() - begin
late = [(at, said["seconds_left"]) for at, said in told if at >= all_s / 5]
wrong = [(at, left) for at, left in late
         if left is None or abs(left - (all_s - at)) > .3 * (all_s - at) + .3]
print(json.dumps({"status": status, "first_s": told[0][0] if told else None, "all_s": all_s, "lines": len(late),
                  "wrong": len(wrong), "stage": told[0][1]["stage"] if told else None}))
