"""Figures 9 and 10: the notch filter, the shaped aperture, and what sharpness costs."""
import json

from analysis import decibels, rms
from claims import above, below
from page import figure, side_by_side
from plots import THEORY, Plot, axis, number
from shapes import profile, response_of, shape_plot, vertical_plot
from still import fields, percent, share


def profile_plot(weft, shapes):
    plot = Plot(axis(-2.5, 2.5, "height from the line's middle, scan lines", ticks=range(-2, 3)),
                axis(0, 1.08, "weight", ticks=(0, 0.25, 0.5, 0.75, 1)),
                "Measured vertical weights of the apertures and the paper's f", 420, 340)
    for k, name in enumerate(("line", "box", "notch", "shaped"), 1):
        plot.points([p for p in profile(shapes[name]) if abs(p[0]) < 2.4], k, name, 2.3)
    curve = [(v / 50, quadratic(v / 50)) for v in range(-120, 121)]
    plot.line(curve, THEORY, "f of the paper", dashed=True)
    return plot.svg(weft)


def quadratic(v):
    v = abs(v)
    return 0.5 - v * v / 4 if v < 1 else v * v / 4 - v + 1 if v < 2 else 0.0


def beyond(pairs):
    return rms([r for f, r in pairs if f > 0.55])


SIDES = {"calm": ("end", -9, 12), "shaped": ("start", 9, 14)}  # where names do not meet


def costs_plot(found, curves):
    plot = Plot(axis(0, 1, "sharpness: response at a quarter of a cycle a line"),
                axis(0, 1.1 * max(100 * share(found, n) for n in found),
                     "flicker of a still zone plate, % RMS"), "Flicker against sharpness, by aperture",
                height=360)
    for curve in curves:
        width = number(curve["width"])
        pairs = [(x, 100 * y) for x, y in zip(curve["sharpness"], curve["flicker"])]
        plot.line(pairs, THEORY, f"the least there can be, {width} pixel" + ("s" if width != "1" else "") +
                  " wide, overshoot 8 %", dashed=curve["width"] > 1)
    for k, name in enumerate(found, 1):
        x, y = found[name]["bob"]["sharpness"], 100 * share(found, name)
        anchor, dx, dy = SIDES.get(name, ("start", 9, 0))
        plot.points([(x, y)], (k - 1) % 7 + 1, radius=5)
        plot.word(x, y, name, anchor, dx, dy, series=(k - 1) % 7 + 1)
    return plot


def designed(ctx):
    """The least flicker there can be by sharpness, for the designs that crisp is one of."""
    said = ctx.weft.run("filters", "--frontier", ctx.weft.folder + "/frontier.png", "--json")
    curves = json.loads(said)["curves"]
    return [c for c in curves if c["overshoot"] == max(c["overshoot"] for c in curves)]


def run(ctx):
    shapes, heights = ctx.figures["apertures"], ctx.figures["heights"]
    found = ctx.figures["plates"]
    zero = {name: response_of(shapes[name], 0.5) for name in shapes}
    alike = rms([a[1] - b[1] for a, b in zip(profile(shapes["notch"]), profile(shapes["shaped"]))])
    form = rms([w - quadratic(v) for v, w in profile(shapes["notch"])])
    maps = side_by_side(*(shape_plot(ctx.weft, shapes[name], "x, pixels", f"Measured weight of the aperture {name}",
                                     (2, 3), (300, 380)) for name in ("box", "notch", "shaped")))
    box, notch = beyond(heights["box"]), beyond(heights["notch"])
    ctx.report.section(
        "notch", "A notch where it flickers",
        "The box of two lines has its first zero at half a cycle a line, and that is its whole "
        "secret. But a box is a crude filter. The paper's answer is a quadratic f, four lines "
        "high, with the same zero and calmer beyond, and then a beautiful trick: cut a hole of "
        "that shape into a card. Points that fall into the hole count alike, those outside do not "
        "count, as in the facsimile machines of 1934.",
        figure("fig-9", maps + '<div style="height:16px"></div><div class="row n2 plots">' +
               profile_plot(ctx.weft, shapes) + vertical_plot(ctx, heights) + "</div>",
               "<b>Figure 9.</b> Apertures as measured with points of light on a grid of 1/8 "
               "pixel, lines drawn white. Below left: their weight by height, over the paper's f. "
               "Below right: their responses, dots measured on zone plates, curves in closed form."),
        f"Hole and weight are the same thing in height: they differ by {number(alike, 4)} RMS. The "
        "card's hole is two pixels wide in its middle, though, and narrows outward, so that it "
        "also tempers fine "
        'diagonals. That will pay off <a href="#color">with color</a>.',
        figure("fig-10", fields(found["shaped"]["clip"], "shaped"),
               "<b>Figure 10.</b> The zone plate of Figure 8 "
               "again, both fields, through <code>shaped</code>. Compare the upper and lower "
               "edges."),
        f"Flicker falls from {percent(share(found, 'line'))} RMS to "
        f"{percent(share(found, 'notch'))} with <code>notch</code> and "
        f"{percent(share(found, 'shaped'))} with <code>shaped</code>; <code>box</code> has "
        f"{percent(share(found, 'box'))}.")
    frontier(ctx, found)
    add = ctx.report.row
    add("§5", "The box has a zero at 0.5 cycles a line; so has the quadratic filter.",
        f"responses there: box {number(zero['box'], 5)}, notch {number(zero['notch'], 5)}, shaped "
        f"{number(zero['shaped'], 5)}; line {number(zero['line'], 3)}", [*(below(f"<i>{name}</i>", zero[name], 0.005, 0.02) for name in ("box", "notch")),
         above("<i>line</i>", zero["line"], 0.2, 0.1)])
    add("§5", "The notch filter attenuates other high frequencies better than the box.",
        f"from 0.55 to 1 cycle a line: box {number(decibels(box), 1)} dB, notch "
        f"{number(decibels(notch), 1)} dB RMS",
        [below("<i>notch</i> over <i>box</i>", notch / box, 0.5, 0.8)])
    add("§5, Fig. 9", "Unweighted sampling within a shape of width proportional to f gives a similar result.",
        f"vertical weights of <i>shaped</i> and <i>notch</i> differ by {number(alike, 4)} RMS, "
        "<i>notch</i> "
        f"from f by {number(form, 4)}", [below("from <i>notch</i>", alike, 0.01, 0.03), below("from f", form, 0.01, 0.03)])


def frontier(ctx, found):
    plot = costs_plot(found, designed(ctx))
    line, box = found["line"]["bob"], found["box"]["bob"]
    words = [f"There is no free sharpness. A box two lines high keeps {percent(box['sharpness'], 0)} of a quarter "
             f"of a cycle a line and flickers by {percent(share(found, 'box'), 1)}; one line high "
             f"it keeps {percent(line['sharpness'], 0)} and flickers by "
             f"{percent(share(found, 'line'), 1)}. Lower right would be heaven."]
    words.append(designs(ctx, found))
    ctx.report.section(
        "frontier", "What sharpness costs", *words,
        figure("frontier-plot", plot.svg(ctx.weft), "Flicker of the still zone plate against sharpness. Dots are "
               "measured by <code>weft measure</code> on rendered fields, curves computed by "
               "<code>weft filters --frontier</code>: the least for this plate and these kernels."))
    ctx.report.row("§5", "There is a tradeoff between flicker and vertical sharpness.",
                   "; ".join(f"<i>{name}</i> {number(found[name]['bob']['sharpness'], 2)} sharp, "
                             f"{percent(share(found, name), 1)} flicker" for name in found),
                   [above("<i>line</i> over <i>box</i>, sharpness", line["sharpness"] / box["sharpness"], 1.1, 1),
                    above("flicker", line["flicker"]["rms"] / box["flicker"]["rms"], 1.1, 1)], better(ctx))


def against_box(ctx, name):
    """Flicker through an aperture over that through the box, by picture: the plate, lettering and the shipped
    still scene."""
    stills = {a: ctx.weft.measure(ctx.weft.render("still", "525i", a, tau=0, samples=16 if ctx.quick else 64))
              for a in ("box", name)}
    plates, letters = ctx.figures["plates"], ctx.figures["letters"]
    return {"the plate": share(plates, name) / share(plates, "box"),
            "the lettering": share(letters, name) / share(letters, "box"),
            "<code>still.lua</code>": stills[name]["flicker"]["rms"] / stills["box"]["flicker"]["rms"]}


def listed(ratios):
    return ", ".join(f"{number(ratio, 2)} on {picture}" for picture, ratio in ratios.items())


def designs(ctx, found):
    """What the designed apertures do, on the plate that they were designed for and on pictures."""
    crisp, ratios = found["crisp"]["bob"], {name: against_box(ctx, name) for name in ctx.designs}
    ctx.figures["against_box"] = ratios
    worse = [picture for picture, ratio in ratios["crisp"].items() if ratio > 1]
    caught = (f" A plate is not a picture, though: on {' and '.join(worse)} it flickers <i>more</i> than the box."
              if worse else "")
    return ("Today one can ask a computer for the weights that flicker least at a given sharpness, on the plate. "
            f"<code>crisp</code> is one of these: {percent(crisp['sharpness'], 0)} sharp, "
            f"{percent(share(found, 'crisp'), 1)} flicker. It has weights below zero, which a hole in a card cannot "
            f"have. Against the box its flicker is {listed(ratios['crisp'])}; that of <code>calm</code> "
            f"{listed(ratios['calm'])}." + caught)


def better(ctx):
    """What the designed aperture says of the paper's, in words: only what holds on every picture."""
    ratios = ctx.figures["against_box"]["crisp"]
    if all(ratio < 1 for ratio in ratios.values()):
        return "But the paper's apertures do not exhaust it: <i>crisp</i> is sharper and calmer than <i>box</i>."
    return f"<i>crisp</i> does not escape it: its flicker over that of <i>box</i> is {listed(ratios)}."
