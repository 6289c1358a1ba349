"""The nearest known name to an unknown name.

Names compare without case. The distance is the number of letters inserted, deleted, replaced or
swapped with their neighbour. The nearest name is only a suggestion: programs name things in series
and families, `Pick1` and `Pick2`, `MoveL` and `MoveC`, so an unknown name stays unknown.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from rapidsim.syntax.spelling import distance
from rapidsim.syntax.stored_table import rapid_table

_LOOKALIKES = str.maketrans("oil", "011")
"""Letters that are read as digits: `p1O` is `p10`."""


def reserved_words() -> Collection[str]:
    """Reserved words of the language, which are never names."""
    return rapid_table().words


def closest(name: str, candidates: Iterable[str]) -> str | None:
    """Return the candidate closest to a name; None if none is close. Ties go to the first."""
    folded = name.lower()
    looks = folded.translate(_LOOKALIKES)
    best: str | None = None
    limit = _most_slips(folded)
    for candidate in candidates:
        other = candidate.lower()
        if len(other) == len(folded) and other.translate(_LOOKALIKES) == looks and other != folded:
            return candidate
        if limit and other != folded and _is_near(folded, other, limit):
            best, limit = candidate, distance(folded, other) - 1
    return best


def _most_slips(name: str) -> int:
    """Maximum distance for a name of this length; names of three letters have many neighbours."""
    return 0 if len(name) < 4 else 1 if len(name) < 7 else 2


def _is_near(a: str, b: str, limit: int) -> bool:
    """Whether the distance of two folded names is within a limit; cheap if it is not."""
    if abs(len(a) - len(b)) > limit or len(set(a) ^ set(b)) > 2 * limit:
        return False
    return distance(a, b) <= limit
