"""Where the items of test_plot.sh's plots are: plot_places.py FOLDER, with all.svg, all.png, bar.svg, log.svg."""
import base64
import math
import struct
import sys
import xml.etree.ElementTree as tree
import zlib

SVG = "{http://www.w3.org/2000/svg}"
LEFT, RIGHT, TOP, FLOOR = 66, 546, 12, 274
failed = 0


def check(name, found, wanted, within=0.006):
    global failed
    same = len(found) == len(wanted) and all(abs(a - b) <= within for a, b in zip(found, wanted))
    if not same:
        failed += 1
        print(f"FAILED: {name}: {found}, not {wanted}")


def across(x, low=0, high=10):
    return LEFT + (RIGHT - LEFT) * (x - low) / (high - low)


def down(y, low=5, high=-5):
    return FLOOR + (TOP - FLOOR) * (y - low) / (high - low)


def circles(root):
    return [[float(c.get(k)) for k in ("cx", "cy", "r")] for c in root.iter(SVG + "circle")]


def box(element):
    return [float(element.get(k)) for k in ("x", "y", "width", "height")]


def rows(data):
    """R G B rows of a PNG of 8 bits, with filters undone."""
    at, head, body = 8, None, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        piece = data[at + 8:at + 8 + size]
        head = struct.unpack(">IIBB", piece[:10]) if kind == b"IHDR" else head
        body += piece if kind == b"IDAT" else b""
        at += 12 + size
    width, lines, step = head[0], head[1], {2: 3, 6: 4}[head[3]]
    body, before, out = zlib.decompress(body), bytes(width * step), []
    for y in range(lines):
        kind, raw = body[y * (width * step + 1)], body[y * (width * step + 1) + 1:(y + 1) * (width * step + 1)]
        line = bytearray(raw)
        for i, value in enumerate(raw):
            a, b = line[i - step] if i >= step else 0, before[i]
            c = before[i - step] if i >= step else 0
            p = a + b - c
            nearest = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            line[i] = (value + (0, a, b, (a + b) // 2, nearest)[kind]) & 255
        out.append([tuple(line[i:i + 3]) for i in range(0, len(line), step)])
        before = bytes(line)
    return out


def look_at_svg(root):
    check("the picture is higher by a legend of one line", [int(root.get("height"))], [320 + 19 + 8])
    lines = [[float(v) for p in c.get("points").split() for v in p.split(",")]
             for c in root.iter(SVG + "polyline") if "s1" in c.get("class")]
    check("the line", lines[0][:4], [across(0), down(-5), across(5), down(0)])
    check("a line that leaves goes on beyond", lines[0][4:5], [across(10)])
    if lines[0][5] <= FLOOR:
        check("it does", [1], [0])
    found = circles(root)
    check("dots", found[0] + found[2], [across(2.5), down(2.5), 6, across(1), down(1), 3])
    check("a dot beyond the axes is at their edge", found[1], [across(9), down(5), 6])
    check("a hollow one", found[3], [across(8), down(4), 11])
    check("the ring", found[4], [across(2), down(-2), 13])
    check("the label's dot", found[5], [across(6), down(-3), 2.6])
    rects = [box(r) for r in root.iter(SVG + "rect")]
    check("the band", rects[1], [across(2), TOP, across(4) - across(2), FLOOR - TOP])
    check("the box, less its edge", rects[2], [across(6) + 2, down(-1) + 2, across(8) - across(6) - 4,
                                              down(1) - down(-1) - 4])
    image = next(root.iter(SVG + "image"))
    check("the map", box(image), [across(0), down(-5), across(5) - across(0), down(0) - down(-5)])
    pixels = rows(base64.b64decode(image.get("href").split(",")[1]))
    check("its darkest value", pixels[0][0], (0, 0, 5))
    check("its brightest value", pixels[1][1], (255, 252, 219))
    words = {t.text: t for t in root.iter(SVG + "text")}
    check("the word", [float(words["word"].get(k)) for k in "xy"], [across(5) - 7, down(3) + 4])
    if words["word"].get("text-anchor") != "end" or "dashed <line>" not in words:
        check("words", [1], [0])
    label = words["label"]
    check("the label is right of its dot", [float(label.get("x"))], [across(6) + 2.6 + 5 + 2])
    if "\N{MINUS SIGN}4.0" not in words or root.find(SVG + "title").text != 'all <kinds> & "more"':
        check("ticks and title", [1], [0])


def look_at_bar(root):
    """A map that tells its colors: a bar of them beside axes that are narrower by 82."""
    right = RIGHT - 82
    map_image, bar = list(root.iter(SVG + "image"))
    check("the map leaves room", box(map_image), [LEFT, TOP, right - LEFT, FLOOR - TOP])
    check("the bar", box(bar), [right + 14, TOP, 12, FLOOR - TOP])
    pixels = rows(base64.b64decode(bar.get("href").split(",")[1]))
    check("it is bright above", [sum(pixels[0][0]) > 3 * 220, sum(pixels[-1][0]) < 30], [True, True])
    words = {t.text: float(t.get("y")) for t in root.iter(SVG + "text")
             if t.get("y")}
    check("its numbers stand at their values",
          [words[f"\N{MINUS SIGN}{n}"] if n else words["0"] for n in (40, 30, 20, 10, 0)],
          [FLOOR + (TOP - FLOOR) * (45 - n) / 45 + 4 for n in (40, 30, 20, 10, 0)])
    if "dB below white" not in [t.text for t in root.iter(SVG + "text")]:
        check("what they are", [1], [0])


def look_at_log(root):
    top = TOP + 26  # below the title
    found = circles(root)
    low, high = -0.05, 2.05  # decades, a little more than the data
    places = [(LEFT + (RIGHT - LEFT) * math.log10(x) / 3,
               FLOOR + 26 + (top - FLOOR - 26) * (math.log10(y) - low) / (high - low), 2.6)
              for x, y in ((10, 1), (100, 100))]
    check("dots over logarithms", found[0] + found[1], [*places[0], *places[1]])


def look_at_png(pixels):
    check("a PNG has two pixels a unit", [len(pixels[0]), len(pixels)], [1120, 694])
    red = (0, 143, 107)  # series 3
    check("a dot's middle", pixels[round(2 * down(2.5))][round(2 * across(2.5))], red, 1)
    mine = [(x, y) for y in range(694) for x in range(1120)
            if pixels[y][x] == red and abs(x - 2 * across(2.5)) < 16 and abs(y - 2 * down(2.5)) < 16]
    middle = [sum(p[k] + 0.5 for p in mine) / len(mine) for k in (0, 1)]
    check("a dot's center of gravity", middle, [2 * across(2.5), 2 * down(2.5)], 0.3)
    check("the paper", pixels[3][3], (255, 255, 255))


folder = sys.argv[1] + "/"
look_at_svg(tree.parse(folder + "all.svg").getroot())
look_at_bar(tree.parse(folder + "bar.svg").getroot())
look_at_log(tree.parse(folder + "log.svg").getroot())
with open(folder + "all.png", "rb") as file:
    look_at_png(rows(file.read()))
sys.exit(failed > 0)
