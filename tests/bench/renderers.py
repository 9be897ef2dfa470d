#!/usr/bin/env python3
"""What a renderer takes for equal error: all subframes, those that a plan wants, and those refined to an error.

    tests/bench/renderers.py BUILD               POV-Ray on two scenes; ten minutes of a processor
    tests/bench/renderers.py BUILD --publish     writes the results into README.md

examples/povray/render.py renders each scene with eight subframes a field: all of them, what a plan for half a field
wants, and what it still wants for an error. Seconds are those of POV-Ray's processes, start included. The truth is a
frame of 32 subframes within the window of each field; RMSE is that of Y', white being 1, in that frame. Exits with 1 where a target is missed.
"""
import argparse
import array
import os
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
PEERS, DRIVER = os.path.join(HERE, "..", "peers"), os.path.join(HERE, "..", "..", "examples", "povray", "render.py")
WIDTH, LINES, FRAMES, TRUE_FRAME, ERROR = 480, 384, 8, 3, 0.005
RASTER = f"{WIDTH}x{LINES}@25i,tff,par=16:15"
RATE, TRUE_RATE = 400, 3200
# A scene: what refining may take of all subframes' seconds.
SCENES = {"one_mover": 0.2, "wheel": 0.6}


class Renders:
    """A scene's folders of subframes, and what POV-Ray took for each."""

    def __init__(self, build, work, scene):
        self.weft, self.work, self.scene = os.path.join(build, "weft"), work, scene
        self.log, self.povray = os.path.join(work, "seconds"), os.path.join(work, "povray")
        with open(self.povray, "w", encoding="utf-8") as file:
            file.write(f"#!/bin/bash\nTIMEFORMAT='%U %S'\n{{ time povray \"$@\" 2>&1; }} 2>>{self.log}\n")
        os.chmod(self.povray, 0o755)

    def render(self, folder, *options):
        """Seconds of POV-Ray's processes, and how many there were."""
        with open(self.log, "w", encoding="utf-8"):
            pass
        surroundings = {**os.environ, "WEFT": self.weft, "POVRAY": self.povray, "POVRAY_OPTIONS": f"+L{PEERS} +WT1"}
        subprocess.run([sys.executable, DRIVER, os.path.join(PEERS, self.scene + ".pov"), self.path(folder), "--raster",
                        RASTER, *map(str, options)], check=True, env=surroundings, stdout=subprocess.DEVNULL)
        with open(self.log, encoding="utf-8") as file:
            took = [sum(map(float, line.split())) for line in file if line[0].isdigit()]
        return sum(took), len(took)

    def path(self, name):
        return os.path.join(self.work, self.scene + "." + name)

    def luma(self, folder, rate, first, last):
        """Y' of frames first to last of the video of a folder, of each a list of codes over 219 * 256."""
        video = self.path(folder + ".y4m")
        subprocess.run([self.weft, "convert", self.path(folder), "--raster", RASTER, "--subframe-rate", str(rate),
                        "--temporal-width", "1/2", "--output-frames", f"{first}-{last}", "--bits", "16", "-q",
                        "--overwrite", "-o", video], check=True)
        frames = []
        with open(video, "rb") as file:
            chroma = 2 if b"C444" in file.readline() else 1
            while file.readline():
                codes = array.array("H", file.read(2 * WIDTH * LINES))
                file.seek(2 * WIDTH * LINES * chroma, 1)
                frames.append([code / (219 * 256) for code in codes])
        return frames


def rmse(a, b):
    return (sum((x - y) ** 2 for x, y in zip(a, b)) / len(a)) ** 0.5


def within(some, whole):
    """The share of pixels of all frames that are off by no more than the error."""
    off = [abs(x - y) for a, b in zip(some, whole) for x, y in zip(a, b)]
    return sum(x <= ERROR for x in off) / len(off)


def measure(build, work, scene):
    """A row: seconds and RMSE of all, of planned and of refined, and the share of pixels within the error."""
    renders, last = Renders(build, work, scene), FRAMES - 1
    span, wide = ("--frames", f"0-{last}", "--subframe-rate", RATE), ("--temporal-width", "1/2")
    took = {"all": renders.render("all", *span, "--temporal-width", "1"),
            "planned": renders.render("planned", *span, *wide),
            "refined": renders.render("refined", *span, *wide, "--error", ERROR)}
    renders.render("truth", "--frames", f"{TRUE_FRAME}-{TRUE_FRAME}", "--subframe-rate", TRUE_RATE, *wide)
    truth = renders.luma("truth", TRUE_RATE, TRUE_FRAME, TRUE_FRAME)[0]
    videos = {name: renders.luma(name, RATE, 0, last) for name in took}
    off = {name: rmse(video[TRUE_FRAME], truth) for name, video in videos.items()}
    return took, off, within(videos["refined"], videos["all"])


def told(rows):
    """The rows as a table, and whether all targets are kept."""
    lines, kept = ["| scene | all eight | planned | refined | RMSE of all eight | planned | refined | pixels within E |",
                   "|---|---|---|---|---|---|---|---|"], True
    for scene, (took, off, share) in rows.items():
        seconds = {name: s for name, (s, _) in took.items()}
        planned, refined = (seconds[name] / seconds["all"] for name in ("planned", "refined"))
        fine = (planned <= 0.51 and refined <= SCENES[scene] and share >= 0.99 and off["planned"] == off["all"]
                and off["refined"] <= 1.02 * off["all"])
        kept = kept and fine
        lines.append(f"| `{scene}.pov` | {seconds['all']:.1f} s | {planned:.3f} x (<= .5) | {refined:.3f} x "
                     f"(<= {SCENES[scene]:g}) in {took['refined'][1]} renders | {off['all']:.6f} | {off['planned']:.6f} | "
                     f"{off['refined']:.6f} | {100 * share:.2f} % |" + ("" if fine else " **missed**"))
    return "\n".join(lines) + "\n", kept


def publish(text):
    page = os.path.join(HERE, "README.md")
    with open(page, encoding="utf-8") as file:
        before, rest = file.read().split("<!-- renderers -->\n")
    with open(page, "w", encoding="utf-8") as file:
        file.write(f"{before}<!-- renderers -->\n{time.strftime('%Y-%m-%d')}.\n\n{text}<!-- renderers end -->"
                   + rest.split("<!-- renderers end -->")[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=os.path.abspath)
    parser.add_argument("--publish", action="store_true")
    parser.add_argument("--scenes", default=",".join(SCENES))
    asked, rows = parser.parse_args(), {}
    with tempfile.TemporaryDirectory() as work:
        for scene in asked.scenes.split(","):
            rows[scene] = measure(asked.build, work, scene)
            print(told({scene: rows[scene]})[0], flush=True)
    text, kept = told(rows)
    if asked.publish:
        publish(text)
    return not kept


if __name__ == "__main__":
    sys.exit(main())
