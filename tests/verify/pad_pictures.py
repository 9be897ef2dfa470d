#!/usr/bin/env python3
"""pad_pictures.py IN OUT BYTES: H.264 with access unit delimiters, every access unit filled up to BYTES with filler
data (Rec. ITU-T H.264, 7.3.2.7)."""
import sys

data, wanted = open(sys.argv[1], "rb").read(), int(sys.argv[3])
start = b"\0\0\0\1\x09"
units = [start + unit for unit in data.split(start)[1:]]
with open(sys.argv[2], "wb") as out:
    for unit in units:
        missing = wanted - len(unit)
        if missing < 6:
            sys.exit(f"a picture of {len(unit)} bytes is too large")
        out.write(unit + b"\0\0\0\1\x0c" + b"\xff" * (missing - 6) + b"\x80")
