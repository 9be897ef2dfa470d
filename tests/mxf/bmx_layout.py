#!/usr/bin/env python3
"""bmx_layout.py FILE RASTER BITS: holds the picture's descriptor in an uncompressed MXF, item by item and byte by byte,
to what bmx asks for before it takes a file for uncompressed, and what it writes itself. The rows were read from bmx's
source (its table of uncompressed essence, its data model and its labels) and not found by running it. Items are looked
up by the labels that the primer gives their tags, as bmx does. One thing differs: of 10 bits bmx stores whole groups of
48 samples, 1296 of 1280, which ffmpeg would show as the picture's width. `broken` as a fourth argument: it must not hold."""
import sys

SETS = bytes.fromhex("060e2b34025301010d0101010101")
PRIMER = bytes.fromhex("060e2b34020501010d01020101050100")
ELEMENT = bytes.fromhex("060e2b34010201010d0103011501")  # uncompressed, one element of it
LABEL = "060e2b34010101"
CODING = "060e2b340401010a040102010102"
CONTAINER = "060e2b34040101010d01030102"
EQUATIONS = "060e2b3404010101040101010"

# Size, frames a second, last bytes of the container's label, lines of the map, layout, standard, equations.
RASTERS = {
    "625i": (720, 576, (25, 1), "050105", (23, 336), 3, 1, "201"),
    "525i": (720, 486, (30000, 1001), "050101", (21, 283), 3, 1, "201"),
    "525i-imx": (720, 486, (30000, 1001), "050101", (20, 283), 3, 1, "201"),
    "1080i50": (1920, 1080, (25, 1), "050229", (21, 584), 3, 4, "202"),
    "1080i59.94": (1920, 1080, (30000, 1001), "050239", (21, 584), 3, 4, "202"),
    "1080i60": (1920, 1080, (30, 1), "050249", (21, 584), 3, 4, "202"),
    "1080p25": (1920, 1080, (25, 1), "050221", (42, 0), 0, 4, "202"),
    "720p50": (1280, 720, (50, 1), "050319", (26, 0), 0, 5, "202"),
}


def wanted(raster, bits):
    width, lines, rate, container, line_map, layout, standard, equations = RASTERS[raster]
    black, white, levels = (64, 940, 897) if bits == 10 else (16, 235, 225)
    long = "{:08x}".format
    rows = (
        ("SampleRate", "010406010100000000", long(rate[0]) + long(rate[1])),
        ("EssenceContainer", "020601010401020000", CONTAINER + container),
        ("FrameLayout", "010401030104000000", "%02x" % layout),
        ("StoredWidth", "010401050202000000", long(width)),
        ("StoredHeight", "010401050201000000", long(lines)),
        ("SampledWidth", "010401050108000000", long(width)),
        ("SampledHeight", "010401050107000000", long(lines)),
        ("DisplayWidth", "01040105010c000000", long(width)),
        ("DisplayHeight", "01040105010b000000", long(lines)),
        ("VideoLineMap", "020401030205000000", long(2) + long(4) + long(line_map[0]) + long(line_map[1])),
        ("FieldDominance", "020401030106000000", "01" if layout == 3 else None),
        ("SignalStandard", "050405011300000000", "%02x" % standard),
        ("PictureEssenceCoding", "020401060100000000", CODING + ("0201" if bits == 10 else "0101")),
        ("CodingEquations", "020401020101030100", EQUATIONS + equations + "0000"),
        ("ComponentDepth", "02040105030a000000", long(bits)),
        ("HorizontalSubsampling", "010401050105000000", long(2)),
        ("VerticalSubsampling", "020401050110000000", long(1)),
        ("ColorSiting", "010401050106000000", "00"),
        ("BlackRefLevel", "010401050303000000", long(black)),
        ("WhiteRefLevel", "010401050304000000", long(white)),
        ("ColorRange", "020401050305000000", long(levels)),
    )
    return {LABEL + label: (name, value) for name, label, value in rows}


def triplets(data):
    at = 0
    while at < len(data):
        size = data[at + 16] & 0x7F if data[at + 16] & 0x80 else 0
        length = int.from_bytes(data[at + 17 : at + 17 + size], "big") if size else data[at + 16]
        yield data[at : at + 16], data[at + 17 + size : at + 17 + size + length]
        at += 17 + size + length


def items_of(data):
    """Of the picture's descriptor, by labels; the first picture element's key."""
    labels, items, element = {}, {}, None
    for key, value in triplets(data):
        if key == PRIMER:
            entries = [value[at : at + 18] for at in range(8, len(value), 18)]
            labels = {entry[:2]: entry[2:].hex() for entry in entries}
        elif key[:14] == SETS and key[14] == 0x28:
            at = 0
            while at < len(value):
                length = int.from_bytes(value[at + 2 : at + 4], "big")
                items[labels[value[at : at + 2]]] = value[at + 4 : at + 4 + length].hex()
                at += 4 + length
        elif key.startswith(ELEMENT[:13]) and element is None:
            element = key
    return items, element


def main():
    items, element = items_of(open(sys.argv[1], "rb").read())
    faults = [
        f"{name}: {items.get(label)}, not {value}"
        for label, (name, value) in wanted(sys.argv[2], int(sys.argv[3])).items()
        if items.get(label) != value
    ]
    if element is None or element[13:15] != b"\x01\x02":
        faults.append("its element is not wrapped by frames")
    if bool(faults) != (sys.argv[4:] == ["broken"]):
        sys.exit("\n".join(faults) or "nothing is wrong with it")


main()
