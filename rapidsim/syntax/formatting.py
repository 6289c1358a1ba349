"""Layout of a text: the indentation of its lines and the case of its reserved words.

The layout comes from tokens, not from the tree, so that comments, line breaks and alignment within
lines stay as they are written:

- The first line of a statement is indented by the number of blocks that it is in. ELSE, CASE,
  ERROR and their like stand at the level of the block that they divide.
- Another line of the same statement keeps its distance to the first, as does what is aligned in it.
- A comment on a line of its own is indented like the code below it. Above the end of a block it
  belongs to the block; above ELSE or CASE it may stand at either level, and stays there.
- Reserved words are in capitals, as the controller's editor writes them. White space at the end of
  lines goes. Everything else, line ends included, is kept.

A text with errors can be laid out as well: the end of a block closes what was left open inside.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from enum import StrEnum
from itertools import pairwise

from rapidsim.diagnostics import LINE_END
from rapidsim.syntax.lexer import Tokens, lex
from rapidsim.text_edits import TextEdit, edited_text
from rapidsim.values import value_class

DEFAULT_INDENT = 4
"""Spaces per level in a text that is not indented; RobotStudio's own."""
_TAB = 4
_LARGEST_INDENT = 8

_BLANKS = " \t"
_BEFORE_HEADER = " \t\r\n\x00\x1a\ufeff"
_TRUTH_VALUE = re.compile(r'"(?:[^"\r\n]|"")*"|\b(true|false)\b', re.IGNORECASE)

_END_OF = {
    "ENDMODULE": "MODULE",
    "ENDPROC": "PROC",
    "ENDFUNC": "FUNC",
    "ENDTRAP": "TRAP",
    "ENDRECORD": "RECORD",
    "ENDFOR": "FOR",
    "ENDWHILE": "WHILE",
    "ENDTEST": "TEST",
    "ENDIF": "IF",
}
_ROUTINES = ("PROC", "FUNC", "TRAP")
_DIVIDED_BY = {
    "ELSE": ("IF",),
    "ELSEIF": ("IF",),
    "CASE": ("TEST",),
    "CSE": ("TEST",),
    "DEFAULT": ("TEST",),
    "EIT": ("IF",),
    "ERROR": _ROUTINES,
    "UNDO": _ROUTINES,
    "BACKWARD": _ROUTINES,
}
"""Words that divide a block, with the blocks that they divide."""
_NAMES_IN_HEAD = {"MODULE": 1, "PROC": 1, "FUNC": 2, "TRAP": 1, "RECORD": 1, "ERROR": 0}
"""Number of names between a word and the parameters, which end a head without semicolon."""
_OPENING = frozenset({"MODULE", *_ROUTINES, "RECORD", "FOR", "WHILE", "TEST"})
_LAST_OF_STATEMENT = frozenset(
    {"SEMICOLON", "THEN", "DO", "COLON", "ELSE", "DEFAULT", "UNDO", "BACKWARD", *_END_OF}
    | {"TDN", "DDN", "RDN", "SMT", "CSE", "EIT"}
)
_FIRST_OF_STATEMENT = frozenset({*_END_OF, *_DIVIDED_BY} - {"ERROR"})
"""Words that begin a line of their own even if the statement above has no end."""
_NO_WORDS = frozenset({"NAME", "NUMBER", "STRING", "LITERALS"})


class WordCase(StrEnum):
    """Case of reserved words."""

    UPPER = "upper"
    KEEP = "keep"
    """Unchanged."""


@value_class(frozen=True, slots=True)
class Style:
    """Options of the layout."""

    indent: int | None = None
    """Spaces per level; None for what the text itself uses most."""
    words: WordCase = WordCase.UPPER


DEFAULT_STYLE = Style()


@value_class(frozen=True, slots=True)
class _Line:
    """One line of the text."""

    start: int
    end: int
    """Offset past its last character, before the line end."""
    column: int
    """Indentation as written, in spaces."""
    next_token: int
    """Index of the first token that begins in the line or below it."""
    has_tokens: bool
    """Whether that token is in the line."""


def format_text(text: str, style: Style = DEFAULT_STYLE) -> str:
    """Return a text in its layout; formatting the result again changes nothing."""
    return edited_text(text, formatting_edits(text, style))


def formatting_edits(text: str, style: Style = DEFAULT_STYLE) -> tuple[TextEdit, ...]:
    """Return the edits that lay a text out, in order; none changes a line end.

    A text with characters that RAPID does not have, or with a string that has no end, is left as
    it is.
    """
    tokens = lex(text)
    if tokens.unterminated or "UNKNOWN" in tokens.kinds:
        return ()
    lines = _lines(text, tokens)
    levels = _levels(tokens)
    indent = style.indent or _usual_indent(lines, levels)
    edits = list(_edits_of_blanks(text, lines, _columns(text, lines, tokens, levels, indent)))
    if style.words is WordCase.UPPER:
        edits += word_edits(text, tokens)
    return tuple(sorted(edits))


def word_edits(text: str, tokens: Tokens) -> Iterator[TextEdit]:
    """Yield the edits that write reserved words in capitals."""
    for kind, start, end in zip(tokens.kinds, tokens.starts, tokens.ends, strict=True):
        if kind == "LITERALS":
            for found in _TRUTH_VALUE.finditer(text, start, end):
                if found[1] and not found[1].isupper():
                    yield found.start(), found.end(), found[1].upper()
        elif kind not in _NO_WORDS and text[start : start + 1].isalpha():
            word = text[start:end]
            if not word.isupper():
                yield start, end, word.upper()


def _lines(text: str, tokens: Tokens) -> list[_Line]:
    ends = [(found.start(), found.end()) for found in LINE_END.finditer(text)]
    starts = [0, *(end for _, end in ends)]
    lines = []
    for start, end in zip(starts, [*(start for start, _ in ends), len(text)], strict=True):
        body = text[start:end]
        stripped = body.lstrip(_BLANKS)
        blanks = body[: len(body) - len(stripped)].expandtabs(_TAB)
        token = bisect_left(tokens.starts, start)
        has_tokens = token < len(tokens.kinds) - 1 and tokens.starts[token] < end
        lines.append(_Line(start, end, len(blanks), token, has_tokens))
    return lines


def _levels(tokens: Tokens) -> dict[int, int]:
    """Level of indentation by the index of each token that begins a statement or divides a block.

    Other tokens continue a statement.
    """
    levels: dict[int, int] = {}
    blocks: list[str] = []
    begins, condition_of = True, ""
    head: _Head | None = None
    for k, kind in enumerate(tokens.kinds):
        if head is not None and head.ends_before(kind):
            head, begins = None, True
        begins = begins or kind in _FIRST_OF_STATEMENT
        if begins:
            if kind in _END_OF:
                _close(blocks, (_END_OF[kind],))
                levels[k] = max(len(blocks) - 1, 0)
            elif kind in _DIVIDED_BY:
                _close(blocks, _DIVIDED_BY[kind])
                levels[k] = max(len(blocks) - 1, 0)
            else:
                levels[k] = len(blocks)
        if kind in _END_OF:
            if blocks and blocks[-1] == _END_OF[kind]:
                blocks.pop()
        elif kind in _OPENING:
            blocks.append(kind)
        elif kind in ("IF", "ELSEIF"):
            condition_of = kind
        elif kind == "THEN" and condition_of == "IF":
            blocks.append("IF")
        if kind in _NAMES_IN_HEAD and (kind != "ERROR" or begins):
            head = _Head(_NAMES_IN_HEAD[kind])
        begins = kind in _LAST_OF_STATEMENT
    return levels


class _Head:
    """Rest of a head after PROC, MODULE and their like: names, then parameters in parentheses."""

    def __init__(self, names: int) -> None:
        self._names = names
        self._depth = 0
        self._is_past_word = False
        self._is_over = False

    def ends_before(self, kind: str) -> bool:
        """Whether the head is complete before a token, which is then the first that follows."""
        if self._is_over:
            return True
        if self._depth:
            self._depth += (kind == "LPAR") - (kind == "RPAR")
            self._is_over = not self._depth
        elif self._names and kind in ("NAME", "RDN"):
            self._names -= 1
        elif kind == "LPAR" and not self._names:
            self._depth = 1
        else:
            return True
        return False


def _close(blocks: list[str], wanted: Sequence[str]) -> None:
    """Close the blocks inside the innermost one of some kinds; none if there is none."""
    for k in range(len(blocks) - 1, -1, -1):
        if blocks[k] in wanted:
            del blocks[k + 1 :]
            return
        if blocks[k] in _ROUTINES and wanted != ("MODULE",):
            return


def _columns(
    text: str, lines: Sequence[_Line], tokens: Tokens, levels: dict[int, int], indent: int
) -> Iterator[int]:
    """Yield the indentation of each line in the layout, in spaces; it is 0 for empty lines."""
    columns = [line.column for line in lines]
    comments: list[int] = []
    """Lines with a comment alone, since the last statement."""
    shift = 0
    header_end = _header_end(text, tokens)
    for k, line in enumerate(lines):
        level = levels.get(line.next_token)
        if line.start < header_end:
            continue
        if level is None and line.next_token < len(tokens.kinds) - 1:
            columns[k] = max(line.column + shift, 0)
        elif not line.has_tokens:
            comments.append(k)
        elif level is not None:
            columns[k] = indent * level
            shift = columns[k] - line.column
            kind = tokens.kinds[line.next_token]
            for comment in comments:
                is_inside = kind in _END_OF or (
                    kind in _DIVIDED_BY and lines[comment].column > line.column
                )
                columns[comment] = indent * (level + is_inside)
            comments.clear()
    for comment in comments:
        columns[comment] = 0
    yield from columns


def _header_end(text: str, tokens: Tokens) -> int:
    """Offset before which the lines belong to a header such as `%%% VERSION:1 %%%`."""
    begins = min([tokens.starts[0], *(comment.start for comment in tokens.comments[:1])])
    return begins if text[:begins].strip(_BEFORE_HEADER) else 0


def _edits_of_blanks(
    text: str, lines: Sequence[_Line], columns: Iterable[int]
) -> Iterator[TextEdit]:
    for line, column in zip(lines, columns, strict=True):
        body = text[line.start : line.end]
        stripped = body.strip(_BLANKS)
        if not stripped:
            # Without the blanks between them, two line ends CR and LF would be one.
            if body and text[line.start - 1 : line.start] != "\r":
                yield line.start, line.end, ""
            continue
        lead = len(body) - len(body.lstrip(_BLANKS))
        if body[:lead] != " " * column:
            yield line.start, line.start + lead, " " * column
        end = line.start + len(body.rstrip(_BLANKS))
        if end < line.end:
            yield end, line.end, ""


def _usual_indent(lines: Sequence[_Line], levels: dict[int, int]) -> int:
    """Spaces per level that a text uses most, where a line is one level below the one before."""
    firsts = [
        (levels[line.next_token], line.column)
        for line in lines
        if line.has_tokens and line.next_token in levels
    ]
    steps = Counter(
        column - column_before
        for (level_before, column_before), (level, column) in pairwise(firsts)
        if level == level_before + 1 and 1 < column - column_before <= _LARGEST_INDENT
    )
    return min(steps, key=lambda step: (-steps[step], step), default=DEFAULT_INDENT)
