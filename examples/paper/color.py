"""Figure 11: what a composite encoder makes of fine detail without any color, NTSC and PAL."""
import cmath

import pictures
from analysis import decibels, PI
from claims import above, below
from page import exact, figure, picture, side_by_side, table
from plots import Plot, axis, number
from still import middle_columns

# Raster, pixel aspect, field-line and pixel frequency of the subcarrier.
SYSTEMS = {
    "ntsc": {"name": "NTSC", "raster": "525i", "aspect": 10 / 11, "across": 35 / 132,
             "down": (0.25,)},
    "pal": {"name": "PAL", "raster": "625i", "aspect": 12 / 11, "across": 4.43361875 / 13.5,
            # 283.7516 cycles a line: over a field's lines, two frame lines apart, U advances by
            # 0.7516 of a cycle, and V, switched every line, by half a cycle more.
            "down": tuple(sorted(abs(((283.7516 + half + 0.5) % 1 - 0.5) / 2) for half in (0, 0.5)))}}
# Where sampling folds PAL's subcarrier to: one less its frequency, half less that of its lines.
PAL_CORNER = (1 - SYSTEMS["pal"]["across"], 0.5 - SYSTEMS["pal"]["down"][0])
ENCODERS = ("cheap", "filtered")
APERTURES = ("box", "notch", "shaped")


def source(ctx, system, aperture):
    return ctx.weft.render("zoneplate", SYSTEMS[system]["raster"], aperture, tau=0,
                           samples=16 if ctx.quick else 64)


def seen(ctx, system, aperture, encoder="cheap", decoder="notch"):
    return ctx.weft.clip_of(ctx.weft.composite(source(ctx, system, aperture), system, encoder, decoder))


def chroma(clip, n):
    """U + iV of the field n, as a grid of means over blocks of 8 pixels by 4 own lines."""
    _, u, v = clip.frames[n // 2]
    size, own = clip.width, list(clip.own_lines(n))
    ku, kv = 0.872 / 224, 1.23 / 224  # from Cb and Cr to U and V, in units of Y'
    grid = []
    for k in range(0, len(own) - 3, 4):
        row = []
        for x in range(0, size - 7, 8):
            a = sum(sum(u[y * size + x:y * size + x + 8]) for y in own[k:k + 4]) / 32 - 128
            b = sum(sum(v[y * size + x:y * size + x + 8]) for y in own[k:k + 4]) / 32 - 128
            row.append(complex(ku * a, kv * b))
        grid.append(row)
    return grid


def smooth(grid, reach):
    """Magnitudes of means over squares: large only where the color does not turn, which is the middle of
    a bullseye."""
    high, wide = len(grid), len(grid[0])
    total = [[0j] * (wide + 1)]
    for row in grid:
        line, above = [0j], total[-1]
        run = 0j
        for k, value in enumerate(row):
            run += value
            line.append(run + above[k + 1])
        total.append(line)
    area = (2 * reach + 1) ** 2
    return [[abs(total[y + reach + 1][x + reach + 1] - total[y - reach][x + reach + 1] -
                 total[y + reach + 1][x - reach] + total[y - reach][x - reach]) / area
             for x in range(reach, wide - reach)] for y in range(reach, high - reach)]


def bullseyes(clip, count):
    """Middles of the strongest bullseyes: distances from the picture's middle in pixels and frame lines,
    and how strong."""
    reach = 1
    levels = smooth(chroma(clip, 0), reach)
    peaks = []
    for y in range(1, len(levels) - 1):
        for x in range(1, len(levels[0]) - 1):
            around = [levels[j][i] for j in (y - 1, y, y + 1) for i in (x - 1, x, x + 1)]
            if levels[y][x] == max(around) > 1e-6:
                sums = sum(v ** 2 for v in around)
                cx = sum(i * levels[j][i] ** 2 for j in (y - 1, y, y + 1) for i in (x - 1, x, x + 1)) / sums
                cy = sum(j * levels[j][i] ** 2 for j in (y - 1, y, y + 1) for i in (x - 1, x, x + 1)) / sums
                peaks.append((levels[y][x], 8 * (cx + reach + 0.5) - clip.width / 2,
                              8 * (cy + reach + 0.5) - clip.lines / 2))
    chosen = []
    for level, x, y in sorted(peaks, reverse=True):
        if all(abs(x - a) > 60 or abs(y - b) > 40 for _, a, b in chosen):
            chosen.append((level, x, y))
        if len(chosen) == count:
            break
    return chosen


def expected(system, lines):
    """Where the plate has the subcarrier's frequency: pixels and frame lines from the middle."""
    s = SYSTEMS[system]
    return s["across"] * lines / s["aspect"] ** 2, [f * lines for f in s["down"]]


def diagonal(shape, fx, fy):
    """The response of a measured shape to a slanted wave."""
    fine, half = 8, len(shape) / 2
    total, wave = 0, 0
    for j, row in enumerate(shape):
        for i, weight in enumerate(row):
            if weight:
                total += weight
                wave += weight * cmath.exp(-2j * PI * (fx * (i + 0.5 - half) + fy * (j + 0.5 - half)) / fine)
    return abs(wave) / total


def nearest(system, clip):
    """The four bullseyes nearest to where they should be, the largest miss and the mean level. PAL has
    pairs, U and V, that nearly coincide: the nearer of both counts."""
    x, ys = expected(system, clip.lines)
    found = [b for b in bullseyes(clip, 12) if abs(abs(b[1]) - x) < 20 and
             min(abs(abs(b[2]) - y) for y in ys) < 20]
    miss = [max(abs(abs(b[1]) - x), min(abs(abs(b[2]) - y) for y in ys)) for b in found]
    return found, (sum(m < 12 for m in miss), max(miss, default=99)), max((b[0] for b in found), default=0)


def shot(clip, note):
    rows = pictures.color_rows(clip, 0, range(clip.lines), *middle_columns(clip))
    return exact(pictures.png(rows, color=True, filtered=True),
                 f"A gray zone plate as a television shows it: {note}", note)


def close_up(clip, system, note):
    """The bullseye at the upper right, enlarged."""
    x, ys = expected(system, clip.lines)
    middle, y, half = (round(v) for v in (clip.width / 2 + x, clip.lines / 2 - ys[0],
                                          73 / SYSTEMS[system]["aspect"]))
    rows = pictures.color_rows(clip, 0, range(y - 60, y + 60), middle - half, middle + half)
    return picture(pictures.png(rows, color=True, filtered=True), f"A false bullseye enlarged: {note}",
                   "pixels", note, 146 / 120)


def places_plot(weft, found):
    plot = Plot(axis(-0.5, 0.5, "horizontal frequency, cycles a pixel", ticks=(-0.5, -0.25, 0, 0.25, 0.5)),
                axis(-0.4, 0.4, "vertical frequency, cycles a line", ticks=(-0.25, 0, 0.25)),
                "Where the bullseyes stand, as frequencies of the zone plate", height=380)
    for k, (system, (eyes, _, _)) in enumerate(found.items(), 1):
        s, lines = SYSTEMS[system], 486 if system == "ntsc" else 576
        carriers = [(sx * s["across"], sy * f) for sx in (-1, 1) for f in s["down"] for sy in (-1, 1)]
        plot.add("points", points=carriers, series=k, radius=11, hollow=True, dashed=True)
        plot.points([(x * s["aspect"] ** 2 / lines, -y / lines) for _, x, y in eyes], k,
                    f"{s['name']}, found; the rings are the subcarrier", 4)
    return plot.svg(weft)


def percent(value, digits=1):
    return f"{number(100 * value, digits)} %"


def measures(ctx):
    """Cross-color by system and aperture, as weft measure finds it, and levels of the bullseyes."""
    found = {}
    for system in SYSTEMS:
        for aperture in APERTURES + (() if ctx.quick else ctx.designs):
            path = source(ctx, system, aperture)
            found[system, aperture] = ctx.weft.measure(path)["cross_color"]
    return found


def run(ctx):
    clips = {(s, a): seen(ctx, s, a) for s in SYSTEMS for a in ("box", "shaped")}
    careful = {s: seen(ctx, s, "box", "filtered", "comb3") for s in SYSTEMS}
    cross = measures(ctx)
    eyes = {s: nearest(s, clips[s, "box"]) for s in SYSTEMS}
    level = {key: nearest(key[0], clip)[2] for key, clip in clips.items()}
    clean = {s: max((b[0] for b in bullseyes(careful[s], 1)), default=0.0) for s in SYSTEMS}
    tempered = {name: diagonal(ctx.figures["apertures"][name], 35 / 132, 0.25) for name in APERTURES}
    prose(ctx, clips, careful["ntsc"], (cross, level, clean, tempered))
    bullseye_section(ctx, eyes, clips)
    rows(ctx, eyes, (cross, level, clean, tempered))


def prose(ctx, clips, careful, figures):
    cross, level, clean, tempered = figures
    notes = {"box": "box", "shaped": "shaped"}
    corner = {name: diagonal(ctx.figures["apertures"][name], *PAL_CORNER) for name in notes}
    four = side_by_side(*(shot(clips[s, a], f"<b>{SYSTEMS[s]['name']}</b>, {notes[a]}")
                          for s in SYSTEMS for a in notes), columns=2)
    near = side_by_side(*(close_up(clips[s, a], s, f"<b>{SYSTEMS[s]['name']}</b>, {a}, enlarged")
                          for s in SYSTEMS for a in notes))
    lines = [(f"<code>{a}</code>", *(percent(cross[s, a][key]) for s in SYSTEMS for key in ("rms", "p999")))
             for a in APERTURES + ctx.designs if ("ntsc", a) in cross]
    ctx.report.section(
        "color", "Color where there is none",
        "On its way to a living room a picture becomes composite: color is put on a subcarrier, "
        "right in among the luminance. A cheap encoder does not make room for it first. Then fine "
        "detail that happens to look like the subcarrier <i>is</i> color to a television. This "
        "zone plate is gray, every pixel of it.",
        figure("fig-11", four + '<div style="height:16px"></div>' + near, "<b>Figure 11.</b> What a set shows of the gray zone plate, after "
               "<code>weft composite</code> with a cheap encoder. Above NTSC, below PAL; left "
               "through <code>box</code>, right through <code>shaped</code>; and one bullseye of "
               "each, enlarged."),
        "The shaped aperture was made against flicker, yet it helps here: it is somewhat like a "
        "diamond, and so it is the diagonals it takes away. At the subcarrier it lets "
        f"{percent(tempered['shaped'], 0)} pass, the box {percent(tempered['box'], 0)}. The "
        f"bullseyes sink from {number(level['ntsc', 'box'], 3)} to "
        f"{number(level['ntsc', 'shaped'], 3)} of white with NTSC and from "
        f"{number(level['pal', 'box'], 3)} to {number(level['pal', 'shaped'], 3)} with PAL. Not "
        f"everywhere, though: PAL's subcarrier has a fold at {number(PAL_CORNER[0], 3)} cycles a pixel and "
        f"{number(PAL_CORNER[1], 3)} a line, beyond what pixels can hold, and there the shaped aperture lets "
        f"{number(corner['shaped'], 3)} pass, the box {number(corner['box'], 3)}.",
        table(("False color of the gray "
               "plate", "NTSC, RMS", "99.9 % below", "PAL, RMS", "99.9 % below"), lines),
        figure("careful", '<div class="row n2">' + shot(careful, "<b>NTSC</b>, box, careful encoder, "
               "comb filter") + "<div><p>With the best hardware it is no problem at all. Here the encoder "
               "takes out of the luminance what would be mistaken for color, and the set combs "
               "lines. Of the bullseyes "
               f"{number(decibels(clean['ntsc'] / level['ntsc', 'box']), 0)} dB are left. The "
               "price is fine luminance around the subcarrier, which is gone.</p></div></div>",
               "The same gray plate, by a careful studio."))


def bullseye_section(ctx, eyes, clips):
    lines = []
    for system, (found, _, _) in eyes.items():
        x, ys = expected(system, clips[system, "box"].lines)
        wanted = f"±{number(x, 1)}, ±{' or ±'.join(number(y, 1) for y in ys)}"
        lines += [(SYSTEMS[system]["name"], f"{number(bx, 1)}, {number(by, 1)}", wanted, number(level, 3))
                  for level, bx, by in sorted(found, key=lambda b: (b[2], b[1]))]
    ctx.report.section(
        "bullseyes", "Where the bullseyes stand",
        "A zone plate is a map of frequencies, so a bullseye's place says which frequency made "
        "it. For NTSC that must be 35/132 cycles a pixel and a quarter of a cycle a line, since "
        "the subcarrier makes 227.5 cycles a line and neighbors within a field are in opposite "
        "phase. For PAL, 283.75 cycles and a V that is switched every line put U and V close to "
        "an eighth of a cycle a line.",
        figure("bullseyes-plot", places_plot(ctx.weft, eyes), "Middles of the bullseyes in the pictures above, on the "
               "plate's frequencies."),
        table(("System", "Found at, pixels and lines from the middle", "Computed", "Chroma"), lines),
        "PAL's U and V bullseyes overlap, and where they do, their middles pull on each other.")


def rows(ctx, eyes, figures):
    cross, level, clean, tempered = figures
    apertures = ctx.figures["apertures"]
    add = ctx.report.row
    found, (count, miss), _ = eyes["ntsc"]
    near = ", ".join(f"({number(x, 0)}, {number(y, 0)})" for _, x, y in found)
    add("Fig. 3, 11", "The subcarrier lies at high diagonal frequencies; chroma aliasing shows as two colored "
        "bullseyes, left and right.",
        f"{len(found)} bullseyes at {near} pixels and lines from the middle, within "
        f"{number(miss, 1)} of where "
        "the subcarrier's frequency is", [above("bullseyes", count, 3.5, 1.5), below("off by", miss, 4, 12)],
        "Four here, two on each side: this plate is centered in the picture.")
    found, (count, miss), _ = eyes["pal"]
    x, ys = expected("pal", 576)
    add("Fig. 11", "(The paper has NTSC only; the same for PAL.)",
        f"{len(found)} bullseyes, within {number(miss, 1)} of ±{number(x, 0)} pixels and "
        f"±{' or ±'.join(number(y, 0) for y in ys)} "
        f"lines", [above("bullseyes", count, 2.5, 1.5), below("off by", miss, 12, 16)], "PAL splits them into U and V, which nearly coincide.")
    for system in SYSTEMS:
        name = SYSTEMS[system]["name"]
        a, b = level[system, "box"], level[system, "shaped"]
        add("§6", f"The notch aperture greatly reduces chroma aliasing in comparison with the box ({name}).",
            f"bullseyes {number(a, 3)} and {number(b, 3)} ({number(decibels(b / a), 1)} dB); whole "
            "picture "
            f"{percent(cross[system, 'box']['rms'])} and {percent(cross[system, 'shaped']['rms'])} "
            "RMS", [below("bullseyes, <i>shaped</i> over <i>box</i>", b / a, 0.7, 0.9),
                    below("picture", cross[system, "shaped"]["rms"] / cross[system, "box"]["rms"], 0.9, 1)],
            f"To {number(100 * b / a, 0)} % in the bullseyes. How great that is, is a matter of "
            "taste.")
    add("§6", "It does so because its shape attenuates diagonal frequencies.",
        f"response at the NTSC subcarrier: box {number(tempered['box'], 3)}, notch "
        f"{number(tempered['notch'], 3)}, "
        f"shaped {number(tempered['shaped'], 3)}", [
            below("<i>notch</i> over <i>box</i>", tempered["notch"] / tempered["box"], 0.95, 1),
            below("<i>shaped</i> over <i>notch</i>", tempered["shaped"] / tempered["notch"], 0.95, 1)])
    corner = {name: diagonal(apertures[name], *PAL_CORNER) for name in APERTURES}
    add("§6", "(Not in the paper: the same where PAL's subcarrier has its fold, at "
        f"{number(PAL_CORNER[0], 3)} cycles a pixel and {number(PAL_CORNER[1], 3)} a line.)",
        f"response there: box {number(corner['box'], 3)}, notch {number(corner['notch'], 3)}, "
        f"shaped {number(corner['shaped'], 3)}",
        [below("<i>shaped</i> over <i>box</i>", corner["shaped"] / corner["box"], 1)],
        "What folds there is finer than pixels and lines, and <i>shaped</i> lets more of it pass.")
    add("§6", "With the best encoding hardware it is not generally a problem, even in this pattern.",
        f"strongest false color with a careful encoder {number(clean['ntsc'], 4)} (NTSC), "
        f"{number(clean['pal'], 4)} (PAL)", [below("strongest", max(clean.values()), 0.01, 0.02)])
