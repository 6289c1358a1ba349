"""Queue of changes for a slow reader."""

from __future__ import annotations

from collections import Counter, deque
from dataclasses import dataclass, field
from typing import Final

from rapidsim.server.messages import ChangeEvent, Item

MOST_WAITING: Final = 1000
"""Largest number of changes for one reader: one for each resource that it can subscribe to."""


@dataclass(slots=True, eq=False)
class EventQueue:
    """A queue that drops outdated changes.

    If it is full, the oldest change with a newer one of the same resource is dropped: the reader
    misses intermediate values, but always receives the last one of each resource.
    """

    most: int = MOST_WAITING
    _changes: deque[ChangeEvent] = field(default_factory=deque)
    _of_resource: Counter[str] = field(default_factory=Counter)

    def __len__(self) -> int:
        """Number of queued changes."""
        return len(self._changes)

    def add(self, change: ChangeEvent) -> None:
        """Append a change."""
        self._changes.append(change)
        self._of_resource[change.resource] += 1
        if len(self._changes) > self.most:
            repeated = (
                k for k, one in enumerate(self._changes) if self._of_resource[one.resource] > 1
            )
            self._take(next(repeated, 0))

    def next(self) -> tuple[Item, ...]:
        """Remove and return the oldest change."""
        return self._take(0).items

    def _take(self, index: int) -> ChangeEvent:
        change = self._changes[index]
        del self._changes[index]
        self._of_resource[change.resource] -= 1
        if not self._of_resource[change.resource]:
            del self._of_resource[change.resource]
        return change
