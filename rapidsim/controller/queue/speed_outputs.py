"""Analog outputs that follow the speed of the TCP: TriggSpeed."""

from __future__ import annotations

from dataclasses import field
from typing import ClassVar

import numpy as np

from rapidsim.controller.cell.cell import Cause, Cell
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.values import value_class

STEP_S = 0.012
"""Interval [s] at which an output is written."""
_MM = 1e-3


@value_class(frozen=True, slots=True)
class _Follower:
    """Parameters of an output that follows the speed, with the instruction that set it up."""

    cause: Cause
    per_mm_s: float
    lag_s: float


@value_class(slots=True)
class SpeedOutputs:
    """The outputs that follow one robot's speed: a `event_source.EventSource`.

    They are written while time passes and no further move can be queued, so the preview of the
    motion is what will happen.
    """

    on_path: ClassVar = True
    unit: MechanicalUnit
    cell: Cell
    _followers: dict[str, _Follower] = field(default_factory=dict)
    _written_s: float = 0.0

    def follow(
        self, cause: Cause, now_s: float, signal: str, per_mm_s: float, lag_s: float
    ) -> None:
        """Let an output be a factor times the future speed [mm/s]; a factor of 0 ends it."""
        self._followers[signal.lower()] = _Follower(cause, per_mm_s, lag_s)
        self._write(signal, self._followers[signal.lower()], now_s)
        if per_mm_s == 0.0:
            del self._followers[signal.lower()]

    def next_s(self) -> float | None:
        """Time [s] at which outputs are next written; None while the robot is at rest."""
        if not self._followers:
            return None
        ends_s = self.unit.preview().duration
        return min(self._written_s + STEP_S, ends_s) if self._written_s < ends_s else None

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Write all outputs; see `event_source.EventSource`."""
        del until_s
        time_s = self.next_s()
        assert time_s is not None
        time_s = max(time_s, passed_s)
        for signal, follower in self._followers.items():
            self._write(signal, follower, time_s)
        self._written_s = time_s
        return time_s

    def advance_to(self, time_s: float) -> None:
        """Skip the time at rest: outputs follow a robot from when it moves again."""
        self._written_s = max(self._written_s, time_s - STEP_S)

    def _write(self, signal: str, follower: _Follower, time_s: float) -> None:
        samples = self.unit.preview().at(np.array([time_s + follower.lag_s]))
        value = follower.per_mm_s * float(samples.tcp_speed[0]) / _MM
        self.cell.schedule(follower.cause, Moment(Instant(time_s)), {signal: value})
