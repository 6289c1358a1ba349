"""Streams of a robot's position to a sensor without guidance: EGMStreamStart.

Read-only: a stream never commits the path.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
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
from rapidsim.language.data import ToolData, WobjData
from rapidsim.motion.guidance.feedback import Feedback, Frames, Guided, standing_feedback
from rapidsim.motion.trajectory.samples import Samples

TELLS_S: Final = 0.020
"""Period [s] at which the controller reads the robot's position."""
_AHEAD_S: Final = 0.060
SPEED_STEP_S: Final = 0.001
"""Interval [s] over which the speed of axes is computed."""


@dataclass(slots=True, eq=False)
class SensorStream:
    """An active stream."""

    sensor: GuidanceSensor
    sample_s: float
    next_s: float
    """Time [s] of the next read of the position."""
    guided: Guided = Guided.NOT_YET
    """State of guidance that the sensor receives with the position."""

    def send_due(
        self,
        unit: MechanicalUnit,
        resolver: Resolver,
        state: MotionState,
        tool: ToolData | None,
        wobj: WobjData | None,
    ) -> None:
        """Send the positions that are due."""
        now_s, self.next_s = self.next_s, self.next_s + TELLS_S
        begin_s, end_s = (
            (now_s, now_s + _AHEAD_S) if self.sensor.has_lookahead else (now_s - TELLS_S, now_s)
        )
        first, last = (int(np.ceil(at / self.sample_s - 1e-6)) for at in (begin_s, end_s))
        times: Array = np.arange(max(first, 0), last, dtype=np.float64) * self.sample_s
        if not len(times):
            return
        told = partial(told_frames, resolver, state, tool, wobj)
        self.sensor.stream(feedback_at(unit, resolver, told, times, self.guided))


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
