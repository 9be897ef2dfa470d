"""Figures 8 and 10, line crawl, and the rule the paper doubts: flicker in what does not move."""
import pictures
from analysis import correlation, mean, rms
from claims import above, below
from page import exact, figure, picture, side_by_side, table
from plots import Plot, axis, number

RASTER = "525i"


def plates(ctx):
    """Zone plates by aperture: paths, clips, and what weft measures of them."""
    samples = 16 if ctx.quick else 64
    names = ("line", "box", "notch", "shaped", "diamond") + ctx.designs
    found = {}
    for name in names:
        path = ctx.weft.render("zoneplate", RASTER, name, tau=0, samples=samples)
        found[name] = {"path": path, "clip": ctx.weft.clip_of(path),
                       "bob": ctx.weft.measure(path, "--chart", "zoneplate")}
    return found


def moire(clip):
    """Both fields near the upper edge, where there should be half a cycle a line: the RMS of each
    about its mean and the correlation of the two."""
    middle, top = clip.width // 2, clip.lines // 12
    parts = []
    for n in (0, 1):
        rows = clip.field(n, middle - 80, middle + 80)[2:top // 2 + 2]
        parts.append([value for row in rows for value in row])
    spread = mean([rms([v - mean(p) for v in p]) for p in parts])
    return spread, correlation(*parts)


CROP = 500  # pixels of a plate, around its middle: two fit side by side, pixel by pixel


def middle_columns(clip):
    return (clip.width - CROP) // 2, (clip.width + CROP) // 2


def fields(clip, name):
    """The middle of both fields pixel by pixel, every line twice: fine rings must not be scaled."""
    words = ("field 1, the lower lines", "field 2, the upper lines")
    return side_by_side(*(exact(pictures.png(pictures.enlarge(
        pictures.gray_rows(clip, 0, clip.own_lines(n), *middle_columns(clip)), 1, 2)),
        f"Zone plate through {name}, {words[n]}", words[n]) for n in (0, 1)))


def flicker_map(clip, block=6):
    """The flicker of measure, half the difference of the fields as a bob display shows them: RMS of
    blocks, and of all."""
    rows, own = clip.picture(), clip.parity(0)
    sums = [[0.0] * (clip.width // block) for _ in range(clip.lines // block)]
    total, last = 0.0, clip.lines - 1
    for y, row in enumerate(rows):
        above, below = rows[y - 1 if y else 1], rows[y + 1 if y < last else last - 1]
        if y in (0, last) and y % 2 == own:
            continue
        squares = [(0.5 * (v - 0.5 * (a + b))) ** 2 for a, v, b in zip(above, row, below)]
        total += sum(squares)
        line = sums[min(y // block, len(sums) - 1)]
        for k in range(len(line)):
            line[k] += sum(squares[k * block:(k + 1) * block])
    levels = [[(v / block ** 2) ** 0.5 for v in line] for line in sums]
    return levels, (total / (clip.width * clip.lines)) ** 0.5


def flicker_plot(weft, levels, name):
    """The map over the plate's frequencies: the plate has 1/2 cycle a line at its upper and lower edge, and
    across what its shape makes of that."""
    wide = 0.5 * 720 / 486 * (10 / 11) ** 2
    plot = Plot(axis(-wide, wide, "across, cycles a pixel", ticks=(-0.5, 0, 0.5)),
                axis(-0.5, 0.5, "up and down, cycles a line", ticks=(-0.5, -0.25, 0, 0.25, 0.5)),
                f"Flicker of a zone plate through {name}, by the frequencies in it", 400, 330)
    plot.map(levels, (-wide, wide, 0.5, -0.5), 0, 0.25, "flicker, of white")
    return f'<div>{plot.svg(weft)}<p><b>{name}</b></p></div>'


def share(found, name, display="bob", key="rms"):
    return found[name][display]["flicker"][key]


def percent(value, digits=2):
    return f"{number(100 * value, digits)} %"


# ---- Lettering ----

def bobbed(clip, n, x0, x1, y0, y1):
    """What a display shows of a field: its own lines, those between by their neighbors."""
    rows, own = pictures.gray_rows(clip, 0, range(clip.lines), x0, x1), clip.parity(n)
    out = []
    for y in range(y0, y1):
        if y % 2 == own:
            out.append(rows[y])
        else:
            out.append(bytes((a + b) // 2 for a, b in zip(rows[y - 1], rows[y + 1])))
    return pictures.png(out)


def lettering(ctx, names):
    found = {}
    for name in names:
        path = ctx.weft.render("lettering", "480x360@30000/1001i,bff", name, tau=0, samples=64)
        found[name] = {"path": path, "clip": ctx.weft.clip_of(path), "bob": ctx.weft.measure(path),
                       "crt": ctx.weft.measure(path, "--display", "crt")}
    return found


def crawl_section(ctx, found):
    box = (36, 166, 96, 190)
    parts = []
    for name in ("line", "shaped"):
        parts += [picture(bobbed(found[name]["clip"], n, *box), f"Lettering through {name}, field {n + 1}",
                          "pixels", f"<b>{name}</b>, field {n + 1}", (box[1] - box[0]) / (box[3] - box[2]))
                  for n in (0, 1)]
    rows = [(f"<code>{name}</code>", percent(share(found, name)), percent(share(found, name, "bob", "p999")),
             percent(share(found, name, "bob", "share"), 1), percent(share(found, name, "crt")))
            for name in found]
    ctx.report.section(
        "crawl", "Line crawl: still and yet it moves",
        "The commonest victim is lettering. These captions do not move. But the rule below them "
        "is not quite level, and where it steps from one line to the next the display shows the "
        "step in one field and not in the other, half a line up, half a line down, thirty times a "
        "second.",
        figure("crawl-fields", side_by_side(*parts), "The two fields of a still frame, each as a display "
               "that doubles lines shows it. Through <code>line</code> the rule's steps and the "
               "cross bars change places with every field. Through <code>shaped</code> both "
               "fields tell the same story."),
        table(("Aperture", "Flicker, RMS", "99.9 % below", "Picture over 2 %", "RMS, lines as on a "
                                                                               "tube"), rows))
    ctx.report.row("§5", "Still pictures show line crawl: moving jaggies, as in the output of poor "
                   "character generators.",
                   f"still lettering flickers by {percent(share(found, 'line'))} RMS through "
                   f"<i>line</i>, {percent(share(found, 'box'))} through <i>box</i>, "
                   f"{percent(share(found, 'shaped'))} through <i>shaped</i>",
                   [above("<i>line</i>, %", 100 * share(found, "line"), 2, 1),
                    above("<i>line</i> over <i>shaped</i>", share(found, "line") / share(found, "shaped"), 1.5, 1)])


# ---- Figure 8 ----

def figure_8(ctx, found, line, notch):
    maps = {name: flicker_map(found[name]["clip"]) for name in ("line", "box", "shaped")}
    ctx.report.section(
        "still", "Flicker in a picture that stands still",
        "A zone plate has every fineness there is: rings get finer outward, and at the upper and "
        "lower edge they reach half a cycle a line, the worst there can be. This one does not "
        "move. Each field is rendered with a box one scan line high.",
        figure("fig-8", fields(found["line"]["clip"], "line"), "<b>Figure 8.</b> Both fields of one "
               "frame through <code>line</code>. The bullseyes at the top and at the bottom are "
               "not in the scene, and where one field has white the other has black: there the "
               f"correlation of the two is {number(line[1], 2)}. A display alternates between "
               "these pictures."),
        "What the eye gets is their difference, thirty times a second. <code>weft measure</code> "
        f"puts it at {percent(share(found, 'line'))} RMS of white light, and "
        f"{percent(share(found, 'line', 'bob', 'share'), 1)} of the picture flickers by more than "
        "2 %.",
        figure("flicker-maps", side_by_side(*(
            flicker_plot(ctx.weft, maps[name][0], name) for name in maps)).replace("row n3", "row n3 plots"),
            "Where it flickers: half the difference of both fields, as a display shows them that fills in "
            "lines, over the frequencies of the plate: " +
            ", ".join(f"{percent(share(found, name))} RMS through <code>{name}</code>" for name in maps) +
            ". Computed by the page's own program, the first comes to {percent(maps['line'][1])} "
            "RMS."))
    ctx.figures["maps"] = maps
    ctx.report.row("Fig. 8", "The fields of a still zone plate through a box one line high are complementary "
                   "Moiré patterns that alternate at 30 Hz.",
                   f"correlation of the fields near half a cycle a line {number(line[1], 3)}, each "
                   f"of {number(line[0], 3)} RMS; flicker of the picture "
                   f"{percent(share(found, 'line'))} RMS",
                   [below("correlation", line[1], -0.9, -0.5), above("RMS of each", line[0], 0.05, 0.02)])
    ctx.report.row("Fig. 10", "Through the notch filter the flickering Moiré is nearly absent.",
                   f"Moiré {number(notch[0], 4)} RMS ({number(line[0] / notch[0], 0)} times less); "
                   f"flicker {percent(share(found, 'notch'))} against "
                   f"{percent(share(found, 'line'))}, over 2 %: "
                   f"{percent(share(found, 'notch', 'bob', 'share'), 2)} of the picture against "
                   f"{percent(share(found, 'line', 'bob', 'share'), 1)}",
                   [below("Moiré, <i>notch</i> over <i>line</i>", notch[0] / line[0], 0.15, 0.3),
                    below("flicker, <i>notch</i> over <i>line</i>", share(found, "notch") / share(found, "line"),
                          0.5, 0.75),
                    below("picture over 2 %, <i>notch</i> over <i>line</i>",
                          share(found, "notch", "bob", "share") / share(found, "line", "bob", "share"), 0.5, 0.75)],
                   "The Moiré is. What still flickers is of middling fineness, between the zeros.")


def rule(ctx, found, letters):
    moving = ctx.figures["wobble"]
    names = ("line", "box", "notch", "shaped")
    plot = Plot(axis(0, 120, "speed of the edge, scan lines a second", ticks=range(0, 121, 30)),
                axis(0, 0.6, "wobble of the edge's light, lines "
                             "RMS"), "Wobble of edges against speed, by aperture",
                height=320)
    for k, name in enumerate(names, 1):
        pairs = [(speed, one["light"]) for speed, one in moving[name].items()]
        plot.line(pairs, k, name)
        plot.points(pairs, k)
    plot.word(0, moving["line"][0]["light"], "still", dx=8, dy=-6)
    still, at30 = moving["line"][0]["light"], moving["line"][30]["light"]
    ctx.report.section(
        "rule", "“Sharper when still”: a rule to distrust",
        "Some would filter only what moves, and let still pictures keep all sharpness lines can "
        "carry. The paper was not convinced. Measure an edge at every speed from rest to 120 "
        "lines a second, and see whether rest is special.",
        figure("rule-plot", plot.svg(ctx.weft), "How far an edge strays from its true path, as its lines tell "
               "it. If standing still were harmless, the curves would start at zero."),
        f"At rest the sharp aperture makes an edge wobble by {number(still, 2)} lines RMS, at 30 "
        f"lines a second by {number(at30, 2)}. Rest is no refuge; only the frequency changes. And "
        f"whole pictures at rest: the zone plate flickers by {percent(share(found, 'line'))}, the "
        f"lettering by {percent(share(letters, 'line'))} RMS through <code>line</code>, against "
        f"{percent(share(found, 'shaped'))} and {percent(share(letters, 'shaped'))} through "
        "<code>shaped</code>.")
    ctx.report.row("§5", "Allowing more vertical sharpness for still images is not safe.",
                   f"edge through <i>line</i>: wobble {number(still, 2)} lines RMS at rest, "
                   f"{number(at30, 2)} at 30 lines/s; still zone plate "
                   f"{percent(share(found, 'line'))}, lettering "
                   f"{percent(share(letters, 'line'))}",
                   [above("wobble at rest over that at 30 lines/s", still / at30, 0.5, 0.25),
                    above("plate, <i>line</i> over <i>shaped</i>", share(found, "line") / share(found, "shaped"),
                          1.5, 1.1),
                    above("lettering, <i>line</i> over <i>shaped</i>",
                          share(letters, "line") / share(letters, "shaped"), 1.5, 1.1)])


def run(ctx):
    found = plates(ctx)
    ctx.figures["plates"] = found
    line, notch = moire(found["line"]["clip"]), moire(found["notch"]["clip"])
    figure_8(ctx, found, line, notch)
    letters = lettering(ctx, ("line", "box", "notch", "shaped") + ctx.designs)
    ctx.figures["letters"] = letters
    crawl_section(ctx, letters)
