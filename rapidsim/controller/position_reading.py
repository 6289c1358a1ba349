"""Reading where the arm of a task is, as often as a program likes.

A reading is exact for the instant at which it is made, and holds for a millisecond, as long as what
`ClkRead` shows, or until an arm that stands moves. A program that asks in every turn of a loop
therefore gets a new one each millisecond, later than turn by turn by no more than that. Readings
that follow each other in even steps are worked out together, ahead of time, for as long as nothing
changes the path. A program takes its steps from a clock in single precision, so they are a little
uneven: of each instant to come its neighbourhood is worked out.
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
_NEAR_S = 1e-4
"""So much earlier or later [s] than in even steps a reading may come. A clock that has run for half
an hour is shown so coarsely, and a parabola over so short a time misses an arm by 1e-7 rad where
its acceleration jumps, and by less than 1e-9 elsewhere."""


class Reading(NamedTuple):
    """Where an arm was found."""

    time_s: float
    joints: Array
    """Shape (n,) [rad]."""
    external: Array
    """Shape (e,) [m or rad]."""
    targets: dict[tuple[ToolData, WobjData], RobTarget]
    """What of it was worked out, by tool and work object."""


class _Expected(NamedTuple):
    """Where an arm will be about an instant, if nothing changes."""

    time_s: float
    joints: Array
    """Shape (3, n) [rad]: `_NEAR_S` earlier, then, and as much later."""
    external: Array
    """Shape (3, e) [m or rad]."""

    def at(self, now_s: float) -> Reading:
        """The arm at an instant near by."""
        part = (now_s - self.time_s) / _NEAR_S
        weights = (
            np.array([part * (part - 1.0), 2.0 - 2.0 * part * part, part * (part + 1.0)]) / 2.0
        )
        return Reading(now_s, weights @ self.joints, weights @ self.external, {})


@dataclass(slots=True, eq=False)
class PositionReader:
    """Reads one robot's position for those who ask at times that never go back."""

    unit: MechanicalUnit
    resolver: Resolver
    _version: tuple[int, int] | None = None
    """What the robot would do when the readings were made."""
    _last: Reading | None = None
    _ahead: list[_Expected] = field(default_factory=list)
    """Of later readings, the next one last."""
    _even_from_s: float = math.inf
    """When [s] the first of the readings was made that follow each other in even steps."""
    _steps: int = 1
    """How many there were since."""
    _step_s: float = math.inf
    """How long [s] one is."""
    _count: int = 1
    """How many readings were worked out together."""

    def read(self, now_s: float) -> Reading:
        """Where the robot is at a time [s] that has come, or was found no longer ago than holds."""
        self.unit.solo_queue.start_is_free = False
        before = None if self._last is None else self._last.time_s
        if self._version != self.unit.version:
            # Whoever reads evenly goes on with it, but what comes may soon be something else again.
            self._version, self._last = self.unit.version, None
            self._ahead.clear()
            self._count = max(1, self._count // 8)
        if self.unit.solo_queue.is_guided:
            # Only the sensor knows where it will be.
            self._step_s = math.inf
            self._ahead.clear()
        last = self._last
        if last is None or not last.time_s <= now_s < self.stays_until(last) - _SAME_S:
            self._last = last = self._next(now_s, before)
            # What it was too late for may have come to light.
            self._version = self.unit.version
        return last

    def stays_until(self, reading: Reading) -> float:
        """Until when [s] nobody gets another reading, if nothing else happens."""
        queue = self.unit.queue
        waits = queue.is_open and not queue.is_halted
        waits |= self.unit.solo_queue.is_guided
        still = not waits and queue.trajectory.duration <= reading.time_s
        return math.inf if still else reading.time_s + HOLDS_S

    def target(self, reading: Reading, tool: ToolData, wobj: WobjData, place: Place) -> RobTarget:
        """Where the TCP was then; see `Resolver.target`."""
        known = reading.targets.get((tool, wobj))
        # Another robot may hold the work object, and has moved since.
        if known is None or self.resolver.may_have_carrier(wobj):
            joints, external = reading.joints, reading.external
            known = self.resolver.target(joints, external, tool, wobj, place)
            reading.targets[tool, wobj] = known
        return known

    def _next(self, now_s: float, before_s: float | None) -> Reading:
        is_even = self._follow(now_s, before_s)
        while self._ahead and self._ahead[-1].time_s < now_s - _NEAR_S:
            self._ahead.pop()
        if self._ahead and self._ahead[-1].time_s <= now_s + _NEAR_S:
            return self._ahead.pop().at(now_s)
        self._count = min(2 * self._count, _AT_ONCE) if is_even else 1
        to_come = now_s + np.arange(1, self._count) * self._step_s
        near = (to_come[:, np.newaxis] + np.array([-_NEAR_S, 0.0, _NEAR_S])).ravel()
        samples = self.unit.queue.seen(now_s, np.append(now_s, near))
        self._ahead = [
            _Expected(time_s, samples.joints[k : k + 3], samples.external[k : k + 3])
            for time_s, k in zip(to_come.tolist(), range(1, len(samples.joints), 3), strict=True)
        ][::-1]
        return Reading(now_s, samples.joints[0], samples.external[0], {})

    def _follow(self, now_s: float, before_s: float | None) -> bool:
        """Whether a reading comes after the one before as that did after its own."""
        step_s = math.inf if before_s is None else now_s - before_s
        is_even = abs(step_s - self._step_s) < _NEAR_S
        if is_even:
            self._steps += 1
            # Over all of them, for one by one they are uneven.
            self._step_s = (now_s - self._even_from_s) / self._steps
        else:
            self._even_from_s, self._steps = now_s - step_s, 1
            self._step_s = step_s
        return is_even
