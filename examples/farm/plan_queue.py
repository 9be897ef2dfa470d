#!/usr/bin/env python3
"""Renders by a plan and converts on a farm: steps that wait for each other.

  plan_queue.py slurm|opencue|deadline N ROUNDS FOLDER OUTPUT COMMAND PLAN_OPTION...

One step lists what `weft plan PLAN_OPTION...` wants, N tasks render it by COMMAND (plan.py says how it is called), and so
on for ROUNDS rounds, which is 1 unless --error among the options refines: then 8 are mostly enough, and one that finds
nothing wanted takes no time. The last step converts FOLDER to OUTPUT. Prints the jobs' numbers or names. Where a task
fails, what waits for it does not run: give the command again, and it goes on from what is there.

WEFT names the program, WEFT_CPUS how many processors a task asks for (4), WEFT_SHOW the show of OpenCue. Slurm is
tested; OpenCue and Deadline are written from their documentation, and only what is handed to them was looked at.
"""
import os
import re
import shlex
import subprocess
import sys
import tempfile

FARM = os.path.dirname(os.path.abspath(__file__))
WEFT, CPUS = os.environ.get("WEFT", "weft"), os.environ.get("WEFT_CPUS", "4")
# What stands for the number of a task in the words of a step.
TASK = {"slurm": "TASK", "opencue": "#IFRAME#", "deadline": "<STARTFRAME>"}
# Of the plan's options convert takes all but these: the size is the files', frames are the output's.
ONLY_PLANS = ("--size", "--samples-a-pixel", "--scene-fps", "--error")


def looks(options):
    """The plan's options as convert takes them."""
    words = []
    for name, value in zip(options[::2], options[1::2]):
        if name not in ONLY_PLANS:
            words += ["--output-frames" if name == "--frames" else name, value]
    return words


def steps(task, parts, rounds, folder, output, command, options):
    """Each waits for the one before: its name, how many tasks it has, and its words."""
    program = ["python3", os.path.join(FARM, "plan.py")]
    for i in range(1, rounds + 1):
        yield f"list {i}", 1, [*program, "list", folder, *options]
        yield f"render {i}", parts, [*program, "render", task, str(parts), folder, command]
    yield "convert", 1, [WEFT, "convert", folder, *looks(options), "--overwrite", "--progress", "plain", "-o", output]


def answer(words, **how):
    """What a program of the queue prints; ends the script where it fails."""
    try:
        done = subprocess.run(words, stdout=subprocess.PIPE, text=True, check=False, **how)
    except OSError as error:
        sys.exit(f"{words[0]}: {error.strerror}; is this machine one of the farm?")
    if done.returncode:
        sys.exit(f"{words[0]} ended with {done.returncode}\n{done.stdout}".rstrip())
    return done.stdout


# ---- Slurm ----

def slurm(title, todo):
    before, jobs = [], []
    for name, tasks, words in todo:
        many = [f"--array=1-{tasks}"] if name.startswith("render") else []
        cpus = [] if name.startswith("list") else [f"--cpus-per-task={CPUS}"]
        told = answer(["sbatch", "--parsable", "--kill-on-invalid-dep=yes", *before, *many, *cpus,
                       f"--job-name={name} {title}", os.path.join(FARM, "plan_task.sh"), *words])
        jobs.append(told.strip().split(";")[0])
        before = [f"--dependency=afterok:{jobs[-1]}"]
    return jobs


# ---- OpenCue, by PyOutline ----

OPENCUE = '''import outline
import outline.cuerun
from outline.modules.shell import Shell

job = outline.Outline({job!r}, shot={title!r}, show={show!r}, user={user!r})
before = None
for name, tasks, command in {layers!r}:
    layer = Shell(name, range="1-%d" % tasks, chunk=1, threads={cpus}, threadable=True, command=command)
    if before:
        layer.depend_all(before)
    job.add_layer(layer)
    before = layer
outline.cuerun.launch(job, use_pycuerun=False)
'''


def opencue(title, todo):
    """A shell reads the words again, and the number of the task must stay what it is."""
    layers = [(name.replace(" ", "_"), tasks, [word if word == TASK["opencue"] else shlex.quote(word) for word in words])
              for name, tasks, words in todo]
    job = "weft-" + re.sub(r"[^A-Za-z0-9_.-]", "_", title)
    text = OPENCUE.format(job=job, title=title, layers=layers, cpus=int(CPUS), show=os.environ.get("WEFT_SHOW", "testing"),
                          user=os.environ.get("USER", "user"))
    answer([sys.executable, "-"], input=text)
    return [job]


# ---- Deadline: the CommandLine plugin ----

def deadline_words(words):
    return " ".join(f"<QUOTE>{word}<QUOTE>" if re.search(r"\s", word) else word for word in words)


def deadline(title, todo):
    jobs = []
    for name, tasks, words in todo:
        about = {"Plugin": "CommandLine", "Name": f"{name} {title}", "Frames": f"1-{tasks}", "ChunkSize": 1,
                 **({"JobDependencies": jobs[-1]} if jobs else {})}
        plugin = {"Executable": words[0], "Arguments": deadline_words(words[1:]), "StartupDirectory": os.getcwd()}
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for file, lines in (("job", about), ("plugin", plugin)):
                paths.append(os.path.join(folder, file + ".job"))
                with open(paths[-1], "w", encoding="utf-8") as to:
                    to.writelines(f"{key}={value}\n" for key, value in lines.items())
            told = answer(["deadlinecommand", *paths])
        found = re.search(r"^JobID=(\S+)", told, re.M)
        if not found:
            sys.exit(f"deadlinecommand names no JobID\n{told}")
        jobs.append(found.group(1))
    return jobs


def number(text):
    return int(text) if re.fullmatch(r"[1-9]\d{0,5}", text) else sys.exit(f"'{text}' is no number from 1 to 999999")


def main():
    words = sys.argv[1:]
    if len(words) < 8 or words[0] not in TASK or len(words) % 2:
        print(__doc__.strip(), file=sys.stderr)
        sys.exit(2)
    kind, parts, rounds, folder, output, command, *options = words
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        sys.exit(f"{folder}: {error.strerror}")
    todo = list(steps(TASK[kind], number(parts), number(rounds), folder, output, command, options))
    title = os.path.basename(os.path.normpath(folder))
    print(*{"slurm": slurm, "opencue": opencue, "deadline": deadline}[kind](title, todo))


if __name__ == "__main__":
    main()
