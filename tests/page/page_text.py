"""What tests of pages share: checks that are counted, and HTML as a reader of our own has it."""
import json
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "br", "input", "hr"}
failed = []


def check(name, good, told=""):
    if not good:
        failed.append(name)
    print(("ok: " if good else "FAILED: ") + name + (f": {told}" if told and not good else ""))


class Structure(HTMLParser):
    """Whether tags close in the order they opened, ids are given once, and nothing is fetched."""

    def __init__(self):
        super().__init__()
        self.open, self.ids, self.wrong, self.outside, self.alts, self.needs = [], [], [], [], [], []

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.ids += [given["id"]] if "id" in given else []
        for key in ("src", "href"):
            value = given.get(key) or "#"
            if not value.startswith(("#", "data:")):
                self.outside.append(value)
        if tag == "img":
            self.alts.append(given.get("alt") or "")
        if "data-needs" in given:
            self.needs.append(json.loads(given["data-needs"]))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append((tag, self.getpos()))
