"""Plots as SVG. Colours are classes of page.css, so that they follow the reader's scheme."""
import html
import math

from pictures import uri

MINUS = "\N{MINUS SIGN}"


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


class Axis:
    """A linear or logarithmic scale of values onto a span of the drawing."""

    def __init__(self, low, high, label, ticks=None, log=False, digits=None):
        self.low, self.high, self.label, self.log, self.digits = low, high, label, log, digits
        self.ticks = ticks if ticks is not None else self.nice()

    def nice(self):
        if self.log:
            first, last = math.ceil(math.log10(self.low)), math.floor(math.log10(self.high))
            return [10.0 ** k for k in range(first, last + 1)]
        span = self.high - self.low
        step = 10 ** math.floor(math.log10(span / 4))
        step *= min((k for k in (1, 2, 2.5, 5, 10) if span / (step * k) <= 6), default=10)
        first = math.ceil(self.low / step - 1e-9)
        return [k * step for k in range(first, math.floor(self.high / step + 1e-9) + 1)]

    def at(self, value, start, end):
        if self.log:
            low, high, value = (math.log10(max(v, 1e-12)) for v in (self.low, self.high, value))
        else:
            low, high = self.low, self.high
        return start + (end - start) * (value - low) / (high - low)


class Plot:
    """Axes first; then lines, points, bands, words; then svg()."""

    left, right, top, bottom = 66, 14, 12, 46

    def __init__(self, x, y, title, width=560, height=320):
        self.x, self.y, self.title, self.width, self.height = x, y, title, width, height
        self.parts, self.keys = [], []

    def px(self, value):
        return round(self.x.at(value, self.left, self.width - self.right), 2)

    def py(self, value):
        return round(self.y.at(value, self.height - self.bottom, self.top), 2)

    def inside(self, y):
        return min(max(y, self.y.low), self.y.high)

    def line(self, pairs, series=1, key=None, dashed=False):
        points = " ".join(f"{self.px(x)},{self.py(self.inside(y))}" for x, y in pairs)
        style = " dashed" if dashed else ""
        self.parts.append(f'<polyline class="line s{series}{style}" points="{points}"/>')
        if key:
            self.keys.append((series, key, "dashed" if dashed else "line"))

    def points(self, pairs, series=1, key=None, radius=2.6, names=()):
        for k, (x, y) in enumerate(pairs):
            tip = f"<title>{html.escape(names[k])}</title>" if k < len(names) else ""
            self.parts.append(f'<circle class="dot s{series}" cx="{self.px(x)}" '
                              f'cy="{self.py(self.inside(y))}" r="{radius}">{tip}</circle>')
        if key:
            self.keys.append((series, key, "dot"))

    def word(self, x, y, text, anchor="start", dx=7, dy=4, series=None):
        kind = f' t{series}' if series else ""
        self.parts.append(f'<text class="word{kind}" x="{self.px(x) + dx}" y="{self.py(y) + dy}" '
                          f'text-anchor="{anchor}">{html.escape(text)}</text>')

    def rule(self, x=None, y=None, text=None):
        if x is not None:
            ends = f'x1="{self.px(x)}" x2="{self.px(x)}" y1="{self.top}" y2="{self.height - self.bottom}"'
        else:
            ends = f'y1="{self.py(y)}" y2="{self.py(y)}" x1="{self.left}" x2="{self.width - self.right}"'
        self.parts.append(f'<line class="rule" {ends}/>')
        if text and x is not None:
            self.word(x, self.y.high, text, dx=4, dy=12)
        elif text:
            self.word(self.x.high, y, text, anchor="end", dx=-4, dy=-5)

    def band(self, x0, x1, text=None):
        self.parts.append(f'<rect class="band" x="{self.px(x0)}" y="{self.top}" '
                          f'width="{round(self.px(x1) - self.px(x0), 2)}" '
                          f'height="{self.height - self.bottom - self.top}"/>')
        if text:
            self.word((x0 + x1) / 2, self.y.high, text, anchor="middle", dx=0, dy=13)

    def bars(self, values, series=1, width=0.7):
        """Values as pairs of x and y; y = None draws none."""
        for x, y in values:
            x0, x1 = self.px(x - width / 2), self.px(x + width / 2)
            y0, y1 = self.py(self.y.low), self.py(self.inside(y))
            self.parts.append(f'<rect class="bar s{series}" x="{x0}" y="{y1}" '
                              f'width="{round(x1 - x0, 2)}" height="{round(y0 - y1, 2)}"/>')

    def image(self, data, x0, x1, y0, y1):
        """A PNG laid over a part of the axes: y0 is its upper edge."""
        self.parts.append(f'<image href="{uri(data)}" x="{self.px(x0)}" y="{self.py(y0)}" '
                          f'width="{round(self.px(x1) - self.px(x0), 2)}" '
                          f'height="{round(self.py(y1) - self.py(y0), 2)}" '
                          'preserveAspectRatio="none" class="pixels"/>')

    def ring(self, x, y, text, radius=13, below=False, kind="ring"):
        self.parts.append(f'<circle class="{kind}" cx="{self.px(x)}" cy="{self.py(y)}" r="{radius}"/>')
        if text:
            shift = radius + 13 if below else -radius - 5
            self.parts.append(f'<text class="{kind}word" x="{self.px(x)}" y="{self.py(y) + shift}" '
                              f'text-anchor="middle">{html.escape(text)}</text>')

    def frame(self):
        right, floor = self.width - self.right, self.height - self.bottom
        out = []
        for value in self.x.ticks:
            at = self.px(value)
            out.append(f'<line class="grid" x1="{at}" x2="{at}" y1="{self.top}" y2="{floor}"/>'
                       f'<text class="tick" x="{at}" y="{floor + 16}" text-anchor="middle">'
                       f'{number(value, self.x.digits)}</text>')
        for value in self.y.ticks:
            at = self.py(value)
            out.append(f'<line class="grid" x1="{self.left}" x2="{right}" y1="{at}" y2="{at}"/>'
                       f'<text class="tick" x="{self.left - 7}" y="{at + 4}" text-anchor="end">'
                       f'{number(value, self.y.digits)}</text>')
        middle = (self.top + floor) / 2
        out.append(f'<text class="label" x="{(self.left + right) / 2}" y="{self.height - 8}" '
                   f'text-anchor="middle">{html.escape(self.x.label)}</text>')
        out.append(f'<text class="label" transform="translate(14 {middle}) rotate(-90)" '
                   f'text-anchor="middle">{html.escape(self.y.label)}</text>')
        return "".join(out)

    def legend(self):
        if not self.keys:
            return ""
        items = "".join('<li><svg viewBox="0 0 24 10" aria-hidden="true">' + (
            f'<circle class="dot s{series}" cx="12" cy="5" r="3.5"/>' if kind == "dot" else
            f'<line class="line s{series} {kind}" x1="0" x2="24" y1="5" y2="5"/>') +
            f"</svg>{html.escape(text)}</li>" for series, text, kind in self.keys)
        return f'<ul class="legend">{items}</ul>'

    def svg(self):
        title = html.escape(self.title, quote=True)
        return (f'<div class="plot"><svg viewBox="0 0 {self.width} {self.height}" role="img" '
                f'aria-label="{title}"><title>{title}</title>{self.frame()}'
                f'{"".join(self.parts)}</svg>{self.legend()}</div>')
