"""Streams of a robot's position to a sensor without guidance: EGMStreamStart.

Read-only: a stream never commits the path.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Final

import numpy as np

from rapidsim.controller.cell.sensors import GuidanceSensor
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.guidance_frames import told_frames
from rapidsim.controller.moves.guidance_start import used_axes
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.frames.transform import Array
from rapidsim.language.guidance import Activation
from rapidsim.motion.guidance.feedback import (
    Feedback,
    Frames,
    Guided,
    ProgramData,
    standing_feedback,
)
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.motion.trajectory.samples import Samples

TELLS_S: Final = 0.020
"""Period [s] at which the controller reads the robot's position for a stream without answers."""
_AHEAD_S: Final = 0.060
_AWAITED_AHEAD: Final = 5
"""Number of samples sent at once to a sensor with look-ahead whose answers are awaited."""
_ROUNDING: Final = 1e-6
SPEED_STEP_S: Final = 0.001
"""Interval [s] over which the speed of axes is computed."""


@dataclass(slots=True, eq=False)
class SensorStream:
    """An active stream."""

    sensor: GuidanceSensor
    sample_s: float
    next_s: float
    """Time [s] of the next read of the position."""
    awaits: bool = False
    """Whether the program receives data from the sensor's answers."""

    def begin(self, now_s: float) -> None:
        """Begin at a time [s]."""
        self.next_s = now_s
        if self.awaits:
            self.next_s = math.ceil(now_s / self.sample_s - _ROUNDING) * self.sample_s
            self.sensor.correct(self.next_s, self.sample_s)

    def send_due(
        self,
        unit: MechanicalUnit,
        resolver: Resolver,
        state: MotionState,
        activation: Activation | None,
        sent: ProgramData,
    ) -> SensorAnswer | None:
        """Send the positions that are due; return the sensor's answer if the program awaits it."""
        times = self._due()
        if not len(times):
            return None
        tool = None if activation is None else activation.tool
        wobj = None if activation is None else activation.wobj
        frames = partial(told_frames, resolver, state, tool, wobj)
        stream = feedback_at(unit, resolver, frames, times, Guided.NOT_YET)
        stream = [replace(feedback, sent=sent) for feedback in stream]
        if not self.awaits or self.sensor.has_lookahead:
            self.sensor.stream(stream)
        return self.sensor.exchange(stream[0]) if self.awaits else None

    def _due(self) -> Array:
        """Return the times (k,) [s] of the positions that are due."""
        now_s, ahead = self.next_s, self.sensor.has_lookahead
        if self.awaits:
            self.next_s += self.sample_s
            samples = np.arange(_AWAITED_AHEAD if ahead else 1, dtype=np.float64)
            return now_s + self.sample_s * samples
        self.next_s += TELLS_S
        begin_s, end_s = (now_s, now_s + _AHEAD_S) if ahead else (now_s - TELLS_S, now_s)
        first, last = (int(np.ceil(at / self.sample_s - _ROUNDING)) for at in (begin_s, end_s))
        return np.arange(max(first, 0), last, dtype=np.float64) * self.sample_s


def feedback_at(
    unit: MechanicalUnit,
    resolver: Resolver,
    told_in: Callable[[Array], Frames],
    times: Array,
    guided: Guided,
) -> list[Feedback]:
    """Feedback to a sensor about a robot on its path at instants (k,) [s].

    Args:
        unit: The robot.
        resolver: Of the robot.
        told_in: Returns the frames of the feedback for external axes (e,) [m or rad].
        times: Instants of the feedback.
        guided: State of guidance in the feedback.
    """
    samples = unit.foreseen().at(np.concatenate([times, times + SPEED_STEP_S]))
    return feedback_of(unit, resolver, told_in(samples.external[0]), samples, len(times), guided)


def feedback_of(
    unit: MechanicalUnit,
    resolver: Resolver,
    frames: Frames,
    samples: Samples,
    count: int,
    guided: Guided,
) -> list[Feedback]:
    """Feedback from samples: `count` of them, followed by those `SPEED_STEP_S` later."""
    now, later = samples.joints[:count], samples.joints[count : 2 * count]
    speeds = np.abs(later - now) / SPEED_STEP_S
    fastest = unit.member.limits.max_speed[: now.shape[1]]
    utilised = 100.0 * np.max(speeds / fastest, axis=1, initial=0.0)
    return [
        standing_feedback(
            frames,
            float(samples.times[k]),
            now[k],
            _external(resolver, samples, k),
            guided,
            float(utilised[k]),
        )
        for k in range(count)
    ]


def _external(resolver: Resolver, samples: Samples, row: int) -> tuple[float, ...]:
    external: Array = samples.external[row]
    return used_axes(resolver.ext_joint(external))
