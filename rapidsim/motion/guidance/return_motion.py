"""Return to the start position of a guidance, in a requested time or as fast as the axes can."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.guidance.joint_law import GuidedAxes
from rapidsim.values import value_class

_TOP_SPEED = 1.875
_TOP_ACCELERATION = 5.7735
"""Peaks of the rest-to-rest polynomial over a distance and a time of 1."""


@value_class(frozen=True, slots=True, eq=False)
class ReturnMotion:
    """Synchronised motion of all axes, from rest to rest."""

    start: Array
    end: Array
    duration_s: float

    def at(self, time_s: float) -> tuple[Array, Array]:
        """Return joints (n,) [rad] and speeds (n,) [rad/s] a time [s] after the start."""
        if time_s >= self.duration_s:
            return self.end, np.zeros_like(self.end)
        u = time_s / self.duration_s
        share = u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
        rate = 30.0 * u**2 * (1.0 - u) ** 2 / self.duration_s
        way = self.end - self.start
        return self.start + share * way, rate * way


def return_motion(axes: GuidedAxes, start: Array, end: Array, duration_s: float) -> ReturnMotion:
    """Return a rest-to-rest motion in the requested time, or longer if the axes need it.

    Args:
        axes: Axis limits.
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
