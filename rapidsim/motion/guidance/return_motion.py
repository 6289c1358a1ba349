"""The return to where a guidance began, in a given time or as fast as the axes can."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.guidance.joint_law import GuidedAxes
from rapidsim.values import value_class

_TOP_SPEED = 1.875
_TOP_ACCELERATION = 5.7735
"""Of the polynomial that begins and ends at rest, over a way and a time of 1."""


@value_class(frozen=True, slots=True, eq=False)
class ReturnMotion:
    """All axes in sync, from rest to rest."""

    start: Array
    end: Array
    duration_s: float

    def at(self, time_s: float) -> tuple[Array, Array]:
        """Joints (n,) [rad] and speeds (n,) [rad/s] a time [s] after the start."""
        if time_s >= self.duration_s:
            return self.end, np.zeros_like(self.end)
        u = time_s / self.duration_s
        share = u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
        rate = 30.0 * u**2 * (1.0 - u) ** 2 / self.duration_s
        way = self.end - self.start
        return self.start + share * way, rate * way


def return_motion(axes: GuidedAxes, start: Array, end: Array, duration_s: float) -> ReturnMotion:
    """A motion between two positions at rest, in the given time or what the axes need.

    Args:
        axes: Their limits.
        start: Joints (n,) [rad].
        end: Joints (n,) [rad].
        duration_s: The requested time [s].
    """
    way = np.abs(end - start)
    by_speed = float(np.max(_TOP_SPEED * way / axes.max_speed, initial=0.0))
    by_acceleration = float(
        np.max(np.sqrt(_TOP_ACCELERATION * way / axes.max_acceleration), initial=0.0)
    )
    return ReturnMotion(start, end, max(duration_s, by_speed, by_acceleration))
