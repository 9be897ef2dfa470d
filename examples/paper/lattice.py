"""Figures 1 to 3: where the samples of interlaced video lie, and what that does to spectra."""
import math

from analysis import decibels, mean, spectrum, steps
from claims import above, below
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


# ---- What a display shows ----

ACROSS, DOWN, FADE = 4, 3, 0.14  # places a field and a line; what is left of light after a field
SPOT = 0.35                      # lines, the standard deviation of a tube's spot


def spread(values, step, weights, first):
    """Impulses `step` places apart, each spread by weights from `first` places before it on."""
    out = [0.0] * (len(values) * step)
    for k, value in enumerate(values):
        if value:
            for i, weight in enumerate(weights, k * step + first):
                if 0 <= i < len(out):
                    out[i] += weight * value
    return out


DECAY = [FADE ** ((k + 0.5) / ACROSS) for k in range(3 * ACROSS)]
REACH = 2 * DOWN
GLOW = [math.exp(-0.5 * (k / DOWN / SPOT) ** 2) for k in range(-REACH, REACH + 1)]


def lit(rows, across):
    """Light by line, DOWN places each, from impulses in rows, each spread by `across`: (places a step,
    weights, how far before it they begin)."""
    wide = [spread(row, *across) for row in rows]
    return [list(row) for row in zip(*(spread(column, DOWN, GLOW, -REACH) for column in zip(*wide)))]


def displayed(rows):
    """The light of a tube in height and time, DOWN places a line and ACROSS a field: every line is a spot
    that lights up when it is drawn and fades."""
    return lit(rows, (ACROSS, DECAY, 0))


def spots(picture):
    """The light of a still picture on a tube, DOWN places a pixel and a line."""
    return lit(picture, (DOWN, GLOW, -REACH))


def shown(rows, xs, ys):
    """The spectrum of what a display makes of lines by fields; axes in cycles a field and a line."""
    return spectrum(displayed(rows), [x / ACROSS for x in xs], [y / DOWN for y in ys])


# ---- Looking for a pattern ----

def peak(levels, xs, ys, center, reach):
    """The largest level within reach of center."""
    return max(levels[j][i] for i, x in enumerate(xs) if abs(x - center[0]) <= reach[0]
               for j, y in enumerate(ys) if abs(y - center[1]) <= reach[1])


def power(levels, xs, ys, center, directions, reach):
    """The mean power along rays that start from center, either way, at distances within reach."""
    dx, dy = xs[1] - xs[0], ys[1] - ys[0]
    found = []
    for ux, uy in directions:
        for r in steps(*reach, 13) + steps(-reach[0], -reach[1], 13):
            i, j = round((center[0] + r * ux - xs[0]) / dx), round((center[1] + r * uy - ys[0]) / dy)
            if 0 <= i < len(xs) and 0 <= j < len(ys):
                found.append(levels[j][i] ** 2)
    return mean(found) if found else 0.0


class Pattern:
    """Rays that a scene's spectrum is known to have, by their directions, and the gaps between them.
    Noise is as strong on the rays as between."""

    def __init__(self, rays, gaps, reach):
        self.rays, self.gaps, self.reach = rays, gaps, reach

    def stands_out(self, levels, xs, ys, center):
        """How far the rays stand above the gaps around center, in dB."""
        on, off = (power(levels, xs, ys, center, which, self.reach) for which in (self.rays, self.gaps))
        return 10 * math.log10(on / off) if on and off else -120.0

    def found(self, levels, xs, ys, near):
        """The place near `near` where it stands out most: dB, x, y, and its level against the middle's."""
        shifts = [k / 80 for k in range(-4, 5)]
        best = max((self.stands_out(levels, xs, ys, (near[0] + a, near[1] + b)), near[0] + a, near[1] + b)
                   for a in shifts for b in shifts)
        top = peak(levels, xs, ys, (0, 0), (0.06, 0.06))
        return (*best, decibels(peak(levels, xs, ys, near, (0.06, 0.06)) / top))


BARS = 5  # at -60, -30, 0, 30 and 60 lines a second


def fan():
    """Bars that move steadily are rays of slope speed over field rate."""
    slope = lambda lines: (-lines / FIELD_RATE, 1.0)
    return Pattern([slope(v) for v in (-60, -30, 0, 30, 60)], [slope(v) for v in (-45, -15, 15, 45)], (0.18, 0.4))


def star():
    """Sticks at 15 n + 4 degrees are rays across them; lines are counted downwards."""
    ray = lambda degrees: (math.cos(math.radians(degrees)), -math.sin(math.radians(degrees)))
    return Pattern([ray(15 * n + 4) for n in range(12)], [ray(15 * n + 11.5) for n in range(12)], (0.25, 0.42))


def add_levels(plot, levels, box, floor=-45):
    """A spectrum in decibels, below its largest value."""
    top = max(map(max, levels))
    plot.map([[decibels(v / top, floor) for v in row] for row in reversed(levels)], box, floor, 0,
             "level, dB below the strongest")


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
    size, frames = ("80x128", 32) if not ctx.quick else ("80x96", 24)
    found, clips = {}, {}
    for aperture in ("notch", "box", "line"):
        clip = ctx.weft.clip("fan", f"{size}@30000/1001i,bff", aperture, frames, tau=0, samples=64,
                             seconds=2 * frames / FIELD_RATE, columns=BARS)
        clips[aperture] = clip
        found[aperture] = shown(signal(clip, 2 * frames), xs, ys)
    clip = ctx.weft.clip("fan", f"{size}@60000/1001p", "notch", 2 * frames, tau=0, samples=64,
                         seconds=2 * frames / FIELD_RATE, columns=BARS)
    found["progressive"] = shown(signal(clip, 2 * frames), xs, ys)
    return xs, ys, found, clips, 2 * frames


def spatial(ctx):
    xs = steps(-1.25, 1.25, 141)
    clip = ctx.weft.clip("sticks", "160x160@30i,tff", "shaped", samples=64)
    scaled = [x / DOWN for x in xs]
    return xs, spectrum(spots(clip.picture()), scaled, scaled)


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


REPLICAS = ((0.5, 0.5), (1, 0), (0, 1))  # cycles a field, cycles a line


def run(ctx):
    xs, ys, found, clips, fields = temporal(ctx)
    width = clips["notch"].width // BARS
    seconds = field_interval(clips["notch"], fields, (BARS - 1) * width + 1, BARS * width - 1, 60)
    shares = {name: flicker_share(found[name], xs, ys) for name in ("line", "box", "notch")}
    sx, levels = spatial(ctx)
    stripes = line_flicker(ctx)
    fans = {name: [fan().found(found[name], xs, ys, near) for near in REPLICAS]
            for name in ("notch", "progressive")}
    stars = [star().found(levels, sx, sx, near) for near in ((1, 0), (0, 1), (0.5, 0.5), (0.5, 0), (0, 0.5))]
    section(ctx, (xs, ys, found, clips, fields, width), (seconds, fans["progressive"][0][3], shares), (sx, levels))
    rows(ctx, seconds, stripes)
    spectra(ctx.report, fans, stars)


def section(ctx, times, figures, stars):
    xs, ys, found, clips, fields, width = times
    seconds, plain, shares = figures
    first = scan_plot(ctx.weft, clips["notch"], fields, 3 * width + 1, 4 * width - 1)
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
        "Sampling copies a spectrum to wherever the lattice says. To see that, five thin bars "
        "cross the picture, each at its own speed. A steady speed is a slanted line in the "
        "spectrum, so together they are a fan, and a fan is easy to find again. What is looked at is "
        "light as a tube shows it: every line of a field lights up as a soft spot, "
        f"{number(SPOT)} of a line in standard deviation, and after one field {number(100 * FADE)} % is left of it.",
        figure("fig-2", second.replace("row n2", "row n2 plots"),
               "<b>Figure 2.</b> The (t, y) spectrum of the displayed light, 45 dB from light to dark. Left: "
               "interlaced. The fan stands again at 60 Hz, at one cycle a line, and at 30 Hz with "
               "half a cycle a line. Right: the same bars without interlace, where the last one "
               f"is missing (measured there: {number(plain, 0)} dB). C marks the color "
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
               "<b>Figure 3.</b> The (x, y) spectrum of the displayed light of a still picture."))


def rows(ctx, seconds, stripes):
    add = ctx.report.row
    add("Fig. 1", "Odd lines are scanned in one 1/60 s, even lines in the next.",
        f"{number(1000 * seconds, 2)} ms between fields (1/59.94 s is 16.68 ms)",
        [below("off by, ms", abs(1000 * seconds - 1000 / FIELD_RATE), 0.17)])
    add("§3", "A pattern brighter on every other line flickers at 30 Hz.",
        f"stripes one line high, light 0.1 and 0.8: the fields differ by {number(stripes['line'], 3)} through "
        f"<i>line</i>; by {number(stripes['box'], 4)}, {number(stripes['notch'], 4)}, "
        f"{number(stripes['shaped'], 4)} through <i>box</i>, <i>notch</i>, <i>shaped</i>",
        [above("through <i>line</i>", stripes["line"], 0.5, 0.1),
         *(below(f"through <i>{name}</i>", stripes[name], 0.02, 0.1) for name in ("box", "notch", "shaped"))])


def place(found):
    alike, x, y, level = found
    return (f"{number(x * FIELD_RATE, 1)} Hz, {number(y, 2)} c/line: rays {number(alike, 0)} dB over the gaps "
            f"between them, level {number(level, 1)} dB")


def stands(name, found, near):
    """What a replica needs: rays, where they should be. Of noise no rays stand out."""
    alike, x, y, _ = found
    return [above(f"{name}, rays over gaps, dB", alike, 6, 4),
            below(f"{name}, off by", math.hypot(x - near[0], y - near[1]), 0.02, 0.04)]


def spectra(report, fans, stars):
    """The rows of Figures 2 and 3: where the fan and the star are found in displayed light."""
    first, at60, up = fans["notch"]
    plain = fans["progressive"][0][3]
    report.row("Fig. 2", "Interlaced sampling puts a replica of the spectrum at 30 Hz, 0.5 cycles a line.",
               f"the fan stands again at {place(first)}; without interlace the level there is {number(plain, 0)} dB",
               [*stands("fan", first, REPLICAS[0]), above("level, dB", first[3], -20, -30),
                below("without interlace, dB", plain, -40, -30)])
    report.row("Fig. 2", "Further replicas stand at 60 Hz and at 1 cycle a line.", f"{place(at60)}; {place(up)}",
               [*stands("60 Hz", at60, REPLICAS[1]), *stands("1 c/line", up, REPLICAS[2]),
                above("weaker level, dB", min(at60[3], up[3]), -30, -40)])
    across, down, *between = stars
    most = max(level for *_, level in between)
    report.row("Fig. 3", "In (x, y) the lattice is that of the pixels: no replica between.",
               f"the star stands again at ({number(across[1], 2)}, {number(across[2], 2)}) and "
               f"({number(down[1], 2)}, {number(down[2], 2)}) cycles a pixel and a line, its rays "
               f"{number(across[0], 0)} and {number(down[0], 0)} dB over their gaps; half way there at most "
               f"{number(most, 0)} dB of the middle's level",
               [*stands("(1, 0)", across, (1, 0)), *stands("(0, 1)", down, (0, 1)),
                below("half way, dB", most, -35, -30)])
