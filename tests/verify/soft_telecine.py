#!/usr/bin/env python3
"""soft_telecine.py IN OUT: MPEG-2 (Rec. ITU-T H.262) without B pictures, whose pictures are now film: progressive,
and of every two the first field of one is shown again, so that four are shown for ten fields."""
import sys

data = bytearray(open(sys.argv[1], "rb").read())
cadence = [(1, 1), (0, 0), (0, 1), (1, 0)]  # top first, repeat first
at, count = data.find(b"\0\0\1\xb5\x8f"), 0
while at >= 0:
    top, repeat = cadence[count % 4]
    flags = at + 4 + 3
    data[flags] = data[flags] & 0x7D | top << 7 | repeat << 1
    data[flags + 1] |= 0x80
    at, count = data.find(b"\0\0\1\xb5\x8f", at + 4), count + 1
if not count:
    sys.exit("no picture coding extension")
open(sys.argv[2], "wb").write(data)
