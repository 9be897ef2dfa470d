"""Figure 6: the carousel, its serration, and what blur does to it."""
import pictures
from analysis import mean
from claims import above
from page import figure, picture, side_by_side
from plots import number

WOVEN, WHOLE = "525i", "720x486@30000/1001psf,bff,par=10:11,601-525"
CROP = (72, 48)


def serrated(woven, whole, frame):
    """The part of the picture where the fields differ most: x, y."""
    a, b, width = woven.frames[frame][0], whole.frames[frame][0], woven.width
    best = (-1, 0, 0)
    rows = [[abs(p - q) for p, q in zip(a[y * width:(y + 1) * width], b[y * width:(y + 1) * width])]
            for y in range(woven.lines)]
    for y in range(60, woven.lines - CROP[1], 16):
        for x in range(0, width - CROP[0], 24):
            best = max(best, (sum(sum(row[x:x + CROP[0]]) for row in rows[y:y + CROP[1]]), x, y))
    return best[1:]


def comb(clip, frame, x, y):
    """How far lines are from the mean of those above and below, in codes of 8 bits."""
    luma, width = clip.frames[frame][0], clip.width
    lines = [luma[j * width + x:j * width + x + CROP[0]] for j in range(y - 1, y + CROP[1] + 1)]
    return mean([abs(b - (a + c) / 2) for p, q, r in zip(lines, lines[1:], lines[2:])
                 for a, b, c in zip(p, q, r)])


def detail(clip, frame, x, y):
    """Mean step from pixel to pixel within the lines of one field."""
    luma, width = clip.frames[frame][0], clip.width
    return mean([abs(luma[j * width + k + 1] - luma[j * width + k])
                 for j in range(y, y + CROP[1], 2) for k in range(x, x + CROP[0])])


def crop(clip, frame, x, y):
    return pictures.png(pictures.color_rows(clip, frame, range(y, y + CROP[1]), x, x + CROP[0]),
                        color=True)


def run(ctx):
    samples, number_of, frame = 12 if ctx.quick else 48, 6, 0
    make = lambda raster, tau: ctx.weft.clip("carousel", raster, "box", f"{number_of}-{number_of}", 8,
                                             tau=tau, samples=samples)
    woven, whole = make(WOVEN, 0), make(WHOLE, 0)
    blurred = {tau: make(WOVEN, tau) for tau in ("1/2", 1)}
    x, y = serrated(woven, whole, frame)
    teeth = [comb(clip, frame, x, y) for clip in (woven, whole)]
    sharp = [detail(clip, frame, x, y) for clip in (woven, *blurred.values())]
    shape = CROP[0] * 10 / 11 / CROP[1]
    cut = lambda clip, alt, note: picture(crop(clip, frame, x, y), alt, "pixels", note, shape)
    full = pictures.png(pictures.color_rows(woven, frame, range(woven.lines)), color=True, filtered=True)
    ctx.report.section(
        "carousel", "Six figures on a carousel",
        "The paper's test animation is a carousel at ten turns a minute. Each field is an instant "
        "of its own: when one frame is frozen, what moves has teeth, because the odd lines are a "
        "sixtieth of a second older than the even ones. That is how it has to be.",
        figure("fig-6", picture(full, "A frame of the carousel: six figures, a striped roof, checkered "
                                "ground", shape=720 * 10 / 11 / 486) + '<div style="height:16px"></div>' +
               side_by_side(cut(woven, "Enlarged part with serrated edges", "<b>field by field</b>: "
                                "serrated when frozen"),
                            cut(whole, "The same part without serration", "<b>frame by frame</b>: "
                                "smooth when frozen"),
                            cut(blurred[1], "The same part with motion blur", "field by field, "
                                "<b>one field of blur</b>")),
               f"<b>Figure 6.</b> Frame {number_of}, box aperture, no blur; and the {CROP[0]} by "
               f"{CROP[1]} pixels in which most moves, enlarged. Neighboring lines disagree by "
               f"{number(teeth[0], 1)} codes on average field by field, {number(teeth[1], 1)} "
               "frame by frame."),
        "In motion it is the other way round. The eye that follows a figure sees both fields "
        "where the "
        'figure was at their instants, and they fit. How much they do is measured <a href="#judder">below'
        "</a>, with an eye that follows. Blur takes "
        f"detail away: steps from pixel to pixel average {number(sharp[0], 2)} codes without it, "
        f"{number(sharp[1], 2)} with half a field, {number(sharp[2], 2)} with a whole one.")
    ctx.report.row("Fig. 6", "A still frame of an interlaced animation looks serrated.",
                   f"lines differ from their neighbors by {number(teeth[0], 1)} codes; frame by "
                   "frame "
                   f"{number(teeth[1], 1)}", [above("field by field over frame by frame", teeth[0] / teeth[1], 1.3, 1.1)])
    ctx.report.row("§4", "The carousel looks sharper without motion blur.",
                   f"steps between pixels {number(sharp[0], 2)} codes without blur, "
                   f"{number(sharp[1], 2)} "
                   f"and {number(sharp[2], 2)} with 1/2 and 1 field", [above("without over 1/2 field", sharp[0] / sharp[1], 1.02, 1),
                    above("1/2 over 1 field", sharp[1] / sharp[2], 1.02, 1)])
