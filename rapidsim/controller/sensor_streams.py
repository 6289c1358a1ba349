"""Telling a sensor where a robot is that nobody guides: EGMStreamStart.

Nothing of the run hangs on it: the path is looked at, not decided.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass
from typing import Final

import numpy as np

from rapidsim.controller.cell.sensors import Sensor
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.guidance_frames import told_frames
from rapidsim.controller.moves.guidance_start import used_axes
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.frames.transform import Array
from rapidsim.language.data import ToolData, WobjData
from rapidsim.motion.guidance.feedback import Guided, standing_feedback
from rapidsim.motion.trajectory.trajectory import Samples

TELLS_S: Final = 0.020
"""So often [s] the controller looks where the robot is."""
_AHEAD_S: Final = 0.060
_NEXT_S: Final = 0.001
"""[s]; from an instant to the one by which the speed of axes is found."""


@dataclass(slots=True, eq=False)
class SensorStream:
    """A stream that is on."""

    sensor: Sensor
    sample_s: float
    next_s: float
    """When the controller looks next [s]."""
    guided: Guided = Guided.NOT_YET
    """What the sensor is told of guidance meanwhile."""

    def tell(
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
            (now_s, now_s + _AHEAD_S) if self.sensor.looks_ahead else (now_s - TELLS_S, now_s)
        )
        first, last = (int(np.ceil(at / self.sample_s - 1e-6)) for at in (begin_s, end_s))
        times: Array = np.arange(max(first, 0), last, dtype=np.float64) * self.sample_s
        if not len(times):
            return
        trajectory = unit.queue.trajectory
        with suppress(MotionError):
            trajectory = unit.queue.preview()
        here, later = trajectory.at(times), trajectory.at(times + _NEXT_S)
        frames = told_frames(resolver, state, tool, wobj, here.external[0])
        speeds = np.abs(later.joints - here.joints) / _NEXT_S
        fastest = unit.own.planner.limits.max_speed[: here.joints.shape[1]]
        utilised = 100.0 * np.max(speeds / fastest, axis=1, initial=0.0)
        self.sensor.tell(
            [
                standing_feedback(
                    frames,
                    time_s,
                    here.joints[k],
                    _external(resolver, here, k),
                    self.guided,
                    float(utilised[k]),
                )
                for k, time_s in enumerate(times.tolist())
            ]
        )


def _external(resolver: Resolver, samples: Samples, row: int) -> tuple[float, ...]:
    external: Array = samples.external[row]
    return used_axes(resolver.ext_joint(external))
