"""Figures 1 to 3: where the samples of interlaced video lie, and what that does to spectra."""
import math

from analysis import decibels, mean, spectrum, steps
from page import figure, side_by_side
from plots import Plot, axis, number

FIELD_RATE = 60000 / 1001
SUBCARRIER = (35 / 132, 0.25)  # cycles a pixel, cycles a frame line; 15 Hz


def signal(clip, fields, x0=0, x1=None):
    """The mean over x of every line at every field; 0 where a field has no line."""
    x1 = clip.width if x1 is None else x1
    rows = [[0.0] * fields for _ in range(clip.lines)]
    progressive = clip.scan == "p"
    for n in range(fields):
        frame, lines = (n, range(clip.lines)) if progressive else (n // 2, clip.own_lines(n))
        for y in lines:
            rows[y][n] = mean(clip.line(frame, y, x0, x1))
    return rows


def peak(levels, xs, ys, center, reach):
    """The largest level within reach of center, and where."""
    return max((levels[j][i], x, y) for i, x in enumerate(xs) if abs(x - center[0]) <= reach[0]
               for j, y in enumerate(ys) if abs(y - center[1]) <= reach[1])


def likeness(levels, a, b, reach):
    """Correlation of the surroundings of two points of a spectrum, on decibels."""
    def patch(at):
        return [decibels(levels[at[1] + j][at[0] + i], -80) for j in range(-reach[1], reach[1] + 1)
                for i in range(-reach[0], reach[0] + 1)]
    p, q = patch(a), patch(b)
    mp, mq = mean(p), mean(q)
    norm = math.sqrt(sum((v - mp) ** 2 for v in p) * sum((v - mq) ** 2 for v in q))
    return sum((v - mp) * (w - mq) for v, w in zip(p, q)) / norm if norm else 0.0


def replica(levels, xs, ys, near, reach):
    """Where the baseband's pattern is found again near a place: x, y, likeness, level in dB."""
    i0, j0 = len(xs) // 2, len(ys) // 2
    dx, dy = xs[1] - xs[0], ys[1] - ys[0]
    i1, j1 = i0 + round(near[0] / dx), j0 + round(near[1] / dy)
    window = (4, 4)
    best = (-2,)
    for j in range(j1 - reach, j1 + reach + 1):
        for i in range(i1 - reach, i1 + reach + 1):
            if window[0] <= i < len(xs) - window[0] and window[1] <= j < len(ys) - window[1]:
                best = max(best, (likeness(levels, (i0, j0), (i, j), window), i, j))
    alike, i, j = best
    height = peak(levels, xs, ys, (xs[i], ys[j]), (2 * dx, 2 * dy))[0]
    base = peak(levels, xs, ys, (0, 0), (2 * dx, 2 * dy))[0]
    return xs[i], ys[j], alike, decibels(height / base)


def add_levels(plot, levels, box, floor=-45):
    """A spectrum in decibels, below its largest value."""
    top = max(map(max, levels))
    plot.map([[decibels(v / top, floor) for v in row] for row in reversed(levels)], box, floor, 0)


# ---- Figure 1 ----

def scan_plot(weft, clip, fields, x0, x1):
    """Dots where there are samples, as bright as they are."""
    first = fields // 2 - 6
    middle = clip.lines // 2
    plot = Plot(axis(-0.6, 11.6, "time, fields of 1/59.94 s", ticks=range(0, 12)),
                axis(12.5, -12.5, "y, scan lines", ticks=range(-12, 13, 4)),
                "Samples of an interlaced picture in time and height: every field has every other "
                "line")
    plot.map([[0]], (-0.6, 11.6, -12.5, 12.5), 0, 1)  # a dark ground
    dots, shades = [], []
    for n in range(first, first + 12):
        for y in clip.own_lines(n):
            if abs(y - middle) > 12:
                continue
            dots.append((n - first, y - middle))
            shades.append(0.18 + 0.82 * min(1.0, 1.8 * mean(clip.line(n // 2, y, x0, x1))) ** (1 / 2.4))
    plot.add("points", points=dots, shades=shades, radius=4.6)
    return plot.svg(weft)


def field_interval(clip, fields, x0, x1, speed):
    """Seconds between fields, by how far a bar of known speed gets from one to the next."""
    places = []
    for n in range(fields // 2 - 10, fields // 2 + 10):
        pairs = [(y, mean(clip.line(n // 2, y, x0, x1))) for y in clip.own_lines(n)]
        places.append(sum(y * v for y, v in pairs) / sum(v for _, v in pairs))
    middle = (len(places) - 1) / 2
    slope = sum((k - middle) * p for k, p in enumerate(places)) / sum(
        (k - middle) ** 2 for k in range(len(places)))
    return slope / speed


# ---- Figures 2 and 3 ----

def interlace_plot(weft, levels, xs, ys, title, rings):
    plot = Plot(axis(xs[0] * FIELD_RATE, xs[-1] * FIELD_RATE, "temporal frequency, Hz",
                     ticks=(-60, -30, 0, 30, 60)),
                axis(ys[0], ys[-1], "vertical frequency, cycles a line", ticks=(-1, -0.5, 0, 0.5, 1)),
                title, height=400)
    add_levels(plot, levels, (xs[0] * FIELD_RATE, xs[-1] * FIELD_RATE, ys[-1], ys[0]))
    if rings:
        plot.ring(0, 0, "baseband")
        for x, y, text in ((30, 0.5, "30 Hz, 0.5"), (60, 0, "60 Hz, 0"), (0, 1, "0, 1")):
            plot.ring(x, y, text)
        plot.ring(15, SUBCARRIER[1], "C", 11, below=True, dashed=True)
    return plot.svg(weft)


def flicker_share(levels, xs, ys):
    """Energy that shows as coarse 20 to 40 Hz flicker, over that of the coarse picture."""
    def energy(low, high):
        return sum(levels[j][i] ** 2 for i, x in enumerate(xs) for j, y in enumerate(ys)
                   if low <= abs(x) * FIELD_RATE <= high and abs(y) < 0.15)
    return decibels(math.sqrt(energy(22, 38) / energy(0, 10)))


def temporal(ctx):
    """Spectra of the fan: aperture or 'progressive' to levels, on axes in cycles a field, a line."""
    xs, ys = steps(-1.25, 1.25, 121), steps(-1.25, 1.25, 101)
    size, frames = ("72x128", 32) if not ctx.quick else ("72x96", 24)
    found, clips = {}, {}
    for aperture in ("notch", "box", "line"):
        clip = ctx.weft.clip("fan", f"{size}@30000/1001i,bff", aperture, frames, tau=0, samples=64,
                             seconds=2 * frames / FIELD_RATE)
        clips[aperture] = clip
        found[aperture] = spectrum(signal(clip, 2 * frames), xs, ys)
    clip = ctx.weft.clip("fan", f"{size}@60000/1001p", "notch", 2 * frames, tau=0, samples=64,
                         seconds=2 * frames / FIELD_RATE)
    found["progressive"] = spectrum(signal(clip, 2 * frames), xs, ys)
    return xs, ys, found, clips, 2 * frames


def spatial(ctx):
    xs = steps(-1.25, 1.25, 101)
    clip = ctx.weft.clip("sticks", "96x96@30i,tff", "shaped", samples=64)
    return xs, spectrum(clip.picture(), xs, xs)


def spatial_plot(weft, levels, xs):
    plot = Plot(axis(xs[0], xs[-1], "horizontal frequency, cycles a pixel", ticks=(-1, -0.5, 0, 0.5, 1)),
                axis(xs[0], xs[-1], "vertical frequency, cycles a line", ticks=(-1, -0.5, 0, 0.5, 1)),
                "Measured spectrum over x and y: the picture's star again at every sampling "
                "frequency",
                height=400)
    add_levels(plot, levels, (xs[0], xs[-1], xs[-1], xs[0]))
    plot.ring(0, 0, "baseband")
    plot.ring(1, 0, "1, 0")
    plot.ring(0, 1, "0, 1")
    for x in (-SUBCARRIER[0], SUBCARRIER[0]):
        for y in (-SUBCARRIER[1], SUBCARRIER[1]):
            plot.ring(x, y, "C", 11, below=y < 0, dashed=True)
    return plot.svg(weft)


def line_flicker(ctx):
    """Means of both fields of stripes one line high, by aperture."""
    found = {}
    for aperture in ("line", "box", "notch", "shaped"):
        clip = ctx.weft.clip("grating", "32x64@30i,tff", aperture, samples=256)
        # Away from the upper and lower edge, where apertures reach out of the picture.
        means = [mean([mean(row) for row in clip.field(n)[4:-4]]) for n in (0, 1)]
        found[aperture] = abs(means[0] - means[1])
    return found


def run(ctx):
    xs, ys, found, clips, fields = temporal(ctx)
    width = clips["notch"].width // 9
    seconds = field_interval(clips["notch"], fields, 8 * width + 1, 9 * width - 1, 60)
    places = {near: replica(found["notch"], xs, ys, near, 6) for near in ((0.5, 0.5), (1, 0), (0, 1))}
    interlaced, plain = [peak(found[name], xs, ys, (0.5, 0.5), (0.06, 0.06))[0] /
                         peak(found[name], xs, ys, (0, 0), (0.06, 0.06))[0]
                         for name in ("notch", "progressive")]
    shares = {name: flicker_share(found[name], xs, ys) for name in ("line", "box", "notch")}
    sx, star = spatial(ctx)
    flat = {near: replica(star, sx, sx, near, 5) for near in ((1, 0), (0, 1))}
    stripes = line_flicker(ctx)
    section(ctx, (xs, ys, found, clips, fields, width), (seconds, plain, shares), (sx, star))
    rows(ctx, seconds, places, (interlaced, plain), flat)
    ctx.report.row("§3", "A pattern brighter on every other line flickers at 30 Hz.",
                   "stripes one line high, light 0.1 and 0.8: the fields differ by "
                   f"{number(stripes['line'], 3)} through <i>line</i>; by "
                   f"{number(stripes['box'], 4)}, {number(stripes['notch'], 4)}, "
                   f"{number(stripes['shaped'], 4)} through <i>box</i>, "
                   f"<i>notch</i>, <i>shaped</i>", stripes["line"] > 0.5 > 50 * stripes["shaped"])


def section(ctx, times, figures, stars):
    xs, ys, found, clips, fields, width = times
    seconds, plain, shares = figures
    first = scan_plot(ctx.weft, clips["notch"], fields, 6 * width + 1, 7 * width - 1)
    second = side_by_side(
        interlace_plot(ctx.weft, found["notch"], xs, ys, "Measured spectrum of interlaced fields: the fan and "
                       "its replicas", True),
        interlace_plot(ctx.weft, found["progressive"], xs, ys, "The same without interlace: no replica at "
                       "30 Hz and half a cycle a line", False))
    ctx.report.section(
        "lattice", "Half a picture at a time",
        "Interlaced video never shows a whole picture. A field has every other line, the next "
        "one, a sixtieth of a second later, the lines between. In time and height the samples "
        "form a quincunx, like the five on a die.",
        figure("fig-1", first, "<b>Figure 1.</b> Samples of a bar that sinks slowly, as rendered: "
               "each dot is the measured light of one scan line in one field. The bar's path "
               f"between fields says how far apart they are: {number(1000 * seconds, 2)} ms."),
        "Sampling copies a spectrum to wherever the lattice says. To see that, nine thin bars "
        "cross the picture, each at its own speed. A steady speed is a slanted line in the "
        "spectrum, so together they are a fan, and a fan is easy to find again.",
        figure("fig-2", second.replace("row n2", "row n2 plots"),
               "<b>Figure 2.</b> The measured (t, y) spectrum, 45 dB from light to dark. Left: "
               "interlaced. The fan stands again at 60 Hz, at one cycle a line, and at 30 Hz with "
               "half a cycle a line. Right: the same bars without interlace, where the last one "
               f"is missing (measured there: {number(decibels(plain), 0)} dB). C marks the color "
               "subcarrier of NTSC."),
        "That replica at the upper right is all the trouble with interlace. What a picture has at "
        "half a cycle a line comes back at 30 Hz as coarse flicker. How much of it there is "
        "depends on how the lines were filtered before there were lines: relative to the picture "
        f"itself, flicker stands at {number(shares['line'], 1)} dB when each looks at one line's "
        f"height, {number(shares['box'], 1)} dB for two lines and {number(shares['notch'], 1)} dB "
        "for the paper's smooth filter.",
        figure("fig-3", '<div class="row n2 plots">' + spatial_plot(ctx.weft, stars[1], stars[0]) +
               "<div><p>Across the picture nothing is interlaced, and the lattice is the plain "
               "one of pixels and lines. The star is the spectrum of twelve crossed sticks. Its "
               "copies at one cycle a pixel and one cycle a line are what ordinary antialiasing "
               "keeps apart.</p><p>The four circles C are where NTSC puts color: 35/132 cycles a "
               "pixel across and a quarter of a cycle a line down. Fine diagonal detail of the "
               "picture itself falls into "
               'them. <a href="#color">Further down</a> they turn into colored bullseyes.</p></div></div>',
               "<b>Figure 3.</b> The measured (x, y) spectrum of a still picture."))


def rows(ctx, seconds, places, levels, flat):
    add = ctx.report.row
    add("Fig. 1", "Odd lines are scanned in one 1/60 s, even lines in the next.",
        f"{number(1000 * seconds, 2)} ms between fields (1/59.94 s is 16.68 ms)",
        abs(seconds * FIELD_RATE - 1) < 0.01)
    x, y, alike, level = places[(0.5, 0.5)]
    ok = abs(x - 0.5) < 0.01 and abs(y - 0.5) < 0.01 and alike > 0.95 and levels[1] < 0.02
    add("Fig. 2", "Interlaced sampling puts a replica of the spectrum at 30 Hz, 0.5 cycles a line.",
        f"found at {number(x * FIELD_RATE, 1)} Hz, {number(y, 2)} c/line, level {number(level, 1)} "
        "dB, "
        f"correlation {number(alike, 3)}; without interlace {number(decibels(levels[1]), 0)} dB", ok)
    x, y, alike, level = places[(1, 0)]
    x2, y2, alike2, level2 = places[(0, 1)]
    add("Fig. 2", "Further replicas stand at 60 Hz and at 1 cycle a line.",
        f"{number(x * FIELD_RATE, 1)} Hz, {number(y, 2)} c/line ({number(level, 1)} dB); "
        f"{number(x2 * FIELD_RATE, 1)} Hz, {number(y2, 2)} c/line ({number(level2, 1)} dB)",
        abs(x - 1) < 0.01 and abs(y2 - 1) < 0.01 and min(alike, alike2) > 0.95)
    (x, y, alike, level), (x2, y2, alike2, level2) = flat[(1, 0)], flat[(0, 1)]
    add("Fig. 3", "In (x, y) the lattice is that of the pixels: no replica between.",
        f"({number(x, 2)}, {number(y, 2)}) and ({number(x2, 2)}, {number(y2, 2)}) cycles a pixel "
        f"and a line, {number(level, 1)} and {number(level2, 1)} dB",
        abs(x - 1) < 0.03 and abs(y2 - 1) < 0.03 and min(alike, alike2) > 0.95)
