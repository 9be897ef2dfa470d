"""Rapid periodic motion: wheels that turn backwards, wings that vanish; and a temporal width for each
object."""
import cmath
import math

import pictures
from analysis import PI, edge_width, mean, sinc
from claims import above, below
from page import figure, picture, side_by_side
from plots import THEORY, Plot, axis, number

RATE = 60000 / 1001
SPOKES, FIELDS, CELL = 8, 8, 60
ACROSS, DOWN, TOP_RPM = 6, 4, 920
RPM = [TOP_RPM * n / (ACROSS * DOWN - 1) for n in range(ACROSS * DOWN)]


# ---- Wheels of every speed ----

def spoke_wave(rows, x, y, radius=15, points=96):
    """The spokes around a wheel's middle as one complex number: how clear, and at which angle."""
    total = 0
    for k in range(points):
        angle = 2 * PI * k / points
        px, py = x + radius * math.cos(angle) - 0.5, y - radius * math.sin(angle) - 0.5
        i, j = int(px), int(py)
        a, b = px - i, py - j
        value = ((rows[j][i] * (1 - a) + rows[j][i + 1] * a) * (1 - b) +
                 (rows[j + 1][i] * (1 - a) + rows[j + 1][i + 1] * a) * b)
        total += value * cmath.exp(-1j * SPOKES * angle)
    return 2 * total / points


def watch(ctx, tau):
    """By wheel: apparent turns a minute and how clear its spokes are."""
    clip = ctx.weft.clip("wheels", f"{ACROSS * CELL}x{DOWN * CELL}@60000/1001p", "box", FIELDS, tau=tau,
                         to=TOP_RPM, samples=6 if ctx.quick else 16)
    frames = [clip.picture(n) for n in range(FIELDS)]
    found = []
    for n in range(ACROSS * DOWN):
        x, y = (n % ACROSS + 0.5) * CELL, (n // ACROSS + 0.5) * CELL
        waves = [spoke_wave(rows, x, y) for rows in frames]
        turn = sum(b * a.conjugate() for a, b in zip(waves, waves[1:]))
        found.append((-cmath.phase(turn) / (2 * PI * SPOKES) * RATE * 60, mean([abs(w) for w in waves])))
    return found


def apparent(rpm):
    """What a wheel of that speed looks like at one picture a field."""
    cycles = rpm / 60 * SPOKES / RATE
    return (cycles - round(cycles)) * RATE / SPOKES * 60


def turning_plot(weft, found):
    low, high = -240, 240
    plot = Plot(axis(0, TOP_RPM, "turns a minute", ticks=range(0, 901, 225)),
                axis(low, high, "turns a minute as seen", ticks=(-225, 0, 225)),
                "Apparent against true speed of an eight-spoked wheel: backwards above 225 turns "
                "a minute",
                420, 340)
    fine = [TOP_RPM * k / 920 for k in range(921)]
    run = []
    for rpm in fine:
        value = apparent(rpm)
        if run and abs(value - run[-1][1]) > 200:
            plot.line(run, THEORY, dashed=True)
            run = []
        run.append((rpm, value))
    plot.line(run, THEORY, "as sampling says", dashed=True)
    plot.points(list(zip(RPM, [f[0] for f in found])), 2, "measured", 3.6)
    return plot.svg(weft)


def clear_plot(weft, found):
    plot = Plot(axis(0, TOP_RPM, "turns a minute", ticks=range(0, 901, 225)),
                axis(0, 1.06, "clearness of the spokes", ticks=(0, 0.25, 0.5, 0.75, 1)),
                "How clear the spokes are against speed, for four temporal widths", 420, 340)
    still = found[0][0][1]
    for k, (tau, wheels) in enumerate(found.items(), 1):
        cycles = [SPOKES * rpm / 60 / RATE for rpm in range(0, TOP_RPM, 5)]
        plot.line([(5 * i, abs(sinc(tau * c))) for i, c in enumerate(cycles)], k,
                  f"{number(tau)} field" + ("s" if tau != 1 else ""))
        plot.points([(rpm, clear / still) for rpm, (_, clear) in zip(RPM, wheels)], k, radius=2.6)
    plot.add("rule", x=225)
    return plot.svg(weft)


# ---- The shipped scene ----

def crops(ctx):
    parts = []
    for tau, word in ((0, "an instant"), ("1/2", "half a field"), (1, "one field"), (2, "two fields")):
        clip = ctx.weft.clip("wheel", "480x360@60000/1001p", "box", "34-34", 8, tau=tau,
                             samples=4 if ctx.quick else 64)
        rows = pictures.color_rows(clip, 0, range(20, 340), 60, 380)
        parts.append(picture(pictures.png(rows, color=True, filtered=True), f"A rolling wheel and a beating "
                             f"bird, window {word}", note=f"<b>{word}</b>"))
    return side_by_side(*parts)


def wheel_section(ctx, found):
    still = found[0][0][1]
    wrong = [k for k, rpm in enumerate(RPM) if 235 < rpm < 440]
    backwards = sum(found[0][k][0] < 0 for k in wrong)
    left = {tau: mean([found[tau][k][1] for k in wrong]) / still for tau in found}
    example = next(k for k, rpm in enumerate(RPM) if rpm > 390)
    ctx.report.section(
        "wheel", "Wheels that turn backwards",
        "A wheel with eight spokes looks the same after an eighth of a turn. Once it turns by "
        "more than half of that between fields, the nearer spoke is the wrong one. With 60 fields "
        "a second this happens beyond 225 turns a minute.",
        '<figure id="wheel-plots"><div class="row n2 plots">' + turning_plot(ctx.weft, found[0]) +
        clear_plot(ctx.weft, found) +
        f"</div><figcaption>Left: {len(RPM)} wheels, each at a speed of its own, and how fast they "
        f"seem to turn. The one at {number(RPM[example], 0)} turns a minute seems to turn at "
        f"{number(found[0][example][0], 0)}. Right: how clearly the spokes are seen. With a window "
        "of one field what turns the wrong way has at least grown faint.</figcaption></figure>",
        f"Where wheels turn backwards ({backwards} of {len(wrong)} here between 235 and 440 turns "
        f"a minute), spokes keep {number(100 * left[0], 0)} % of their contrast without a window, "
        f"{number(100 * left[0.5], 0)} % with half a field, {number(100 * left[1], 0)} % with one "
        f"and {number(100 * left[2], 0)} % with two.")
    ctx.report.section(
        "wings", "Wings, at 25 beats a second",
        "A hummingbird's wings are up and down again within two or three fields. Taken at an "
        "instant they are frozen in a pose that means nothing; a window in time turns them into "
        "the haze they are.",
        figure("wings-pictures", crops(ctx), "The scene <code>wheel.lua</code>: a wheel at 150 turns "
                                             "a minute and "
               "a bird, one field through four windows."))
    ctx.report.row("§4", "A spinning wheel may seem to turn backwards.",
                   f"at {number(RPM[example], 0)} turns a minute it seems to turn at "
                   f"{number(found[0][example][0], 0)} (sampling says "
                   f"{number(apparent(RPM[example]), 0)})",
                   [below("turns a minute as seen", found[0][example][0], -10, 0),
                    below("off what sampling says", abs(found[0][example][0] - apparent(RPM[example])), 5, 20)])
    ctx.report.row("§4", "Rapid periodic motion demands temporal antialiasing.",
                   f"contrast of spokes that turn the wrong way: {number(100 * left[0], 0)} % at "
                   f"an instant, {number(100 * left[0.5], 0)} %, {number(100 * left[1], 0)} %, "
                   f"{number(100 * left[2], 0)} % "
                   "with 1/2, 1 and 2 fields", [
                       above("an instant", left[0], 0.9, 0.7), below("one field", left[1], 0.6, 0.8),
                       below("two over one", left[2] / left[1], 0.9, 1)])


# ---- A width for each object ----

def streaks(ctx, speed):
    """How long each ball's streak is, in field periods: its start is a ramp of that length."""
    clip = ctx.weft.clip("own", "420x240@60p", "box", tau="1/2", flat=1, speed=speed, samples=256)
    lines = [clip.line(0, round(240 / 2 - (1.5 - n) * 240 / 4.2)) for n in range(4)]
    return [edge_width(line, 0.03, 0.9) / 0.8 / speed for line in lines]


def own_section(ctx):
    speed = 56
    widths, lengths = (0, 0.5, 1, 2), streaks(ctx, 16)
    clip = ctx.weft.clip("own", "420x240@60p", "box", 1, 8, tau="1/2", speed=speed,
                         samples=64 if ctx.quick else 256)
    data = pictures.png(pictures.color_rows(clip, 0, range(240), 40, 360), color=True, filtered=True)
    ctx.report.section(
        "per-object", "To each its own shutter",
        "The paper ends with a wish: let the artist give different objects different amounts of "
        "blur. A solid in weft may carry its own temporal width. One picture, one render, four "
        f"balls at the same speed of {speed} pixels a field:",
        figure("own-shutters", '<div class="half">' + picture(data, "Four balls at one speed with four "
               "lengths of blur", shape=320 / 240) + "</div>", "From the top, "
                                                               "<code>temporal_width</code> 0, 1/2, 1 and 2 "
               "field periods. The smear of each, as measured, is "
               f"{', '.join(number(v, 2) for v in lengths)} fields long."))
    ctx.report.row("§7", "Different amounts of temporal filtering for different objects: a future "
                   "consideration.", "asked for 0, 1/2, 1, 2 fields in one picture; streaks measured "
                   f"{', '.join(number(v, 2) for v in lengths)} fields",
                   [below("worst, off by", max(abs(a - b) for a, b in zip(widths, lengths)), 0.15, 0.3)], "Done here. A pixel is a "
                                                                            "sixteenth of a field wide.")


def run(ctx):
    found = {tau: watch(ctx, tau) for tau in (0, 0.5, 1, 2)}
    wheel_section(ctx, found)
    own_section(ctx)
