"""The rows of a run of alike moves during execution, one after the other.

A run is one loop in generated code. Each row's values are created when its turn comes, so a million
moves take no memory in advance.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import repeat
from typing import TYPE_CHECKING, Any

from rapidsim.diagnostics import Source, Span
from rapidsim.language.data import ConfData, ExtJoint, Orient, Pos, RobTarget
from rapidsim.language.moves import Place
from rapidsim.syntax import tree
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.syntax.tree.bulk_statements import Numbers

ROW = "_row"
"""The variable of generated code with the row whose turn it is; None outside of runs."""
_AT_ONCE = 1000
"""Rows whose columns become objects together."""
_PARTS: tuple[tuple[slice, Any], ...] = (
    (slice(0, 3), Pos),
    (slice(3, 7), Orient),
    (slice(7, 11), ConfData),
    (slice(11, 17), ExtJoint),
)


def targets_of(numbers: Numbers) -> Iterator[RobTarget]:
    """Targets from columns (targets, 17)."""
    for first in range(0, len(numbers), _AT_ONCE):
        block = numbers[first : first + _AT_ONCE]
        columns = (_part(block[:, part], kind) for part, kind in _PARTS)
        yield from map(RobTarget._make, zip(*columns, strict=False))


def _part(numbers: Numbers, kind: Any) -> Iterable[Any]:
    """A part of each target; one for all where all are the same, as of external axes."""
    # By their bits, for 0 and -0 are equal and not the same.
    bits = numbers.view("i4")
    if (bits == bits[0]).all():
        return repeat(kind(*numbers[0].tolist()), len(numbers))
    return map(kind._make, numbers.tolist())


class _Texts(Mapping[str, str]):
    """What the arguments of a row are in the text: as those of the statement that it is like."""

    __slots__ = ("_end", "_of_like", "_source", "_start", "_target")

    def __init__(self, of_like: Mapping[str, str], target: str, source: Source, at: tree.Node):
        """Look up all but the target, which stands at a place of its own."""
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
    """One move of a run."""

    written: tree.BulkRow
    place: Place
    target: RobTarget


@value_class(frozen=True, slots=True, eq=False)
class BulkExecution:
    """A run, iterated over whenever it is executed."""

    run: tree.BulkStatements
    like: Place
    """Of the statement in the tree."""
    parameter: str
    """Folded name of the one that takes the target."""

    def __iter__(self) -> Iterator[BulkMove]:
        """Its moves in their order."""
        source, routine, texts = self.like.span.source, self.like.routine, self.like.arguments
        for row, target in zip(self._rows(), targets_of(self.run.numbers), strict=True):
            arguments = _Texts(texts, self.parameter, source, row.target)
            place = Place(Span(source, row.start, row.end), routine, arguments, is_lasting=False)
            yield BulkMove(row, place, target)

    def _rows(self) -> Iterator[tree.BulkRow]:
        for first in range(0, len(self.run), _AT_ONCE):
            yield from self.run.rows(slice(first, first + _AT_ONCE))
