"""What the paper had not: flicker that is weighed and bounded itself, and displays that deinterlace."""
from analysis import rms
from claims import above, below
from page import figure, picture, side_by_side, table
from plots import number
from program import Failure
from still import bobbed, percent

SIZE = "480x360@30000/1001i,bff"
BOX = (36, 166, 96, 190)  # of the lettering, as in the section on crawl
WAYS = (("line", {}), ("box", {}), ("shaped", {}), ("least:4", {}), ("line", {"limit": 0.05}),
        ("line", {"weight": 1, "limit": 0.05}))
DISPLAYS = ("bob", "yadif", "bwdif", "w3fdif")
APERTURES = (("line", {}), ("box", {}), ("shaped", {}), ("calm", {}), ("line", {"limit": 0.05}))


def name_of(way):
    aperture, held = way
    words = [f"weight {number(held['weight'])}"] if "weight" in held else []
    words += [f"limit {number(held['limit'])}"] if "limit" in held else []
    return f"<code>{aperture}</code>" + (", " + ", ".join(words) if words else "")


def lettering(ctx):
    """By way: its clip, what weft measures, and its distance from the sharp picture in light."""
    found, sharp = [], None
    for aperture, held in WAYS:
        path = ctx.weft.render("lettering", SIZE, aperture, tau=0, samples=64, **held)
        clip = ctx.weft.clip_of(path)
        rows = clip.picture()
        sharp = sharp or rows
        distance = rms([a - b for p, q in zip(rows, sharp) for a, b in zip(p, q)])
        found.append((name_of((aperture, held)), clip, ctx.weft.measure(path)["flicker"], distance))
    return found


def deinterlaced(ctx):
    """PSNR of edges that sink 30 lines a second after each display, against whole frames at the fields' instants."""
    frames, common = 8, {"tau": 0, "samples": 16, "period": 16}
    truth = ctx.weft.render("stripes", "240x180@60000/1001p,par=10:11", "line", 2 * frames, 8, **{
        **common, "speed": 0.5})
    rows = []
    for aperture, held in APERTURES:
        path = ctx.weft.render("stripes", "240x180@30000/1001i,tff,par=10:11", aperture, frames, 8, **common, **held)
        cells = []
        for display in DISPLAYS[1:]:
            told = ctx.weft.measure(path, "--display", display, "--against", truth)
            cells.append(told["difference"]["psnr"])
        rows.append((name_of((aperture, held)), cells))
    return rows


def run(ctx):
    found = lettering(ctx)
    by_name = {name: (flicker, distance) for name, _, flicker, distance in found}
    (shaped, shaped_d), (held, held_d) = by_name["<code>shaped</code>"], by_name["<code>line</code>, limit 0.05"]
    least, least_d = by_name["<code>least:4</code>"]
    shots = [picture(bobbed(clip, n, *BOX), f"Lettering through {name}, field {n + 1}", "pixels",
                     f"<b>{name}</b>, field {n + 1}", (BOX[1] - BOX[0]) / (BOX[3] - BOX[2]))
             for name, clip, _, _ in (found[2], found[4]) for n in (0, 1)]
    parts = [
        "One kernel for the whole picture pays everywhere for what flickers in few places. Flicker itself can be "
        "weighed and bounded instead: of all pictures whose flicker nowhere exceeds a limit, take the one nearest to "
        "the sharp one. Where nothing flickers it <i>is</i> the sharp one.",
        figure("held-fields", side_by_side(*shots), "The two fields of the captions, through the paper's aperture and "
               "held below a limit of 5 % of white."),
        table(("Way", "Flicker, RMS", "99.9 % below", "Distance from the sharp picture, RMS"),
              [(name, percent(flicker["rms"]), percent(flicker["p999"]), percent(distance))
               for name, _, flicker, distance in found]),
        "<code>least:MU</code> weighs flicker alone and is a kernel again: of all pictures of its flicker (RMS) it is "
        "the nearest to the sharp one there is."]
    parts += displays(ctx)
    ctx.report.section("held", "Not a kernel but a bound", *parts)
    ctx.report.row("§5", "(Not in the paper: a bound on flicker gives up less sharpness than an aperture.)",
                   f"lettering: <i>shaped</i> flickers by {percent(shaped['p999'])} (99.9 % below) at a distance of "
                   f"{percent(shaped_d)}; a limit of 5 % by {percent(held['p999'])} at {percent(held_d)}; <i>least:4</i> "
                   f"by {percent(least['rms'])} RMS at {percent(least_d)}",
                   [below("99.9 %, limit over <i>shaped</i>", held["p999"] / shaped["p999"], 0.85, 1),
                    below("distance, limit over <i>shaped</i>", held_d / shaped_d, 1.05, 1.2)])


def displays(ctx):
    """What is left of it after displays that guess the lines between."""
    try:
        rows = deinterlaced(ctx)
    except Failure as failure:
        if "libavfilter" not in str(failure) and "deinterlace" not in str(failure):
            raise
        return ["This weft was built without deinterlacers, so that what they make of it is not shown."]
    best = max(rows, key=lambda row: row[1][1])
    ctx.report.row("§5", "(Not in the paper: after a display that deinterlaces, an aperture against flicker still "
                   "pays.)", f"slow edges after bwdif: {rows[0][0]} {number(rows[0][1][1], 1)} dB, {rows[1][0]} "
                   f"{number(rows[1][1][1], 1)} dB, {rows[2][0]} {number(rows[2][1][1], 1)} dB",
                   [above("<i>shaped</i> less <i>line</i>, dB", rows[2][1][1] - rows[0][1][1], 0.5, 0)])
    return ["Most displays of today deinterlace: they guess the lines between from both fields. What they make of "
            "edges that sink 30 lines a second, against whole frames at the fields' own instants, in dB of PSNR:",
            table(("Way", *DISPLAYS[1:]), [(name, *(number(v, 1) for v in cells)) for name, cells in rows]),
            f"After bwdif {best[0]} is nearest here."]
