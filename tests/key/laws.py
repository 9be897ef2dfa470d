"""What the codes of the pictures of shot.sh must be, by trying all K and F'; by the law of light, K is alpha and F'
the code of the light."""
PLACES = {"whole": (40, 30, (.5, .25, .1), 1), "half": (84, 34, (.25, .125, .05), .5),
          "dark": (84, 8, (0, 0, 0), .1), "none": (2, 2, (0, 0, 0), 0)}
STEPS = 400

def code(v):
    return max(v, 0) ** (1 / 2.4)

def span(a, alpha, m):
    rest = [code(a + (1 - alpha) * (i / STEPS) ** 2.4) - m * i / STEPS for i in range(STEPS + 1)]
    return min(rest), max(rest)

def fill_and_key(light, alpha, law, straight):
    if law == "light" or alpha == 1:
        k, f = alpha, [code(a / alpha if straight and alpha else a) for a in light]
        return f, k
    worst, m = min((max(hi - lo for lo, hi in (span(a, alpha, k / 1000) for a in set(light))), k / 1000) for k in range(0, 1001))
    f, k = [sum(span(a, alpha, m)) / 2 for a in light], 1 - m
    return ([min(v / k, 1) if k else 0 for v in f] if straight else f), k

def ycbcr(rgb, bits):  # BT.709, narrow range
    r, g, b = rgb
    y, one = .2126 * r + .7152 * g + .0722 * b, 1 << (bits - 8)
    return (16 + 219 * y) * one, (128 + 224 * (b - y) / 1.8556) * one, (128 + 224 * (r - y) / 1.5748) * one
