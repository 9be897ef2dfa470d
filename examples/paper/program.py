"""Runs weft and reads what it writes: Y4M, its report and what it prints."""
import array
import json
import os
import re
import subprocess
import sys
import time

GAMMA = 2.4  # of the display, Rec. ITU-R BT.1886


class Failure(Exception):
    """What ends the build, with a message for whoever started it."""


def linear_table(bits):
    """Displayed light of every luma code of the narrow range."""
    step = 1 << (bits - 8)
    return [max(0.0, (code / step - 16) / 219) ** GAMMA for code in range(1 << bits)]


class Clip:
    """The frames of a Y4M file. Planes are arrays of codes, line after line."""

    tables = {}

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        end = data.index(b"\n")
        words = data[:end].decode().split()
        fields = {word[0]: word[1:] for word in reversed(words[1:])}
        self.width, self.lines = int(fields["W"]), int(fields["H"])
        over, under = fields["F"].split(":")
        self.rate = int(over) / int(under)
        self.scan = fields.get("I", "p")[0]
        depth = re.search(r"p(\d+)$", fields["C"])
        self.bits = int(depth.group(1)) if depth else 8
        if not fields["C"].startswith("444"):
            raise Failure(f"{path}: chroma is {fields['C']}; this reads 444")
        if self.bits not in Clip.tables:
            Clip.tables[self.bits] = linear_table(self.bits)
        self.frames = list(self._planes(data, end + 1))

    def _planes(self, data, at):
        kind = "H" if self.bits > 8 else "B"
        size = self.width * self.lines * (2 if self.bits > 8 else 1)
        while at < len(data):
            at = data.index(b"\n", at) + 1
            planes = []
            for _ in range(3):
                plane = array.array(kind)
                plane.frombytes(data[at:at + size])
                if kind == "H" and sys.byteorder == "big":
                    plane.byteswap()
                planes.append(plane)
                at += size
            yield planes

    def line(self, frame, y, x0=0, x1=None):
        """Displayed light along a line."""
        table, luma = Clip.tables[self.bits], self.frames[frame][0]
        x1 = self.width if x1 is None else x1
        return [table[code] for code in luma[y * self.width + x0:y * self.width + x1]]

    def picture(self, frame=0, x0=0, x1=None):
        return [self.line(frame, y, x0, x1) for y in range(self.lines)]

    def parity(self, n):
        """0 where field n owns the top line."""
        return (n + (self.scan == "b")) % 2

    def own_lines(self, n):
        return range(self.parity(n), self.lines, 2)

    def field(self, n, x0=0, x1=None):
        """Displayed light on the lines that field n owns."""
        return [self.line(n // 2, y, x0, x1) for y in self.own_lines(n)]

    def column_mean(self, frame, x0, x1):
        """Displayed light of every line, averaged from x0 to x1."""
        return [sum(self.line(frame, y, x0, x1)) / (x1 - x0) for y in range(self.lines)]


class Weft:
    """The program. Outputs are files in a folder of their own, each made once."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.made, self.seconds, self.runs = {}, 0.0, 0
        self.scenes = os.path.dirname(os.path.abspath(__file__))

    def run(self, *words, given=None):
        """What the program prints; `given` is its standard input."""
        started = time.monotonic()
        done = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True, input=given,
                              check=False)
        self.seconds += time.monotonic() - started
        self.runs += 1
        if done.returncode not in (0,):
            told = done.stderr.strip() or "without a word"
            raise Failure(f"weft {' '.join(map(str, words))}\nended with {done.returncode}: {told}")
        return done.stdout

    def make(self, ending, *words):
        """The path of what `weft WORDS -o PATH` writes."""
        if words not in self.made:
            path = os.path.join(self.folder, f"{len(self.made):03d}{ending}")
            self.run(*words, "--overwrite", "-o", path)
            self.made[words] = path
        return self.made[words]

    def scene(self, name):
        for folder in (self.scenes, os.path.join(self.scenes, "..", "scenes")):
            path = os.path.join(folder, name + ".lua")
            if os.path.exists(path):
                return path
        raise Failure(f"there is no scene {name}.lua")

    def render(self, scene, raster, aperture, frames=1, bits=16, **options):
        """The path of a Y4M file. Frames: how many, or which ("6-7"). Options: tau, samples, position,
        weight and limit of flicker, and values of the scene."""
        which = frames if isinstance(frames, str) else f"0-{frames - 1}"
        words = ["render", self.scene(scene), "--raster", raster, "--aperture", aperture,
                 "--frames", which, "--bits", bits, "--chroma", "444"]
        names = {"tau": "--temporal-width", "samples": "--samples", "position": "--shutter-position",
                 "weight": "--flicker-weight", "limit": "--flicker-limit"}
        for key, value in options.items():
            words += [names[key], value] if key in names else ["--set", f"{key}={value}"]
        return self.make(".y4m", *words)

    def clip(self, *words, **options):
        return Clip(self.render(*words, **options))

    @staticmethod
    def clip_of(path):
        return Clip(path)

    def measure(self, path, *words):
        said = self.run("measure", path, *words, "--json")
        try:
            found = json.loads(said)
        except ValueError:
            raise Failure(f"weft measure printed no JSON: {said[:200]}") from None
        return found[0] if isinstance(found, list) else found

    def composite(self, path, system, encoder, decoder):
        return self.make(".y4m", "composite", path, "--system", system, "--encoder", encoder,
                         "--decoder", decoder, "--chroma", "444", "--bits", 8)

    def response(self, aperture):
        return json.loads(self.run("filters", aperture, "--json"))
