"""Execution of bulk moves, one row after the other.

Bulk moves are one loop in generated code. Each row's values are created when it is executed, so a
million moves take no memory in advance.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from heapq import merge
from itertools import repeat
from typing import TYPE_CHECKING, Any, ClassVar

from rapidsim.diagnostics import Source, Span
from rapidsim.language.controller import Motion
from rapidsim.language.data import ConfData, ExtJoint, Orient, Pos, RobTarget
from rapidsim.language.moves import AnnouncedRow, Place
from rapidsim.syntax import tree
from rapidsim.syntax.tree.bulk_statements import EXTAX, ROBCONF, ROT, TRANS
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.syntax.tree.bulk_statements import Numbers, Offsets

ROW = "_row"
"""Variable of generated code with the current row; None outside bulk moves."""
_AT_ONCE = 1000
"""Number of rows that are converted to objects together."""
_PARTS: tuple[tuple[slice, Any], ...] = (
    (TRANS, Pos),
    (ROT, Orient),
    (ROBCONF, ConfData),
    (EXTAX, ExtJoint),
)


def targets_of(numbers: Numbers) -> Iterator[RobTarget]:
    """Targets from columns (targets, 17)."""
    for first in range(0, len(numbers), _AT_ONCE):
        block = numbers[first : first + _AT_ONCE]
        columns = (_part(block[:, part], kind) for part, kind in _PARTS)
        yield from map(RobTarget._make, zip(*columns, strict=False))


def _part(numbers: Numbers, kind: Any) -> Iterable[Any]:
    """One part of each target; a single object if all are equal, as with external axes."""
    # Compared by bits, because 0 and -0 are equal but not identical.
    bits = numbers.view("i4")
    if (bits == bits[0]).all():
        return repeat(kind(*numbers[0].tolist()), len(numbers))
    return map(kind._make, numbers.tolist())


class _Texts(Mapping[str, str]):
    """Texts of the arguments of a row: the statement's that it repeats, with its own target."""

    __slots__ = ("_end", "_of_like", "_source", "_start", "_target")

    def __init__(self, of_like: Mapping[str, str], target: str, source: Source, at: tree.Node):
        """Take all texts from the statement except the target, which has its own position."""
        self._of_like, self._target = of_like, target
        self._source, self._start, self._end = source, at.start, at.end

    def __getitem__(self, name: str) -> str:
        return (
            self._source.text[self._start : self._end]
            if name == self._target
            else self._of_like[name]
        )

    def __iter__(self) -> Iterator[str]:
        return iter(self._of_like)

    def __len__(self) -> int:
        return len(self._of_like)


@value_class(frozen=True, slots=True, eq=False)
class BulkMove:
    """One move of bulk moves."""

    written: tree.BulkRow
    place: Place
    target: RobTarget
    call: ClassVar[None] = None
    """Not a call between moves."""


@value_class(frozen=True, slots=True, eq=False)
class CallBetween:
    """One repetition of a call between bulk moves."""

    written: tree.BulkRow
    place: Place
    call: int
    """Which of the calls between them it repeats."""


@value_class(frozen=True, slots=True, eq=False)
class BulkExecution:
    """Bulk moves, iterated over at each execution."""

    run: tree.BulkStatements
    like: Place
    """Position of the statement in the tree."""
    parameter: str
    """Folded name of the parameter that takes the target."""
    calls: tuple[Place, ...]
    """Positions of the calls in the tree that are repeated between moves."""

    def rows(self, motion: Motion) -> Iterator[BulkMove | CallBetween]:
        """Yield the moves in order, and the calls between them; their targets are announced."""
        calls, count = self._calls(), len(self.run)
        moves_before, call = next(calls, (count, None))
        for first in range(0, count, _AT_ONCE):
            stop = min(first + _AT_ONCE, count)
            targets = BulkTargets(self, slice(first, stop))
            motion.expect(targets)
            done = first
            while call is not None and moves_before < stop:
                yield from targets.moves(motion, done - first, moves_before - first)
                yield call
                done = moves_before
                moves_before, call = next(calls, (count, None))
            yield from targets.moves(motion, done - first, stop - first)

    def _calls(self) -> Iterator[tuple[int, CallBetween]]:
        """Yield the calls between moves in order, each with the number of moves before it."""
        rows = (
            zip(one.moves_before.tolist(), one.rows(), repeat(number), strict=False)
            for number, one in enumerate(self.run.between)
        )
        for before, row, number in merge(*rows, key=lambda one: one[1].start):
            like = self.calls[number]
            span = Span(like.span.source, row.start, row.end)
            yield before, CallBetween(row, Place(span, like.routine, like.arguments), number)


class BulkTargets:
    """The targets of some of the rows, created again when they are needed after their moves."""

    __slots__ = ("_created", "_of", "_rows")

    def __init__(self, of: BulkExecution, rows: slice) -> None:
        """Create the targets of a slice of rows."""
        self._of, self._rows = of, rows
        self._created: tuple[RobTarget, ...] | None = tuple(targets_of(of.run.numbers[rows]))

    def __len__(self) -> int:
        """Number of targets."""
        return len(self._of.run.numbers[self._rows])

    def __getitem__(self, number: int) -> RobTarget:
        """Return a target."""
        if self._created is not None:
            return self._created[number]
        values = self._of.run.numbers[self._rows.start + number].tolist()
        return RobTarget._make(kind._make(values[part]) for part, kind in _PARTS)

    @property
    def starts(self) -> Offsets:
        """Offsets of their statements in the text."""
        return self._of.run.starts[self._rows]

    def place(self, number: int) -> Place:
        """Place of the statement of a target."""
        row = self._rows.start + number
        return self._place(next(self._of.run.rows(slice(row, row + 1))), number)

    def moves(self, motion: Motion, number: int, stop: int) -> Iterator[BulkMove]:
        """Yield the moves from a number on, but for those made together with the one before."""
        created, begin = self._created, self._rows.start
        assert created is not None
        while number < stop:
            rows = self._of.run.rows(slice(begin + number, begin + stop))
            for row, target in zip(rows, created[number:stop], strict=True):
                yield BulkMove(row, self._place(row, number), target)
                number += 1
                more = motion.repeat(self, number, stop - number)
                if more:
                    number += more
                    break
        if stop == len(created):
            self._created = None

    def _place(self, row: tree.BulkRow, number: int) -> Place:
        like = self._of.like
        source = like.span.source
        arguments = _Texts(like.arguments, self._of.parameter, source, row.target)
        span = Span(source, row.start, row.end)
        return Place(span, like.routine, arguments, AnnouncedRow(self, number))
