#!/usr/bin/env python3
"""patch_delivery.py FROM TO KIND NAME OFFSET BYTES: a copy of a file with hexadecimal BYTES written over.
KIND atom: at OFFSET of the body of the last QuickTime atom of this name, or with a + before it the first. KIND item: at OFFSET of the value of MXF's item of this tag (hexadecimal), in every
set of picture descriptors, and for tags 15.. in every timecode component. KIND label: of the operational
pattern in every partition. KIND sound: the atom of this name in every QuickTime track but the first. KIND status: of the key of every partition pack, its byte 14. KIND end: at
OFFSET from the end of the file, which is below 0. KIND picture: of every picture coding extension of MPEG-2, whose byte 3 begins with
the order of the fields."""
import sys

SET = bytes.fromhex("060e2b34025301010d01010101")
PARTITION = bytes.fromhex("060e2b34020501010d01020101")


def atoms(data, name, offset):
    if name[0] == "+":
        at = data.index(name[1:].encode(), data.rindex(b"moov"))
    else:
        at = data.rindex(name.encode())
    return [at + 4 + offset]


def triplets(data):
    at = 0
    while at + 17 <= len(data):
        length, value = data[at + 16], at + 17
        if length & 0x80:
            value += length & 0x7F
            length = int.from_bytes(data[at + 17 : value], "big")
        yield data[at : at + 16], value, length
        at = value + length


def items(data, name, offset):
    tag = int(name, 16)
    kinds = (0x14,) if tag >> 8 == 0x15 else (0x27, 0x28, 0x29, 0x51)
    for key, value, length in triplets(data):
        end, at = value + length, value
        while key.startswith(SET) and key[14] in kinds and at + 4 <= end:
            size = int.from_bytes(data[at + 2 : at + 4], "big")
            if int.from_bytes(data[at : at + 2], "big") == tag:
                yield at + 4 + offset
            at += 4 + size


def labels(data, _, offset):
    for key, value, _ in triplets(data):
        if key.startswith(PARTITION) and 2 <= key[13] <= 4:
            yield value + 64 + offset


def statuses(data, _, offset):
    at = data.find(PARTITION)
    while at >= 0:
        if 2 <= data[at + 13] <= 4:
            yield at + 14 + offset
        at = data.find(PARTITION, at + 1)


def ends(data, _, offset):
    yield len(data) + offset


def pictures(data, _, offset):
    at = data.find(b"\0\0\1\xb5\x8f")
    while at >= 0:
        yield at + 4 + offset
        at = data.find(b"\0\0\1\xb5\x8f", at + 4)


def sounds(data, name, offset):
    """Atoms of this name in every track but the first, which is of pictures."""
    at = data.index(name.encode(), data.rindex(b"moov"))
    while (at := data.find(name.encode(), at + 1)) >= 0:
        yield at + 4 + offset


KINDS = {"sound": sounds, "atom": atoms, "item": items, "label": labels, "status": statuses, "end": ends, "picture": pictures}
source, target, kind, name, offset, new = sys.argv[1:]
data, new = bytearray(open(source, "rb").read()), bytes.fromhex(new)
places = list(KINDS[kind](bytes(data), name, int(offset)))
if not places:
    sys.exit(f"{source} has no {name}")
for at in places:
    data[at : at + len(new)] = new
open(target, "wb").write(data)
