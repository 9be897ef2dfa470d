#!/usr/bin/env python3
"""Writes a TIFF of one color: tiff.py FILE BITS FORMAT PHOTOMETRIC EXTRA ORDER SAMPLE.. [TAG=X,Y..]

FORMAT is 1 for whole numbers and 3 for floats, EXTRA the values of ExtraSamples or "-", ORDER
"II" or "MM"; tags are written as RATIONAL."""
import struct
import sys

name, bits, kind, photometric, extra, order, *rest = sys.argv[1:]
bits, kind, e = int(bits), int(kind), '<' if order == 'II' else '>'
samples = [float(x) for x in rest if '=' not in x]
code = {(8, 1): 'B', (16, 1): 'H', (32, 1): 'I', (16, 3): 'e', (32, 3): 'f', (64, 3): 'd'}[bits, kind]
pixel = struct.pack(e + code * len(samples), *(samples if kind == 3 else map(int, samples)))
data = pixel * (32 * 24)
SHORT, LONG, RATIONAL = 3, 4, 5
tags = [(256, SHORT, [32]), (257, SHORT, [24]), (258, SHORT, [bits] * len(samples)), (259, SHORT, [1]),
        (262, SHORT, [int(photometric)]), (273, LONG, [8]), (277, SHORT, [len(samples)]), (278, SHORT, [24]),
        (279, LONG, [len(data)]), (284, SHORT, [1]), (339, SHORT, [kind] * len(samples))]
if extra != '-':
    tags.append((338, SHORT, [int(x) for x in extra.split(',')]))
for tag, values in (x.split('=') for x in rest if '=' in x):
    tags.append((int(tag), RATIONAL, [float(v) for v in values.split(',')]))
entries, beyond, at = b'', b'', 8 + len(data) + 2 + 12 * len(tags) + 4
for tag, form, values in sorted(tags):
    if form == RATIONAL:
        packed = b''.join(struct.pack(e + 'II', round(v * 10**6), 10**6) for v in values)
    else:
        packed = struct.pack(e + {SHORT: 'H', LONG: 'I'}[form] * len(values), *values)
    entries += struct.pack(e + 'HHI', tag, form, len(values))
    if len(packed) <= 4:
        entries += packed.ljust(4, b'\0')
    else:
        entries += struct.pack(e + 'I', at + len(beyond))
        beyond += packed
with open(name, 'wb') as f:
    f.write((b'II*\0' if e == '<' else b'MM\0*') + struct.pack(e + 'I', 8 + len(data)) + data +
            struct.pack(e + 'H', len(tags)) + entries + struct.pack(e + 'I', 0) + beyond)
