"""The signals of the cell, by name without case, and changes that are still to come."""

from __future__ import annotations

from dataclasses import dataclass, field

from rapidsim.simulation.journal import Moment


@dataclass(frozen=True, slots=True)
class Change:
    """A signal takes a value at a moment."""

    moment: Moment
    name: str
    value: float


@dataclass(slots=True)
class SignalTable:
    """Values of all signals a program has touched; they start at 0."""

    _values: dict[str, float] = field(default_factory=dict)
    _coming: list[Change] = field(default_factory=list)

    def read(self, name: str) -> float:
        """The value of a signal."""
        return self._values.setdefault(name.lower(), 0.0)

    def write(self, name: str, value: float) -> bool:
        """Set a signal; returns whether that changed it."""
        changed = self.read(name) != value
        self._values[name.lower()] = value
        return changed

    def schedule(self, change: Change) -> None:
        """Set a signal later."""
        self._coming.append(change)

    def next_change_s(self) -> float | None:
        """Time [s] of the next change whose time is known; None if there is none."""
        times = [c.moment.time_s for c in self._coming if c.moment.instant.time is not None]
        return min(times, default=None)

    def take_change(self) -> Change:
        """The earliest change whose time is known, taken off."""
        known = [c for c in self._coming if c.moment.instant.time is not None]
        change = min(known, key=lambda c: c.moment.time_s)
        self._coming.remove(change)
        return change
