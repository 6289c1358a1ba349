"""Feedback to a sensor about the robot that it guides, in the sensor's units."""

from __future__ import annotations

from dataclasses import replace
from enum import Enum, auto
from typing import Final

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.guidance.guided_execution import EndReason, GuidedExecution
from rapidsim.motion.guidance.sensor import in_degrees, in_millimetres
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.values import value_class


class Guided(Enum):
    """State of the guidance, as reported in the feedback."""

    NOT_YET = auto()
    RUNNING = auto()
    STOPPED = auto()
    FAILED = auto()


@value_class(frozen=True, slots=True)
class ProgramData:
    """Data of the program for the sensor."""

    digital: bool | None = None
    """Value of an output; None without one."""
    numbers: tuple[float, ...] = ()


NO_DATA: Final = ProgramData()


@value_class(frozen=True, slots=True)
class Feedback:
    """State of the robot at a time."""

    time_s: float
    joints: tuple[float, ...]
    """The arm's axes [deg]."""
    external: tuple[float, ...]
    """External axes [deg, mm]."""
    position: tuple[float, ...]
    """x, y, z [mm]."""
    orientation: tuple[float, ...]
    """q1..q4."""
    guided: Guided
    is_met: bool
    utilisation: float
    """Speed of the fastest axis relative to its maximum [%]."""
    executes: bool = True
    """Whether the program is running."""
    motors_on: bool = True
    sent: ProgramData = NO_DATA


@value_class(frozen=True, slots=True, eq=False)
class Frames:
    """Frames in which the TCP is reported."""

    kinematics: Kinematics
    tcp_from_flange: Transform
    report_from_base: Transform

    def pose(self, joints: Array) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return the position [mm] and q1..q4 of joints (n,) [rad]."""
        flange = self.kinematics.forward(joints)
        return in_millimetres(self.report_from_base @ flange @ self.tcp_from_flange.inverse())


@value_class(frozen=True, slots=True, eq=False)
class GuidedFeedback:
    """Feedback while the robot is guided."""

    frames: Frames
    external: tuple[float, ...]

    def __call__(self, run: GuidedExecution, time_s: float) -> Feedback:
        """Return the feedback at a time [s]."""
        motion = run.motion
        share = np.max(np.abs(motion.speed) / motion.axes.max_speed, initial=0.0)
        told = _guided_state(run.ended, is_over=run.is_over)
        there = standing_feedback(
            self.frames, time_s, motion.joints, self.external, told, float(100.0 * share)
        )
        return replace(there, is_met=run.is_met)


def standing_feedback(
    frames: Frames,
    time_s: float,
    joints: Array,
    external: tuple[float, ...],
    guided: Guided,
    utilisation: float,
) -> Feedback:
    """Return the feedback for joints (n,) [rad] at rest at a time [s]; see `Feedback`."""
    position, orientation = frames.pose(joints)
    return Feedback(
        time_s,
        in_degrees(joints),
        external,
        position,
        orientation,
        guided,
        is_met=False,
        utilisation=utilisation,
    )


def _guided_state(ended: EndReason | None, *, is_over: bool) -> Guided:
    if ended is not None and ended.is_failure:
        return Guided.FAILED
    return Guided.STOPPED if is_over else Guided.RUNNING
