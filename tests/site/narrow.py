"""Opens the site's pages on a screen of 390 pixels: narrow.py CHROMIUM HTML. None is wider than that or throws; the menu opens."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "page"))
from browser import Browser  # noqa: E402

WIDTH = 390


def main(chromium, root):
    root, wrong = Path(root).resolve(), []
    pages = [file for file in sorted(root.rglob("*.html")) if "api" not in file.relative_to(root).parts and file.name != "404.html"]
    with Browser(chromium) as page:
        page.call("Emulation.setDeviceMetricsOverride", width=WIDTH, height=844, deviceScaleFactor=1, mobile=True)
        for file in pages:
            page.events = []
            page.open(file.as_uri())
            wide = page.run("document.scrollingElement.scrollWidth")
            wrong += [f"{file.relative_to(root)}: {wide} pixels wide"] if wide > WIDTH else []
            wrong += [f"{file.relative_to(root)}: {text}" for text in page.complaints()]
        page.run("document.querySelector('[data-toggle=\"wy-nav-top\"]').click()")
        if not page.run("document.querySelector('.wy-nav-side').classList.contains('shift')"):
            wrong.append("the menu does not open")
    print("\n".join(wrong) if wrong else f"{len(pages)} pages")
    return bool(wrong) or not pages


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
