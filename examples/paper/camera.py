"""Figures 4 and 5: what a CCD camera does, built from its parts, against one aperture of weft."""
import pictures
from analysis import rms
from claims import below
from page import exact, figure, side_by_side
from plots import Plot, axis, number
from shapes import shape_plot
from still import middle_columns


def sensor(ctx, samples):
    """A camera of rows one line high, that all see for a whole field and are read out in pairs: a
    list of lines. The scene is half a line lower, so that pairs meet where weft has its lines."""
    rows = ctx.weft.clip("plate", "720x486@60000/1001p,par=10:11", "line", tau=1, shift=0.5,
                         samples=samples).picture()
    return [[(a + b) / 2 for a, b in zip(upper, lower)] for upper, lower in zip(rows, rows[1:])]


def compare(ctx):
    samples = 16 if ctx.quick else 64
    camera = sensor(ctx, samples)
    made = ctx.weft.clip("plate", "525i", "ccd", samples=samples)
    again = ctx.weft.clip("plate", "525i", "ccd", samples=4 * samples)
    light, better = made.picture(), again.picture()
    span = range(2, 484)
    difference = rms([a - b for y in span for a, b in zip(camera[y], light[y])])
    noise = rms([a - b for y in span for a, b in zip(better[y], light[y])])
    return camera, made, difference, noise


def lattice_plot(weft):
    """The camera's windows in time and height, over the lines of the fields."""
    plot = Plot(axis(-0.5, 4, "time, fields", ticks=range(0, 5)),
                axis(5, -1, "y, scan lines", ticks=range(-1, 6)),
                "The windows of a camera in time and height: two lines high, a field long", 420, 320)
    for n in range(4):
        rows = range(n % 2, 5, 2)
        plot.add("boxes", boxes=[[n, n + 1, j - 0.5, j + 1.5] for j in rows], series=1 + n % 2)
        plot.points([(n, j + 0.5) for j in rows], 1 + n % 2, radius=4)
    return plot.svg(weft)


def run(ctx):
    camera, made, difference, noise = compare(ctx)
    x0, x1 = middle_columns(made)
    left = pictures.png(pictures.display_bytes([row[x0:x1] for row in camera]))
    right = pictures.png(pictures.gray_rows(made, 0, range(485), x0, x1))
    ctx.report.section(
        "camera", "What a camera does",
        "A CCD camera sees with rows of sensors one scan line high that collect light for a whole "
        "field. Rows are read out in pairs, other pairs for the next field. So each line "
        "averages a box two lines high and a field long.",
        '<figure id="fig-4"><div class="row n2 plots">' + lattice_plot(ctx.weft) +
        shape_plot(ctx.weft, ctx.figures["shapes"]["ccd"], "time, fields", "Measured weight of the aperture ccd "
                   "in time and height", (2, 3), (420, 320)) +
        "</div><figcaption><b>Figure 4.</b> Left: the boxes of both fields overlap in height and "
        "follow each other in time. Right: the aperture <code>ccd</code>, measured. A point of "
        "light flashed at every eighth of a line and of a field, and this is how much of each "
        "flash arrived. </figcaption></figure>",
        "The paper puts a real camera's picture of a zone plate beside a computed one. There is no "
        "camera here, but there is its construction: every row of sensors rendered on its own, and "
        "pairs added afterwards.",
        figure("fig-5", side_by_side(
            exact(left, "Zone plate seen by rows of sensors that were added in pairs",
                  "Rows of sensors, added in pairs"),
            exact(right, "Zone plate through weft's ccd aperture", "weft, aperture <code>ccd</code>")),
               "<b>Figure 5.</b> The same zone plate twice. They differ by "
               f"{number(difference, 4)} RMS, of white 1; the samples' own noise is "
               f"{number(noise, 4)}."))
    ctx.report.row("Fig. 4, 5", "Ganged CCD rows average a box two lines high and a field long; a synthetic "
                   "box gives the camera's picture.",
                   f"RMS difference {number(difference, 4)}, noise of the samples "
                   f"{number(noise, 4)}",
                   [below("difference over noise", difference / noise, 4, 6),
                    below("difference", difference, 0.02, 0.04)],
                   "The camera here is a model of one, not the one of the paper.")
