"""Occurrences of stimuli and faults: when what happens from outside the program is due.

An occasion of the clock occurs at its times; one with a condition occurs each time that the
condition becomes true, and acts after its delay. It acts at the occurrences that it names, or at
all.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import Generic, TypeVar

from rapidsim.controller.cell.occasions import Occasion
from rapidsim.values import value_class

T = TypeVar("T", bound=Occasion)


@value_class(frozen=True, slots=True)
class DueOccasion(Generic[T]):
    """Something that happens at a time."""

    occasion: T
    time_s: float
    occurrence: int = 1
    """Number of this occurrence, from 1."""

    def following(self, time_s: float) -> DueOccasion[T] | None:
        """The next time that it acts, after it has acted at a time [s]; None if there is none."""
        every_s = self.occasion.every_s
        return (
            None if every_s is None else _due(self.occasion, time_s + every_s, self.occurrence + 1)
        )


class Occasions(Generic[T]):
    """The stimuli or the faults of a cell."""

    def __init__(self, occasions: Sequence[T]) -> None:
        """Take the occasions; none has occurred."""
        self._occasions = list(occasions)
        self._first_added = len(self._occasions)
        self._true: set[int] = set()
        """Indices of the occasions whose condition holds."""
        self._occurrences: Counter[int] = Counter()
        """By index."""

    def begin(self, read: Callable[[str], float], time_s: float = 0.0) -> Iterator[DueOccasion[T]]:
        """Yield what is due from a time [s] on, for signals that a function reads."""
        for index in range(len(self._occasions)):
            yield from self._begin(index, read, time_s)

    def add(
        self, occasion: T, read: Callable[[str], float], time_s: float
    ) -> Iterator[DueOccasion[T]]:
        """Add an occasion at a time [s]; without a time or a condition it is due at once."""
        if occasion.when is None:
            yield from self._clocked(occasion, time_s)
        else:
            self._occasions.append(occasion)
            yield from self._begin(len(self._occasions) - 1, read, time_s)

    def remove_added(self) -> None:
        """Remove the occasions that were added."""
        del self._occasions[self._first_added :]
        self._true = {index for index in self._true if index < self._first_added}
        for index in [one for one in self._occurrences if one >= self._first_added]:
            del self._occurrences[index]

    def depends_on(self, signal: str) -> bool:
        """Whether a condition reads a signal."""
        folded = signal.lower()
        return any(
            folded == name.lower()
            for occasion in self._occasions
            if occasion.when is not None
            for name in occasion.when.signals()
        )

    def change(
        self, name: str, time_s: float, read: Callable[[str], float]
    ) -> Iterator[DueOccasion[T]]:
        """Yield what is due because a signal has changed at a time [s]."""
        folded = name.lower()
        for index, occasion in enumerate(self._occasions):
            if occasion.when is None or not any(
                folded == signal.lower() for signal in occasion.when.signals()
            ):
                continue
            if not occasion.when.holds(read):
                self._true.discard(index)
            elif index not in self._true:
                yield from self._occur(index, time_s)

    def _begin(
        self, index: int, read: Callable[[str], float], time_s: float
    ) -> Iterator[DueOccasion[T]]:
        occasion = self._occasions[index]
        if occasion.when is None:
            yield from self._clocked(occasion, time_s)
        elif occasion.when.holds(read):
            yield from self._occur(index, time_s)

    def _clocked(self, occasion: T, time_s: float) -> Iterator[DueOccasion[T]]:
        first_s = time_s + (occasion.every_s or 0.0)
        if occasion.at_s is not None:
            first_s = max(occasion.at_s, time_s)
        due = _due(occasion, first_s, 1)
        if due is not None:
            yield due

    def _occur(self, index: int, time_s: float) -> Iterator[DueOccasion[T]]:
        self._true.add(index)
        self._occurrences[index] += 1
        occasion, occurrence = self._occasions[index], self._occurrences[index]
        if occasion.first_that_acts(occurrence) == occurrence:
            yield DueOccasion(occasion, time_s + occasion.after_s, occurrence)


def _due(occasion: T, time_s: float, occurrence: int) -> DueOccasion[T] | None:
    """The first time that an occasion of the clock acts, from an occurrence at a time [s] on."""
    acting = occasion.first_that_acts(occurrence)
    if acting is None:
        return None
    skipped_s = (acting - occurrence) * (occasion.every_s or 0.0)
    return DueOccasion(occasion, time_s + skipped_s, acting)
