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

from page import Report
from program import Failure, Weft

EXPERIMENTS = ("lattice", "shapes", "camera", "carousel", "blur", "eyes", "still", "slow", "notch")


class Context:
    """What every experiment is given."""

    def __init__(self, weft, quick):
        self.weft, self.quick, self.report = weft, quick, Report()
        self.designs = ()  # apertures that the paper had not
        self.figures = {}  # what one experiment measured and another speaks of


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--weft", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", help="experiments, for those who work on one")
    return parser.parse_args()


def build(ctx, names):
    for name in names:
        started = time.monotonic()
        __import__(name).run(ctx)
        print(f"{name}: {time.monotonic() - started:.1f} s", file=sys.stderr)


def main():
    args = arguments()
    os.makedirs(args.out, exist_ok=True)
    names = args.only.split(",") if args.only else EXPERIMENTS
    with tempfile.TemporaryDirectory() as folder:
        ctx = Context(Weft(args.weft, folder, print), args.quick)
        try:
            build(ctx, names)
        except Failure as failure:
            print(f"build.py: {failure}", file=sys.stderr)
            return 1
    path = os.path.join(args.out, "index.html")
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(ctx.report.html("<h1>x</h1>", ctx.report.verdicts(), "{}"))
    os.replace(path + ".part", path)
    print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
