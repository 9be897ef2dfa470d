#!/usr/bin/env python3
"""one_thing.py WHAT FROM TO: a copy of a delivery that is wrong in one thing. profile: MPEG-2's High and not 4:2:2, of
the same level; level: Main and not High; open: MXF's header partition, which the footer repeats as closed and complete;
big-endian: samples of sound in MXF by their label (AIFF)."""
import sys

SET = bytes.fromhex("060e2b34025301010d01010101")
PARTITION = bytes.fromhex("060e2b34020501010d01020101")
FILL = bytes.fromhex("060e2b34")
AIFF = bytes.fromhex("3d060010" "060e2b3404010107" "040202017e000000")


def sequences(data):
    """Where sequence extensions of MPEG-2 have their profile and level, as one number of 8 bits."""
    at = data.find(b"\0\0\1\xb5\x18")
    while at >= 0:
        yield at + 4
        at = data.find(b"\0\0\1\xb5\x18", at + 1)


def of_mpeg2(data, number):
    for at in sequences(data):
        data[at] = data[at] & 0xF0 | number >> 4
        data[at + 1] = data[at + 1] & 0x0F | (number & 15) << 4


def open_header(data):
    data[data.index(PARTITION) + 14] = 1
    footer = data.rindex(PARTITION + b"\4")
    data[footer + 14] = 4
    value = footer + 17 + (data[footer + 16] & 0x7F)
    data[value + 32 : value + 40] = (1).to_bytes(8, "big")


def big_endian(data):
    """The item is put into each descriptor of sound, and what fills up the header is as much shorter."""
    old, at, grown = bytes(data), 0, 0
    data.clear()
    while at + 17 <= len(old):
        size = old[at + 16] & 0x7F if old[at + 16] & 0x80 else 0
        length = int.from_bytes(old[at + 17 : at + 17 + size], "big") if size else old[at + 16]
        key, body = old[at : at + 16], old[at + 17 + size : at + 17 + size + length]
        at += 17 + size + length
        if key.startswith(SET) and key[14] in (0x47, 0x48):
            body += AIFF
            grown += len(AIFF)
        elif key.startswith(FILL) and key[8:12] == b"\3\1\2\x10" and len(body) > grown:
            body, grown = body[grown:], 0
        data += key + bytes([0x80 | size]) + len(body).to_bytes(size, "big") + body if size else key + bytes([len(body)]) + body


what, source, target = sys.argv[1:]
data = bytearray(open(source, "rb").read())
whole = bytes(data)
{"profile": lambda d: of_mpeg2(d, 0x12), "level": lambda d: of_mpeg2(d, 0x85), "open": open_header, "big-endian": big_endian}[what](data)
if data == whole or len(data) != len(whole):
    sys.exit(f"{source}: nothing was changed, or its length was")
open(target, "wb").write(data)
