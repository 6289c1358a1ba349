"""The motion of a robot that is jogged by a step: from rest to rest, and it can be halted."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.frames.transform import Array
from rapidsim.motion.configurations.jog_steps import JogArm, JogStep
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes
from rapidsim.motion.guidance.return_motion import ReturnMotion, return_motion
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.values import value_class

_TCP_SPEED: Final = 0.25
"""Fastest TCP [m/s] in manual mode."""
_AXIS_SHARE: Final = 0.25
"""Share of the speed of axes that a step uses."""
_RAMPED: Final = 1.875
"""Peak speed of a step over its mean."""
_PLACES: Final = 21


@value_class(frozen=True, slots=True, eq=False)
class JogMotion:
    """A step that a robot makes."""

    unit: MechanicalUnit
    arm: JogArm
    step: JogStep
    section: GuidedSection
    ramp: ReturnMotion
    """Share of the step over time, as one axis."""
    braking: float
    """Deceleration [1/s2] of which that axis is capable."""

    def halt(self, now_s: float) -> None:
        """Brake from a time [s] on; do not begin if it has not begun by then.

        Steps that follow this one must have been halted before.
        """
        if now_s <= self.section.start_s:
            self.unit.member.trajectory.withdraw_guidance()
            self.section.end_after(0)
            self._end()
            return
        cycle = math.ceil((now_s - self.section.start_s) / CYCLE_S)
        (share,), (rate,) = self.ramp.at(cycle * CYCLE_S)
        rates = np.linspace(rate, 0.0, math.ceil(rate / (self.braking * CYCLE_S)) + 1)
        gained = 0.5 * CYCLE_S * np.cumsum(rates[1:] + rates[:-1])
        joints = self.arm.along(self.step, np.minimum(np.append(share, share + gained), 1.0))
        if cycle * CYCLE_S < self.ramp.duration_s and not isinstance(joints, str):
            self.section.end_after(cycle)
            self._append(joints)

    def _append(self, joints: Array) -> None:
        """Append joints (k, n) [rad], one a cycle, of which the first are known."""
        inner = 0.5 * (joints[2:] - joints[:-2]) / CYCLE_S
        speeds = np.concatenate([inner, np.zeros_like(joints[:1])])
        for row, speed in zip(joints[1:], speeds, strict=False):
            self.section.append(row, speed)
        self._end()

    def _end(self) -> None:
        """Let the robot continue from the end of the step, as soon as it is there."""
        end, member = self.section.end, self.unit.member
        member.end = Waypoint(end, self.arm.robot.forward(end), self.section.external)
        member.ready_s = self.section.end_s
        member.start_is_free = False


def begin_step(unit: MechanicalUnit, arm: JogArm, step: JogStep, start_s: float) -> JogMotion | str:
    """Let a robot make a step from a time [s] on; or return why it is impossible."""
    coarse = arm.along(step, np.linspace(0.0, 1.0, _PLACES))
    if isinstance(coarse, str):
        return coarse
    ramp, braking = _ramp(unit, arm, coarse)
    times = CYCLE_S * np.arange(math.ceil(ramp.duration_s / CYCLE_S) + 1)
    joints = arm.along(step, np.array([ramp.at(one)[0][0] for one in times]))
    if isinstance(joints, str):
        return joints
    stands = unit.member.standing()
    section = GuidedSection(
        start_s,
        CYCLE_S,
        arm.robot.forward,
        arm.tcp_from_flange,
        stands.external,
        stands.joints,
    )
    motion = JogMotion(unit, arm, step, section, ramp, braking)
    unit.member.trajectory.guide(section)
    unit.queue.begin_again(start_s)
    motion._append(joints)
    return motion


def _ramp(unit: MechanicalUnit, arm: JogArm, coarse: Array) -> tuple[ReturnMotion, float]:
    """Return the share of a step over time, and the deceleration [1/s2] of which it is capable."""
    limits, count = unit.member.limits, len(arm.joints)
    flange = arm.robot.forward(coarse)
    tcp = (flange @ arm.tcp_from_flange.inverse()[None]).translation
    travelled = float(np.linalg.norm(np.diff(tcp, axis=0), axis=1).sum())
    # The path as one axis, whose speed and acceleration all axes of the arm can follow.
    rates = np.abs(np.diff(coarse, axis=0)).max(axis=0) * (_PLACES - 1)
    fastest, hardest = limits.max_speed[:count], limits.max_acceleration[:count]
    speed = float(np.min(_AXIS_SHARE * fastest / np.maximum(rates, 1e-9)))
    acceleration = float(np.min(_AXIS_SHARE * hardest / np.maximum(rates, 1e-9)))
    one = np.ones(1)
    axes = GuidedAxes(0.0 * one, one, speed * one, acceleration * one)
    ramp = return_motion(axes, 0.0 * one, one, max(0.1, _RAMPED * travelled / _TCP_SPEED))
    return ramp, acceleration
