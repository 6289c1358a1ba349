"""Draw a span of source text with line numbers, and carets under the relevant part.

Columns count what a terminal shows: tabs reach the next multiple of four, wide characters take two
cells, combining ones none. Long lines are cut around the place.
"""

from __future__ import annotations

import re
import unicodedata

from rapidsim.diagnostics import Span
from rapidsim.report.palette import Palette
from rapidsim.values import value_class

_TAB = 4
_CUT = "..."
_LEAST_WIDTH = 20
_REPLACEMENT = "\N{REPLACEMENT CHARACTER}"
_SUSPECT = re.compile(r"[^\n\t -~]")
"""Characters that may control a terminal; checked one by one, which is slow."""


@value_class(frozen=True, slots=True)
class ShownLine:
    """A source line as a terminal shows it."""

    text: str
    caret_start: int
    """Cell of the first caret, from 0."""
    caret_end: int
    """Cell after the last caret; at least one after the first."""


def source_frame(
    span: Span, label: str, palette: Palette, *, colour: str, width: int, gutter: int = 0
) -> list[str]:
    """Lines of the frame: number, text, carets with a label.

    Args:
        span: What to point at; of several lines the first is shown.
        label: Text behind the carets, or below them where there is no room; may be empty.
        palette: Colours.
        colour: The colour of carets and label.
        width: Cells a line may take.
        gutter: Cells of the line number, if it shares them with longer ones.

    Returns:
        Three lines, the first an empty gutter, and perhaps one for the label.
    """
    gutter = max(gutter, len(str(span.line)))
    number = f"{span.line:{gutter}}"
    rule = palette.paint("|", palette.frame)
    margin = f"{' ' * gutter} {rule}"
    room = width - gutter - 3
    shown = shown_line(span, room)
    lines = ["^" * (shown.caret_end - shown.caret_start)]
    if shown.caret_end + 1 + len(label) <= room:
        lines = [f"{lines[0]} {label}".rstrip()]
    elif label:
        lines.append(label)
    starts = (shown.caret_start, max(0, min(shown.caret_start, room - len(label))))
    return [
        margin,
        f"{palette.paint(number, palette.frame)} {rule} {shown.text}".rstrip(),
        *(
            f"{margin} {' ' * start}{palette.paint(line, colour)}"
            for start, line in zip(starts, lines, strict=False)
        ),
    ]


def printable(text: str) -> str:
    """Text of a program on one line and without anything that steers a terminal."""
    return "".join(_REPLACEMENT if _steers(character) else character for character in text)


def printable_lines(text: str) -> str:
    """Text of several lines without anything else that steers a terminal."""
    return _SUSPECT.sub(lambda found: printable(found[0]), text)


def shown_line(span: Span, width: int) -> ShownLine:
    """The line of a span as cells, at most `width` of them, with the place of the carets."""
    line = span.source.line(span.line)
    first = span.column - 1
    last = span.end_column - 1 if span.end_line == span.line else len(line)
    cells, starts = _cells(line)
    start = starts[min(first, len(line))]
    end = max(starts[min(last, len(line))], start + 1)
    width = max(width, _LEAST_WIDTH)
    if len(cells) <= width:
        return ShownLine("".join(cells), start, end)
    # Keep the place in view with a third of the width before it, where it starts late.
    left = max(0, min(start - width // 3, len(cells) - width))
    right = left + width
    cut = cells[left:right]
    if left > 0:
        cut[: len(_CUT)] = list(_CUT)
    if right < len(cells):
        cut[-len(_CUT) :] = list(_CUT)
    start -= left
    return ShownLine("".join(cut), start, max(start + 1, min(end - left, width)))


def _steers(character: str) -> bool:
    """Whether a character could move the cursor, change colours or reverse the text."""
    return not character.isprintable() and unicodedata.category(character) != "Zs"


def _cells(line: str) -> tuple[list[str], list[int]]:
    """One entry a cell, and the cell each character starts in (one more for the end).

    The second cell of a wide character is empty; a combining character joins the cell before it.
    """
    cells: list[str] = []
    starts: list[int] = []
    for character in line:
        starts.append(len(cells))
        if character == "\t":
            cells += [" "] * (_TAB - len(cells) % _TAB)
        elif unicodedata.combining(character):
            if cells:
                cells[-1] += character
        elif _steers(character):
            cells.append(_REPLACEMENT)
        elif unicodedata.east_asian_width(character) in ("W", "F"):
            cells += [character, ""]
        else:
            cells.append(character)
    starts.append(len(cells))
    return cells, starts
