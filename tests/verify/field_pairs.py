#!/usr/bin/env python3
"""field_pairs.py OUT WIDTH LINES FRAMES ORDER: H.264 (Rec. ITU-T H.264) whose frames are pairs of fields, each a
picture of its own, of I_PCM macroblocks: bars that move from field to field, 25 frames a second, tagged as 625
lines. ORDER is top or bottom. The multiplexers that ffmpeg has put it into containers."""
import sys


class Bits:
    def __init__(self):
        self.text = []

    def u(self, value, count):
        self.text.append(format(value, f"0{count}b"))

    def ue(self, value):
        digits = format(value + 1, "b")
        self.text.append("0" * (len(digits) - 1) + digits)

    def bytes(self, end=True):
        text = "".join(self.text) + ("1" if end else "")
        text += "0" * (-len(text) % 8)
        return int(text, 2).to_bytes(len(text) // 8, "big")


def nal(head, payload):
    out, zeros = bytearray([head]), 0
    for byte in payload:
        if zeros >= 2 and byte <= 3:
            out.append(3)
            zeros = 0
        out.append(byte)
        zeros = zeros + 1 if byte == 0 else 0
    return b"\0\0\0\1" + bytes(out)


def sequence(width, lines):
    b = Bits()
    b.u(77, 8), b.u(0, 8), b.u(40, 8)  # Main, level 4
    for value in (0, 0, 0, 0, 1):  # id, frame_num and POC of four bits, type 0, one reference
        b.ue(value)
    b.u(0, 1), b.ue(width // 16 - 1), b.ue(lines // 32 - 1)
    b.u(0, 1), b.u(0, 1), b.u(1, 1), b.u(0, 1)  # fields; not adaptive; direct 8x8; no cropping
    b.u(1, 1)  # usability information: pixel aspect, colors, clock
    b.u(1, 1), b.u(255, 8), b.u(12, 16), b.u(11, 16), b.u(0, 1)
    b.u(1, 1), b.u(5, 3), b.u(0, 1), b.u(1, 1), b.u(5, 8), b.u(6, 8), b.u(5, 8), b.u(0, 1)
    b.u(1, 1), b.u(1, 32), b.u(50, 32), b.u(1, 1)
    b.u(0, 4)
    return nal(0x67, b.bytes())


def pictures():
    b = Bits()
    b.ue(0), b.ue(0), b.u(0, 2), b.ue(0), b.ue(0), b.ue(0), b.u(0, 3)
    b.ue(0), b.ue(0), b.ue(0), b.u(0b100, 3)
    return nal(0x68, b.bytes())


def field(width, lines, number, first, bottom, frame):
    b = Bits()
    b.ue(0), b.ue(7), b.ue(0), b.u(0, 4), b.u(1, 1), b.u(bottom, 1)
    if first:
        b.ue(frame % 2)  # of the IDR picture
    b.u(0 if first else 1, 4)
    b.u(0, 2 if first else 1)
    b.ue(0), b.ue(1)
    rows = []
    for row in range(16):
        luma = [40 + 160 * ((x + 3 * number) // 24 % 2) for x in range(width)]
        rows.append(bytes(luma))
    payload = bytearray()
    for block in range(width // 16 * (lines // 32)):
        x = block % (width // 16) * 16
        b.ue(25)
        payload += b.bytes(end=False)
        payload += b"".join(row[x : x + 16] for row in rows) + bytes([128]) * 128
        b = Bits()
    payload.append(0x80)
    return nal(0x65 if first else 0x21, payload)


name, width, lines, frames, order = sys.argv[1], *map(int, sys.argv[2:5]), sys.argv[5]
with open(name, "wb") as out:
    for frame in range(frames):
        out.write(nal(9, b"\x10") + sequence(width, lines) + pictures())
        for i in range(2):
            bottom = int(i == (order == "top"))
            if i:
                out.write(nal(9, b"\x10"))
            out.write(field(width, lines, 2 * frame + i, i == 0, bottom, frame))
