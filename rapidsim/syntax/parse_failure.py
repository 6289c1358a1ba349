"""Where a parse is stuck, and how a repair changes the tokens.

A repair is a function from a `ParseFailure` to a `Patch` or None. It never touches the tokens
itself;
the loop in `rapidsim.syntax.repair` does, and then parses again from the last statement before the
change. Tokens that are put in have no width, so every place in the tree stays true.
"""

from __future__ import annotations

import re
from typing import TypeAlias

from rapidsim.diagnostics import Diagnostic, Fix, Related, Source, Span, Violation
from rapidsim.syntax.lexer import Tokens
from rapidsim.syntax.recognizer import accepts
from rapidsim.values import value_class

LOOKAHEAD = 6
"""How many tokens after a change must parse for the change to be believed."""
# Fewer tokens than this prove nothing, so they are taken from the next line.
_SURE = 2
_LINE_END = re.compile(r"[\r\n]")
_BLANKS = re.compile(r"\s*")

Token: TypeAlias = tuple[str, int, int]
"""Kind, start and end."""


@value_class(frozen=True, eq=False, slots=True)
class TokenBuffer:
    """The tokens of a file while they are being repaired."""

    source: Source
    kinds: list[str]
    starts: list[int]
    ends: list[int]

    @classmethod
    def of(cls, tokens: Tokens, source: Source) -> TokenBuffer:
        """A row that may be changed without changing the tokens."""
        return cls(source, list(tokens.kinds), list(tokens.starts), list(tokens.ends))

    def text(self, index: int) -> str:
        """A token as written."""
        return self.source.text[self.starts[index] : self.ends[index]]

    def token(self, index: int) -> Token:
        """Kind and place of a token."""
        return self.kinds[index], self.starts[index], self.ends[index]

    def span(self, first: int, stop: int) -> Span:
        """The place of some tokens, at least one."""
        return Span(self.source, self.starts[first], self.ends[max(first, stop - 1)])

    def place_before(self, index: int) -> int:
        """The offset just past the token before."""
        return self.ends[index - 1] if index else 0

    def first_on_line(self, index: int) -> bool:
        """Whether no other token stands before this one on its line."""
        before = self.place_before(index)
        return index == 0 or bool(_LINE_END.search(self.source.text, before, self.starts[index]))

    def line_stop(self, index: int) -> int:
        """One past the last token on the line of a token."""
        index += 1
        while index < len(self.kinds) - 1 and not self.first_on_line(index):
            index += 1
        return min(index, len(self.kinds) - 1)

    def column(self, index: int) -> int:
        """Column of a token, from 1; a tab counts as one, as it does for every line alike."""
        return self.source.position(self.starts[index])[1]

    def indent(self, index: int) -> int:
        """Column of the first character on the line of a token that is not blank."""
        start = self.starts[index]
        begin = start - self.column(index) + 1
        blanks = _BLANKS.match(self.source.text, begin, start)
        return (blanks.end() if blanks else begin) - begin + 1


@value_class(frozen=True, eq=False, slots=True)
class Patch:
    """Put `tokens` in the place of those from `start` up to `stop`, and say why."""

    start: int
    stop: int
    tokens: tuple[Token, ...]
    diagnostic: Diagnostic


@value_class(frozen=True, eq=False, slots=True)
class ParseFailure:
    """A parse that cannot take the token at `index`."""

    row: TokenBuffer
    index: int
    stack: tuple[int, ...]
    """States before that token."""
    statement: int
    """The first token of the statement, declaration or head that it belongs to."""
    statement_stack: tuple[int, ...]
    """States before `statement`."""
    module: int
    """The first token of the module that it belongs to."""

    @property
    def kind(self) -> str:
        """The kind of the token that does not fit."""
        return self.row.kinds[self.index]

    def window(self, start: int) -> list[str]:
        """The kinds that must parse for a change before them to be believed.

        They end with the statement or the line, because the next may have an error of its own.
        """
        row = self.row
        kinds = row.kinds[start : start + LOOKAHEAD]
        for count, kind in enumerate(kinds):
            if kind == "SEMICOLON":
                return kinds[: count + 1]
            if count >= _SURE and row.first_on_line(start + count):
                return kinds[:count]
        return kinds

    def accepts_after(self, kinds: list[str], after: int) -> bool:
        """Whether the parse takes these tokens and then the ones from `after` on."""
        return accepts(self.stack, kinds + self.window(after))


def insertion(
    row: TokenBuffer, index: int, kind: str, violation: Violation, related: tuple[Related, ...] = ()
) -> Patch:
    """Insert a token before another one; its place is the end of the token before."""
    place = row.place_before(index)
    span = Span(row.source, place, place)
    return Patch(index, index, ((kind, place, place),), Diagnostic(violation, span, related))


def replacement(
    row: TokenBuffer, start: int, stop: int, kind: str, violation: Violation, fix: Fix | None = None
) -> Patch:
    """Replace some tokens by one."""
    span = row.span(start, stop)
    token = (kind, span.start, span.end)
    return Patch(start, stop, (token,), Diagnostic(violation, span, fix=fix))


def deletion(row: TokenBuffer, start: int, stop: int, violation: Violation) -> Patch:
    """Remove some tokens."""
    return Patch(start, stop, (), Diagnostic(violation, row.span(start, stop)))
