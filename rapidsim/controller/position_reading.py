"""Reading the position of a task's arm, at any rate.

A reading is exact for the instant at which it is made, and holds for a millisecond, as long as a
value of `ClkRead`, or until an arm at rest moves. A program that reads in every turn of a loop
therefore gets a new reading each millisecond, later than turn by turn by no more than that.
Readings at regular intervals are computed in batches, ahead of time, for as long as nothing changes
the path. A program takes its intervals from a clock in single precision, so they are slightly
irregular: each predicted instant is computed with its neighbourhood.
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
"""Time [s] for which a reading holds. Unverified: no manual specifies the age of a position that a
program reads; the resolution of `ClkRead` is the finest that a program can distinguish."""
_AT_ONCE = 64
"""Maximum number of readings in a batch."""
_SAME_S = 1e-9
"""Instants that differ by less [s] are equal: the ticks of a loop sum to a rounding error less."""
_NEAR_S = 1e-4
"""Maximum deviation [s] of a reading from the regular interval. It is the resolution of a clock in
single precision after half an hour, and a parabola over so short a time misses an arm by 1e-7 rad
where its acceleration jumps, and by less than 1e-9 elsewhere."""


class Reading(NamedTuple):
    """Measured position of an arm."""

    time_s: float
    joints: Array
    """Shape (n,) [rad]."""
    external: Array
    """Shape (e,) [m or rad]."""
    targets: dict[tuple[ToolData, WobjData], RobTarget]
    """Robtargets computed from it so far, by tool and work object."""


class _Expected(NamedTuple):
    """Predicted position of an arm about an instant, if nothing changes."""

    time_s: float
    joints: Array
    """Shape (3, n) [rad]: `_NEAR_S` before the instant, at it, and as much after it."""
    external: Array
    """Shape (3, e) [m or rad]."""

    def at(self, now_s: float) -> Reading:
        """The arm at an instant near the predicted one."""
        part = (now_s - self.time_s) / _NEAR_S
        weights = (
            np.array([part * (part - 1.0), 2.0 - 2.0 * part * part, part * (part + 1.0)]) / 2.0
        )
        return Reading(now_s, weights @ self.joints, weights @ self.external, {})


@dataclass(slots=True, eq=False)
class PositionReader:
    """Reads one robot's position at times that never decrease."""

    unit: MechanicalUnit
    resolver: Resolver
    _version: tuple[int, int] | None = None
    """Version of the robot's plan for which the readings were made."""
    _last: Reading | None = None
    _ahead: list[_Expected] = field(default_factory=list)
    """Predicted readings, the next one last."""
    _even_from_s: float = math.inf
    """Time [s] of the first reading of the current regular series."""
    _steps: int = 1
    """Number of intervals since that first reading."""
    _step_s: float = math.inf
    """Mean interval [s] of the series."""
    _count: int = 1
    """Number of readings in the last batch."""

    def read(self, now_s: float) -> Reading:
        """Position of the robot at a time [s], or an earlier reading if that still holds."""
        self.unit.member.start_is_free = False
        before = None if self._last is None else self._last.time_s
        if self._version != self.unit.version:
            # A regular series continues, but the plan may change again soon: reduce the batch.
            self._version, self._last = self.unit.version, None
            self._ahead.clear()
            self._count = max(1, self._count // 8)
        if self.unit.member.is_guided:
            # The sensor's future values are unknown, so nothing can be predicted.
            self._step_s = math.inf
            self._ahead.clear()
        last = self._last
        if last is None or not last.time_s <= now_s < self.stays_until(last) - _SAME_S:
            self._last = last = self._next(now_s, before)
            # The read may have ended the block because it was too late for a corner, a new version.
            self._version = self.unit.version
        return last

    def stays_until(self, reading: Reading) -> float:
        """Time [s] until which `read` returns this reading if no event intervenes."""
        queue = self.unit.queue
        waits = queue.is_open and not queue.is_halted
        waits |= self.unit.member.is_guided
        still = not waits and self.unit.trajectory.duration <= reading.time_s
        return math.inf if still else reading.time_s + HOLDS_S

    def target(self, reading: Reading, tool: ToolData, wobj: WobjData, place: Place) -> RobTarget:
        """Robtarget of a reading in a tool and a work object; see `Resolver.target`."""
        known = reading.targets.get((tool, wobj))
        # Another robot that holds the work object may have moved since.
        if known is None or self.resolver.may_have_carrier(wobj):
            joints, external = reading.joints, reading.external
            time_s = reading.time_s
            known = self.resolver.target(joints, external, tool, wobj, place, time_s)
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
        samples = self.unit.seen(now_s, np.append(now_s, near))
        self._ahead = [
            _Expected(time_s, samples.joints[k : k + 3], samples.external[k : k + 3])
            for time_s, k in zip(to_come.tolist(), range(1, len(samples.joints), 3), strict=True)
        ][::-1]
        return Reading(now_s, samples.joints[0], samples.external[0], {})

    def _follow(self, now_s: float, before_s: float | None) -> bool:
        """Update the series with a reading; return whether it has the interval of the series."""
        step_s = math.inf if before_s is None else now_s - before_s
        is_even = abs(step_s - self._step_s) < _NEAR_S
        if is_even:
            self._steps += 1
            # The mean over all intervals, because single ones are irregular.
            self._step_s = (now_s - self._even_from_s) / self._steps
        else:
            self._even_from_s, self._steps = now_s - step_s, 1
            self._step_s = step_s
        return is_even
