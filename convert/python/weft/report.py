"""Reports as dicts and lists that notebooks show as tables."""
from __future__ import annotations

import html
from typing import Any


def _table(value: Any) -> str:
    if isinstance(value, dict):
        rows = "".join(f"<tr><th style='text-align:left;vertical-align:top'>{html.escape(str(key))}</th>"
                       f"<td style='text-align:left'>{_table(one)}</td></tr>"
                       for key, one in value.items())
        return f"<table>{rows}</table>"
    if isinstance(value, list) and any(isinstance(one, (dict, list)) for one in value):
        return "".join(_table(one) for one in value)
    if isinstance(value, list):
        return html.escape(", ".join(_word(one) for one in value[:64])
                           + (", .." if len(value) > 64 else ""))
    return html.escape(_word(value))


def _word(value: Any) -> str:
    if value is None:
        return "–"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


class Report(dict):
    """What a command tells with --json or --report: a dict, which a notebook shows as a table."""

    def _repr_html_(self) -> str:
        return _table(self)


class Reports(list):
    """The reports of several files."""

    def _repr_html_(self) -> str:
        return _table(list(self))


def wrap(value: Any) -> Any:
    """A report as one of these classes."""
    if isinstance(value, dict):
        return Report(value)
    return Reports(Report(one) for one in value) if isinstance(value, list) else value
