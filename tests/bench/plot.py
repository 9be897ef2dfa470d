"""Log-log plots as SVG, with the slope of each line fitted."""
import math
from xml.sax.saxutils import escape

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 760, 460, 70, 50, 40, 210
COLORS = ["#1b6ca8", "#c0392b", "#2e8b57", "#8e44ad", "#b8860b", "#16a085", "#7f8c8d", "#d35400"]


def slope(points):
    """Of log y over log x, by least squares; None of fewer than two."""
    pairs = [(math.log(x), math.log(y)) for x, y in points if x > 0 and y > 0]
    if len(pairs) < 2:
        return None
    mx = sum(x for x, _ in pairs) / len(pairs)
    my = sum(y for _, y in pairs) / len(pairs)
    across = sum((x - mx) ** 2 for x, _ in pairs)
    return sum((x - mx) * (y - my) for x, y in pairs) / across if across > 0 else None


class Axis:
    """Decades from below the least to above the most, over a stretch of the picture."""

    def __init__(self, values, start, end):
        self.low = math.log10(min(values)) - 0.05
        self.high = math.log10(max(values)) + 0.05
        self.start, self.end = start, end

    def at(self, value):
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def ticks(self):
        for decade in range(math.floor(self.low), math.ceil(self.high) + 1):
            for digit in (1, 2, 5):
                value = digit * 10.0 ** decade
                if self.low <= math.log10(value) <= self.high:
                    yield value


def text(x, y, what, anchor="middle", more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" {more}>{escape(what)}</text>'


def axes(x, y, xlabel, ylabel):
    for value in x.ticks():
        at = x.at(value)
        yield f'<path d="M{at:.1f} {y.start}V{y.end}" class="grid"/>'
        yield text(at, y.start + 18, f"{value:g}")
    for value in y.ticks():
        at = y.at(value)
        yield f'<path d="M{x.start} {at:.1f}H{x.end}" class="grid"/>'
        yield text(x.start - 8, at + 4, f"{value:g}", "end")
    yield text((x.start + x.end) / 2, HEIGHT - 10, xlabel)
    middle = (y.start + y.end) / 2
    yield text(16, middle, ylabel, more=f'transform="rotate(-90 16 {middle})"')


def line(x, y, number, name, points):
    color = COLORS[number % len(COLORS)]
    steps = "L".join(f"{x.at(a):.1f} {y.at(b):.1f}" for a, b in points)
    yield f'<path d="M{steps}" stroke="{color}" fill="none" stroke-width="1.6"/>'
    for a, b in points:
        yield f'<circle cx="{x.at(a):.1f}" cy="{y.at(b):.1f}" r="3" fill="{color}"/>'
    fitted = slope(points)
    label = name if fitted is None else f"{name}: slope {fitted:.2f}"
    yield text(WIDTH - RIGHT + 14, TOP + 16 + 20 * number, label, "start", f'fill="{color}"')


def log_log(path, title, xlabel, ylabel, series):
    """series: (name, [(x, y)]) each."""
    series = [(name, sorted(p for p in points if p[0] > 0 and p[1] > 0))
              for name, points in series]
    series = [(name, points) for name, points in series if points]
    if not series:
        return
    x = Axis([p[0] for _, points in series for p in points], LEFT, WIDTH - RIGHT)
    y = Axis([p[1] for _, points in series for p in points], HEIGHT - BOTTOM, TOP)
    body = [text(LEFT, 24, title, "start", 'font-weight="bold"'), *axes(x, y, xlabel, ylabel)]
    for number, (name, points) in enumerate(series):
        body += line(x, y, number, name, points)
    with open(path, "w") as f:
        f.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
                'font-family="sans-serif" font-size="12">\n'
                '<style>.grid{stroke:#ddd;stroke-width:1}</style>\n'
                f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#fff"/>\n' +
                "\n".join(body) + "\n</svg>\n")
