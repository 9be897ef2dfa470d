"""What is found in pictures: spectra, responses, edges."""
import cmath
import math

PI = math.pi


def sinc(z):
    return 1.0 if z == 0 else math.sin(PI * z) / (PI * z)


def mean(values):
    return sum(values) / len(values)


def rms(values):
    return math.sqrt(mean([value * value for value in values])) if values else 0.0


def decibels(ratio, floor=-120.0):
    return max(floor, 20 * math.log10(ratio)) if ratio > 0 else floor


def correlation(a, b):
    ma, mb = mean(a), mean(b)
    a, b = [v - ma for v in a], [v - mb for v in b]
    norm = math.sqrt(sum(v * v for v in a) * sum(v * v for v in b))
    return sum(p * q for p, q in zip(a, b)) / norm if norm else 0.0


def hann(count):
    return [0.5 - 0.5 * math.cos(2 * PI * (k + 0.5) / count) for k in range(count)]


# ---- Spectra ----

def transform(values, frequencies):
    """The Fourier sum of real or complex values at frequencies in cycles a step."""
    out = []
    for f in frequencies:
        turn = cmath.exp(-2j * PI * f)
        total = 0
        for value in reversed(values):  # Horner's scheme
            total = total * turn + value
        out.append(total)
    return out


def spectrum(rows, across, down):
    """|DFT| of rows under a Hann window: a row for each frequency down, cycles a step."""
    window_x, window_y = hann(len(rows[0])), hann(len(rows))
    inner = []
    for row, weight in zip(rows, window_y):
        if weight and any(row):
            inner.append(transform([v * w * weight for v, w in zip(row, window_x)], across))
        else:
            inner.append([0] * len(across))
    columns = [transform(list(column), down) for column in zip(*inner)]
    return [[abs(columns[x][y]) for x in range(len(across))] for y in range(len(down))]


def steps(low, high, count):
    return [low + (high - low) * k / (count - 1) for k in range(count)]


# ---- Zone plates: 1/2 + 1/2 cos(phase), whose phase is known everywhere ----

def amplitude(values, phases):
    """The amplitude of cos(phase + any angle) in values, by least squares with a constant."""
    rows = [(1.0, math.cos(p), math.sin(p)) for p in phases]
    normal = [[sum(r[i] * r[j] for r in rows) for j in range(3)] for i in range(3)]
    right = [sum(r[i] * v for r, v in zip(rows, values)) for i in range(3)]
    found = solve(normal, right)
    return math.hypot(found[1], found[2])


def solve(matrix, right):
    """Gauss with pivots, for a few unknowns; what is not determined is 0."""
    n = len(right)
    a = [row[:] + [r] for row, r in zip(matrix, right)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(a[i][k]))
        a[k], a[best] = a[best], a[k]
        if abs(a[k][k]) < 1e-9:
            a[k] = [0.0] * (n + 1)
            a[k][k] = 1.0
        for i in range(n):
            if i != k:
                factor = a[i][k] / a[k][k]
                a[i] = [p - factor * q for p, q in zip(a[i], a[k])]
    return [a[k][n] / a[k][k] for k in range(n)]


def plate_response(line, middle, rate, aspect=1.0, half=10, every=4):
    """Along a line through a zone plate's middle: pairs of frequency and response. The frequency
    is rate * distance, in cycles a step."""
    pairs = []
    for at in range(half, len(line) - half, every):
        distance = (at + 0.5 - middle) * aspect
        if distance < 0:
            continue
        part = range(at - half, at + half + 1)
        phases = [PI * rate * ((k + 0.5 - middle) * aspect) ** 2 / aspect for k in part]
        pairs.append((rate * distance, 2 * amplitude([line[k] for k in part], phases)))
    return pairs


# ---- Edges ----

def crossing(values, level):
    """Where values first rise through a level, in steps from the first value's middle."""
    for k, (a, b) in enumerate(zip(values, values[1:])):
        if a < level <= b:
            return k + (level - a) / (b - a)
    return None


def edge_width(values, low=0.0, high=1.0):
    """From 10 to 90 % of a rising edge, in steps."""
    a = crossing(values, low + 0.1 * (high - low))
    b = crossing(values, low + 0.9 * (high - low))
    return None if a is None or b is None else b - a


def strongest(values, rate):
    """Frequency and amplitude of the strongest component of values less their straight line."""
    count = len(values)
    middle = (count - 1) / 2
    slope = sum((k - middle) * v for k, v in enumerate(values)) / sum(
        (k - middle) ** 2 for k in range(count))
    level = mean(values)
    rest = [(v - level - slope * (k - middle)) for k, v in enumerate(values)]
    best = max(((abs(transform(rest, [f / count])[0]), f) for f in range(1, count // 2 + 1)))
    double = 1 if 2 * best[1] == count else 2
    return rate * best[1] / count, double * best[0] / count, rms(rest)
