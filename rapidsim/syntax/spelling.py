"""Reserved words that a misspelt word may be intended as."""

from __future__ import annotations

from functools import lru_cache

from rapidsim.syntax.stored_table import rapid_table

_SHORT = 4
_TINY = 2


@lru_cache(maxsize=1024)
def near_words(text: str) -> tuple[tuple[int, str], ...]:
    """Reserved words that a name may be a misspelling of, nearest first, each with its distance.

    One slip is allowed in a word of up to four letters, two in a longer one; two letters may only
    be swapped, since nearly any name of two letters is a slip away from OR.
    """
    written = text.upper()
    found = []
    for word in rapid_table().words:
        allowed = 1 if min(len(word), len(written)) <= _SHORT else 2
        if abs(len(word) - len(written)) <= allowed:
            slips = distance(written, word)
            swapped = sorted(written) == sorted(word)
            if 0 < slips <= allowed and (len(word) > _TINY or swapped):
                found.append((slips, word))
    return tuple(sorted(found))


def distance(a: str, b: str) -> int:
    """Number of letters to insert, delete, change or swap with their neighbour.

    Source: optimal string alignment, the restricted Damerau-Levenshtein distance.
    """
    two_above: list[int] = []
    above: list[int] = []
    row = list(range(len(b) + 1))
    for i, letter in enumerate(a, 1):
        two_above, above, row = above, row, [i]
        for j, other in enumerate(b, 1):
            row.append(min(above[j] + 1, row[j - 1] + 1, above[j - 1] + (letter != other)))
            if i > 1 and j > 1 and letter == b[j - 2] and a[i - 2] == other:
                row[j] = min(row[j], two_above[j - 2] + 1)
    return row[-1]
