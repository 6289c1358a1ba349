"""Control law for joints that follow a goal sent every few milliseconds: filters, gain, limits.

The goal passes a low-pass filter; the speed, gain times the remaining distance plus the sensor's
own, passes another; its integral is the position. A recorded run of RobotWare 6.15 is followed
within 0.02 degrees (rms) if the bandwidth of the second is taken in rad/s, not Hz, and a cycle
passes between filter and drive. That an axis always can brake in time, and keeps its own limits
of speed and acceleration, is ours.

Source: Application manual Externally Guided Motion, "The EGM control loop".
"""

from __future__ import annotations

import math
from dataclasses import field
from typing import Final

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.values import value_class

CYCLE_S: Final = 0.004
"""The controller's cycle [s]."""
BRAKING_SHARE: Final = 0.9
"""Share of its acceleration that an axis uses to brake for a goal or a limit."""
_FASTEST = 1e9
"""Speed [rad/s] above which a wish makes no difference."""
_SLOWEST = 1e-12
"""Speed [rad/s] at which an axis stands; a divisor."""
_LEAST_GAIN = 1e-9
"""Gain [1/s] below which nothing moves; its square is a divisor."""


@value_class(frozen=True, slots=True, eq=False)
class GuidedAxes:
    """Limits of the axes (n,) [rad, s]."""

    lower: Array
    upper: Array
    max_speed: Array
    max_acceleration: Array


@value_class(frozen=True, slots=True)
class Tuning:
    """Strength with which the axes follow their goal."""

    gain: float
    """Speed [rad/s] per rad of remaining distance: Kp x PosCorrGain; 0 for speed control only."""
    max_speed: float = math.inf
    """Largest speed [rad/s] of an axis; others are slowed down alike."""
    bandwidth: float = 0.0
    """Bandwidth [rad/s] of the filter of the speed; 0 for no filter."""


@value_class(slots=True, eq=False)
class LowPass:
    """Low-pass filters of first order in series, initially at rest."""

    frequencies_hz: tuple[float, ...]
    """0 for no filter."""
    start: Array
    shares: tuple[float, ...] = field(init=False)
    """Share of the remaining distance that each stage covers in a cycle."""
    _stages: list[Array] = field(init=False)

    def __post_init__(self) -> None:
        """Start at rest."""
        self.shares = tuple(map(_share, self.frequencies_hz))
        self._stages = [self.start for _ in self.shares]

    def follow(self, goal: Array) -> Array:
        """Return the filtered goal, a cycle later."""
        for number, share in enumerate(self.shares):
            stage = self._stages[number]
            goal = self._stages[number] = stage + share * (goal - stage)
        return goal


def _share(hertz: float) -> float:
    return filter_share(2.0 * math.pi * hertz)


def filter_share(bandwidth: float) -> float:
    """Share of the remaining difference that a filter of a bandwidth [rad/s] covers in a cycle.

    All of it without a bandwidth.
    """
    return 1.0 - math.exp(-bandwidth * CYCLE_S) if bandwidth > 0.0 else 1.0


@value_class(slots=True, eq=False)
class JointMotion:
    """Axes that move in steps of one cycle, with constant acceleration within each."""

    axes: GuidedAxes
    joints: Array
    """Shape (n,) [rad]."""
    speed: Array
    """Shape (n,) [rad/s]."""
    _wanted: Array | None = None
    """Filtered speed (n,) [rad/s] that the guidance wants; None before it begins."""

    def towards(self, goal: Array, tuning: Tuning, speed: Array, share: float = 1.0) -> None:
        """Advance by a cycle towards a goal.

        Args:
            goal: The goal (n,) [rad].
            tuning: Gain and speed limit.
            speed: Feed-forward (n,) [rad/s]: the goal's own speed.
            share: Share of their maximum speed that axes may use, while the guidance begins; 0..1.
        """
        wanted = self._approach(goal - self.joints, tuning.gain) if tuning.gain else 0.0
        most = share * np.minimum(self.axes.max_speed, tuning.max_speed)
        wanted = np.clip(wanted + speed, -_FASTEST, _FASTEST)
        # The slowest axis sets the pace of all, so that the robot keeps its direction.
        excess = float(np.max(np.abs(wanted) / np.maximum(most, _SLOWEST), initial=1.0))
        before = self.speed if self._wanted is None else self._wanted
        self._wanted = before + filter_share(tuning.bandwidth) * (wanted / excess - before)
        self.at_speed(np.clip(self._wanted, -most, most))

    def at_speed(self, wanted: Array) -> None:
        """Advance by a cycle and get as close to a speed (n,) [rad/s] as the axes can."""
        axes = self.axes
        wanted = np.clip(wanted, -axes.max_speed, axes.max_speed)
        brakes = 2.0 * BRAKING_SHARE * axes.max_acceleration
        # An axis must be able to stop before its limit.
        ahead = np.maximum(axes.upper - self.joints, 0.0)
        behind = np.maximum(self.joints - axes.lower, 0.0)
        wanted = np.minimum(wanted, np.minimum(np.sqrt(brakes * ahead), ahead / CYCLE_S))
        wanted = np.maximum(wanted, -np.minimum(np.sqrt(brakes * behind), behind / CYCLE_S))
        step = axes.max_acceleration * CYCLE_S
        speed = np.clip(wanted, self.speed - step, self.speed + step)
        joints = self.joints + 0.5 * CYCLE_S * (self.speed + speed)
        kept = np.clip(joints, axes.lower, axes.upper)
        self.joints, self.speed = kept, np.where(kept == joints, speed, 0.0)

    @property
    def is_at_rest(self) -> bool:
        """Whether all axes are at rest."""
        return not self.speed.any()

    def _approach(self, remaining: Array, gain: float) -> Array:
        """Return the speed (n,) [rad/s]: proportional near the goal, brakeable further off.

        The two laws meet where speed and slope are equal.
        """
        brakes = BRAKING_SHARE * self.axes.max_acceleration
        gain = min(max(gain, _LEAST_GAIN), 0.5 / CYCLE_S)
        far = np.sqrt(2.0 * brakes * np.maximum(np.abs(remaining) - brakes / (2.0 * gain**2), 0.0))
        near = np.abs(remaining) <= brakes / gain**2
        return np.sign(remaining) * np.where(near, gain * np.abs(remaining), far)
