"""Lays out what mkdocs builds the site of: the repository's pages in their folders, with what they link to,
and pages made of the program's help, the Python package and the schemas. Use: stage.py SOURCE BUILD."""
import ast
import html
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

SITE = "examples/site"
# The menu: titles, and pages by their places in the repository; made/ is what this program writes.
MENU = [
    ("Start", ["README.md"]),
    ("Guides", [("For the pipeline TD", "examples/guides/td.md"), ("For the artist", "examples/guides/artist.md"),
                ("For the scripter", "examples/guides/scripter.md")]),
    ("From a renderer", ["examples/tutorial/*.md", "examples/blender/README.md", "examples/pbrt.md", "examples/farm/README.md"]),
    ("Reference", ["made/commands/*.md", ("JSON schemas", "made/schemas.md"), ("Python", "made/python.md"),
                   ("C", "made/c.md")]),
    ("Pictures", [("Gallery", f"{SITE}/gallery.md"), ("Scenes", "examples/scenes/README.md"),
                  ("The paper", "examples/paper/README.md"), ("Benchmarks", "tests/bench/README.md"),
                  ("Notes on speed", "tests/bench/NOTES.md")]),
    ("Questions", [f"{SITE}/questions.md"]),
    ("Carry it on", [f"{SITE}/carry_on.md", "*/README.md", "*/*/README.md", "*/*/*/README.md"]),
    ("Changelog", [f"{SITE}/changelog.md"]),
]
LINK = re.compile(r"(!?\[[^\]]*\]\()([^)\s]+)(\))")


def said(*arguments):
    return subprocess.run([os.environ["WEFT"], *arguments], check=True, capture_output=True, text=True).stdout


# ---- Pages that are made ----

def commands():
    return re.findall(r"^  weft (\w+) ", said("--help").split("\n\nA first")[0], re.M)


OPTION = re.compile(r"^  (-\w, |    )(--[\w-]+)(?: (.*?))?(?:  +(\S.*))?$")


def option_rows(lines):
    """Of a command's help: [heading] of each group, [names, what it takes, what it does] of options, and what is neither."""
    rows, rest = [], []
    for line, after in zip(lines, lines[1:] + [""]):
        found = OPTION.match(line)
        if found:
            short, name, takes, does = found.groups()
            rows.append([short.strip() + " " + name if short.strip() else name, takes or "", does or ""])
        elif rows and len(rows[-1]) == 3 and not rest and re.match(r"^ {20,}\S", line):
            rows[-1][2] += " " + line.strip()
        elif line.endswith(":") and OPTION.match(after):
            rows.append([line[:-1]])
        elif line or rest:
            rest.append(line)
    return rows, rest


def row_html(names, takes, does):
    name = names.split("--")[-1]
    takes = f"<code>{html.escape(takes)}</code>" if takes else ""
    return (f'<tr><td id="{name}"><code>{html.escape(names)}</code> {takes}</td>'
            f"<td>{html.escape(does.strip())}</td></tr>")


def command_page(command):
    lines = said(command, "--help").splitlines()
    options = [k for k, line in enumerate(lines) if OPTION.match(line)]
    groups = [k - 1 for k in options if re.match(r"\S.*:$", lines[k - 1])]
    first = (groups or options or [len(lines)])[0]
    rows, rest = option_rows(lines[first:])
    page = [f"# weft {command}", "", "<pre>" + html.escape("\n".join(lines[:first]).rstrip()) + "</pre>", ""]
    is_open = False
    for row in rows:
        if len(row) == 1:
            page += ["</table>", ""] * is_open + [f"## {row[0]}", ""]
            is_open = False
            continue
        page += [] if is_open else ['<table class="options">']
        is_open = True
        page.append(row_html(*row))
    page += ["</table>", ""] * is_open
    page += ["<pre>" + html.escape("\n".join(rest).rstrip()) + "</pre>"] if rest else []
    return "\n".join(page) + "\n"


def described(node, level, prefix=""):
    """A class or function with its arguments and its docstring, and the public methods of a class."""
    words = ast.get_docstring(node) or ""
    arguments = "" if isinstance(node, ast.ClassDef) else f"({ast.unparse(node.args)})"
    page = [f"{'#' * level} `{prefix}{node.name}`", "", f"<pre>{html.escape(prefix + node.name + arguments)}</pre>", "",
            "<pre>" + html.escape(words) + "</pre>" if words else "", ""]
    if isinstance(node, ast.ClassDef):
        for child in node.body:
            if isinstance(child, ast.FunctionDef) and not child.name.startswith("_") and ast.get_docstring(child):
                page += described(child, level + 1, node.name + ".")
    return page


def python_page(package):
    start = ast.parse((package / "__init__.py").read_text())
    public = next(ast.literal_eval(node.value) for node in start.body
                  if isinstance(node, ast.Assign) and node.targets[0].id == "__all__")
    found = {}
    for file in sorted(package.glob("*.py")):
        found |= {node.name: node for node in ast.parse(file.read_text()).body
                  if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    page = ["# The Python package", "", "<pre>" + html.escape(ast.get_docstring(start)) + "</pre>", ""]
    for name in sorted(public, key=str.lower):
        page += described(found[name], 2) if name in found else [f"## `{name}`", ""]
    return "\n".join(page) + "\n"


def schema_page(folder):
    page = ["# JSON schemas", "", "What weft writes as JSON is described by these, which an installation has in "
            "`share/weft/schema`. Keys stay from version to version; new ones join them.", ""]
    for file in sorted(folder.glob("*.json")):
        schema = json.loads(file.read_text())
        keys = ", ".join(f"`{key}`" for key in schema.get("properties", {}))
        page += [f"## {file.name}", "", f"{schema.get('title', '')}. [The schema](../convert/schema/{file.name})", ""]
        page += [f"Keys: {keys}.", ""] if keys else []
    return "\n".join(page)


def make_pages(source, pages):
    made = pages / "made"
    (made / "commands").mkdir(parents=True)
    for command in commands():
        (made / "commands" / f"{command}.md").write_text(command_page(command))
    (made / "python.md").write_text(python_page(source / "convert/python/weft"))
    (made / "schemas.md").write_text(schema_page(source / "convert/schema"))
    (made / "c.md").write_text("# The C library\n\n`weft.h` is its one header: "
                              '<a href="../api/weft_8h.html">what it declares</a>.\n')


# ---- Pages of the repository ----

def table_wide(text):
    """Tables in Markdown get a box of their own, which scrolls on a small screen."""
    return re.sub(r"((?:^\|.*\n)+)", lambda table: f'<div class="table-wide" markdown="1">\n\n{table[1]}\n</div>\n', text,
                  flags=re.M)


def folder_page(folder, source, pages):
    """A list of a folder's files, which come along."""
    listing = pages / folder.relative_to(source) / "files.md"
    listing.parent.mkdir(parents=True, exist_ok=True)
    names = sorted(file.name for file in folder.iterdir() if file.is_file())
    for name in names:
        shutil.copy(folder / name, listing.parent / name)
    listing.write_text(f"# {folder.relative_to(source)}\n\n" + "".join(f"- [{name}]({name})\n" for name in names))


def link_target(source, place, link, pages):
    """Where a link leads on the site: folders lead to their page; files that are no pages come along."""
    if re.match(r"^(\w+:|#|/)", link):
        return link
    path, _, anchor = link.partition("#")
    file = Path(os.path.normpath(source / place / ".." / path))
    if file.is_dir() and (file / "README.md").exists():
        return os.path.join(path, "README.md") + (f"#{anchor}" if anchor else "")
    if file.is_dir():
        folder_page(file, source, pages)
        return os.path.join(path, "files.md")
    if file.suffix != ".md" and file.is_file():
        copy = pages / file.relative_to(source)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file, copy)
    return link


def outside_code(text, change):
    """The text with `change` done to what is neither fenced nor indented as code."""
    parts = re.split(r"((?:^```[^\n]*\n(?:.*\n)*?^```$)|(?:^ {4}.*\n))", text, flags=re.M)
    return "".join(part if k % 2 else change(part) for k, part in enumerate(parts))


def stage(source, pages, place):
    is_made = place.startswith("made/")
    text = ((pages if is_made else source) / place).read_text()
    linked = outside_code(text, lambda part: table_wide(
        LINK.sub(lambda m: m[1] + link_target(source, place, m[2], pages) + m[3], part)))
    (pages / place).parent.mkdir(parents=True, exist_ok=True)
    (pages / place).write_text(linked)


def menu_places(source, pages):
    """The menu as mkdocs takes it, its patterns replaced by the pages that are in no place before."""
    taken, menu = set(), []
    named = {entry[1] if isinstance(entry, tuple) else entry for _, entries in MENU for entry in entries}
    for title, entries in MENU:
        section = []
        for entry in entries:
            name, pattern = entry if isinstance(entry, tuple) else (None, entry)
            root = pages if pattern.startswith("made/") else source
            places = sorted(str(file.relative_to(root)) for file in root.glob(pattern))
            for place in places:
                if place in taken or (place != pattern and place in named) or place.startswith(("build", "out")):
                    continue
                taken.add(place)
                section.append({name: place} if name else place)
        menu.append({title: section[0] if len(section) == 1 else section})
    return menu, sorted(taken)


def jquery_name():
    """Debian's mkdocs has another jQuery than its pages ask for."""
    told = subprocess.run(["mkdocs", "--version"], check=True, capture_output=True, text=True).stdout
    theme = Path(re.search(r"from (.*) \(Python", told)[1]) / "themes/readthedocs"
    return str(next(theme.glob("js/jquery*.js")).relative_to(theme))


def main(source, build):
    pages = build / "pages"
    pages.mkdir(parents=True)
    make_pages(source, pages)
    menu, places = menu_places(source, pages)
    for place in places:
        stage(source, pages, place)
    shutil.copy(source / SITE / "phone.css", pages)
    # JSON is YAML too.
    (build / "mkdocs.yml").write_text(json.dumps({
        "site_name": "weft", "docs_dir": str(pages), "use_directory_urls": False, "nav": menu, "plugins": [],
        "theme": {"name": "readthedocs", "custom_dir": str(source / SITE / "theme"), "jquery": jquery_name(),
                  "highlightjs": False, "navigation_depth": 3, "collapse_navigation": True},
        "markdown_extensions": ["md_in_html", "sane_lists"], "extra_css": ["phone.css"]}, indent=1))


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
