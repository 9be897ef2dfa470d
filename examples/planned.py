"""What scripts that render by a plan share: asking for it, and files that stand at their names when they are whole."""
import json
import os
import socket
import subprocess
import sys
import zlib

from stamp_exr import stamp


def plan(options, folder=None):
    """What `weft plan` wants: its JSON as text, and read. With --error among the options, what FOLDER still wants. Ends
    the script where weft refuses, which has said why."""
    refines = ["--refine", folder] if "--error" in options else []
    done = subprocess.run([os.environ.get("WEFT", "weft"), "plan", *options, *refines, "--format", "json"],
                          stdout=subprocess.PIPE, check=False)
    if done.returncode:
        sys.exit(done.returncode)
    return done.stdout, json.loads(done.stdout)


def region(wanted, size):
    """The rectangle of a subframe that is wanted; all of it where it is not refined."""
    return wanted.get("region", [0, 0, *size])


def path(folder, wanted):
    return os.path.join(folder, f"shot.{wanted['number']:04d}.exr")


def unfinished(folder, wanted):
    """Where a subframe is rendered to; nobody else does there."""
    os.makedirs(os.path.join(folder, "unfinished"), exist_ok=True)
    return os.path.join(folder, "unfinished", f"{wanted['number']:04d}.{socket.gethostname()}.{os.getpid()}.exr")


def finish(folder, wanted):
    """Gives a subframe that is rendered its time, what exists of it, and its name."""
    part = unfinished(folder, wanted)
    try:
        stamp(part, wanted["time"], wanted.get("region"))
        os.replace(part, path(folder, wanted))
    except (OSError, ValueError) as error:
        sys.exit(f"subframe {wanted['number']}: {error}")


def share(subframes, index, parts):
    """The part of a list for one of several machines. Lists of what refining wants differ as files appear: there each
    machine has its own numbers, whatever else is listed."""
    if any("region" in wanted for wanted in subframes):
        return [wanted for wanted in subframes if zlib.crc32(str(wanted["number"]).encode()) % parts == index - 1]
    return subframes[index - 1::parts]
