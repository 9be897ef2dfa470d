#!/usr/bin/env python3
"""Writes Y4M of noise, in which nothing can be guessed: noise.py FILE WIDTH LINES FRAMES I C [WORD..]"""
import random
import sys

SIZES = {"420jpeg": (2, 2), "420": (2, 2), "422": (2, 1), "444": (1, 1), "411": (4, 1), "mono": None, "444alpha": (1, 1)}


def main(path, width, lines, frames, scan, chroma, *words):
    rng, width, lines = random.Random(1), int(width), int(lines)
    planes = [(width, lines)]
    if SIZES[chroma]:
        across, down = SIZES[chroma]
        planes += 2 * [(-(-width // across), -(-lines // down))]
    if chroma.endswith("alpha"):
        planes += [(width, lines)]
    with open(path, "wb") as file:
        file.write(f"YUV4MPEG2 W{width} H{lines} F25:1 {scan} A1:1 C{chroma} {' '.join(words)}".rstrip().encode() + b"\n")
        for _ in range(int(frames)):
            file.write(b"FRAME\n")
            for w, h in planes:
                file.write(bytes(rng.randrange(256) for _ in range(w * h)))


if __name__ == "__main__":
    main(*sys.argv[1:])
