"""A run: statements that are alike but for a target, kept as columns."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import repeat
from typing import TYPE_CHECKING, Any, TypeAlias

from rapidsim.syntax.tree.expressions import Node, node
from rapidsim.syntax.tree.statements import Call, Data

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Numbers: TypeAlias = NDArray[np.floating[Any]]
    Offsets: TypeAlias = NDArray[np.int64]


@node
class BulkStatements(Node):
    """Statements behind one that they are like; that one is in the tree and stands for them.

    They are not in the tree: who looks at statements sees one of each kind. They differ in the
    target that is the first argument of a call, or in the name and the value of a declared target,
    and in nothing else.
    """

    like: Call | Data
    starts: Offsets
    """Of each statement."""
    ends: Offsets
    numbers: Numbers
    """Of each target, flat, rounded to single precision: shape (statements, numbers)."""
    numbers_of_like: Numbers
    """The same of the statement in the tree: shape (numbers,)."""
    names: tuple[str, ...] = ()
    """Folded names that they declare."""
    declared: Offsets | None = None
    """Where the line of the declaration of each target begins; None if it is written out."""

    def __len__(self) -> int:
        """How many statements it stands for."""
        return len(self.starts)

    def row_at(self, start: int) -> BulkRow | None:
        """The call that begins at an offset; None if none does."""
        row = int(self.starts.searchsorted(start))
        if not (row < len(self) and self.starts[row] == start and isinstance(self.like, Call)):
            return None
        return next(self.rows(slice(row, row + 1)))

    def row_around(self, offset: int) -> BulkRow | None:
        """The call that contains an offset; None if none does."""
        row = int(self.starts.searchsorted(offset, "right")) - 1
        if row < 0 or offset >= self.ends[row] or not isinstance(self.like, Call):
            return None
        return next(self.rows(slice(row, row + 1)))

    def rows(self, which: slice = slice(None)) -> Iterator[BulkRow]:
        """Its calls, or some of them, as places that know what they are like."""
        assert isinstance(self.like, Call)
        places = zip(self.starts[which].tolist(), self.ends[which].tolist(), strict=True)
        declared = repeat(None) if self.declared is None else self.declared[which].tolist()
        for (start, end), line in zip(places, declared, strict=False):
            yield BulkRow(start, end, self.like, line)


@node
class BulkRow(Node):
    """One call of a run: its place, and what it is like."""

    like: Call
    declared: int | None
    """Where the line begins that declares its target."""

    def moved(self, offset: int) -> int:
        """Where the part stands that the statement in the tree has at an offset."""
        if offset <= self.like.arguments[0].start:
            return offset + self.start - self.like.start
        return offset + self.end - self.like.end

    @property
    def target(self) -> Node:
        """The place of its target, or of the name of that."""
        first = self.like.arguments[0]
        return Node(self.moved(first.start), self.moved(first.end))
