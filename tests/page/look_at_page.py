#!/usr/bin/env python3
"""Looks at a page of weft page in a browser: look_at_page.py CHROMIUM PAGE CLIP.y4m[:709]..
The clips are those that the page was made of, in their order, with the matrix that is not BT.601's."""
import base64
import pathlib
import re
import sys

from browser import Browser
from page_text import Structure, check, failed
from y4m_fields import Clip

FADE = 0.14  # of a tube's line after one field

CANVAS = """(function (panel) {
  var c = weftPlayer.panels[panel].canvas;
  var d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data, text = "";
  for (var k = 0; k < d.length; k += 8192) text += String.fromCharCode.apply(null, d.subarray(k, k + 8192));
  return btoa(text);
})(%d)"""


# ---- Pixels ----

def expected(clip, fields, tick, mode, columns):
    """Lines of [R', G', B'] that the screen should show, and how far each may be off."""
    now, before = tick % fields, (tick - 1) % fields
    if mode == "frame":
        before = now ^ 1
    own, last, out = (now + clip.first) % 2, clip.lines - 1, []
    for y in range(clip.lines):
        if y % 2 == own:
            out.append((clip.line(now, y, columns), 0))
        elif mode == "bob":
            above = clip.line(now, y - 1 if y else 1, columns)
            below = clip.line(now, y + 1 if y < last else last - 1, columns)
            out.append(([[(a + b) >> 1 for a, b in zip(*pair)] for pair in zip(above, below)], 0))
        elif mode == "crt":
            out.append(([[FADE * v for v in pixel] for pixel in clip.line(before, y, columns)], 1))
        else:
            out.append((clip.line(before, y, columns), 0))
    return out


def shown(page, clip, panel):
    data, step = base64.b64decode(page.run(CANVAS % panel)), 4 * clip.width
    return [data[y * step:(y + 1) * step] for y in range(clip.lines)]


def worst(page, clip, panel, fields, tick, mode, columns):
    """How far the canvas is from the clip, in codes, beyond what is allowed."""
    rows, most = shown(page, clip, panel), 0
    for row, (line, allowed) in zip(rows, expected(clip, fields, tick, mode, columns)):
        for x, pixel in zip(columns, line):
            off = max(abs(a - b) for a, b in zip(row[4 * x:4 * x + 3], pixel))
            most = max(most, off - allowed, 255 - row[4 * x + 3])
    return most


def pixels(page, clips, fields):
    """Every clip in every mode, all lines: byte for byte the fields."""
    for number, clip in enumerate(clips):
        page.run(f"weftPlayer.setVariant({number % 2}, 'clip-{number}')")
        for mode in ("weave", "bob", "crt", "frame"):
            most = 0
            for tick in (0, 1, fields - 1, fields + 2):
                page.run(f"weftPlayer.setMode('{mode}'); weftPlayer.tick = {tick}; weftPlayer.draw();")
                columns = sorted({0, 1, clip.width - 1, *range(tick % 7, clip.width, 23)})
                most = max(most, worst(page, clip, number % 2, fields, tick, mode, columns))
            check(f"clip {number}, {mode}: all lines are those of the right fields", most <= 0, str(most))
        formulas(page, clip, number)


def formulas(page, clip, number):
    """The first frame beside the standards' formulas: grays to the nearest code, color to what rounding leaves."""
    page.run("weftPlayer.setMode('weave'); weftPlayer.tick = 1; weftPlayer.draw();")
    off, gray_off, grays = 0, 0, 0
    for y, row in enumerate(shown(page, clip, number % 2)):
        field = 0 if y % 2 == clip.first else 1
        for x in range(0, clip.width, 22):
            exact = clip.exact(field, y, x)
            worst = max(abs(row[4 * x + k] - exact[k]) for k in range(3))
            off = max(off, worst)
            if clip.is_gray(field, y, x):
                grays, gray_off = grays + 1, max(gray_off, worst)
    *_, blue = clip.weights()
    rounding = 0.5 + (0.5 * (1 + blue) if clip.bits > 8 else 0)
    check(f"clip {number}: within what 8 bits leave of the standards' formulas", off <= rounding + 0.01, str(off))
    check(f"clip {number}: grays are the nearest there are", gray_off <= 0.501, f"{gray_off}, of {grays}")


# ---- Handling ----

def key(page, name, shift="false"):
    return page.run(f"""document.getElementById('player').dispatchEvent(new KeyboardEvent('keydown',
        {{key: '{name}', shiftKey: {shift}, bubbles: true}})),
        [weftPlayer.tick, weftPlayer.mode, weftPlayer.layout, weftPlayer.wipe, weftPlayer.heat, weftPlayer.zoom]""")


def steps(page):
    page.run("weftPlayer.tick = 4; weftPlayer.setLayout('side')")
    got = [key(page, "ArrowRight")[0], key(page, "ArrowLeft")[0], key(page, "ArrowRight", "true")[0]]
    check("arrows step fields and frames", got == [5, 4, 6], str(got))
    check("letters choose the display", [key(page, k)[1] for k in "bwfc"] == ["bob", "weave", "frame", "crt"])
    check("s makes a wipe and takes it back", [key(page, "s")[2] for _ in "12"] == ["wipe", "side"])
    page.run("weftPlayer.setWipe(50)")
    check("brackets move the wipe", [key(page, k)[3] for k in "[]]"] == [45, 50, 55])
    check("h shows the heat map and hides it", [key(page, "h")[4] for _ in "12"] == [True, False])
    check("plus and minus change the size", [key(page, "+")[5], key(page, "-")[5]] == [2, 1])
    key(page, " ")
    wait = "new Promise(function (done) { setTimeout(function () { done(weftPlayer.tick); }, %d); })"
    before = page.run(wait % 1)
    check("space plays", page.run(wait % 800) > before)
    key(page, " ")
    before = page.run(wait % 100)
    check("and pauses", page.run(wait % 200) == before and page.run("weftPlayer.playing") is False)
    stops = page.run("""Array.from(document.querySelectorAll('#player button, #player select, #player input'))
        .filter(function (e) { return e.offsetParent; }).map(function (e) {
          e.focus();
          return document.activeElement === e && (e.textContent.trim() || e.labels.length > 0); })""")
    check("everything can be reached by keys and has a name", stops and all(stops), str(stops))


WIPED = """(function () {
  var over = document.querySelector('[data-screen="1"]'), under = document.querySelector('[data-screen="0"]');
  var a = over.getBoundingClientRect(), b = under.getBoundingClientRect();
  var line = document.querySelector('.screens').getBoundingClientRect();
  return [getComputedStyle(over).clipPath, Math.abs(a.left - b.left) + Math.abs(a.top - b.top) +
          Math.abs(a.width - line.width) + Math.abs(a.left - line.left)];
})()"""


def wipe(page):
    page.run("weftPlayer.setLayout('wipe'); weftPlayer.setWipe(30)")
    clip, apart = page.run(WIPED)
    check("in a wipe the right picture lies over the left", "30%" in clip and apart < 1, str([clip, apart]))
    page.run("""(function () { var r = document.querySelector('[data-set="wipe"]'); r.value = 70;
                r.dispatchEvent(new Event('input', {bubbles: true})); })()""")
    check("a slider moves it", "70%" in page.run(WIPED)[0])
    page.run("weftPlayer.setLayout('side')")


def heat(page, clips):
    page.run("weftPlayer.setHeat(true)")
    found = page.run("""Array.from(document.querySelectorAll('canvas.heat')).map(function (c) {
        var d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data, n = 0;
        for (var k = 3; k < d.length; k += 4) n += d[k] > 60;
        var a = c.getBoundingClientRect(), b = c.parentNode.querySelector('canvas').getBoundingClientRect();
        return [c.width, c.height, n / c.width / c.height, Math.abs(a.left - b.left) + Math.abs(a.top - b.top) +
                Math.abs(a.width - b.width)]; })""")
    size = [clips[0].width, clips[0].lines]
    check("heat maps lie on the pictures", len(found) == min(2, len(clips)) and all(
        f[:2] == size and 0 < f[2] < 0.9 and f[3] < 1 for f in found), str(found))
    page.run("weftPlayer.setHeat(false)")


def screens(page):
    for width, ratio in ((1280, 1), (390, 1), (390, 3), (1600, 1.5)):
        page.call("Emulation.setDeviceMetricsOverride", width=width, height=844, deviceScaleFactor=ratio,
                  mobile=False)
        page.run("new Promise(function (done) { window.dispatchEvent(new Event('resize')); "
                 "requestAnimationFrame(function () { requestAnimationFrame(done); }); })")
        for layout, zoom in (("side", "fit"), ("side", 1), ("wipe", "fit"), ("wipe", 1)):
            page.run(f"weftPlayer.setLayout('{layout}'); weftPlayer.setZoom('{zoom}')")
            wide = page.run("document.documentElement.scrollWidth")
            check(f"it fits {width} pixels, {layout}, {zoom}", wide <= width, str(wide))
            scales = page.run("""Array.from(document.querySelectorAll('#player canvas')).filter(
                function (c) { return c.offsetParent; }).map(function (c) { return c.getBoundingClientRect().width * window.devicePixelRatio / c.width; })""")
            check(f"pixels are whole at {width}, {ratio}", all(abs(s - max(1, round(s))) < 0.01 for s in scales),
                  str(scales))
            box = page.run("""[document.querySelector('#player canvas').getBoundingClientRect().width,
                               document.querySelector('#player .screens').clientWidth]""")
            check(f"what fits does, at {width}, {ratio}", zoom == 1 or box[0] <= box[1] + 1 or scales[0] < 1.01, str(box))
        small = page.run("""Array.from(document.querySelectorAll('#player button, #player select')).filter(
            function (e) { return e.offsetParent && e.getBoundingClientRect().height < 24; }).length""")
        check(f"nothing is too small to touch at {width}", small == 0, str(small))
    page.call("Emulation.clearDeviceMetricsOverride")


# ---- Text ----

def luminance(color):
    parts = [int(color[k:k + 2], 16) / 255 for k in (1, 3, 5)]
    light = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in parts]
    return 0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2]


def contrast(text):
    """Of all words on both backgrounds, in both schemes: 4.5 (WCAG 2.1, 1.4.3)."""
    for scheme in re.findall(r":root \{(.*?)\}", text, re.S):
        color = dict(re.findall(r"--(\w+): (#[0-9a-f]{6})", scheme))
        for ink in ("ink", "soft", "accent"):
            for paper in ("paper", "card"):
                a, b = sorted((luminance(color[ink]), luminance(color[paper])))
                check(f"{ink} on {paper}", (b + 0.05) / (a + 0.05) >= 4.5, f"{(b + 0.05) / (a + 0.05):.2f}")


def read(text):
    page = Structure()
    page.feed(text)
    page.close()
    check("tags close as they opened", not page.wrong and not page.open, str(page.wrong[:3]))
    check("ids are given once", len(page.ids) == len(set(page.ids)))
    check("nothing is fetched", not page.outside and "@import" not in text and "http" not in re.sub(
        r"<script.*?</script>", "", text, flags=re.S), str(page.outside[:3]))
    for name in ("player", "measures", "notes"):
        check(f"{name} is there", name in page.ids)
    contrast(text)


def main(chromium, path, *clips):
    text = pathlib.Path(path).read_text(encoding="utf-8")
    read(text)
    clips = [Clip(*clip.split(":")) for clip in clips]
    fields = 2 * min(len(clip.frames) for clip in clips)
    with Browser(chromium) as page:
        page.open(pathlib.Path(path).resolve().as_uri())
        check("nothing plays by itself", page.run("weftPlayer.loaded.then(function () { return "
                                                  "weftPlayer.ready && !weftPlayer.playing; })"))
        page.run("weftPlayer.setLayout('side')")
        pixels(page, clips, fields)
        heat(page, clips)
        if len(clips) > 1:
            steps(page)
            wipe(page)
        screens(page)
        check("no script failed", not page.run("window.pageErrors.length") and not page.complaints(),
              str(page.run("window.pageErrors")) + str(page.complaints()))
    print(f"{len(failed)} checks failed" if failed else "all checks passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
