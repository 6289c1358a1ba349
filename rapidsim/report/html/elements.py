"""Small elements of HTML; text of programs is escaped here."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from html import escape

from rapidsim.report.findings.source_frame import printable

_CODE = re.compile(r"`([^`\n]*)`")


def text(words: object) -> str:
    """Text that a program may have written: no markup, nothing that steers a terminal or page."""
    return escape(printable(str(words)))


def prose(words: object) -> str:
    """Escaped text, with words in backticks set as code."""
    return _CODE.sub(r"<code>\1</code>", text(words))


def tile(label: str, value: str, remark: str = "") -> str:
    """A figure with its name, and a small `remark` below it."""
    below = f'<span class="remark">{text(remark)}</span>' if remark else ""
    name = f'<span class="label">{text(label)}</span>'
    return f'<div class="tile">{name}<b>{text(value)}</b>{below}</div>'


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], *, kind: str) -> str:
    """A table of cells that are HTML already.

    Args:
        heads: Column heads; one that starts with `>` is a column of numbers.
        rows: Cells.
        kind: Its class, for the style.
    """
    numeric = [head.startswith(">") for head in heads]
    head = "".join(
        f'<th class="number">{text(name[1:])}</th>' if number else f"<th>{text(name)}</th>"
        for name, number in zip(heads, numeric, strict=True)
    )
    body = "".join(
        "<tr>"
        + "".join(
            f'<td class="number" data-name="{text(name[1:])}">{cell}</td>'
            if number
            else f"<td>{cell}</td>"
            for cell, name, number in zip(row, heads, numeric, strict=True)
        )
        + "</tr>\n"
        for row in rows
    )
    return (
        f'<div class="wide"><table class="{kind}"><thead><tr>{head}</tr></thead>'
        f"<tbody>\n{body}</tbody></table></div>"
    )


def bar(share: float, *, waits: bool = False) -> str:
    """A bar for a share, 0 to 1, of the longest; of moves, or of waits."""
    percent = f"{100.0 * min(max(share, 0.0), 1.0):.2f}"
    kind = "bar wait" if waits else "bar"
    return f'<span class="{kind}"><i style="width:{percent}%"></i></span>'


def section(name: str, title: str, body: str, remark: str = "") -> str:
    """A section of the page with a link in the contents; empty if it has no content."""
    if not body:
        return ""
    small = f"<small>{text(remark)}</small>" if remark else ""
    return f'<section id="{name}"><h2>{text(title)}{small}</h2>\n{body}\n</section>\n'
