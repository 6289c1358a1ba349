"""A guidance from start to end, cycle by cycle: a function of the sensor's answers.

The cycles and the answers determine the motion to the last bit: in the engine that moves the robot,
in the process beside it that talks to the sensor, and when a journal is replayed.
"""

from __future__ import annotations

import math
from dataclasses import field
from enum import Enum, auto

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.guidance.goals import GuidanceGoal
from rapidsim.motion.guidance.joint_law import CYCLE_S, JointMotion, Tuning
from rapidsim.motion.guidance.return_motion import ReturnMotion, return_motion
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.values import value_class


class EndReason(Enum):
    """What ended the guidance."""

    CONVERGED = auto()
    STOPPED = auto()
    """The program has."""
    SILENT = auto()
    """The sensor has said nothing for too long."""
    OUT_OF_REACH = auto()
    """The arm cannot get where the sensor wants it."""

    @property
    def is_failure(self) -> bool:
        """Whether the end was not requested."""
        return self in (EndReason.SILENT, EndReason.OUT_OF_REACH)


@value_class(frozen=True, slots=True)
class EndConditions:
    """When and how a guidance ends."""

    condition_s: float
    """So long [s] the goal must be near."""
    ramp_in_s: float
    """So long [s] the guidance takes to have its full strength."""
    silence_s: float
    """So long [s] the sensor may say nothing."""
    moves_back: bool
    """Whether the robot ends where it began."""
    ramp_out_s: float
    """In so long [s], if it can."""
    ends_by_itself: bool = True
    """Whether to be near ends it."""


@value_class(slots=True, eq=False)
class GuidedExecution:
    """The motion of a robot under guidance; `step` advances it by a cycle."""

    motion: JointMotion
    aim: GuidanceGoal
    tuning: Tuning
    terms: EndConditions
    ended: EndReason | None = None
    """What has ended it; the robot may still come to rest, or be on its way back."""
    is_met: bool = False
    """Whether the condition of the goal has held long enough."""
    has_answer: bool = False
    """Whether the sensor has said anything."""
    is_over: bool = False
    """Whether the robot stands, and will not move any more."""
    start: Array = field(init=False)
    _cycles: int = 0
    _silent: int = 0
    """Cycles since the sensor has said something."""
    _near: int = 0
    """Cycles for which the goal has been near."""
    _moves_back: bool = False
    _ramp_out_s: float = 0.0
    _back: ReturnMotion | None = None
    _back_cycles: int = 0

    def __post_init__(self) -> None:
        """Begin where the arm stands."""
        self.start = self.motion.joints

    def step(self, answer: SensorAnswer | None) -> None:
        """Advance by a cycle with the sensor's answer since the last one."""
        self._cycles += 1
        if self.ended is None:
            self._guide(answer)
        if self.ended is not None:
            self._bring_to_rest()

    def stop(self, *, moves_back: bool, ramp_out_s: float) -> None:
        """End the guidance: the robot comes to rest, or returns to where it began."""
        if self.ended is None:
            self._end(EndReason.STOPPED, moves_back=moves_back, ramp_out_s=ramp_out_s)

    def cancel_return(self) -> None:
        """Come to rest at the current position instead of returning."""
        self._moves_back, self._back = False, None

    def _guide(self, answer: SensorAnswer | None) -> None:
        if answer is not None and self.aim.accept(answer):
            self.has_answer, self._silent = True, 0
        else:
            self._silent += 1
            if self._silent * CYCLE_S > self.terms.silence_s:
                self._end(EndReason.SILENT, moves_back=False)
                return
        goal = self.aim.goal(self.motion.joints)
        if goal is None or not all(np.isfinite(part).all() for part in goal):
            self._end(EndReason.OUT_OF_REACH, moves_back=False)
            return
        ramp_s = self.terms.ramp_in_s
        share = 1.0 if ramp_s <= 0.0 else min(1.0, self._cycles * CYCLE_S / ramp_s)
        self.motion.towards(goal[0], self.tuning, goal[1], share)
        is_near = self.has_answer and self.aim.is_met(self.motion.joints)
        self._near = self._near + 1 if is_near else 0
        self.is_met = is_near and self._near * CYCLE_S >= self.terms.condition_s
        if self.is_met and self.terms.ends_by_itself:
            self._end(EndReason.CONVERGED, moves_back=self.terms.moves_back)

    def _end(self, reason: EndReason, *, moves_back: bool, ramp_out_s: float | None = None) -> None:
        self.ended, self._moves_back = reason, moves_back
        self._ramp_out_s = self.terms.ramp_out_s if ramp_out_s is None else ramp_out_s

    def _bring_to_rest(self) -> None:
        motion = self.motion
        if self._back is not None:
            self._back_cycles += 1
            motion.joints, motion.speed = self._back.at(self._back_cycles * CYCLE_S)
        elif not motion.is_at_rest:
            motion.at_speed(np.zeros_like(motion.speed))
            return
        elif self._moves_back:
            ramp_s = self._ramp_out_s if math.isfinite(self._ramp_out_s) else 0.0
            self._back = return_motion(motion.axes, motion.joints, self.start, max(0.0, ramp_s))
            return
        self.is_over = motion.is_at_rest
