"""Edges that drift: where each field shows them, how far from the truth, and how often a second."""
import pictures
import still
from analysis import crossing, rms, strongest
from claims import above, below
from page import figure, picture
from plots import THEORY, Plot, axis, number

FIELD_RATE = 60000 / 1001
SPEEDS = range(0, 121, 10)
NAMES = ("line", "box", "notch", "shaped")


def places(clip, x, fields):
    """Where the edge is in every field, in frame lines: by its contour, as who sees single lines, and
    by how much light there is, as who does not."""
    contour, amount = [], []
    for n in range(fields):
        own = clip.own_lines(n)
        light = [clip.line(n // 2, y, x, x + 1)[0] for y in own]
        contour.append(own[0] + 2 * crossing(light, 0.4) + 0.5)
        amount.append(own[-1] + 1.5 - 2 * sum(light) / 0.8)
    return contour, amount


def wobbles(ctx):
    """By aperture and speed: what is known of an edge's wobble."""
    frames, width = (12, 16) if ctx.quick else (16, 24)
    found = {}
    for name in NAMES:
        clip = ctx.weft.clip("edges", f"{width * len(SPEEDS)}x200@30000/1001i,bff", name, frames, tau=0,
                             samples=12 if ctx.quick else 24)
        found[name] = {}
        for k, speed in enumerate(SPEEDS):
            pairs = [places(clip, k * width + x, 2 * frames) for x in range(2, width - 2, 2)]
            contours = [strongest(contour, FIELD_RATE) for contour, _ in pairs]
            best = max(contours, key=lambda one: one[1])
            found[name][speed] = {
                "hertz": best[0], "lines": best[1], "contour": rms([one[2] for one in contours]),
                "light": rms([strongest(amount, FIELD_RATE)[2] for _, amount in pairs])}
    return found


def slice_of(clip, x, fields, y0, lines):
    """Height down, fields across; black where a field has no line."""
    rows = [bytearray(fields) for _ in range(lines)]
    for n in range(fields):
        frame = pictures.gray_rows(clip, n // 2, range(y0, y0 + lines), x, x + 1)
        for k in range(lines):
            if (y0 + k) % 2 == clip.parity(n):
                rows[k][n] = frame[k][0]
    return pictures.png(pictures.enlarge([bytes(row) for row in rows], 6, 6))


def bob_slice(clip, x, fields, y0, lines):
    """The same as a display that fills in lines shows it."""
    columns = []
    for n in range(fields):
        values = [row[0] for row in pictures.gray_rows(clip, n // 2, range(clip.lines), x, x + 1)]
        columns.append(bytes(values[y] if y % 2 == clip.parity(n) else (values[y - 1] + values[y + 1]) // 2
                             for y in range(y0, y0 + lines)))
    return pictures.png(pictures.enlarge([bytes(row) for row in zip(*columns)], 6, 6))


def slices(ctx):
    """Time slices of an edge that sinks 30 lines a second, by aperture, two rows of pictures."""
    parts = [[], []]
    for name in NAMES:
        clip = ctx.weft.clip("edges", "24x96@30000/1001i,bff", name, 12, tau=0, columns=1, drift=30,
                             samples=64)
        for row, cut in zip(parts, (slice_of, bob_slice)):
            row.append(picture(cut(clip, 12, 24, 18, 24), f"Time slice of a sinking edge through {name}",
                               "pixels", note=f"<b>{name}</b>" if cut is slice_of else None))
    return "".join('<div class="row n4">' + "".join(row) + "</div>" for row in parts)


def frequency_plot(weft, found):
    plot = Plot(axis(0, 120, "speed of the edge, scan lines a second", ticks=range(0, 121, 30)),
                axis(0, 32, "frequency of the wobble, Hz", ticks=(0, 10, 20, 30)),
                "Frequency of the wobble against speed: 30 Hz at rest, 0 at 60 lines a second", height=320)
    plot.add("band", across=[24, 52], text="where eyes see flicker best")
    plot.line([(0, 30), (60, 0), (120, 30)], THEORY, "|speed \N{MINUS SIGN} 60| / 2", dashed=True)
    plot.points([(v, one["hertz"]) for v, one in found["line"].items() if one["lines"] > 0.1], 1, "measured, line",
                radius=3.4)
    return plot.svg(weft)


def run(ctx):
    found = wobbles(ctx)
    ctx.figures["wobble"] = found
    at30, rest = found["line"][30], found["line"][0]
    frequency, amount = at30["hertz"], at30["lines"]
    calm = {name: found[name][30]["light"] for name in NAMES}
    contour = {name: found[name][30]["contour"] for name in NAMES}
    ctx.report.section(
        "slow-edges", "Edges that drift at thirty lines a second",
        "The paper finds jaggies most annoying on nearly horizontal edges that move slowly up or "
        "down, at around 30 scan lines a second. In the time of one field such an edge moves half "
        "a line, and the lines of the next field are where it would be, or are not.",
        figure("slices", slices(ctx), "An edge that sinks 30 lines a second, in time (24 fields across) and "
               "height (24 lines). Above: the lines of each field. Below: as a display fills them "
               "in. The truth is a straight slope. Through <code>line</code> it is a staircase "
               f"whose steps take {number(FIELD_RATE / frequency, 1)} fields: a crawl at "
               f"{number(frequency, 1)} Hz."),
        "Why thirty? The lines themselves hop one line a field, 60 lines a second. An edge at speed v meets "
        "them anew |v \N{MINUS SIGN} 60|/2 times a second. At rest that is 30 Hz, fast and half hidden. At 30 "
        "lines a second it is 15 Hz, close to where eyes are most sensitive. At 60 it stands still: half the "
        "lines are just missing.",
        figure("wobble-plot", frequency_plot(ctx.weft, found), "How often a second the drawn edge swings about its "
               f"true path, measured at 13 speeds. At 30 lines a second: {number(frequency, 1)} "
               f"Hz, by up to {number(amount, 2)} lines either way."),
        "Filtering in height is what helps. Seen from where single lines merge, an edge is where "
        f"its light ends; that place wobbles by {number(calm['line'], 2)} lines RMS at 30 lines a "
        f"second through <code>line</code>, by {number(calm['box'], 3)} through <code>box</code>, "
        f"{number(calm['notch'], 3)} through <code>notch</code> and {number(calm['shaped'], 3)} "
        "through <code>shaped</code>. Who sits so close as to see lines sees the contour, which "
        f"depends on how the display fills in what is not there: {number(contour['line'], 2)}, "
        f"{number(contour['box'], 2)}, {number(contour['notch'], 2)} and "
        f"{number(contour['shaped'], 2)} lines.")
    still.rule(ctx, ctx.figures["plates"], ctx.figures["letters"])
    ctx.report.row("§5", "Moving jaggies are most noticeable on nearly horizontal edges at around 30 "
                         "scan lines "
                   "a second.",
                   f"the wobble at 30 lines/s has {number(frequency, 1)} Hz and "
                   f"{number(amount, 2)} lines; at rest {number(rest['hertz'], 0)} Hz; at 60 "
                   "lines/s it does not swing",
                   [above("Hz", frequency, 12, 10), below("Hz", frequency, 18, 22), above("lines", amount, 0.2, 0.1)],
                   "That eyes are most sensitive near 15 Hz is not measured here.")
    ctx.report.row("§5", "Less vertical sharpness is the remedy.",
                   f"wobble at 30 lines/s: {number(calm['line'], 3)}, {number(calm['box'], 3)}, "
                   f"{number(calm['notch'], 3)}, {number(calm['shaped'], 3)} lines RMS of the "
                   "light through <i>line</i>, <i>box</i>, <i>notch</i>, <i>shaped</i>; of the "
                   f"contour {number(contour['line'], 2)}, {number(contour['box'], 2)}, "
                   f"{number(contour['notch'], 2)}, "
                   f"{number(contour['shaped'], 2)}", [
                       above("light, <i>line</i> over <i>notch</i>", calm["line"] / calm["notch"], 5, 2),
                       above("contour, <i>line</i> less <i>box</i>", contour["line"] - contour["box"], 0.01, 0),
                       above("contour, <i>box</i> less <i>notch</i>", contour["box"] - contour["notch"], -0.01, -0.03)])
