#!/usr/bin/env python3
"""Looks at the page that examples/paper makes, as text and in a browser: paper_page.py PAGE CHROMIUM [part]

With "part" the page is of some experiments only: how much there is of everything is not looked at.
"""
import base64
import json
import math
import pathlib
import random
import re
import struct
import sys
import zlib

from browser import Browser
from page_text import Structure, check, failed

IDS = [f"fig-{n}" for n in range(1, 12)] + [
    "lattice", "rotated", "crawl", "slow-edges", "rule", "judder", "wheel", "wings", "per-object",
    "bullseyes", "frontier", "default", "default-plot", "player", "table"]
FADE = 0.14


# ---- As text ----

def read(text, whole):
    page = Structure()
    page.feed(text)
    page.close()
    check("tags close as they opened", not page.wrong and not page.open, str(page.wrong[:3]))
    check("ids are given once", len(page.ids) == len(set(page.ids)))
    check("nothing is fetched", not page.outside and "@import" not in text, str(page.outside[:3]))
    unclean = [alt for alt in page.alts if not alt.strip() or re.search(r"[<>&]|\\b(None|nan)\\b", alt)]
    check("pictures have words without tags", not unclean, str(unclean[:3]))
    for name in IDS if whole else ["player", "table"]:
        check(f"{name} is there", name in page.ids)
    if "default" in page.ids or whole:
        defaults(text)
    check("no number is missing", not re.search(r"\bnan\b|\binf\b|None", re.sub(
        r"data:image/png;base64,[A-Za-z0-9+/=]+|<script.*?</script>", "", text, flags=re.S)))


def defaults(text):
    """The default's figures are those that the bench publishes, which holds them to what it measured."""
    bench = pathlib.Path(__file__).parent.parent / "bench/README.md"
    rows = re.findall(r"^\| (\w+) \| (\d+) \| `(\w+)` \| (\d+) \+- (\d+) % \| ([\d.]+), ([\d.]+) \| `(\w+)` \|$",
                      bench.read_text(encoding="utf-8"), re.M)
    section = re.search(r'<section id="default".*?</section>', text, re.S)
    said = " ".join(re.sub(r"<[^>]*>", " ", section.group() if section else "").split())
    wanted = ["{} {} {} {} ± {} % {}, {} {}".format(*row) for row in rows]
    check("the default's figures are the bench's", len(rows) == 3 and all(row in said for row in wanted),
          str([row for row in wanted if row not in said]))


# ---- Verdicts, told again from figures and thresholds ----

def verdict(needs):
    """One figure beyond the threshold of differing is enough; all beyond that of agreeing are needed."""
    differ = [not sign * value > sign * against for _, value, sign, _, against in needs]
    agree = [sign * value > sign * for_it for _, value, sign, for_it, _ in needs]
    return "differs" if any(differ) else "agrees" if needs and all(agree) else "open"


def thresholds(rows):
    """Rows as [text of the verdict, needs]: the word follows from what stands beside it."""
    wrong = [row for row in rows if not row[0].startswith(verdict(row[1]))]
    check("verdicts follow from their thresholds", not wrong, str(wrong[:2]))
    untold = [row for row in rows for need in row[1] if need[0].split("<")[0].strip() not in row[0]]
    check("thresholds stand beside verdicts", not untold, str(untold[:2]))
    # A need with one threshold both agrees and differs there; with two, one lies beyond the other.
    loose = [need for _, needs in rows for need in needs if need[2] * need[3] < need[2] * need[4] or
             not all(map(math.isfinite, need[1:]))]
    check("no figure can only agree", not loose, str(loose[:2]))
    claims = [row for row in rows if not row[1]]
    check("few claims are left to taste", len(claims) <= len(rows) / 8, str(len(claims)))


def noise(examples):
    """Figures 2 and 3 of noise: a test of displayed light that noise passes would be none."""
    sys.path.insert(0, examples)
    import claims
    import lattice
    from page import Report
    rng, report = random.Random(1), Report()
    xs = lattice.steps(-1.25, 1.25, 121)
    fields = [[rng.random() if y % 2 != n % 2 else 0.0 for n in range(48)] for y in range(96)]
    fan = lattice.shown(fields, xs, xs)
    still = [x / lattice.DOWN for x in xs]
    star = lattice.spectrum(lattice.spots([[rng.random() for _ in range(96)] for _ in range(96)]), still, still)
    lattice.spectra(report, {name: [lattice.fan().found(fan, xs, xs, near) for near in lattice.REPLICAS]
                             for name in ("notch", "progressive")},
                    [lattice.star().found(star, xs, xs, near)
                     for near in ((1, 0), (0, 1), (0.5, 0.5), (0.5, 0), (0, 0.5))])
    told = [claims.verdict(row[3]) for row in report.rows]
    check("noise is not taken for Figures 2 and 3", told == [False] * 3, str(told))


# ---- The player's fields, found without it ----

def decode(uri):
    """Rows of R G B from the page's PNGs: 8 bits, gray or R G B, filters 0, 1 and 2."""
    data = base64.b64decode(uri.split(",", 1)[1])
    width, lines, _, kind = struct.unpack(">IIBB", data[16:26])
    step, at, body = (3 if kind == 2 else 1), 8, b""
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        body += data[at + 8:at + 8 + size] if name == b"IDAT" else b""
        at += 12 + size
    raw, rows = zlib.decompress(body), []
    for y in range(lines):
        row = bytearray(raw[y * (step * width + 1) + 1:(y + 1) * (step * width + 1)])
        if raw[y * (step * width + 1)] == 1:
            for k in range(step, len(row)):
                row[k] = (row[k] + row[k - step]) & 255
        elif raw[y * (step * width + 1)] == 2 and rows:
            row = bytearray((a + b) & 255 for a, b in zip(row, rows[-1]))
        rows.append(row)
    return rows, step


def expected(clip, sprite, tick, mode, x):
    """A column's red as the screen should show it."""
    rows, step = sprite
    half, fields = clip["lines"] // 2, clip["fields"]

    def field_at(n):
        order = list(range(fields)) + (list(range(fields - 2, 0, -1)) if clip["bounce"] else [])
        return order[n % len(order)]

    def light(field, y):
        return rows[field * half + y // 2][x * step]

    now, before = field_at(tick), field_at(tick - 1)
    if mode == "frame":
        before = now + 1 if now % 2 == 0 else now - 1
    own, last, out = (now + clip["first"]) % 2, clip["lines"] - 1, []
    for y in range(clip["lines"]):
        if y % 2 == own:
            out.append(light(now, y))
        elif mode == "bob":
            out.append((light(now, y - 1 if y else 1) + light(now, y + 1 if y < last else last - 1)) >> 1)
        else:
            out.append(light(before, y) * (FADE if mode == "crt" else 1))
    return out


COLUMN = """(function (panel, x) {
  var c = weftPlayer.panels[panel].canvas;
  var d = c.getContext("2d").getImageData(x, 0, 1, c.height).data;
  return Array.from({length: c.height}, function (_, y) { return d[4 * y]; });
})(%d, %d)"""


def screens(page, clips):
    """Every clip in every mode: canvas against fields."""
    for clip in clips:
        page.run(f"weftPlayer.setClip('{clip['id']}')")
        names = page.run("weftPlayer.panels.map(function (p) { return p.variant.name; })")
        check(f"{clip['id']} opens on two apertures", len(set(names)) == 2, str(names))
        by_name = {v["name"]: decode(v["sprite"]) for v in clip["variants"]}
        for mode in ("crt", "bob", "weave", "frame"):
            worst = 0
            for tick in (0, 1, clip["fields"] + 1):
                page.run(f"weftPlayer.setMode('{mode}'); weftPlayer.tick = {tick}; weftPlayer.draw();")
                for panel, name in enumerate(names):
                    x = clip["width"] // 3
                    shown = page.run(COLUMN % (panel, x))
                    wanted = expected(clip, by_name[name], tick, mode, x)
                    worst = max(worst, max(abs(a - b) for a, b in zip(shown, wanted)))
            check(f"{clip['id']}, {mode}: the right lines of the right fields", worst <= 1, str(worst))


def steps(page):
    """Buttons, keys and time."""
    press = lambda name: page.run(f"""document.querySelector('#player [data-do="{name}"]').click(),
                                   weftPlayer.tick""")
    page.run("weftPlayer.tick = 4; weftPlayer.draw()")
    got = [press(name) for name in ("field", "field", "field-back", "frame", "frame-back", "frame-back")]
    check("buttons step fields and frames", got == [5, 6, 5, 6, 4, 2], str(got))
    key = lambda name, shift: page.run(
        f"""document.getElementById('player').dispatchEvent(new KeyboardEvent('keydown',
            {{key: '{name}', shiftKey: {shift}, bubbles: true}})), weftPlayer.tick""")
    got = [key("ArrowRight", "false"), key("ArrowLeft", "false"), key("ArrowRight", "true")]
    check("keys step fields and frames", got == [3, 2, 4], str(got))
    key("b", "false")
    check("keys choose the display", page.run("weftPlayer.mode") == "bob")
    wait = """new Promise(function (done) { setTimeout(function () {
        done([weftPlayer.tick, performance.now()]); }, %d); })"""
    page.run("weftPlayer.setRate(50)")
    press("play")
    page.run(wait % 300)
    first, second = page.run(wait % 1), page.run(wait % 1500)
    rate = 1000 * (second[0] - first[0]) / (second[1] - first[1])
    check("it plays at its rate", 40 <= rate <= 60, f"{rate} fields in a second")
    check("fields that were shown are not told as left out", page.run("weftPlayer.dropped") <= 4 or
          "left out" in page.run("document.querySelector('.dropped').textContent"))
    page.run("(function () { var end = performance.now() + 500; while (performance.now() < end) {} })()")
    page.run(wait % 200)
    told = page.run("[weftPlayer.dropped, document.querySelector('.dropped').textContent]")
    check("fields left out are told", told[0] >= 15 and told[1].startswith(f"{told[0]} of "), str(told))
    press("play")
    first, second = page.run(wait % 100)[0], page.run(wait % 200)[0]
    check("it pauses", first == second and page.run("weftPlayer.playing") is False)


EXACT = """Array.from(document.querySelectorAll('img.exact, #player canvas')).map(function (i) {
    var box = i.getBoundingClientRect(), r = window.devicePixelRatio;
    return [box.width * r / (i.naturalWidth || i.width), box.height * r / (i.naturalHeight || i.height)]; })"""


def sizes(page, clip, whole):
    """Fine rings pixel by pixel, on screens of any density and size."""
    check("the player shows the whole raster", not whole or [clip["width"], clip["lines"]] == [720, 486])
    for width, ratio in ((1280, 1), (390, 1), (1280, 1.5), (800, 2)):
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=ratio,
                  mobile=False)
        page.run("new Promise(function (done) { window.dispatchEvent(new Event('resize')); "
                 "requestAnimationFrame(function () { requestAnimationFrame(done); }); })")
        scales_of = [s for pair in page.run(EXACT) for s in pair]
        off = [s for s in scales_of if abs(s - max(1, round(s))) > 0.01]
        check(f"pictures of rings are not scaled at {width} pixels, {ratio} a unit",
              scales_of and not off, str(off[:4]))
    page.call("Emulation.clearDeviceMetricsOverride")


def scales(page):
    """Every map of colors has a bar that tells them, and axes with names."""
    bare = page.run("""Array.from(document.querySelectorAll('.plot > svg')).filter(function (s) {
        var maps = s.querySelectorAll('image').length;
        return maps && !s.querySelector('circle[r="4.6"]') && maps < 2; }).length""")
    check("maps have bars of their colors", bare == 0, str(bare))
    silent = page.run("""Array.from(document.querySelectorAll('.plot > svg')).filter(function (s) {
        var words = Array.from(s.querySelectorAll('text')).map(function (t) { return t.textContent; });
        return words.filter(function (w) { return /[a-z]{2}/.test(w); }).length < 2; }).length""")
    check("axes have names", silent == 0, str(silent))


def look(page, text, whole):
    check("nothing plays by itself", page.run("weftPlayer.loaded.then(function () { return "
                                              "weftPlayer.ready && !weftPlayer.playing; })"))
    pictures = page.run("""Promise.all(Array.from(document.querySelectorAll('img, svg image')).map(function (i) {
        var copy = new Image();
        copy.src = i.src || i.href.baseVal;
        return copy.decode().then(function () { return copy.naturalWidth; }, function () { return 0; }); }))""")
    check("pictures are there", len(pictures) >= (30 if whole else 1) and min(pictures) > 0, str(pictures))
    charts = page.run("""Array.from(document.querySelectorAll('.plot > svg')).map(function (s) {
        return s.getBoundingClientRect().height > 50 &&
               s.querySelectorAll('polyline, circle, image').length > 0; })""")
    check("plots are drawn", len(charts) >= (15 if whole else 1) and all(charts), str(charts))
    rows = page.run("""Array.from(document.querySelectorAll('#table .claims tbody tr')).map(function (r) {
        return Array.from(r.cells).map(function (c) { return c.textContent; }); })""")
    check("the table has its rows", len(rows) >= (35 if whole else 1), str(len(rows)))
    thresholds(page.run("""Array.from(document.querySelectorAll('#table .claims tbody tr')).map(function (r) {
        var needs = r.querySelector('[data-needs]');
        return [r.cells[3].textContent, needs ? JSON.parse(needs.dataset.needs) : []]; })"""))
    bad = [r for r in rows if len(r) != 4 or not re.search(r"\d", r[2]) or
           not r[3].startswith(("agrees", "differs", "open"))]
    check("its rows have numbers and verdicts", not bad, str(bad))
    places = " ".join(r[0] for r in rows)
    gone = [n for n in range(1, 12) if not re.search(rf"Fig\. (\d+, )?{n}\b", places)]
    check("the table speaks of every figure", not whole or not gone, str(gone))
    clips = json.loads(re.search(r'id="player-data">(.*?)</script>', text, re.S).group(1))["clips"]
    screens(page, clips if whole else clips[::3])
    steps(page)
    sizes(page, clips[0], whole)
    scales(page)
    for width in (390, 1280):
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1,
                  mobile=False)
        wide = page.run("document.documentElement.scrollWidth")
        check(f"it fits {width} pixels", wide <= width, str(wide))
    check("no script failed", not page.run("window.pageErrors.length") and not page.complaints(),
          str(page.run("window.pageErrors")) + str(page.complaints()))


def main(path, chromium, part=""):
    whole = part != "part"
    text = pathlib.Path(path).read_text(encoding="utf-8")
    check("the page is not too large", len(text) < 22e6, str(len(text)))
    read(text, whole)
    noise(str(pathlib.Path(__file__).resolve().parents[2] / "examples" / "paper"))
    with Browser(chromium) as page:
        page.open(pathlib.Path(path).resolve().as_uri())
        look(page, text, whole)
    print(f"{len(failed)} checks failed" if failed else "all checks passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
