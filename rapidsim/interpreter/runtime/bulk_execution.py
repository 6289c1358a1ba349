"""Execution of bulk moves, one row after the other.

Bulk moves are one loop in generated code. Each row's values are created when it is executed, so a
million moves take no memory in advance.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import repeat
from typing import TYPE_CHECKING, Any

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


@value_class(frozen=True, slots=True, eq=False)
class BulkExecution:
    """Bulk moves, iterated over at each execution."""

    run: tree.BulkStatements
    like: Place
    """Position of the statement in the tree."""
    parameter: str
    """Folded name of the parameter that takes the target."""

    def moves(self, motion: Motion) -> Iterator[BulkMove]:
        """Yield the moves in order; their targets are announced."""
        for first in range(0, len(self.run), _AT_ONCE):
            targets = BulkTargets(self, slice(first, first + _AT_ONCE))
            motion.expect(targets)
            yield from targets.moves(motion)


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

    def moves(self, motion: Motion) -> Iterator[BulkMove]:
        """Yield the moves in order, but for those that are made together with the one before."""
        created, number, more = self._created, 0, 1
        assert created is not None
        while more:
            more = 0
            rows = self._of.run.rows(slice(self._rows.start + number, self._rows.stop))
            for row, target in zip(rows, created[number:], strict=True):
                yield BulkMove(row, self._place(row, number), target)
                number += 1
                more = motion.repeat(self, number)
                if more:
                    number += more
                    break
        self._created = None

    def _place(self, row: tree.BulkRow, number: int) -> Place:
        like = self._of.like
        source = like.span.source
        arguments = _Texts(like.arguments, self._of.parameter, source, row.target)
        span = Span(source, row.start, row.end)
        return Place(span, like.routine, arguments, AnnouncedRow(self, number))
