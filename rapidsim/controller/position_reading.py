"""Reading where the arm of a task is, as often as a program likes.

A reading is exact for the instant at which it is made, and holds for a millisecond: as long as what
`ClkRead` shows. A program that asks in every turn of a loop therefore gets a new one each
millisecond, later than turn by turn by no more than that. Readings that follow each other in even
steps are worked out together, ahead of time, for as long as nothing changes the path.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.frames.transform import Array
from rapidsim.language.data import RobTarget, ToolData, WobjData
from rapidsim.language.moves import Place

HOLDS_S = 1e-3
"""So long [s] a reading holds. Unverified: no manual says how old a position may be that a program
reads; the resolution of `ClkRead` is the finest that a program can tell times by."""
_AT_ONCE = 64
"""So many readings are worked out together, at most."""
_SAME_S = 1e-9
"""Instants so near [s] are one: the ticks of a loop add up to a rounding less."""


class Reading(NamedTuple):
    """Where an arm was found."""

    time_s: float
    joints: Array
    """Shape (n,) [rad]."""
    external: Array
    """Shape (e,) [m or rad]."""
    targets: dict[tuple[ToolData, WobjData], RobTarget]
    """What of it was worked out, by tool and work object."""


@dataclass(slots=True, eq=False)
class PositionReader:
    """Reads one robot's position for those who ask at times that never go back."""

    unit: MechanicalUnit
    resolver: Resolver
    _version: tuple[int, int] | None = None
    """What the robot would do when the readings were made."""
    _last: Reading | None = None
    _ahead: list[Reading] = field(default_factory=list)
    """Later readings if nothing changes, the next one last."""
    _step_s: float = math.inf
    """How long [s] after the one before it the last reading was made."""
    _count: int = 1
    """How many were worked out with it."""

    def read(self, now_s: float) -> Reading:
        """Where the robot is at a time [s] that has come, or was found no longer ago than holds."""
        before = None if self._last is None else self._last.time_s
        if self._version != self.unit.version:
            # Whoever reads evenly goes on with it, but what comes may soon be something else again.
            self._version, self._last = self.unit.version, None
            self._ahead.clear()
            self._count = max(1, self._count // 8)
        if self.unit.own.is_led:
            # Only the sensor knows where it will be.
            self._step_s = math.inf
            self._ahead.clear()
        last = self._last
        if last is None or not 0.0 <= now_s - last.time_s < HOLDS_S - _SAME_S:
            step_s = math.inf if before is None else now_s - before
            self._last = last = self._next(now_s, step_s)
            # What it was too late for may have come to light.
            self._version = self.unit.version
        return last

    def stays_until(self, reading: Reading) -> float:
        """Until when [s] nobody gets another reading, if nothing else happens."""
        queue = self.unit.queue
        waits = queue.is_open and not queue.is_halted
        waits |= self.unit.own.is_led
        still = not waits and queue.trajectory.duration <= reading.time_s
        return math.inf if still else reading.time_s + HOLDS_S

    def target(self, reading: Reading, tool: ToolData, wobj: WobjData, place: Place) -> RobTarget:
        """Where the TCP was then; see `Resolver.target`."""
        known = reading.targets.get((tool, wobj))
        if known is None:
            joints, external = reading.joints, reading.external
            known = self.resolver.target(joints, external, tool, wobj, place)
            reading.targets[tool, wobj] = known
        return known

    def _next(self, now_s: float, step_s: float) -> Reading:
        while self._ahead and self._ahead[-1].time_s < now_s - _SAME_S:
            self._ahead.pop()
        if self._ahead and self._ahead[-1].time_s <= now_s + _SAME_S:
            return self._ahead.pop()
        is_even = abs(step_s - self._step_s) < _SAME_S
        self._step_s = step_s
        self._count = min(2 * self._count, _AT_ONCE) if is_even else 1
        times = now_s + np.arange(self._count, dtype=np.float64) * (step_s if is_even else 0.0)
        samples = self.unit.queue.seen(now_s, times)
        found = [
            Reading(time_s, samples.joints[k], samples.external[k], {})
            for k, time_s in enumerate(times.tolist())
        ]
        self._ahead = found[:0:-1]
        return found[0]
