"""Finds and runs weft, and says what went wrong in its words."""
import json
import os
import shutil
import subprocess


class Failed(Exception):
    """What a person is told."""


def find(wished=""):
    """The program: what the preferences say, $WEFT, or what lies on the path."""
    for name in (wished, os.environ.get("WEFT", ""), "weft"):
        found = shutil.which(name) if name else None
        if found:
            return found
    raise Failed("weft was not found; say in the add-on's preferences where it is, or set WEFT")


DONE, NO_SENSE, DEGRADED = 0, 2, 3  # exit codes; degraded: done, but something was held or filled in


def ended(program, *words):
    try:
        return subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    except OSError as error:
        raise Failed(f"{program}: {error.strerror}") from None


def failed(done):
    """Its messages end with what would be right, and are passed on."""
    return Failed((done.stderr.strip() or f"weft ended with {done.returncode}").replace("weft: ", "", 1))


def run(program, *words):
    """What it prints."""
    done = ended(program, *words)
    if done.returncode not in (DONE, DEGRADED):
        raise failed(done)
    return done.stdout


def make_sense(program, *words):
    """Refuses what is contradictory: an output that holds no alpha, a codec that is not for its container."""
    done = ended(program, *words)
    if done.returncode == NO_SENSE:
        raise failed(done)


def asked(program, *words):
    """What it prints as JSON."""
    return json.loads(run(program, *words))
