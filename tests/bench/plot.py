"""Log-log plots, drawn by `weft plot`, with the slope of each line fitted."""
import json
import math
import subprocess


def slope(points):
    """Of log y over log x, by least squares; None of fewer than two."""
    pairs = [(math.log(x), math.log(y)) for x, y in points if x > 0 and y > 0]
    if len(pairs) < 2:
        return None
    mx = sum(x for x, _ in pairs) / len(pairs)
    my = sum(y for _, y in pairs) / len(pairs)
    across = sum((x - mx) ** 2 for x, _ in pairs)
    return sum((x - mx) * (y - my) for x, y in pairs) / across if across > 0 else None


def items(number, name, points):
    """A line and its dots, in the color of that number."""
    fitted, series = slope(points), number % 8 + 1
    yield {"kind": "line", "points": points, "series": series,
           "name": name if fitted is None else f"{name}: slope {fitted:.2f}"}
    yield {"kind": "points", "points": points, "series": series, "radius": 3}


def log_log(weft, path, title, xlabel, ylabel, series):
    """Draws into the SVG file path. weft: the program; series: (name, [(x, y)]) each."""
    series = [(name, sorted(p for p in points if p[0] > 0 and p[1] > 0))
              for name, points in series]
    series = [(name, points) for name, points in series if points]
    if not series:
        return
    plot = {"title": title, "width": 760, "height": 460,
            "x": {"label": xlabel, "log": True}, "y": {"label": ylabel, "log": True},
            "items": [i for k, (name, points) in enumerate(series) for i in items(k, name, points)]}
    subprocess.run([weft, "plot", "-", "-o", path], input=json.dumps(plot), text=True, check=True)
