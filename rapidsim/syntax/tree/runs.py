"""A run: statements that are alike but for the numbers of a literal, kept as columns."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from rapidsim.syntax.tree.expressions import Node, node
from rapidsim.syntax.tree.statements import Call

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Numbers: TypeAlias = NDArray[np.floating[Any]]
    Offsets: TypeAlias = NDArray[np.int64]


@node
class Run(Node):
    """Statements behind one that they are like; that one is in the tree and stands for them.

    They are not in the tree: who looks at statements sees one of each kind. They differ in the
    numbers of the literal that is the first argument, and in nothing else.
    """

    like: Call
    starts: Offsets
    """Of each statement."""
    ends: Offsets
    numbers: Numbers
    """Of each literal, flat, rounded to single precision: shape (statements, numbers)."""

    def __len__(self) -> int:
        """How many statements it stands for."""
        return len(self.starts)

    def rows(self) -> Iterator[RunRow]:
        """Its statements, as places that know the run."""
        places = zip(self.starts.tolist(), self.ends.tolist(), strict=True)
        return (RunRow(start, end, self.like) for start, end in places)


@node
class RunRow(Node):
    """One statement of a run: its place, and what it is like."""

    like: Call
