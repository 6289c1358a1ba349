"""Motion that was not planned: joints once per cycle, as requested by an external sensor.

Between cycles accelerations are constant, so no interpolation is needed here either.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rapidsim.frames.transform import Array, Transform

_STEP_S = 0.001
"""Half the interval [s] of the central difference for the speed of the TCP."""
_FIRST_ROOM = 256


@dataclass(eq=False)
class GuidedSection:
    """A guided motion; it can only be extended, or ended earlier."""

    start_s: float
    cycle_s: float
    forward: Callable[[Array], Transform]
    """Returns base_from_flange of joints (k, n) [rad]."""
    tcp_from_flange: Transform
    external: Array
    """Values of the external axes (e,) during the motion [m or rad]."""
    start: Array
    """Joints (n,) [rad] at the start, at rest."""
    _count: int = 0
    _dropped: int = 0
    """Number of discarded cycles."""
    _joints: Array = field(init=False)
    """Joints, then speeds, at the start and at the end of each known cycle, with spare capacity."""

    def __post_init__(self) -> None:
        """Start at rest."""
        self._joints = np.zeros((_FIRST_ROOM, 2, len(self.start)))
        self._joints[0, 0] = self.start

    @property
    def end_s(self) -> float:
        """Time [s] up to which it is known."""
        return self.start_s + self._count * self.cycle_s

    @property
    def end(self) -> Array:
        """Joints (n,) [rad] at the current end."""
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

    def end_after(self, cycles: int) -> None:
        """Discard what is known after so many cycles, which have not been discarded."""
        self._count = min(self._count, cycles)

    def forget(self, before_s: float) -> None:
        """Discard data that queries for a time [s] or later do not need."""
        past = int((before_s - self.start_s) / self.cycle_s) - 1
        gone = min(past, self._count) - self._dropped
        if gone > 0:
            self._joints = self._joints[gone:].copy()
            self._dropped += gone

    def joints_at(self, times: Array) -> Array:
        """Return joints (k, n) [rad] at instants (k,) [s]; at rest before and after."""
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
        """Return base_from_tcp (k,) of joints (k, n) [rad]."""
        return self.forward(joints) @ self.tcp_from_flange.inverse()[None]

    def tcp_speed_at(self, times: Array) -> Array:
        """Return the speed (k,) [m/s] of the TCP in base."""
        before, after = self.joints_at(times - _STEP_S), self.joints_at(times + _STEP_S)
        way = self.tcp_at(after).translation - self.tcp_at(before).translation
        speed: Array = np.linalg.norm(way, axis=1) / (2.0 * _STEP_S)
        return speed
