"""Plots of the page, drawn by `weft plot`: SVG whose colors follow the reader's scheme."""
import json

MINUS = "\N{MINUS SIGN}"
THEORY = 8  # the series of what is computed, not measured: gray


def number(value, digits=None):
    """A number as a reader expects it: a true minus, no needless zeros."""
    if digits is None:
        text = f"{value:.3g}"
        if "e" in text:
            text = f"{value:.1e}" if abs(value) < 1 else f"{value:.0f}"
    else:
        text = f"{value:.{digits}f}"
        if float(text) == 0:
            text = f"< {10.0 ** -digits:.{digits}f}" if value and digits > 2 else text.lstrip("-")
    return text.replace("-", MINUS).replace("<", "&lt;")


def axis(low, high, label, ticks=None):
    given = {"low": low, "high": high, "label": label}
    return {**given, "ticks": list(ticks)} if ticks is not None else given


class Plot:
    """Axes first; then what is drawn over them, in its order; then svg(weft)."""

    def __init__(self, x, y, description, width=560, height=320):
        self.items = []
        self.data = {"description": description, "width": width, "height": height, "x": x, "y": y,
                     "items": self.items}

    def add(self, kind, **keys):
        """An item of a kind that `weft plot --help` describes; keys that are None are left out."""
        self.items.append({"kind": kind, **{k: v for k, v in keys.items() if v is not None}})

    def line(self, pairs, series=1, name=None, dashed=False):
        self.add("line", points=list(pairs), series=series, name=name, dashed=dashed)

    def points(self, pairs, series=1, name=None, radius=2.6):
        self.add("points", points=list(pairs), series=series, name=name, radius=radius)

    def word(self, x, y, text, anchor="start", dx=7, dy=4, series=0):
        self.add("word", at=[x, y], text=text, anchor=anchor, shift=[dx, dy], series=series)

    def map(self, values, box, least=None, most=None, text=None):
        """Values as colors; box is (x0, x1, y0, y1), the first row being at y0. Text says what they are, at
        a bar of the colors."""
        self.add("map", values=values, box=list(box), range=None if least is None else [least, most], text=text)

    def ring(self, x, y, text, radius=13, below=False, dashed=False):
        self.add("ring", at=[x, y], text=text, radius=radius, below=below, dashed=dashed)

    def svg(self, weft):
        return f'<div class="plot">{weft.run("plot", "-", "-o", "-", given=json.dumps(self.data))}</div>'
