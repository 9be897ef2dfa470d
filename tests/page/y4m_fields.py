"""Reads Y4M without weft, and makes R'G'B' of its fields as a page promises."""

MATRICES = {"601": (0.299, 0.114), "709": (0.2126, 0.0722)}


class Clip:
    """All frames of a Y4M file of 8 or 10 bits, 4:2:2, 4:4:4 or 4:2:0, as planes of codes."""

    def __init__(self, path, matrix="601"):
        with open(path, "rb") as file:
            head = file.readline().decode().split()
            words = {word[0]: word[1:] for word in head[1:] if not word.startswith("X")}
            self.width, self.lines = int(words["W"]), int(words["H"])
            chroma = words.get("C", "420")
            self.bits = 10 if chroma.endswith("p10") else 8
            self.across = 1 if chroma.startswith("444") else 2
            self.down = 2 if chroma.startswith("420") else 1
            self.first = {"b": 1, "t": 0}[words["I"]]  # parity of field 0
            self.matrix, self.full = MATRICES[matrix], "XCOLORRANGE=FULL" in head
            self.frames = []
            while file.readline().startswith(b"FRAME"):
                self.frames.append([self.plane(file, p) for p in range(3)])

    def plane(self, file, p):
        width = self.width // (self.across if p else 1)
        lines = self.lines // (self.down if p else 1)
        data = file.read(width * lines * (1 if self.bits == 8 else 2))
        if self.bits == 8:
            return [data[y * width:(y + 1) * width] for y in range(lines)]
        codes = memoryview(data).cast("H")
        return [codes[y * width:(y + 1) * width].tolist() for y in range(lines)]

    def chroma8(self, code):
        """A code of chroma rounded to 8 bits."""
        return code if self.bits == 8 else min(255, (code + 2) >> 2)

    def luma8(self, code):
        """Of more bits, 0 for black, 255 for white and beyond: ten have a black of 64 and a white of 940."""
        return code if self.bits == 8 else (2 * (code - 64) * 255 + 876) // (2 * 876)

    def chroma_line(self, y):
        """4:2:0 of fields: those of a field go with its own lines."""
        return y if self.down == 1 else y // 4 * 2 + y % 2

    def rows(self, field, y):
        planes = self.frames[field // 2]
        line = self.chroma_line(y)
        return planes[0][y], planes[1][line], planes[2][line]

    def weights(self, rounded=True):
        """Of Y', Cr in red, Cb and Cr in green, Cb in blue; of codes as they are rounded to 8 bits, or as they are."""
        kr, kb = self.matrix
        kg = 1 - kr - kb
        y, c = (1, 1) if self.full else (255 / 219, 255 / 224)
        if self.bits > 8 and rounded:
            y = 1
        red, blue = 2 * (1 - kr) * c, 2 * (1 - kb) * c
        return y, red, kb * blue / kg, kr * red / kg, blue

    def line(self, field, y, columns):
        """[R', G', B'] of those columns of a line, in whole numbers."""
        luma, cb, cr = self.rows(field, y)
        wy, red, green_b, green_r, blue = (round(65536 * w) for w in self.weights())
        black, out = 0 if self.full or self.bits > 8 else 16, []

        def between(row, x):
            at = x // self.across
            here = self.chroma8(row[at])
            if self.across == 1 or x % 2 == 0 or x + 1 == self.width:
                return here - 128
            return ((here + self.chroma8(row[at + 1]) + 1) >> 1) - 128

        for x in columns:
            y1, b, r = (self.luma8(luma[x]) - black) * wy + 32768, between(cb, x), between(cr, x)
            three = (y1 + red * r, y1 - green_b * b - green_r * r, y1 + blue * b)
            out.append([min(255, max(0, v >> 16)) for v in three])
        return out

    def is_gray(self, field, y, x):
        _, cb, cr = self.rows(field, y)
        at, middle = x // self.across, 128 << (self.bits - 8)
        near = range(max(0, at - 1), min(len(cb), at + 2))
        return all(cb[k] == middle and cr[k] == middle for k in near)

    def exact(self, field, y, x):
        """The same of an even column, in floating point, of codes that are not rounded."""
        luma, cb, cr = self.rows(field, y)
        unit, at = 1 << (self.bits - 8), x // self.across
        wy, red, green_b, green_r, blue = self.weights(rounded=False)
        y1 = wy * (luma[x] / unit - (0 if self.full else 16))
        b, r = cb[at] / unit - 128, cr[at] / unit - 128
        return [min(255, max(0, v)) for v in (y1 + red * r, y1 - green_b * b - green_r * r, y1 + blue * b)]
