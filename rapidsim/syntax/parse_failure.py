"""Position and state of a failed parse, and the patches that repair it.

A repair is a function from a `ParseFailure` to a `Patch` or None. It never changes the tokens; the
loop in `rapidsim.syntax.repair` does, and then parses again from the last statement before the
change. Inserted tokens have no width, so every offset in the tree remains valid.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace
from itertools import chain
from operator import attrgetter
from typing import TypeAlias

from rapidsim.diagnostics import Diagnostic, Fix, Related, Source, Span, Violation
from rapidsim.syntax.blocks import TOP, Nesting, OpenBlock, nesting
from rapidsim.syntax.lexer import Tokens
from rapidsim.syntax.recognizer import accepts, rejected
from rapidsim.values import value_class

LOOKAHEAD = 6
"""Number of tokens after a change that must parse before the change is accepted."""
# Fewer tokens than this are no evidence, so the window continues on the next line.
_SURE = 2
_LINE_END = re.compile(r"[\r\n]")
_BLANKS = re.compile(r"\s*")

Token: TypeAlias = tuple[str, int, int]
"""Kind, start and end."""


@value_class(frozen=True, eq=False, slots=True)
class TokenBuffer:
    """Tokens of a file during repair."""

    source: Source
    kinds: list[str]
    starts: list[int]
    ends: list[int]

    @classmethod
    def of(cls, tokens: Tokens, source: Source) -> TokenBuffer:
        """Copy tokens so that they can be changed without changing the original."""
        return cls(source, list(tokens.kinds), list(tokens.starts), list(tokens.ends))

    def text(self, index: int) -> str:
        """Text of a token."""
        return self.source.text[self.starts[index] : self.ends[index]]

    def token(self, index: int) -> Token:
        """Kind and offsets of a token."""
        return self.kinds[index], self.starts[index], self.ends[index]

    def span(self, first: int, stop: int) -> Span:
        """Span of one or more tokens."""
        return Span(self.source, self.starts[first], self.ends[max(first, stop - 1)])

    def place_before(self, index: int) -> int:
        """Offset just past the previous token."""
        return self.ends[index - 1] if index else 0

    def first_on_line(self, index: int) -> bool:
        """Whether a token is the first on its line."""
        before = self.place_before(index)
        return index == 0 or bool(_LINE_END.search(self.source.text, before, self.starts[index]))

    def line_stop(self, index: int) -> int:
        """Index after the last token on the line of a token."""
        index += 1
        while index < len(self.kinds) - 1 and not self.first_on_line(index):
            index += 1
        return min(index, len(self.kinds) - 1)

    def column(self, index: int) -> int:
        """Column of a token, from 1; a tab counts as one, on all lines alike."""
        return self.source.position(self.starts[index])[1]

    def indent(self, index: int) -> int:
        """Column of the first non-blank character on the line of a token."""
        start = self.starts[index]
        begin = start - self.column(index) + 1
        blanks = _BLANKS.match(self.source.text, begin, start)
        return (blanks.end() if blanks else begin) - begin + 1


@value_class(frozen=True, eq=False, slots=True)
class Patch:
    """Replacement of the tokens from `start` up to `stop` by `tokens`, with its diagnostic."""

    start: int
    stop: int
    tokens: tuple[Token, ...]
    diagnostic: Diagnostic

    def with_fix(self, fix: Fix | None) -> Patch:
        """Return the patch with a fix in its diagnostic."""
        return replace(self, diagnostic=replace(self.diagnostic, fix=fix))


@value_class(frozen=True, slots=True)
class Checkpoint:
    """State of a parse at the beginning of a statement, declaration or module."""

    index: int
    """Its first token."""
    stack: tuple[int, ...]
    """Parser states before it."""
    module: int
    """First token of the module that contains it."""
    nesting: Nesting = TOP
    """Blocks of that module that are open before it."""


_index = attrgetter("index")


@value_class(frozen=True, eq=False, slots=True)
class ParseFailure:
    """A parse that does not accept the token at `index`."""

    row: TokenBuffer
    index: int
    stack: tuple[int, ...]
    """Parser states before that token."""
    checkpoints: Sequence[Checkpoint]
    """States at the statements so far, the last of which contains the token."""

    @property
    def kind(self) -> str:
        """Kind of the token that is not accepted."""
        return self.row.kinds[self.index]

    @property
    def statement(self) -> int:
        """First token of the statement, declaration or head that contains it."""
        return self.checkpoints[-1].index

    @property
    def statement_stack(self) -> tuple[int, ...]:
        """Parser states before `statement`."""
        return self.checkpoints[-1].stack

    @property
    def module(self) -> int:
        """First token of the module that contains it."""
        return self.checkpoints[-1].module

    def checkpoint(self, index: int) -> Checkpoint:
        """State at the statement that contains an earlier token."""
        return self.checkpoints[bisect_right(self.checkpoints, index, key=_index) - 1]

    def blocks(self, index: int) -> tuple[OpenBlock, ...]:
        """Blocks of the module that are open before a token, outermost first."""
        before = self.checkpoint(index)
        return nesting(self.row.kinds, before.index, index, before.nesting).blocks

    def rejected_with(self, start: int, stop: int, kind: str) -> int | None:
        """Try another token in place of some earlier ones.

        Returns:
            None if the parse then accepts all tokens up to the failing one; else the number of
            tokens, from the statement with the change on, that it accepts.
        """
        before, kinds = self.checkpoint(start), self.row.kinds
        behind = map(kinds.__getitem__, range(stop, self.index + 1))
        return rejected(before.stack, chain(kinds[before.index : start], (kind,), behind))

    def window(self, start: int) -> list[str]:
        """Kinds of tokens that must parse before a change in front of them is accepted.

        They end with the statement or the line, because the next one may have a separate error.
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
        """Whether the parse accepts these tokens and then the ones from `after` on."""
        return accepts(self.stack, kinds + self.window(after))


def insertion(
    row: TokenBuffer, index: int, kind: str, violation: Violation, related: tuple[Related, ...] = ()
) -> Patch:
    """Insert a token before another one; its offset is the end of the previous token."""
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
