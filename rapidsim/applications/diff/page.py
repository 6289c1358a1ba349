"""A comparison as one HTML file: the changes, with both paths overlaid."""

from __future__ import annotations

import re
from collections.abc import Sequence
from html import escape

from rapidsim.applications.diff.changes import Comparison, TimeChange
from rapidsim.applications.diff.path_views import path_views
from rapidsim.applications.diff.rendering import ReportBlock, blocks, time_cells
from rapidsim.colours import style_variables

_STYLE = """
body { margin: 0 auto; max-width: 1000px; padding: 16px; background: var(--page);
  color: var(--ink); font: 15px/1.5 system-ui, sans-serif }
h1 { font-size: 20px; overflow-wrap: anywhere } h2 { font-size: 16px }
section { background: var(--panel); border: 1px solid var(--rule); border-radius: 10px;
  padding: 4px 16px 12px; margin-bottom: 14px }
code { background: var(--page); border-radius: 4px; padding: 1px 4px; font-size: 13px }
li, td:first-child { overflow-wrap: anywhere } ul { padding-left: 20px }
table { border-collapse: collapse } td, th { padding: 2px 0 2px 16px; text-align: right;
  font-variant-numeric: tabular-nums } td:not(:first-child) { white-space: nowrap }
th { color: var(--soft); font-weight: normal } td:first-child { padding-left: 0; text-align: left }
.views { display: flex; flex-wrap: wrap; gap: 16px }
figure { margin: 0; flex: 1 1 300px } svg { width: 100%; height: auto } figcaption, .key {
  color: var(--soft); font-size: 13px }
svg line { stroke: var(--rule); stroke-width: 1 } svg text { fill: var(--soft); font-size: 12px }
polyline { fill: none; stroke-width: 1.6; vector-effect: non-scaling-stroke }
/* Wide, so that it is seen where both go the same way. */
.old { stroke: var(--programmed); color: var(--programmed) }
polyline.old { stroke-width: 5; opacity: 0.55 }
.new { stroke: var(--tcp); color: var(--tcp) }
"""


def comparison_page(comparison: Comparison) -> str:
    """Return the page as text; it works offline."""
    old, new = map(escape, comparison.names)
    parts = map(_section, blocks(comparison))
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{old} and {new}</title><style>{style_variables()}{_STYLE}</style></head><body>"
        f"<h1>{old} &rarr; {new}</h1>{''.join(parts)}{_paths(comparison)}</body></html>\n"
    )


def _section(block: ReportBlock) -> str:
    if not block.lines and not block.times:
        return f"<section><p>{escape(block.title)}</p></section>"
    items = "".join(f"<li>{_marked(line)}</li>" for line in block.lines)
    return (
        f"<section><h2>{block.title}</h2>{_table(block.times)}"
        f"{f'<ul>{items}</ul>' if items else ''}</section>"
    )


def _marked(line: str) -> str:
    """Return a line as HTML, with code between backticks."""
    return re.sub(r"`([^`]*)`", r"<code>\1</code>", escape(line))


def _table(times: Sequence[TimeChange]) -> str:
    if not times:
        return ""
    rows = "".join(
        f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in time_cells(one))}</tr>"
        for one in times
    )
    head = "<tr><th></th><th>before</th><th>after</th><th>change</th></tr>"
    return f"<table>{head}{rows}</table>"


def _paths(comparison: Comparison) -> str:
    """Return views of the TCP paths."""
    views = path_views(*comparison.paths)
    if not views:
        return ""
    key = '<p class="key"><b class="old">before</b>, <b class="new">after</b></p>'
    return f"<section><h2>Path of the TCP</h2>{views}{key}</section>"
