"""Walks a built site: check_site.py links HTML | options HTML WEFT | words HTML WORDLIST. Links and anchors lead somewhere and
nothing comes from the network; each option of each command has its row; words are American English."""
import html
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src"), ("object", "data")}


class Page(HTMLParser):
    """A page's links, its anchors, what is loaded with it, and its words outside code."""

    def __init__(self, file):
        super().__init__()
        self.links, self.anchors, self.loaded, self.words, self.within = [], set(), [], [], []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        self.anchors |= {found[key] for key in ("id", "name") if found.get(key)}
        for key in ("href", "src", "data"):
            if found.get(key) and (tag, key) in LOADED | {("a", "href"), ("area", "href")}:
                self.links.append(found[key])
                self.loaded += [found[key]] if (tag, key) in LOADED else []
        if tag in ("code", "pre", "script", "style", "title", "nav", "footer"):
            self.within.append(tag)

    def handle_endtag(self, tag):
        if tag in self.within:
            self.within.remove(tag)

    def handle_data(self, data):
        if not self.within:
            self.words += re.findall(r"(?<![\w./_-])[A-Za-z][a-z']+(?![\w./_]|-\w)", data)


def pages_of(root):
    return {file: Page(file) for file in sorted(root.rglob("*.html"))}


def dead(file, link, pages):
    """Why a link leads nowhere, or None."""
    parts = urlsplit(link)
    if parts.scheme:
        return None if parts.scheme in ("http", "https", "mailto", "data") else "a scheme of its own"
    if parts.path.startswith("/"):
        return "an absolute path"
    target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
    if not target.exists() or target.is_dir():
        return "no such file"
    anchor = unquote(parts.fragment)
    if anchor and target.suffix == ".html" and anchor not in pages[target].anchors:
        return "no such anchor"
    return None


def check_links(root):
    pages, wrong = pages_of(root), []
    for file, page in pages.items():
        # Names of the error page begin at the site's root, wherever that is.
        if file.name == "404.html":
            continue
        wrong += [f"{file.relative_to(root)}: {link}: {why}" for link in page.links if (why := dead(file, link, pages))]
        wrong += [f"{file.relative_to(root)}: {link} is loaded from the network" for link in page.loaded
                  if re.match(r"(https?:)?//", link)]
    for file in root.rglob("*.css"):
        found = re.findall(r"(?:url\(['\"]?|@import ['\"])((?:https?:)?//[^)'\"]*)", file.read_text(encoding="utf-8"))
        wrong += [f"{file.relative_to(root)}: {link} is loaded from the network" for link in found]
    return wrong, f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links"


def completed(weft):
    """Each command's options, as shells complete them."""
    script = subprocess.run([weft, "completion", "fish"], check=True, capture_output=True, text=True).stdout
    found = {}
    for line in script.splitlines():
        command = re.search(r"__fish_seen_subcommand_from (\w+)", line)
        option = re.search(r" -l ([\w-]+)", line)
        if command and option:
            found.setdefault(command[1], set()).add(option[1])
    return found


def check_options(root, weft):
    wrong, count, shells = [], 0, completed(weft)
    listed = subprocess.run([weft, "--help"], check=True, capture_output=True, text=True).stdout
    for command in sorted(set(re.findall(r"^  weft (\w+) ", listed, re.M)) | set(shells)):
        file = root / f"made/commands/{command}.html"
        rows = re.findall(r'<td id="([\w-]+)"><code>([^<]*)</code>([^\n]*)</td>\s*<td>([^<]*)</td>',
                          file.read_text(encoding="utf-8")) if file.exists() else []
        told = subprocess.run([weft, command, "--help"], check=True, capture_output=True, text=True).stdout
        wanted = shells.get(command, set()) | set(re.findall(r"^ {2,8}(?:-\w, )?--([\w-]+)", told, re.M))
        shown = {row[0]: row[3] for row in rows}
        count += len(shown)
        wrong += [f"{command}: no row of --{name}" for name in sorted(wanted - set(shown) - {"help"})]
        wrong += [f"{command}: there is no --{name}" for name in sorted(set(shown) - wanted - {"help"})]
        plain = " ".join(told.split())
        wrong += [f"{command}: --{name} is told otherwise: {does}" for name, does in shown.items()
                  if not does or " ".join(html.unescape(does).split()) not in plain]
        wrong += [] if file.exists() else [f"{command}: no page"]
    return wrong + ([] if count > 100 else [f"only {count} options"]), f"{count} options"


def check_words(root, words):
    """What hunspell does not know and the list has not: words that are written as names are (Capital) too."""
    known = {word.strip() for word in Path(words).read_text().splitlines() if word.strip() and not word.startswith("#")}
    where = {}
    for file, page in pages_of(root).items():
        if "api" not in file.relative_to(root).parts:
            for word in page.words:
                where.setdefault(re.sub(r"'s$", "", word.strip("'")), file.relative_to(root))
    asked = subprocess.run(["hunspell", "-d", "en_US", "-l"], input="\n".join(where), check=True, capture_output=True, text=True)
    unknown = sorted({word for word in asked.stdout.split() if word not in known and word.lower() not in known})
    return [f"{where.get(word, '')}: {word}" for word in unknown], f"{len(where)} different words"


def main(what, root, *rest):
    wrong, count = {"links": check_links, "options": check_options, "words": check_words}[what](Path(root).resolve(), *rest)
    print("\n".join(wrong) if wrong else count)
    return bool(wrong) or count.startswith("0 ")


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
