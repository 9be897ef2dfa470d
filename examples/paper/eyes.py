"""Judder against blur: what an eye sees that follows the motion, and one that does not."""
import cmath

import pictures
from analysis import crossing, edge_width, PI
from claims import above, below
from page import figure, picture, side_by_side
from plots import Plot, axis, number

SPEED = 8          # pixels a field of 1/59.94 s
FIELDS = 20        # looked at
INTERLACED, FILM = "@30000/1001i,bff", "@24000/1001p"
SCREENS = {"60 fields": INTERLACED, "24 frames": FILM, "30 frames": "@30000/1001psf,bff"}


def shown(screen, n):
    """The frame and first line of what a screen shows as field n, and the lines' step."""
    if screen == "24 frames":  # 2:3, whole frames
        return (2 * n + 1) // 5, 0, 1
    return n // 2, (n + 1) % 2, 2


def profile(clip, screen, n, lower):
    """Light along x of a field, of the upper (wide bar) or lower (thin bar) lines."""
    frame, first, step = shown(screen, n)
    half = clip.lines // 2
    lines = [y for y in range(first, clip.lines, step) if (y >= half + 4 if lower else y < half - 4)]
    return clip.line(frame, lines[len(lines) // 2])


def following(clip, screen):
    """The wide bar's profile for an eye that goes along: mean over fields, from its start."""
    span = range(-30, 90)
    total = [0.0] * len(span)
    for n in range(2, FIELDS):
        row = profile(clip, screen, n, False)
        for k, offset in enumerate(span):
            x = 30 + offset + SPEED * n
            total[k] += row[x] if 0 <= x < len(row) else 0
    return [v / (FIELDS - 2) for v in total]


def strobing(clip, screen):
    """How strongly the resting eye sees separate images of the thin bar: the modulation, at one
    image a step, of all its images together."""
    step = SPEED * 5 / 2 if screen == "24 frames" else SPEED
    step = 2 * SPEED if screen == "30 frames" else step
    total = [0.0] * clip.width
    for n in range(FIELDS):
        total = [a + b for a, b in zip(total, profile(clip, screen, n, True))]
    level = min(total)
    part = [v - level for v in total[70:150]]
    wave = sum(v * cmath.exp(-2j * PI * k / step) for k, v in enumerate(part))
    return abs(wave) / sum(part)


def double(clip, screen):
    """Pixels between the edges of both fields of a frame, for the eye that follows; and frozen."""
    a, b = [crossing(profile(clip, screen, n, False), 0.45) for n in (6, 7)]
    return abs(b - a - SPEED), abs(b - a)


CASES = [("60 fields", tau) for tau in (0, 0.25, 0.5, 1, 2, 4)] + [
    ("24 frames", tau) for tau in (0, 0.5, 1)]


def measured(ctx):
    found = {}
    for screen, tau in CASES + [("30 frames", 0)]:
        frames = {"24 frames": FIELDS * 2 // 5 + 1}.get(screen, FIELDS // 2)
        clip = ctx.weft.clip("pursuit", f"320x24{SCREENS[screen]}", "box", frames, tau=tau,
                             speed=SPEED, samples=64)
        found[screen, tau] = {"blur": edge_width(following(clip, screen), 0.02, 0.9),
                              "strobe": strobing(clip, screen), "edges": double(clip, screen)}
    return found


# ---- Pictures ----

def retina(ctx, screen, tau, follow):
    """What falls on the retina in eight fields: rows of light around the disc."""
    size = 72
    frames = {"24 frames": 5}.get(screen, 5)
    clip = ctx.weft.clip("pursuit", f"200x{size}{SCREENS[screen]}", "box", frames, tau=tau, speed=SPEED,
                         disc=1, samples=16 if ctx.quick else 32)
    total = [[0.0] * size for _ in range(size)]
    for n in range(2, 10):
        frame, first, step = shown(screen, n)
        x0 = SPEED * n if follow else SPEED * 5
        for y in range(size):
            own = y if step == 1 or y % 2 == first else y + 1 if y + 1 < size else y - 1
            row = clip.line(frame, own, max(0, x0), min(clip.width, x0 + size))
            other = row if own == y or y == 0 else clip.line(frame, y - 1, x0, x0 + size)
            for x in range(len(row)):
                total[y][x] += (row[x] + other[x]) / 16
    return pictures.png(pictures.display_bytes(total, 0.9))


def views(ctx):
    cases = [("60 fields", 0, "60 fields, an instant"), ("60 fields", 1, "60 fields, one field"),
             ("60 fields", 4, "60 fields, four fields"), ("24 frames", 0.5, "24 frames, 180\N{DEGREE SIGN}")]
    rows = []
    for follow, word in ((True, "following"), (False, "resting")):
        rows.append(side_by_side(*(picture(retina(ctx, screen, tau, follow), f"A spoked disc for the "
                                           f"{word} eye: {name}", "soft", note=f"<b>{name}</b>, {word}")
                                   for screen, tau, name in cases)))
    return '<div style="height:14px"></div>'.join(rows)


def trade_plot(weft, found):
    plot = Plot(axis(0, 28, "blur for the eye that follows, pixels from 10 to 90 %"),
                axis(0, 1.02, "strobing for the eye that rests", ticks=(0, 0.25, 0.5, 0.75, 1)),
                "Strobing against blur for temporal widths, 60 fields and 24 frames", height=360)
    fields = [(c["blur"], c["strobe"]) for (s, _), c in found.items() if s == "60 fields"]
    film = [(c["blur"], c["strobe"]) for (s, _), c in found.items() if s == "24 frames"]
    plot.line(fields, 1, "60 fields a second")
    plot.line(film, 2, "24 frames a second, shown 2:3")
    plot.points(fields, 1, radius=4)
    plot.points(film, 2, radius=4)
    for (screen, tau), case in found.items():
        if screen != "30 frames":
            word = f"{number(tau)} field{'' if tau == 1 else 's'}" if screen == "60 fields" else f"{number(360 * tau)}\N{DEGREE SIGN}"
            low = case["strobe"] < 0.05
            plot.word(case["blur"], case["strobe"], word, anchor="middle" if low else "start",
                      dx=14 if low else 7, dy=-9 if low else 4, series=1 if screen == "60 fields" else 2)
    return plot.svg(weft)


def run(ctx):
    found = measured(ctx)
    get = lambda screen, tau, key: found[screen, tau][key]
    split, frozen = get("60 fields", 0, "edges")
    split_whole, frozen_whole = get("30 frames", 0, "edges")
    width = {tau: get("60 fields", tau, "blur") for tau in (0, 0.5, 1, 2, 4)}
    strobe = {tau: get("60 fields", tau, "strobe") for tau in (0, 0.5, 1, 2, 4)}
    film = {tau: found["24 frames", tau] for tau in (0, 0.5, 1)}
    ctx.report.section(
        "judder", "Judder or blur: ask the eye",
        "A thing that moves can be looked at in two ways. An eye that rests sees a row of sharp "
        "images where there should be a smear: judder. An eye that follows holds the thing still "
        "on its retina, and there every smear of the shutter is just a loss. Here both eyes are "
        f"computed from rendered fields. A disc goes past at {SPEED} pixels a field; for the "
        "following eye each field is put where the eye was looking at its instant.",
        figure("judder-views", views(ctx), "What has fallen on the retina after eight fields. Above, the "
               "eye follows; below, it rests. Film at 24 frames shows each image two or three "
               "times, and the following eye sees two or three of them side by side."),
        figure("judder-plot", trade_plot(ctx.weft, found), "Every temporal width is a place on this curve. "
               "Down is less judder, left is sharper. No width is at the lower left corner, and "
               "24 frames are nowhere near."),
        f"With 60 fields a window of one field removes strobing altogether ({number(strobe[1], 2)} "
        f"left) and makes an edge {number(width[1], 1)} pixels wide, which without blur is "
        f"{number(width[0], 1)}. A filter of four fields, two whole frames, makes it "
        f"{number(width[4], 1)}, and has nothing left to gain. The paper could not recommend a "
        "number either: it asks for a knob.",
        "The same eye answers for the teeth of the carousel. Frozen, the two fields of a frame "
        f"stand {number(frozen, 1)} pixels apart; for the eye that follows, {number(split, 2)}. If "
        f"both fields are taken at one instant it is {number(frozen_whole, 2)} frozen and "
        f"{number(split_whole, 1)} for the eye that follows: there the teeth are, in motion, where "
        "they hurt.")
    rows(ctx, found, (split, frozen, split_whole, frozen_whole), width, film)


def rows(ctx, found, edges, width, film):
    split, frozen, split_whole, frozen_whole = edges
    strobe = {tau: found["60 fields", tau]["strobe"] for tau in (0, 0.5, 1, 2, 4)}
    add = ctx.report.row
    add("§4", "Sampled field by field the moving image is fine; sampled frame by frame it is serrated.",
        f"fields apart for the eye that follows: {number(split, 2)} px by fields, "
        f"{number(split_whole, 1)} px by frames; frozen {number(frozen, 1)} and "
        f"{number(frozen_whole, 2)}",
        [below("followed, by fields", split, 0.3, 0.6), above("followed, by frames", split_whole, 1, 0.6),
         below("frozen, by frames", frozen_whole, 0.3, 0.6), above("frozen, by fields", frozen, 1, 0.6)])
    add("§4", "Temporal prefiltering removes judder.",
        f"strobing {number(strobe[0], 2)} at an instant, {number(strobe[0.5], 2)} at half a field, "
        f"{number(strobe[1], 3)} at one", [
            above("at an instant", strobe[0], 0.2, 0.1), below("one field", strobe[1], 0.05, 0.1)])
    add("§4", "For the eye that follows, blur looks like a smear.",
        f"edge {number(width[0], 1)} px wide at an instant, {number(width[0.5], 1)}, "
        f"{number(width[1], 1)} "
        f"and {number(width[2], 1)} with 1/2, 1 and 2 fields", [
            above("1/2 field over an instant", width[0.5] / width[0], 1.1, 1),
            above("1 over 1/2", width[1] / width[0.5], 1.1, 1), above("2 over 1", width[2] / width[1], 1.1, 1)])
    add("§4", "Filters that span many frames give unacceptable blur.",
        f"four fields: edge {number(width[4], 1)} px wide, strobing {number(strobe[4], 2)}; one "
        "field: "
        f"{number(width[1], 1)} px, {number(strobe[1], 2)}", [above("four fields over one", width[4] / width[1], 3, 2)])
    add("§4", "Judder is less serious in video than in motion pictures.",
        f"for the following eye: {number(film[0.5]['blur'], 1)} px at 24 frames, "
        f"180\N{DEGREE SIGN}, against {number(width[0.5], 1)} px at 60 fields, half a field; "
        f"strobing of the resting eye {number(film[0.5]['strobe'], 2)} and "
        f"{number(strobe[0.5], 2)}, but images "
        f"{number(SPEED * 2.5, 0)} px apart instead of {SPEED}", [above("film over video", film[0.5]["blur"] / width[0.5], 2, 1.2)])
    add("§4", "At 10 turns a minute judder was not apparent without blur.",
        f"a thing at {SPEED} px a field, not the carousel itself: strobing {number(strobe[0], 2)} "
        "for a resting "
        "eye, none for one that "
        "follows", (), "Measured, judder is there; whether it is apparent only viewers can say.")
