"""Which lines of bulk statements need not be parsed: what the parser receives from its caller."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

from rapidsim.values import value_class

if TYPE_CHECKING:
    import numpy as np

    from rapidsim.syntax.tree.bulk_statements import Numbers

    Mask: TypeAlias = np.ndarray[Any, np.dtype[np.bool_]]


@value_class(frozen=True, slots=True, eq=False)
class BulkReading:
    """Decisions of a caller about bulk statements."""

    more_than: int
    """Number of moves up to which all lines are parsed."""
    of_targets: Callable[[Numbers], Mask]
    """Returns which targets (k,) of numbers (k, 17), as written, are plain: their lines may be
    represented by others of the run."""
    of_declared: Callable[[Numbers], Mask]
    """Returns which declared targets are plain."""
    of_calls: Callable[[str], bool]
    """Whether a call of an instruction, by its name, may be represented by another to the letter:
    one that neither moves nor changes what moves do."""
    keeps_data: bool = False
    """Whether declarations, and moves to declared targets, are parsed."""
