"""Cards: small HTML pictures of results for notebooks, which show what `_repr_html_` returns.

A card has a title, a few figures, a table of at most ten rows, and a drawing if there is one. All
texts are escaped; colours are those of the notebook, light or dark.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

_MOST_ROWS = 10
_LONGEST = 100
"""Letters of a text in a card."""
_LEFT = "text-align:left;vertical-align:top"


def card(
    title: str,
    figures: Mapping[str, str],
    *,
    heads: Sequence[str] = (),
    rows: Sequence[Sequence[str]] = (),
    drawing: str = "",
) -> str:
    """Return a card.

    Args:
        title: Its first line.
        figures: Values by name.
        heads: Heads of the table.
        rows: Rows of the table; those after the tenth are counted only.
        drawing: An SVG element.
    """
    parts = [f"<p><b>{_text(title)}</b></p>", drawing]
    if figures:
        parts.append(_table((), [(name, value) for name, value in figures.items()]))
    if rows:
        parts.append(_table(heads, rows[:_MOST_ROWS]))
    if len(rows) > _MOST_ROWS:
        parts.append(f"<p>and {len(rows) - _MOST_ROWS} more</p>")
    return f"<div>{''.join(parts)}</div>"


def line_drawing(points: Sequence[tuple[float, float]], label: str, *, size: int = 240) -> str:
    """Return an SVG element with a line through points, y upwards, in equal scales.

    Args:
        points: Coordinates in any unit; fewer than two give no drawing.
        label: Its description, shown on hovering.
        size: Largest width and height in pixels.
    """
    if len(points) < 2:
        return ""
    across, up = [point[0] for point in points], [point[1] for point in points]
    scale = (size - 8.0) / (max(max(across) - min(across), max(up) - min(up)) or 1.0)
    placed = (
        f"{4 + scale * (x - min(across)):.1f},{4 + scale * (max(up) - y):.1f}" for x, y in points
    )
    width = 8 + scale * (max(across) - min(across))
    height = 8 + scale * (max(up) - min(up))
    return (
        f'<svg width="{width:.0f}" height="{height:.0f}" role="img"><title>{_text(label)}</title>'
        f'<polyline points="{" ".join(placed)}" fill="none" stroke="currentColor"/></svg>'
    )


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    head = "".join(f'<th style="{_LEFT}">{_text(name)}</th>' for name in heads)
    body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    return f"<table>{f'<tr>{head}</tr>' if heads else ''}{body}</table>"


def _cell(value: str) -> str:
    return f'<td style="{_LEFT}">{_text(value)}</td>'


def _text(value: str) -> str:
    shown = value if len(value) <= _LONGEST else f"{value[: _LONGEST - 3]}..."
    return escape(shown)
