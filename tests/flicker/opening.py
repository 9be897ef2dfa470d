"""Whether what the README says under its first picture is what its three ways measure: opening.py WEFT SOURCE."""
import os
import re
import sys
import tempfile

weft, source = sys.argv[1:]
sys.path.insert(0, os.path.join(source, "examples", "scenes"))
from before_after import LIMIT, Maker, told  # noqa: E402

SAMPLES = 16  # a quarter of the picture's


def said():
    """The numbers under the picture, as text: RMS of the first and third, and of the second; the limit; and where it
    flickers most, of the third and of the others."""
    with open(os.path.join(source, "README.md"), encoding="utf-8") as file:
        text = " ".join(file.read().split())
    found = re.search(r"about the same flicker \(RMS (\.\d+) of white, of the second (\.\d+)\).*nowhere over (\.\d+) of white.*"
                      r"The third is a little sharper than both, and where it flickers most, it does so by (\.\d+) "
                      r"instead of (\.\d+)", text)
    if not found:
        sys.exit("README.md says something else under its first picture: make this test say it too")
    return found.groups()


def rounded(value, text):
    """Whether a number is what is printed: to half of the last digit."""
    return abs(value - float(text)) <= 0.5 * 10 ** -len(text.split(".")[1])


def main():
    calm, second, limit, least, most = said()
    with tempfile.TemporaryDirectory() as folder:
        make = Maker(weft, folder, SAMPLES)
        figures = {name: told(frame, make.sharp) for name, frame in make.ways().items()}
    print(figures)
    third, others = figures["nearest"], (figures["ffmpeg"], figures["shaped"])
    checks = {
        "all flicker by what is said": rounded(third[0], calm) and rounded(others[0][0], calm),
        "the second does": rounded(others[1][0], second),
        "the limit is the one that is said": float(limit) == LIMIT and third[1] <= LIMIT + 2e-4,
        "the third flickers most by what is said": rounded(third[1], least),
        "the others do": all(rounded(f[1], most) for f in others),
        "the third is a little sharper": all(0.8 < third[2] / f[2] < 1 for f in others)}
    wrong = [what for what, holds in checks.items() if not holds]
    print("\n".join(f"FAILED: {what}" for what in wrong) or "all hold")
    return 1 if wrong else 0


sys.exit(main())
