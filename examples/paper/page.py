"""The page: sections, figures, the table, and one file of HTML."""
import html
import os
import re

from claims import WORDS, told, verdict
from pictures import uri

HERE = os.path.dirname(os.path.abspath(__file__))


PLAYER = os.path.join(HERE, "..", "..", "convert", "page")  # installed, its files lie here


def asset(name):
    path = os.path.join(HERE, name)
    with open(path if os.path.exists(path) else os.path.join(PLAYER, name), encoding="utf-8") as file:
        return file.read()


def plain(text):
    """Text without tags and entities, for those who hear it."""
    return html.unescape(re.sub(r"<[^>]*>", "", text))


def picture(data, alt, kind="", note=None, shape=None):
    """An image of the page. `shape` is its width over its height, where pixels are not square."""
    style = f' style="aspect-ratio:{shape:.4f}"' if shape else ""
    image = f'<img class="{kind}" src="{uri(data)}" alt="{html.escape(plain(alt), quote=True)}"{style}>'
    return f'<div class="picture">{image}' + (f"<p>{note}</p>" if note else "") + "</div>"


def exact(data, alt, note=None):
    """An image whose pixels are the screen's, or whole numbers of them: fine rings that a browser scales
    would show its own aliases."""
    return picture(data, alt, "exact", note).replace('"picture"', '"picture whole"', 1)


def side_by_side(*items, columns=None):
    return f'<div class="row n{columns or len(items)}">{"".join(items)}</div>'


def figure(name, body, caption):
    return f'<figure id="{name}">{body}<figcaption>{caption}</figcaption></figure>'


def table(head, rows):
    cells = "".join(f"<th scope=col>{cell}</th>" for cell in head)
    body = "".join("<tr>" + f"<th scope=row>{row[0]}</th>" + "".join(
        f"<td>{cell}</td>" for cell in row[1:]) + "</tr>" for row in rows)
    return (f'<div class="scroll"><table><thead><tr>{cells}</tr></thead><tbody>{body}</tbody>'
            "</table></div>")


class Report:
    """What the experiments hand in: sections of prose and figures, and rows of the table."""

    def __init__(self):
        self.sections, self.rows = [], []

    def section(self, name, title, *parts):
        """Parts that do not start with a tag are paragraphs."""
        body = "".join(part if part.startswith("<") else f"<p>{part}</p>" for part in parts)
        self.sections.append((name, title, body))

    def row(self, where, claim, measured, needs, why=""):
        """`needs` are the thresholds on measured figures; none where it is a matter of taste or cannot
        be told."""
        self.rows.append((where, claim, measured, needs, why))

    def verdicts(self):
        out = []
        for where, claim, measured, needs, why in self.rows:
            word = WORDS[verdict(needs)]
            why = f'<span class="why">{why}</span>' if why else ""
            out.append(f'<tr><td class="where">{where}</td><td>{claim}</td>'
                       f'<td class="measured">{measured}</td>'
                       f'<td class="verdict {word}"><b>{word}</b>{why}{told(needs)}</td></tr>')
        return ('<div class="scroll"><table class="claims"><thead><tr><th scope=col>Where</th>'
                "<th scope=col>The paper says</th><th scope=col>Measured here</th>"
                f'<th scope=col>Verdict</th></tr></thead><tbody>{"".join(out)}</tbody></table></div>')

    def contents(self):
        first = [("player-section", "See for yourself", "")]
        return "".join(f'<li><a href="#{name}">{title}</a></li>' for name, title, _ in
                       first + self.sections)

    def html(self, opening, player, closing, data):
        sections = "".join(f'<section id="{name}" aria-labelledby="{name}-title">'
                           f'<h2 id="{name}-title">{title}</h2>{body}</section>'
                           for name, title, body in self.sections)
        sections = re.sub(r"(?<=\d) (?=(%|Hz|ms|dB|px)\b|%)", "\N{NO-BREAK SPACE}", sections)
        return asset("page.html").format(style=asset("page.css") + asset("player.css"), opening=opening,
                                         contents=self.contents(), player=player,
                                         sections=sections, closing=closing, data=data,
                                         pixels=asset("pixels.js"), script=asset("player.js"))
