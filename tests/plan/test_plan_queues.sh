#!/bin/bash
# What examples/farm/plan_queue.py hands to OpenCue and to Deadline, which are not here: programs of these names take
# it and run the steps in their order, as the documentation of either says.
source "$(dirname "$0")/../program/script.sh"
not_sanitized never
needs python3
export WEFT WEFT_CPUS=2 PATH=$work/bin:$PATH PYTHONPATH=$work/bin PYTHONDONTWRITEBYTECODE=1
queue() { exits 0 python3 "$WEFT_SOURCE/examples/farm/plan_queue.py" "$@"; }
looks=(--raster 96x64@30i,tff --frames 1-2 --subframe-rate 480 --aperture box)
weft trace "$WEFT_SOURCE/examples/scenes/one_mover.lua" --raster 96x64@30i,tff --oversample 1x1x8 --frames 0-3 \
    -o "made.####.exr" -q || exit 1
weft convert "made.####.exr" --raster 96x64@30i,tff --aperture box --output-frames 1-2 -q -o whole.y4m || exit 1
cat >"render one.sh" <<END
#!/bin/bash
printf -v file $work/made.%04d.exr "\$1"
cp "\$file" "\$9"
END
chmod +x "render one.sh"

# Deadline: a job and its plugin as KEY=VALUE lines; <QUOTE> and <STARTFRAME> are the CommandLine plugin's.
mkdir -p bin/outline/modules
cat >bin/deadlinecommand <<'END'
#!/usr/bin/env python3
import shlex, subprocess, sys
job, plugin = (dict(line.rstrip("\n").split("=", 1) for line in open(path)) for path in sys.argv[1:])
assert job["Plugin"] == "CommandLine" and job["ChunkSize"] == "1", job
with open("submitted", "a+") as file:
    file.seek(0)
    before = len(file.readlines())
    file.write(f"{job['Name']} {job['Frames']} {job.get('JobDependencies', '-')}\n")
assert job.get("JobDependencies") == (f"id{before - 1}" if before else None), job
for frame in range(1, int(job["Frames"].split("-")[1]) + 1):
    words = plugin["Arguments"].replace("<STARTFRAME>", str(frame)).replace("<QUOTE>", '"')
    subprocess.run([plugin["Executable"], *shlex.split(words)], check=True, cwd=plugin["StartupDirectory"],
                   stdout=subprocess.DEVNULL)
print(f"Result=Success\nJobID=id{before}")
END
chmod +x bin/deadlinecommand
check "Deadline" queue deadline 3 1 "by deadline" deadline.y4m "$work/render one.sh" "${looks[@]}"
check "three jobs" prints "id0 id1 id2"
check "that wait for each other" same "$(cat submitted)" "list 1 by deadline 1-1 -
render 1 by deadline 1-3 id0
convert by deadline 1-1 id1"
check "make the video" cmp deadline.y4m whole.y4m

# OpenCue: PyOutline's names, of which the steps are layers; a shell reads what the words are joined to.
touch bin/outline/modules/__init__.py
cat >bin/outline/__init__.py <<'END'
class Outline:
    def __init__(self, name, shot, show, user):
        self.name, self.layers = name, []
    def add_layer(self, layer):
        self.layers.append(layer)
END
cat >bin/outline/modules/shell.py <<'END'
class Shell:
    def __init__(self, name, range, chunk, threads, threadable, command):
        self.name, self.range, self.command, self.after = name, range, command, None
        assert (chunk, threads, threadable) == (1, 2, True) and " " not in name
    def depend_all(self, before):
        self.after = before
END
cat >bin/outline/cuerun.py <<'END'
import subprocess
def launch(job, use_pycuerun):
    before = None
    for layer in job.layers:
        assert layer.after is before
        before = layer
        for frame in range(1, int(layer.range.split("-")[1]) + 1):
            subprocess.run(" ".join(layer.command).replace("#IFRAME#", str(frame)), shell=True, check=True,
                           stdout=subprocess.DEVNULL)
END
check "OpenCue" queue opencue 2 6 "by cue" cue.y4m "$work/render one.sh" "${looks[@]}" --error 0.005
check "one job" prints "weft-by_cue"
check "refined" exits 0 weft plan "${looks[@]}" --error 0.005 --refine "by cue" --format json
check "to the end" value "d['subframes'] == []"
check "made a video" exits 0 weft measure cue.y4m --against whole.y4m --json
check "as good" value "d['difference']['rmse'] < 0.0005"

# ---- What goes wrong ----

bad() { exits "$1" python3 "$WEFT_SOURCE/examples/farm/plan_queue.py" "${@:2}"; }
check "a queue that is none" bad 2 condor 2 1 f o.y4m c "${looks[@]}"
check "tells its use" says "slurm|opencue|deadline N ROUNDS"
check "no tasks" bad 1 deadline 0 1 f o.y4m c "${looks[@]}"
check "are told of" says "'0' is no number from 1 to 999999"
touch file
check "a folder that cannot be" bad 1 deadline 2 1 file/sub o.y4m c "${looks[@]}"
check "is told of" says "file/sub: Not a directory"
rm bin/deadlinecommand
check "no Deadline" bad 1 deadline 2 1 f o.y4m c "${looks[@]}"
check "is told of" says "deadlinecommand: No such file or directory; is this machine one of the farm?"
finish
