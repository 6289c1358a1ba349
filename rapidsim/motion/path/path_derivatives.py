"""State of the arm at points of a path, and derivatives by the path's parameter."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.joint_mapping import Index
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class PathPoints:
    """State of the arm at points of a path."""

    joints: Array
    """Shape (k, n) [rad]."""
    external: Array
    """Shape (k, e) [m or rad]: the external axes."""
    base_from_tcp: Transform
    """Shape (k,); the tool is that of the segment."""
    segment: Index
    """Shape (k,): index in `Path.segments`."""
    tcp_rate: Array
    """Shape (k,): TCP travel against the work object per unit of s; below 1 in corners."""


@value_class(frozen=True, slots=True, eq=False)
class PathRates:
    """Derivatives with respect to s at points of a path."""

    first: Array
    """Shape (k, n + e): joints [rad/m], then external axes."""
    second: Array
    """Shape (k, n + e): joints [rad/m2], then external axes."""
    tcp_rate: Array
    """Shape (k,): TCP travel [m/m]."""
    turn_rate: Array
    """Shape (k,): reorientation [rad/m]."""

    stance: Array
    """Shape (k, 4 a): directions of lower arm and forearm of each of the a arms in its vertical
    plane, on which its inertia depends: sine and cosine of the angle from straight up of the lower
    arm, then of the forearm; of a SCARA sine and cosine of joint 2, then zeros; of other arms
    without meaning."""

    @staticmethod
    def not_filled(count: int, axes: int) -> PathRates:
        """Return uninitialised arrays for `count` points."""
        speeds = np.empty((2, count))
        joints = np.empty((2, count, axes))
        return PathRates(joints[0], joints[1], speeds[0], speeds[1], np.empty((count, 4)))

    def put(self, index: Index, rates: PathRates) -> None:
        """Replace some rows."""
        for mine, other in zip(self.columns, rates.columns, strict=True):
            mine[index] = other

    def beyond(self, count: int) -> PathRates:
        """Return all rows after the first `count`."""
        return PathRates(*(part[count:] for part in self.columns))

    def and_then(self, more: PathRates) -> PathRates:
        """Return these points followed by others."""
        parts = zip(self.columns, more.columns, strict=True)
        return PathRates(*(np.concatenate(pair) for pair in parts))

    @property
    def columns(self) -> tuple[Array, Array, Array, Array, Array]:
        """The five arrays, in this order."""
        return self.first, self.second, self.tcp_rate, self.turn_rate, self.stance


def norms(velocity: Array, turning: Array) -> Array:
    """Return the lengths (k, 2) of two rows of vectors (k, 3)."""
    return np.stack([np.linalg.norm(velocity, axis=-1), np.linalg.norm(turning, axis=-1)], axis=-1)
