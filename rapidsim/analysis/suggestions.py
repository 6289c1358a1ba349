"""Which known name somebody may have meant.

Two questions with different answers: what to suggest for a name that is wrong for certain
(`closest`), and whether a name that could be somebody else's is a slip of the keyboard (`is_slip`).
Both compare without case. Distance is the number of letters inserted, deleted, replaced or swapped
with their neighbour.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable

from rapidsim.syntax.spelling import distance
from rapidsim.syntax.stored_table import rapid_table


def reserved_words() -> Collection[str]:
    """Words of the language, which are never names."""
    return rapid_table().words


def closest(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate nearest to a name; None if none is near. Ties go to the first."""
    folded = name.lower()
    best: str | None = None
    limit = _most_slips(folded)
    for candidate in candidates:
        other = candidate.lower()
        if limit and other != folded and _is_near(folded, other, limit):
            best, limit = candidate, distance(folded, other) - 1
    return best


def slip_of(name: str, candidates: Iterable[str]) -> str | None:
    """The candidate of which a name is a slip of the keyboard, if there is one."""
    return closest(name, (candidate for candidate in candidates if is_slip(name, candidate)))


def is_slip(name: str, meant: str) -> bool:
    """Whether a name is more likely a slip than a name of its own.

    Programs name things in series and families: `Pick1` and `Pick2`, `MoveL` and `MoveC`, `rPick`
    and `Pick`. Names that differ only in a digit, in the last letter or by one letter put before or
    behind are such relatives, unless that letter is a doubled one or a small one left out.
    """
    a, b = name.lower(), meant.lower()
    if len(a) < 3 or a == b or not _is_near(a, b, _most_slips(a)):
        return False
    start = _common_start(a, b)
    end = _common_start(a[start:][::-1], b[start:][::-1])
    changed = a[start : len(a) - end] + b[start : len(b) - end]
    if any(not letter.isalpha() for letter in changed):
        return False
    if start == 0:
        return False
    if start >= min(len(a), len(b)) - (len(a) == len(b)):
        if len(a) > len(b):
            return a[-1] == a[-2]
        return len(b) > len(a) >= 6 and meant[-1].islower()
    return True


def _most_slips(name: str) -> int:
    """How many slips a name of this length can hide and still be recognised."""
    return 0 if len(name) < 2 else 1 if len(name) < 7 else 2


def _common_start(a: str, b: str) -> int:
    count = 0
    for x, y in zip(a, b, strict=False):
        if x != y:
            break
        count += 1
    return count


def _is_near(a: str, b: str, limit: int) -> bool:
    """Whether two folded names are within a distance; cheap for names that are not."""
    if abs(len(a) - len(b)) > limit or len(set(a) ^ set(b)) > 2 * limit:
        return False
    return distance(a, b) <= limit
