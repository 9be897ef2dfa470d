"""What a claim of the paper needs before it agrees, and what makes it differ: thresholds on measured
figures, told beside each verdict."""
import html
import json
import math

from plots import number

WORDS = {True: "agrees", False: "differs", None: "open"}


class Need:
    """A figure and its two thresholds. On the far side of `agree` it speaks for the claim, on the other
    side of `differ` against it, and between the two it leaves the claim open."""

    def __init__(self, what, value, sign, agree, differ):
        self.what, self.value, self.sign = what, value, sign
        self.agree, self.differ = agree, agree if differ is None else differ
        if sign * self.agree < sign * self.differ:
            raise ValueError(f"{what}: one figure can both agree and differ")

    def verdict(self):
        value, agree, differ = (self.sign * v for v in (self.value, self.agree, self.differ))
        if math.isnan(value) or value <= differ:
            return False
        return True if value > agree else None

    def words(self):
        more, less = ("&gt;", "&lt;") if self.sign > 0 else ("&lt;", "&gt;")
        apart = f", differs if {less} {number(self.differ)}" if self.differ != self.agree else ""
        return f"{self.what} {more} {number(self.agree)}{apart}"

    def data(self):
        return [self.what, self.value, self.sign, self.agree, self.differ]


def above(what, value, agree, differ=None):
    """The figure has to be above `agree`; below `differ` the claim is wrong."""
    return Need(what, value, 1, agree, differ)


def below(what, value, agree, differ=None):
    """The figure has to be below `agree`; above `differ` the claim is wrong."""
    return Need(what, value, -1, agree, differ)


def verdict(needs):
    """True where all needs are met, False where one speaks against the claim, None where it stays open:
    one figure is enough to differ, and all are needed to agree."""
    found = [need.verdict() for need in needs]
    if not found:
        return None
    return False if False in found else True if all(found) else None


def told(needs):
    """The thresholds, for readers, and the figures behind them, for programs."""
    if not needs:
        return ""
    data = html.escape(json.dumps([need.data() for need in needs]), quote=True)
    return (f'<span class="needs" data-needs="{data}">Agrees if ' +
            "; ".join(need.words() for need in needs) + ".</span>")
