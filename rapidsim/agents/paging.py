"""Answers of limited size: what does not fit comes with the next cursor."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

Answer: TypeAlias = dict[str, Any]

LARGEST = 8000
"""Bytes of an answer as JSON."""


def paged(answer: Mapping[str, object], lists: Sequence[str], cursor: int) -> Answer:
    """Return an answer with as much of its lists as fits.

    The lists count as one, in their order. At least one entry is returned, so that a reader of all
    pages gets all of them.

    Args:
        answer: The whole answer.
        lists: Names of the lists in it that may be cut.
        cursor: Number of entries of earlier pages; the last one returned is `next_cursor`.
    """
    entries = [(name, entry) for name in lists for entry in _entries(answer[name])]
    page: Answer = {**answer, **{name: [] for name in lists}, "next_cursor": None}
    size = _size(page)
    for number, (name, entry) in enumerate(entries[cursor:], cursor):
        size += _size(entry) + 2
        if size > LARGEST and number > cursor:
            page["next_cursor"] = number
            break
        page[name].append(entry)
    return page


def _entries(value: object) -> Sequence[object]:
    return value if isinstance(value, list) else ()


def _size(value: object) -> int:
    return len(json.dumps(value, ensure_ascii=False).encode())
