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
    """The numbers under the picture: RMS of all, the limit, and where it flickers most, of the third and of the others."""
    with open(os.path.join(source, "README.md"), encoding="utf-8") as file:
        text = " ".join(file.read().split())
    found = re.search(r"about the same flicker \(RMS (\.\d+) of white\).*nowhere over (\.\d+) of white.*"
                      r"The third is a little sharper than both, and where it flickers most, it does so by (\.\d+) "
                      r"instead of (\.\d+)", text)
    if not found:
        sys.exit("README.md says something else under its first picture: make this test say it too")
    return [float(number) for number in found.groups()]


def main():
    calm, limit, least, most = said()
    with tempfile.TemporaryDirectory() as folder:
        make = Maker(weft, folder, SAMPLES)
        figures = {name: told(frame, make.sharp) for name, frame in make.ways().items()}
    third, others = figures.pop("nearest"), list(figures.values())
    print("nearest", third, figures)
    checks = {
        "all flicker by what is said": all(abs(f[0] - calm) <= 0.0007 for f in (third, *others)),
        "the limit is the one that is said": limit == LIMIT and third[1] <= limit + 2e-4,
        "the third flickers most by what is said": abs(third[1] - least) <= 0.0025,
        "the others do": all(abs(f[1] - most) <= 0.0055 for f in others),
        "the third is a little sharper": all(0.8 < third[2] / f[2] < 1 for f in others)}
    wrong = [what for what, holds in checks.items() if not holds]
    print("\n".join(f"FAILED: {what}" for what in wrong) or "all hold")
    return 1 if wrong else 0


sys.exit(main())
