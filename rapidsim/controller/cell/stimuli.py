"""Occurrences of stimuli: when the changes of inputs from outside the program are due.

A stimulus of the clock occurs at its times; one with a condition occurs each time that the
condition becomes true, and acts after its delay. It acts at the occurrences that it names, or at
all.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence

from rapidsim.controller.cell.description import Stimulus
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class DueStimulus:
    """A stimulus that acts at a time."""

    stimulus: Stimulus
    time_s: float
    occurrence: int = 1
    """Number of this occurrence, from 1."""

    def following(self, time_s: float) -> DueStimulus | None:
        """The next time that it acts, after it has acted at a time [s]; None if there is none."""
        every_s = self.stimulus.every_s
        return (
            None if every_s is None else _due(self.stimulus, time_s + every_s, self.occurrence + 1)
        )


class Stimuli:
    """The stimuli of a cell."""

    def __init__(self, stimuli: Sequence[Stimulus]) -> None:
        """Take the stimuli; none has occurred."""
        self._stimuli = stimuli
        self._true: set[int] = set()
        """Indices of the stimuli whose condition holds."""
        self._occurrences: Counter[int] = Counter()
        """By index."""

    def begin(self, read: Callable[[str], float]) -> Iterator[DueStimulus]:
        """Yield what is due from time zero on, for signals that a function reads."""
        for index, stimulus in enumerate(self._stimuli):
            if stimulus.when is None:
                first_s = stimulus.every_s if stimulus.at_s is None else stimulus.at_s
                due = _due(stimulus, first_s or 0.0, 1)
                if due is not None:
                    yield due
            elif stimulus.when.holds(read):
                yield from self._occur(index, 0.0)

    def change(
        self, name: str, time_s: float, read: Callable[[str], float]
    ) -> Iterator[DueStimulus]:
        """Yield what is due because a signal has changed at a time [s]."""
        folded = name.lower()
        for index, stimulus in enumerate(self._stimuli):
            if stimulus.when is None or not any(
                folded == signal.lower() for signal in stimulus.when.signals()
            ):
                continue
            if not stimulus.when.holds(read):
                self._true.discard(index)
            elif index not in self._true:
                yield from self._occur(index, time_s)

    def _occur(self, index: int, time_s: float) -> Iterator[DueStimulus]:
        self._true.add(index)
        self._occurrences[index] += 1
        stimulus, occurrence = self._stimuli[index], self._occurrences[index]
        if stimulus.first_that_acts(occurrence) == occurrence:
            yield DueStimulus(stimulus, time_s + stimulus.after_s, occurrence)


def _due(stimulus: Stimulus, time_s: float, occurrence: int) -> DueStimulus | None:
    """The first time that a stimulus of the clock acts, from an occurrence at a time [s] on."""
    acting = stimulus.first_that_acts(occurrence)
    if acting is None:
        return None
    skipped_s = (acting - occurrence) * (stimulus.every_s or 0.0)
    return DueStimulus(stimulus, time_s + skipped_s, acting)
