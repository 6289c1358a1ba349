"""Bulk statements: statements that differ only in a target, stored as columns.

Between bulk moves there may be calls that are repeated to the letter, such as those of an output.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate, pairwise, repeat
from typing import TYPE_CHECKING, Any, TypeAlias

from rapidsim.syntax.tree.expressions import Node, node
from rapidsim.syntax.tree.statements import Call, Data

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Numbers: TypeAlias = NDArray[np.floating[Any]]
    Offsets: TypeAlias = NDArray[np.int64]

TARGET_SHAPE = (3, 4, 4, 6)
"""Numbers in the parts of a target: position, orientation, configuration, external axes."""
TARGET_WIDTH = sum(TARGET_SHAPE)
TRANS, ROT, ROBCONF, EXTAX = (
    slice(first, stop) for first, stop in pairwise(accumulate(TARGET_SHAPE, initial=0))
)
"""Places of these parts among the numbers of a target."""


@node
class BulkStatements(Node):
    """Statements that repeat a preceding one, which represents them in the tree.

    They are not in the tree: a traversal visits one statement of each kind. They differ only in the
    target that is the first argument of a call, or in the name and the value of a declared target.
    """

    like: Call | Data
    starts: Offsets
    """Start offset of each statement."""
    ends: Offsets
    numbers: Numbers
    """Numbers of each target, flat, rounded to single precision: shape (statements, numbers)."""
    numbers_of_like: Numbers
    """Numbers of the statement in the tree: shape (numbers,)."""
    names: tuple[str, ...] = ()
    """Folded names that they declare."""
    declared: Offsets | None = None
    """Offset of the line that declares each target; None if targets are written out."""
    between: tuple[RepeatedCall, ...] = ()
    """Calls between them, each with all its repetitions."""

    def __len__(self) -> int:
        """Number of statements."""
        return len(self.starts)

    def row_at(self, start: int) -> BulkRow | None:
        """Return the call that begins at an offset; None if none does."""
        row = int(self.starts.searchsorted(start))
        if not (row < len(self) and self.starts[row] == start and isinstance(self.like, Call)):
            return None
        return next(self.rows(slice(row, row + 1)))

    def row_around(self, offset: int) -> BulkRow | None:
        """Return the call that contains an offset; None if none does."""
        row = int(self.starts.searchsorted(offset, "right")) - 1
        if row < 0 or offset >= self.ends[row] or not isinstance(self.like, Call):
            return None
        return next(self.rows(slice(row, row + 1)))

    def rows(self, which: slice = slice(None)) -> Iterator[BulkRow]:
        """Yield its calls, or a slice of them, as rows."""
        assert isinstance(self.like, Call)
        places = zip(self.starts[which].tolist(), self.ends[which].tolist(), strict=True)
        declared = repeat(None) if self.declared is None else self.declared[which].tolist()
        for (start, end), line in zip(places, declared, strict=False):
            yield BulkRow(start, end, self.like, line)


@node
class RepeatedCall(Node):
    """A call between bulk moves, repeated to the letter; a preceding one is in the tree."""

    like: Call
    move: Call
    """The last of such moves before it."""
    starts: Offsets
    """Start offset of each repetition."""
    moves_before: Offsets
    """Number of bulk moves before each repetition."""

    def rows(self) -> Iterator[BulkRow]:
        """Yield the repetitions as rows."""
        length = self.like.end - self.like.start
        return (BulkRow(start, start + length, self.like, None) for start in self.starts.tolist())


@node
class BulkRow(Node):
    """One call of bulk statements: its position, and the statement that it repeats."""

    like: Call
    declared: int | None
    """Offset of the line that declares its target; None if the target is written out."""

    def moved(self, offset: int) -> int:
        """Map an offset in the statement in the tree to the corresponding offset in this row."""
        if offset <= self.like.arguments[0].start:
            return offset + self.start - self.like.start
        return offset + self.end - self.like.end

    @property
    def target(self) -> Node:
        """Node of its target, or of the target's name."""
        first = self.like.arguments[0]
        return Node(self.moved(first.start), self.moved(first.end))
