"""Telling a sensor where a robot is that nobody guides: EGMStreamStart.

Nothing of the run hangs on it: the path is looked at, not decided.
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
from rapidsim.controller.queue.motion_queue import foreseen
from rapidsim.frames.transform import Array
from rapidsim.language.data import ToolData, WobjData
from rapidsim.motion.guidance.feedback import Feedback, Frames, Guided, standing_feedback
from rapidsim.motion.trajectory.trajectory import Samples

TELLS_S: Final = 0.020
"""So often [s] the controller looks where the robot is."""
_AHEAD_S: Final = 0.060
SPEED_STEP_S: Final = 0.001
"""[s]; from an instant to the one by which the speed of axes is found."""


@dataclass(slots=True, eq=False)
class SensorStream:
    """A stream that is on."""

    sensor: GuidanceSensor
    sample_s: float
    next_s: float
    """When the controller looks next [s]."""
    guided: Guided = Guided.NOT_YET
    """What the sensor is told of guidance meanwhile."""

    def send_due(
        self,
        unit: MechanicalUnit,
        resolver: Resolver,
        state: MotionState,
        tool: ToolData | None,
        wobj: WobjData | None,
    ) -> None:
        """Tell what is due."""
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
    """What a sensor is told of a robot on its path at instants (k,) [s].

    Args:
        unit: Whose robot it is.
        resolver: Likewise.
        told_in: The frames in which it is told, by where external axes (e,) stand [m or rad].
        times: Of the words.
        guided: What is told of guidance.
    """
    samples = foreseen(unit.queue).at(np.concatenate([times, times + SPEED_STEP_S]))
    return feedback_of(unit, resolver, told_in(samples.external[0]), samples, len(times), guided)


def feedback_of(
    unit: MechanicalUnit,
    resolver: Resolver,
    frames: Frames,
    samples: Samples,
    count: int,
    guided: Guided,
) -> list[Feedback]:
    """The same of samples: so many, and behind them those `SPEED_STEP_S` later."""
    now, later = samples.joints[:count], samples.joints[count : 2 * count]
    speeds = np.abs(later - now) / SPEED_STEP_S
    fastest = unit.solo_queue.planner.limits.max_speed[: now.shape[1]]
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
