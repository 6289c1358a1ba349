"""Motion that was not planned: joints once per cycle, as requested from outside.

Between cycles accelerations are constant, so nothing is interpolated here either.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rapidsim.frames.transform import Array, Transform

_STEP_S = 0.001
"""[s]; from an instant to the two beside it, by which the speed of the TCP is found."""
_FIRST_ROOM = 256


@dataclass(eq=False)
class GuidedSection:
    """A guided motion; it can only be extended."""

    start_s: float
    cycle_s: float
    forward: Callable[[Array], Transform]
    """base_from_flange of joints (k, n) [rad]."""
    tcp_from_flange: Transform
    external: Array
    """Where external axes (e,) stand meanwhile [m or rad]."""
    start: Array
    """Joints (n,) [rad] of an arm that stands."""
    _count: int = 0
    _dropped: int = 0
    """How many cycles are forgotten."""
    _joints: Array = field(init=False)
    """Joints, then speeds, at the end of each cycle that is known, with room for more; the start
    first."""

    def __post_init__(self) -> None:
        """Stand."""
        self._joints = np.zeros((_FIRST_ROOM, 2, len(self.start)))
        self._joints[0, 0] = self.start

    @property
    def end_s(self) -> float:
        """The time [s] up to which it is known."""
        return self.start_s + self._count * self.cycle_s

    @property
    def end(self) -> Array:
        """Joints (n,) [rad] at the end so far."""
        end: Array = self._joints[self._count - self._dropped, 0].copy()
        return end

    def append(self, joints: Array, speed: Array) -> None:
        """Extend by a cycle.

        Args:
            joints: Joints at its end (n,) [rad].
            speed: Axis speeds at its end (n,) [rad/s].
        """
        self._count += 1
        row = self._count - self._dropped
        if row == len(self._joints):
            self._joints = np.concatenate([self._joints, np.zeros_like(self._joints)])
        self._joints[row] = joints, speed

    def forget(self, before_s: float) -> None:
        """Forget what nobody who looks at a time [s] or later can see."""
        past = int((before_s - self.start_s) / self.cycle_s) - 1
        gone = min(past, self._count) - self._dropped
        if gone > 0:
            self._joints = self._joints[gone:].copy()
            self._dropped += gone

    def joints_at(self, times: Array) -> Array:
        """Joints (k, n) [rad] at instants (k,) [s]; at rest before and after."""
        way = np.clip((times - self.start_s) / self.cycle_s, 0.0, self._count)
        before = np.minimum(way.astype(np.int64), max(self._count - 1, 0))
        after = np.minimum(before + 1, self._count)
        share = (way - before)[:, None]
        before, after = before - self._dropped, after - self._dropped
        joints, speed = self._joints[before, 0], self._joints[before, 1]
        gained = self._joints[after, 1] - speed
        moved: Array = joints + self.cycle_s * share * (speed + 0.5 * share * gained)
        return np.where(share >= 1.0, self._joints[after, 0], moved)

    def tcp_at(self, joints: Array) -> Transform:
        """base_from_tcp (k,) of joints (k, n) [rad]."""
        return self.forward(joints) @ self.tcp_from_flange.inverse()[None]

    def tcp_speed_at(self, times: Array) -> Array:
        """Speed (k,) [m/s] of the TCP in base."""
        before, after = self.joints_at(times - _STEP_S), self.joints_at(times + _STEP_S)
        way = self.tcp_at(after).translation - self.tcp_at(before).translation
        speed: Array = np.linalg.norm(way, axis=1) / (2.0 * _STEP_S)
        return speed
