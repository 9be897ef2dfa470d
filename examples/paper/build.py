#!/usr/bin/env python3
"""Renders and measures all of the paper with weft and writes one page of HTML.
  build.py --weft PROGRAM --out FOLDER [--quick] [--only NAME,..]
"""
import argparse
import html
import os
import sys
import tempfile
import time

import clips
from claims import verdict
from page import Report, asset
from program import Failure, Weft

EXPERIMENTS = ("lattice", "shapes", "camera", "carousel", "blur", "eyes", "wheels", "still", "slow",
               "notch", "held", "default", "color")


class Context:
    """What every experiment is given."""

    def __init__(self, weft, quick):
        self.weft, self.quick, self.report = weft, quick, Report()
        self.designs = ("crisp", "calm")  # apertures that the paper had not
        self.figures = {}  # what one experiment measured and another speaks of


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--weft", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", help="experiments, for those who work on one")
    return parser.parse_args()


def opening(ctx):
    verdicts = [verdict(row[3]) for row in ctx.report.rows]
    agree, differ = verdicts.count(True), verdicts.count(False)
    told = (f"{len(verdicts)} claims were put to the test. {agree} hold" +
            (f", {differ} come{'s' * (differ == 1)} out otherwise" if differ else "") +
            f", and {verdicts.count(None)} can only be judged by looking.")
    return (
        '<p class="kicker">Amanatides and Mitchell, SIGGRAPH 1990, rendered and measured again</p>'
        "<h1>Antialiasing of interlaced video</h1>"
        '<p class="lead">Television drew half a picture at a time. In 1990 two people at Bell Laboratories '
        "asked how a computer should draw for it, and found that a pixel is best looked at "
        "through a hole of a particular shape. This page does their experiments over "
        "again.</p><p>Every picture here was rendered by weft and every number was measured in "
        "those pictures when the "
        f'page was built. {told} The <a href="#table">table at the end</a> has them all; before it '
        'come the pictures, and a <a href="#player-section">player</a> that shows what pictures cannot.</p>')


def closing(ctx, seconds):
    version = ctx.weft.run("--version").strip()
    command = "run.sh --quick" if ctx.quick else "run.sh"
    return (f"<p>Made by <code>examples/paper/{command}</code> with {html.escape(version)}: "
            f"{ctx.weft.runs} runs of "
            f"the program, {seconds:.0f} seconds. The page needs nothing but itself.</p><p>John "
            "Amanatides and Don P. Mitchell, <i>Antialiasing of Interlaced Video Animation</i>, "
            "Computer Graphics 24, 4 (Proceedings of SIGGRAPH 1990). Claims are paraphrased. All "
            "light is relative to white, after a display of gamma 2.4. The widths of lines, boxes "
            "and all other names in <code>this type</code> are apertures of weft: <code>weft "
            "filters</code> lists them.</p>")


def player_of(ctx):
    return asset("introduction.html").replace("RASTER", "{} by {}".format(*clips.size(ctx))).replace(
        "PLAYER", asset("player.html"))


def finish(ctx, player, started):
    """The page from all that was handed in."""
    report = ctx.report
    report.section("table", "The paper says, measured here",
                   "“Agrees” and “differs” are comparisons made by the program that wrote this "
                   "page, on the numbers in the same row, with the thresholds that stand beside them. "
                   "All of a row's figures must pass for it to agree; one that fails makes it differ. "
                   "What lies between two thresholds is open.", report.verdicts())
    head, body = opening(ctx), player_of(ctx) if player else ""
    return report.html(head, body, closing(ctx, time.monotonic() - started), player or "{}")


def write(path, text):
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def main():
    args, started = arguments(), time.monotonic()
    os.makedirs(args.out, exist_ok=True)
    names = args.only.split(",") if args.only else EXPERIMENTS
    with tempfile.TemporaryDirectory() as folder:
        ctx = Context(Weft(args.weft, folder), args.quick)
        try:
            for name in names:
                began = time.monotonic()
                __import__(name).run(ctx)
                print(f"{name}: {time.monotonic() - began:.1f} s", file=sys.stderr)
            page = finish(ctx, clips.run(ctx), started)
        except Failure as failure:
            print(f"build.py: {failure}", file=sys.stderr)
            return 1
    path = os.path.join(args.out, "index.html")
    write(path, page)
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
