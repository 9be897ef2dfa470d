"""The apertures themselves: their shapes, found with points of light, and their responses, found
with zone plates. Figures 4, 7 and 9, and the box turned on its side."""
import cmath
import os

import pictures
from analysis import decibels, plate_response, rms, sinc
from plots import Plot, axis

FINE = 8       # positions a pixel, a line and a field
BLOCK = 8      # pixels or lines around each point
BASE, POINT = 0.3, 24.0


# ---- Impulses ----

def light_of(clip, frame):
    """Signed light over the base level."""
    return [[value - BASE for value in row] for row in clip.picture(frame)]


def convert(ctx, names, raster, aperture, rate, words=()):
    path = ctx.weft.make(".y4m", "convert", *names, "--raster", raster, "--aperture", aperture,
                         "--subframe-rate", rate, "--bits", 16, "--chroma", "444", *words)
    return ctx.weft.clip_of(path)


def impulse_xy(ctx, aperture):
    """h(u, v): rows by v, FINE values a line and pixel, u and v from -BLOCK/2."""
    size = BLOCK * FINE
    path = os.path.join(ctx.weft.folder, "points.exr")
    if not os.path.exists(path):
        rows = [[BASE] * (size * FINE) for _ in range(size * FINE)]
        for b in range(FINE):
            for a in range(FINE):
                rows[b * size + size // 2 + b][a * size + size // 2 + a] = POINT
        pictures.exr(path, rows)
    light = light_of(convert(ctx, [path], f"{size}x{size}@60p", aperture, 60), 0)
    # The point of block (a, b) lies (a + 1/2) / FINE right of the middle; pixel k of the block has
    # its middle at k + 1/2, so it sees the point at u = BLOCK/2 + (a + 1/2)/FINE - k - 1/2.
    shape = [[0.0] * size for _ in range(size)]
    for j in range(size):
        v = (size // 2 + j // BLOCK) - FINE * (j % BLOCK) + size // 2 - FINE // 2
        for i in range(size):
            u = (size // 2 + i // BLOCK) - FINE * (i % BLOCK) + size // 2 - FINE // 2
            if 0 <= u < size and 0 <= v < size:
                shape[v][u] = light[j][i]
    return shape


def impulse_ty(ctx, aperture, tau):
    """h(v, t): rows by v, FINE values a line and a field; v and t from -BLOCK/2."""
    size, fields, first = BLOCK * FINE, 8, 4
    folder = os.path.join(ctx.weft.folder, "flashes")
    names = [os.path.join(folder, f"{k:03d}.exr") for k in range(FINE * (fields + 2))]
    if not os.path.exists(folder):
        os.mkdir(folder)
        for k, name in enumerate(names):
            rows = [[BASE] * (FINE * 2) for _ in range(size * FINE)]
            column = k - FINE * first
            if 0 <= column < FINE:
                for b in range(FINE):
                    for x in (0, 1):
                        rows[b * size + size // 2 + b][2 * column + x] = POINT
            pictures.exr(name, rows)
    clip = convert(ctx, names, f"{2 * FINE}x{size}@60p", aperture, 60 * FINE,
                   ("--temporal-width", tau))
    shape = [[0.0] * size for _ in range(size)]
    for n in range(min(len(clip.frames), fields + 1)):
        light = light_of(clip, n)
        for j in range(size):
            v = (size // 2 + j // BLOCK) - FINE * (j % BLOCK) + size // 2 - FINE // 2
            for c in range(FINE):
                t = FINE * (first - n) + c + size // 2
                if 0 <= v < size and 0 <= t < size:
                    shape[v][t] = (light[j][2 * c] + light[j][2 * c + 1]) / 2
    return shape


def shape_plot(weft, shape, label, title, reach, size=(320, 300)):
    """A heat map of h with the scan lines' edges drawn over it."""
    top = max(map(max, shape))
    plot = Plot(axis(-reach[0], reach[0], label, ticks=range(-reach[0], reach[0] + 1)),
                axis(reach[1], -reach[1], "y, scan lines", ticks=range(-reach[1], reach[1] + 1)), title,
                *size)
    half = BLOCK / 2
    rows = [row[int((half - reach[0]) * FINE):int((half + reach[0]) * FINE)]
            for row in shape[int((half - reach[1]) * FINE):int((half + reach[1]) * FINE)]]
    low = min(0, min(map(min, rows)))
    plot.map(rows, (-reach[0], reach[0], -reach[1], reach[1]), low, top, "weight")
    for k in range(1 - reach[1], reach[1] + 1):
        plot.add("rule", y=k - 0.5)
    return plot.svg(weft)


def profile(shape, across=True):
    """Weights over v, whatever u (or over u, whatever v), of sum 1 a line."""
    sums = [sum(row) for row in (shape if across else zip(*shape))]
    total = sum(sums) / FINE
    return [((k + 0.5) / FINE - BLOCK / 2, value / total) for k, value in enumerate(sums)]


# ---- Responses, with a zone plate that drifts ----

SIZE, SPEED, WIDE = 360, 8, 2  # pixels, pixels a field, stretched


def drifting(ctx, aperture, tau, drift=SPEED):
    return ctx.weft.clip("plate", f"{SIZE}x{SIZE}@60p", aperture, tau=tau, wide=WIDE, drift=drift,
                         position="center", samples=24 if ctx.quick else 128)


def temporal_response(clip):
    """Pairs of cycles a field and response, the horizontal aperture's part taken out."""
    rate = 1 / (WIDE ** 2 * SIZE)
    pairs = plate_response(clip.line(0, SIZE // 2), SIZE / 2, rate)
    # Too near the middle the smear is longer than the rings are wide.
    return [(SPEED * f, r / sinc(f)) for f, r in pairs if f >= 24 * rate]


def vertical_response(ctx, aperture, lines=486):
    """Pairs of cycles a line and response, 0 to 1, of a still zone plate."""
    pairs = []
    for rings in (1, 2):
        clip = ctx.weft.clip("plate", f"8x{lines}@30i,bff", aperture, rings=rings, tau=0,
                             samples=256 if ctx.quick else 1024)
        column = [row[4] for row in clip.picture()]
        found = plate_response(column, lines / 2, rings / lines, half=12, every=9 if rings == 1 else 12)
        pairs += [(f, r) for f, r in found if rings == 1 or f > 0.48]
    return pairs


def near(pairs, frequency):
    """The response at a frequency, between those measured."""
    pairs = sorted(pairs)
    for (f0, r0), (f1, r1) in zip(pairs, pairs[1:]):
        if f0 <= frequency <= f1:
            return r0 + (r1 - r0) * (frequency - f0) / ((f1 - f0) or 1)
    return pairs[-1][1]


def response_of(shape, frequency, across=True):
    """The response by the measured shape: exact, for the shape has no noise."""
    pairs = profile(shape, across)
    total = sum(p for _, p in pairs)
    middle = sum(z * p for z, p in pairs) / total
    turns = [cmath.exp(-2j * cmath.pi * frequency * (z - middle)) * p for z, p in pairs]
    return abs(sum(turns)) / total


def vertical_plot(ctx, series):
    plot = Plot(axis(0, 1, "vertical frequency, cycles a line", ticks=(0, 0.25, 0.5, 0.75, 1)),
                axis(-60, 3, "response, dB", ticks=(0, -20, -40, -60)),
                "Measured vertical responses of the apertures and their closed forms", 420, 340)
    plot.add("rule", x=0.5, text="what is here flickers")
    for k, (name, pairs) in enumerate(series.items(), 1):
        curve = [(r["frequency"], r["vertical_db"]) for r in ctx.weft.response(name)["response"]]
        exact = EXACT.get(name)
        if exact:
            curve = [(f / 200, decibels(abs(exact(f / 200)))) for f in range(201)]
        plot.line(curve, series=k, name=name)
        plot.points([(f, decibels(r)) for f, r in pairs], series=k)
    return plot.svg(ctx.weft)


EXACT = {"line": sinc, "box": lambda f: sinc(2 * f),
         "notch": lambda f: sinc(2 * f) * sinc(f) ** 2, "shaped": lambda f: sinc(2 * f) * sinc(f) ** 2}


def temporal_plot(weft, responses):
    plot = Plot(axis(0, 60, "temporal frequency, Hz", ticks=(0, 15, 30, 45, 60)),
                axis(0, 1.05, "response", ticks=(0, 0.25, 0.5, 0.75, 1)),
                "Measured temporal responses of four apertures and their closed forms", 420, 320)
    for k, (name, (pairs, exact)) in enumerate(responses.items(), 1):
        plot.line([(f * 0.6, abs(exact(f / 100))) for f in range(101)], series=k, name=name)
        plot.points([(60 * f, r) for f, r in pairs], series=k)
    return plot.svg(weft)


def as_one(clip):
    return pictures.png(pictures.gray_rows(clip, 0, range(clip.lines)))


def run(ctx):
    shapes = {name: impulse_ty(ctx, name, tau) for name, tau in
              (("ccd", 1), ("rotated", 2), ("diamond", 2))}
    clips = {name: drifting(ctx, aperture, tau) for name, aperture, tau in
             (("box, an instant", "box", 0), ("ccd", "ccd", 1), ("rotated", "rotated", 2),
              ("diamond", "diamond", 2))}
    forms = {"box, an instant": lambda f: 1.0, "ccd": sinc, "rotated": lambda f: sinc(2 * f),
             "diamond": lambda f: sinc(f) ** 2}
    responses = {name: (temporal_response(clip), forms[name]) for name, clip in clips.items()}
    heights = {name: vertical_response(ctx, name) for name in ("line", "box", "notch", "shaped")}
    ctx.figures.update(shapes=shapes, heights=heights, clips=clips, responses=responses,
                       blur=spatial_equivalent(ctx))
    ctx.figures["apertures"] = {name: impulse_xy(ctx, name)
                                for name in ("line", "box", "notch", "shaped")}


def spatial_equivalent(ctx):
    """RMS difference of a moving picture, blurred by time, and a still one, blurred by space."""
    moving = drifting(ctx, "box", 1).picture()
    still = drifting(ctx, "box", 0, drift=0).picture()
    weights = [1 if 0 < k < SPEED else 0.5 for k in range(SPEED + 1)]
    half, errors, unblurred = SPEED // 2, [], []
    for a, b in zip(moving[20:-20:4], still[20:-20:4]):
        for x in range(40, SIZE - 40):
            value = sum(w * b[x + k - half] for k, w in enumerate(weights)) / SPEED
            errors.append(a[x] - value)
            unblurred.append(a[x] - b[x])
    return rms(errors), rms(unblurred)

