"""Waypoints, with the attitude of the tool at each.

An attitude is a unit quaternion, or only a pitch: then the tool is in the vertical plane through
axis 1 and the point, which is all that a five-axis arm can reach and what a pen on a wall needs.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform, matrix_from_quaternion, slerp
from rapidsim.values import value_class

_ON_AXIS_1 = 1e-9
"""Distance [m] from axis 1 below which a pitch has no direction, and forward is used."""


@value_class(frozen=True, slots=True, eq=False)
class Points:
    """A sequence of points in the robot's base frame."""

    positions: Array
    """Shape (k, 3) [m]."""
    attitudes: Array | None
    """Quaternions (k, 4), scalar first, pitches (k, 1) [rad], or None if any pitch is allowed."""
    knots: Array | None = None
    """Shape (k,): parameter of a spline at each point; None for the length of the chords."""
    times: Array | None = None
    """Shape (k,) [s]: time at each point; None for times by the speed along the chords."""
    speeds: Array | None = None
    """Shape (k, n) [rad/s]: joint speeds at each; None for 0."""
    accelerations: Array | None = None
    """Shape (k, n) [rad/s2]: joint accelerations at each; None for 0."""
    numbers: npt.NDArray[np.int64] | None = None
    """Shape (k,): number of each in messages; None to count from 1."""

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.positions)

    def some(self, rows: npt.NDArray[np.int64]) -> Points:
        """Return a subset of the points, with their numbers."""
        return Points(
            positions=self.positions[rows],
            attitudes=_rows(self.attitudes, rows),
            knots=_rows(self.knots, rows),
            times=_rows(self.times, rows),
            speeds=_rows(self.speeds, rows),
            accelerations=_rows(self.accelerations, rows),
            numbers=np.array([self.number(row) for row in rows.tolist()], dtype=np.int64),
        )

    def number(self, row: int) -> int:
        """Return the number of a point in messages."""
        return row + 1 if self.numbers is None else int(self.numbers[row])

    def pair(self, row: int) -> str:
        """Return the name in messages of a point and the next."""
        return f"points {self.number(row)} and {self.number(row + 1)}"


def posed(positions: Array, attitudes: Array) -> Transform:
    """Return base_from_tcp at positions (k, 3) [m] in attitudes (k, 4) or (k, 1)."""
    if attitudes.shape[-1] == 4:
        return Transform(matrix_from_quaternion(attitudes), positions)
    x, y = positions[..., 0], positions[..., 1]
    away = np.where(np.hypot(x, y) > _ON_AXIS_1, np.arctan2(y, x), 0.0)
    ca, sa = np.cos(away), np.sin(away)
    cp, sp = np.cos(attitudes[..., 0]), np.sin(attitudes[..., 0])
    left = np.stack([-sa, ca, np.zeros_like(ca)], axis=-1)
    up = np.stack([-ca * sp, -sa * sp, cp], axis=-1)
    out = np.stack([ca * cp, sa * cp, sp], axis=-1)
    return Transform(np.stack([left, up, out], axis=-1), positions)


def between(start: Array, end: Array, fraction: Array) -> Array:
    """Return attitudes (k, 4) or (k, 1), interpolated at shares (k,) between two."""
    if len(start) == 4:
        return slerp(start, end, fraction)
    pitch: Array = start + np.asarray(fraction)[:, None] * (end - start)
    return pitch


def turn(start: Array, end: Array) -> float:
    """Return the angle [rad] between two attitudes of the same kind."""
    if len(start) == 4:
        near = -end if float(start @ end) < 0.0 else end
        chord, rest = np.linalg.norm(near - start), np.linalg.norm(near + start)
        return float(4.0 * np.arctan2(chord, rest))
    return float(abs(end[0] - start[0]))


def linear_turn_rates(angle: float) -> tuple[float, float]:
    """Return the rates of linear quaternion interpolation, at the ends and middle of a rotation.

    Args:
        angle: Angle of the whole rotation [rad], below a half turn.

    Returns:
        Rates [rad] per unit of the interpolation; `slerp` turns at `angle` throughout.
    """
    return 2.0 * float(np.sin(0.5 * angle)), 4.0 * float(np.tan(0.25 * angle))


def _rows(field: Array | None, rows: npt.NDArray[np.int64]) -> Array | None:
    return None if field is None else field[rows]
