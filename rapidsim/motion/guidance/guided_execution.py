"""Execution of a guidance from start to end by cycles: a function of the sensor's answers.

The cycles and the answers determine the motion to the last bit: in the engine that moves the robot,
in the separate process that communicates with the sensor, and in the replay of a journal.
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
    """Reason for the end of the guidance."""

    CONVERGED = auto()
    STOPPED = auto()
    """The program has stopped it."""
    SILENT = auto()
    """No message from the sensor for too long."""
    OUT_OF_REACH = auto()
    """The arm cannot reach the sensor's goal."""

    @property
    def is_failure(self) -> bool:
        """Whether the end was not requested."""
        return self in (EndReason.SILENT, EndReason.OUT_OF_REACH)


@value_class(frozen=True, slots=True)
class EndConditions:
    """Conditions under which a guidance ends, and its start and end ramps."""

    condition_s: float
    """Time [s] for which the goal must be near."""
    ramp_in_s: float
    """Time [s] in which the guidance reaches full strength."""
    silence_s: float
    """Longest time [s] without a message from the sensor."""
    moves_back: bool
    """Whether the robot ends at its start position."""
    ramp_out_s: float
    """Requested time [s] of the return; longer if the axes need it."""
    ends_by_itself: bool = True
    """Whether nearness to the goal ends it."""


@value_class(slots=True, eq=False)
class GuidedExecution:
    """Motion of a robot under guidance; `step` advances it by a cycle."""

    motion: JointMotion
    aim: GuidanceGoal
    tuning: Tuning
    terms: EndConditions
    ended: EndReason | None = None
    """Reason for its end; the robot may still be braking or returning; None before the end."""
    is_met: bool = False
    """Whether the condition of the goal has held long enough."""
    has_answer: bool = False
    """Whether the sensor has sent anything."""
    is_over: bool = False
    """Whether the robot is at rest and will not move any more."""
    start: Array = field(init=False)
    _delayed: tuple[Array, Array] | None = None
    """Filtered goal and its speed of the last cycle, which the drives follow in this one."""
    _cycles: int = 0
    _silent: int = 0
    """Cycles since the last message of the sensor."""
    _near: int = 0
    """Cycles for which the goal has been near."""
    _moves_back: bool = False
    _ramp_out_s: float = 0.0
    _back: ReturnMotion | None = None
    _back_cycles: int = 0

    def __post_init__(self) -> None:
        """Start at the current joints."""
        self.start = self.motion.joints

    def step(self, answer: SensorAnswer | None) -> None:
        """Advance by a cycle with the sensor's answer since the last cycle."""
        self._cycles += 1
        if self.ended is not None or not self._is_guided(answer):
            self._bring_to_rest()

    def stop(self, *, moves_back: bool, ramp_out_s: float) -> None:
        """End the guidance: the robot stops, or returns to its start position."""
        if self.ended is None:
            self._end(EndReason.STOPPED, moves_back=moves_back, ramp_out_s=ramp_out_s)

    def cancel_return(self) -> None:
        """Stop at the current position instead of returning."""
        self._moves_back, self._back = False, None

    def _is_guided(self, answer: SensorAnswer | None) -> bool:
        """Follow the sensor's goal for a cycle; return False if there is none to follow."""
        if answer is not None and self.aim.accept(answer):
            self.has_answer, self._silent = True, 0
        else:
            self._silent += 1
            if self._silent * CYCLE_S > self.terms.silence_s:
                self._end(EndReason.SILENT, moves_back=False)
                return False
        goal = self.aim.goal(self.motion.joints)
        if goal is None or not all(np.isfinite(part).all() for part in goal):
            self._end(EndReason.OUT_OF_REACH, moves_back=False)
            return False
        ramp_s = self.terms.ramp_in_s
        share = 1.0 if ramp_s <= 0.0 else min(1.0, self._cycles * CYCLE_S / ramp_s)
        delayed, self._delayed = self._delayed, goal
        if delayed is not None:
            self.motion.towards(delayed[0], self.tuning, delayed[1], share)
        is_near = self.has_answer and self.aim.is_met(self.motion.joints)
        self._near = self._near + 1 if is_near else 0
        self.is_met = is_near and self._near * CYCLE_S >= self.terms.condition_s
        if self.is_met and self.terms.ends_by_itself:
            self._end(EndReason.CONVERGED, moves_back=self.terms.moves_back)
        return True

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
