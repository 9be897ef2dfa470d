"""The box turned on its side, and the diamond of Figure 7: apertures in time."""
from analysis import sinc
from claims import above, below
from page import figure, picture, side_by_side
from plots import number
from shapes import as_one, response_of, shape_plot, temporal_plot

NOTES = {"box, an instant": "<b>box</b>, no width in time",
         "ccd": "<b>ccd</b>, one field", "rotated": "<b>rotated</b>, two fields, one line",
         "diamond": "<b>diamond</b>"}


def percent(value):
    return f"{number(100 * value, 0)} %"


def run(ctx):
    shapes, responses = ctx.figures["shapes"], ctx.figures["responses"]
    at, half = [{name: response_of(shape, f, across=False) for name, shape in shapes.items()}
                for f in (0.25, 0.5)]
    line, box, diamond = [response_of(shapes[name], 0.5) for name in ("rotated", "ccd", "diamond")]
    maps = side_by_side(*(picture(as_one(ctx.figures["clips"][name]), f"A drifting zone plate through "
                                  f"{name}", note=NOTES[name]) for name in responses))
    equal, plain = ctx.figures["blur"]
    ctx.report.section(
        "time", "Boxes, bricks and diamonds",
        "What else could a pixel average over? The paper turns the camera's box on its side, one "
        "line high and a frame long, and tries a diamond in time and height, which looks so "
        "symmetrical on paper. Here is a picture that shows what each does: a zone plate that "
        "drifts to the right at 8 pixels a field. Further right things change faster, further up "
        "lines are finer, so that the frame <i>is</i> a map of the aperture's response, from 0 to "
        "60 Hz across and to half a cycle a line up and down.",
        '<figure id="rotated">' + maps.replace("row n4", "row n4") +
        "<figcaption><b>One frame of a drifting zone plate.</b> Where rings vanish nothing "
        "passes. With no width in time all motion stays, 60 Hz and beyond included, which is "
        "judder. The rotated box loses half of everything beyond "
        f"{number(half_power(responses['rotated'][0]) * 60, 0)} Hz, the camera's beyond "
        f"{number(half_power(responses['ccd'][0]) * 60, 0)} Hz.</figcaption></figure>",
        figure("fig-7", '<div class="row n2 plots">' +
               shape_plot(ctx.weft, shapes["diamond"], "time, fields", "Measured weight of the diamond in time and "
                          "height", (2, 2), (420, 320)) + temporal_plot(ctx.weft, responses) + "</div>",
               "<b>Figure 7.</b> The diamond as measured, and how much of a change in time "
               "passes. Curves are closed forms, dots are measured in the frames above."),
        f"At 15 Hz the camera keeps {percent(at['ccd'])}, the diamond {percent(at['diamond'])}, "
        f"the rotated box {percent(at['rotated'])}. And of half a cycle a line, which is what "
        f"flickers, the diamond lets {percent(diamond)} pass and the rotated box {percent(line)}; "
        f"the box, two lines high, {percent(box)}. Blurred where one wants detail and sharp where "
        "one wants none: the paper's verdict on both holds.",
        "For steady motion, blur in time is nothing but a smear along the way, which could be "
        f"added to a still picture afterwards. The two differ by {number(equal, 4)} RMS here, "
        f"where the blur itself amounts to {number(plain, 3)}.")
    add = ctx.report.row
    add("§4", "Temporal filtering of steady motion equals spatial filtering along the motion.",
        f"RMS difference {number(equal, 4)}; without the smear {number(plain, 3)}", [below("difference over smear", equal / plain, 0.1, 0.3)])
    add("§4", "The rotated box, one line high and a frame long, yields far too much motion blur.",
        f"at 15 Hz {percent(at['rotated'])} is left (camera {percent(at['ccd'])}); "
        f"at 30 Hz {percent(half['rotated'])} (camera "
        f"{percent(half['ccd'])})", [below("at 15 Hz, less the camera's", at["rotated"] - at["ccd"], -0.1, -0.05)])
    add("Fig. 7", "The diamond blurs motion too much ...",
        f"at 15 Hz {percent(at['diamond'])} is left (camera {percent(at['ccd'])}); the closed form "
        "says "
        f"{percent(sinc(0.25) ** 2)}", [below("at 15 Hz, less the camera's", at["diamond"] - at["ccd"], -0.05, -0.02)])
    add("Fig. 7", "... and is too sharp vertically, which causes flicker.",
        f"response at 0.5 cycles a line {number(diamond, 3)}; box {number(box, 3)}",
        [above("diamond", diamond, 0.2, 0.05), below("box", box, 0.01, 0.05)])


def half_power(pairs):
    """The first frequency at which half is left."""
    return next((f for f, r in pairs if r < 0.5), float("nan"))
