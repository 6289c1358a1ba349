"""Places on the path with actions: outputs, interrupts and calls.

A mark has a distance before the end of a move, or after its start, along the programmed curve, and
a time before the robot is there. Its time follows from the preview of the motion: while time
passes, no further move can be queued, so the preview is what will happen.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import field
from typing import ClassVar

import numpy as np

from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.values import value_class

_ROUNDING_M = 1e-9


@value_class(frozen=True, slots=True, eq=False)
class PathMark:
    """A place on the path with an action."""

    move: QueuedMove
    distance_m: float
    """Distance back from the end of the move, or forward from its start."""
    from_start: bool
    ahead_s: float
    """Time before the robot's arrival; negative for after."""
    act: Callable[[float], None]
    """Called with the time [s] of the mark."""
    interrupts: bool = False
    """Whether it runs a trap or a procedure."""


@value_class(slots=True)
class PathMarks:
    """The marks on a robot's path that it has not passed yet: a `event_source.EventSource`."""

    on_path: ClassVar = True
    unit: MechanicalUnit
    _pending: list[PathMark] = field(default_factory=list)
    _due: tuple[tuple[int, int], int, tuple[float, ...]] | None = None
    """The version of the path and the number of marks for which the times were computed."""

    @property
    def is_pending(self) -> bool:
        """Whether the robot has not passed all marks yet."""
        return bool(self._pending)

    @property
    def may_interrupt(self) -> bool:
        """Whether a mark may run a trap or a procedure."""
        return any(mark.interrupts for mark in self._pending)

    def add(self, mark: PathMark) -> None:
        """Add a mark to the path."""
        self._pending.append(mark)

    def clear(self) -> None:
        """Drop the marks that the robot has not passed."""
        self._pending.clear()

    def next_s(self) -> float | None:
        """Time [s] at which the robot passes the next mark; None if it passes none."""
        earliest_s = min(self._times(), default=math.inf)
        return None if math.isinf(earliest_s) else earliest_s

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Carry out the action of the next mark; see `event_source.EventSource`."""
        del until_s
        times = self._times()
        index = min(range(len(times)), key=times.__getitem__)
        mark = self._pending.pop(index)
        mark.act(max(times[index], passed_s))
        return times[index]

    def advance_to(self, time_s: float) -> None:
        """Do nothing: marks wait until they are passed."""

    def _times(self) -> tuple[float, ...]:
        """Time [s] at which the robot passes each mark; infinite if it does not get there."""
        if not self._pending:
            return ()
        key = (self.unit.version, len(self._pending))
        if self._due is None or self._due[:2] != key:
            key = (self.unit.version, len(self._pending))
            self._due = (*key, self._worked_out(self.unit.preview()))
        return self._due[2]

    def _worked_out(self, preview: Trajectory) -> tuple[float, ...]:
        """Times of all marks, computed from a preview in one go."""
        places_m = np.array([self._place(mark) for mark in self._pending])
        comes = places_m <= preview.length + _ROUNDING_M
        times_s = np.full(len(places_m), math.inf)
        times_s[comes] = preview.time_at_place(places_m[comes])
        # A robot at rest at the start arrived there earlier; the move begins when it leaves.
        begins_s = [mark.move.command_start_s or 0.0 for mark in self._pending]
        ahead_s = np.array([mark.ahead_s for mark in self._pending])
        return tuple((np.maximum(times_s, begins_s) - ahead_s).tolist())

    def _place(self, mark: PathMark) -> float:
        """Position [m] of a mark on the path of the whole run; infinite if it is not planned."""
        places = self.unit.places_of(mark.move)
        if places is None:
            return math.inf
        start_m, end_m = places
        distance_m = mark.distance_m
        if distance_m:
            distance_m *= self.unit.path_ratio(mark.move)
        if mark.from_start:
            return min(start_m + distance_m, end_m)
        return max(end_m - distance_m, start_m)
