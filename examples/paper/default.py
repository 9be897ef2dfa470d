"""What the paper had not: which aperture fields should have where none is named, by the bench's published figures."""
import csv
import math
import os

from claims import above, below
from page import figure, table
from plots import Plot, axis, number

# Of tests/bench/defaults.py, which measures them and has the rule. Without the sources they are not there.
FIGURES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../tests/bench/results/defaults.csv")
NAMED = ("line", "rotated", "box", "ccd", "notch", "shaped", "diamond", "crisp", "calm")
DISPLAYS = ("crt", "bwdif", "yadif", "w3fdif")
WORDS = ("raster", "scene", "way")
KEPT = "shaped"


def read():
    """By raster, by way, by scene."""
    found = {}
    with open(FIGURES, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            row = {key: text if key in WORDS else float(text) for key, text in row.items()}
            found.setdefault(row["raster"], {}).setdefault(row["way"], {})[row["scene"]] = row
    return found


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def after(row):
    """The mean distance from the progressive picture after the displays."""
    return mean(row[display] for display in DISPLAYS)


def distance(scenes):
    return mean(map(after, scenes.values()))


def seen(scenes):
    """The median of visible flicker, 99.9 % of it being below; where nothing stands still there is none."""
    values = sorted(0 if math.isnan(row["jnd"]) else row["jnd"] for row in scenes.values())
    return (values[(len(values) - 1) // 2] + values[len(values) // 2]) / 2


def chosen(ways):
    """The nearest of those whose flicker is not seen in half of the scenes or more."""
    return min((name for name in NAMED if seen(ways[name]) < 1), key=lambda name: distance(ways[name]))


def nearer(ways, name):
    """By how many percent nearer than the default, in the mean over scenes, and two standard errors of that."""
    shares = [100 - 100 * after(row) / after(ways[KEPT][scene]) for scene, row in ways[name].items()]
    middle = mean(shares)
    variance = sum((share - middle)**2 for share in shares) / (len(shares) - 1)
    return middle, 2 * math.sqrt(variance / len(shares))


def calmer(ways, name):
    """The least ratio of a way's flicker to the default's, over scenes in which something stands still."""
    return min(row["rms"] / ways[KEPT][scene]["rms"] for scene, row in ways[name].items() if row["rms"] > 1e-3)


def plot(ctx, found):
    """What is seen of flicker over the distance, of every aperture that has a name."""
    top = max(distance(ways[name]) for ways in found.values() for name in NAMED)
    drawn = Plot(axis(0, 1.1 * top, "distance after displays, RMS of Y', Cb and Cr"), axis(0, 4, "seen, JND"),
                 "Visible flicker over distance from the progressive picture after displays, by aperture and raster",
                 height=380)
    drawn.line([[0, 1], [1.1 * top, 1]], series=8, name="just noticed", dashed=True)
    for series, (raster, ways) in enumerate(found.items(), 1):
        at = {name: [distance(ways[name]), seen(ways[name])] for name in NAMED}
        drawn.points(at.values(), series=series, name=raster)
        for name in ("line", "box", "shaped"):
            drawn.word(*at[name], name, series=series)
    return drawn.svg(ctx.weft)


def plus_minus(pair):
    return f"{pair[0]:.0f} ± {pair[1]:.0f} %"


def run(ctx):
    if not os.path.exists(FIGURES):
        return
    found = read()
    best = {raster: chosen(ways) for raster, ways in found.items()}
    rows = [(raster, len(ways[KEPT]), f"<code>{best[raster]}</code>", plus_minus(nearer(ways, best[raster])),
             f"{seen(ways[best[raster]]):.2f}, {seen(ways[KEPT]):.2f}", f"<code>{KEPT}</code>")
            for raster, ways in found.items()]
    others = [raster for raster in found if best[raster] != KEPT]
    ctx.report.section(
        "default", "Where no aperture is named",
        "These figures are not of this run but of weft's bench, which takes a dozen moving scenes through every aperture "
        "and four displays. Of the apertures whose flicker is not seen in half of the scenes or more, the nearest to the "
        "progressive picture after the displays is what the figures speak for.",
        table(("Raster", "Scenes", "They speak for", "Nearer than <code>shaped</code> by",
               "Seen: it, <code>shaped</code>, JND", "weft takes"), rows),
        figure("default-plot", plot(ctx, found), "What is seen of flicker, and how far the picture is from the "
               "progressive one, by aperture; further left is nearer, and below the dashed line half of the scenes "
               "do not flicker for the eye."),
        f"On 525 lines composite coding makes false color of what wider apertures pass, and <code>{best['525i']}</code> is "
        f"the nearest. On {' and '.join(others)} nothing is coded so, and <code>box</code> would be nearer. There too weft "
        "takes <code>shaped</code>: it has always said so, jobs that name no aperture would make other pictures, and it "
        "flickers less on every scene of which something stands still. Who wants to be nearer names <code>box</code>.",
        "One scene, the wheel's, flickers by 26 JND and more through every aperture at 25 frames a second, and hardly at "
        "30: the wings of its bird beat 25 times a second, so that each frame is like the one before while its two "
        "fields are not. That is there to be seen, and no aperture along the picture's lines can take it away.")
    wheel = {raster: found[raster]["line"]["wheel"]["jnd"] for raster in found}
    tell(ctx, found, best, others, wheel)


def tell(ctx, found, best, others, wheel):
    ratios = {raster: calmer(found[raster], "box") for raster in others}
    margins = {raster: nearer(found[raster], best[raster]) for raster in others}
    ctx.report.row("§5", "(Not in the paper: its aperture is the one to take where none is named.)",
                   f"525i: the figures speak for <i>{best['525i']}</i>. " + "; ".join(
                       f"{raster}: for <i>{best[raster]}</i>, by {plus_minus(margins[raster])}, which flickers by "
                       f"{number(ratios[raster])} times <i>shaped</i> or more, RMS" for raster in others),
                   [below("525i, distance of <i>shaped</i> over that of the nearest",
                          distance(found["525i"][KEPT]) / distance(found["525i"][best["525i"]]), 1.0005, 1.05)] +
                   [below(f"{raster}, how much nearer <i>{best[raster]}</i> is, %", margins[raster][0], 0, 5)
                    for raster in others],
                   "It is right for composite video of 525 lines, and kept on the others for what it does to flicker.")
    ctx.report.row("§5", "(Not in the paper: what beats at the frame rate flickers whatever the aperture.)",
                   "the wheel and its bird, of which wings beat 25 times a second, through <i>line</i>: " +
                   ", ".join(f"{number(jnd)} JND on {raster}" for raster, jnd in wheel.items()),
                   [above(f"{raster} over 525i", wheel[raster] / wheel["525i"], 5, 2) for raster in others])
