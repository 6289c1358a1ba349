"""Waypoints, with the attitude of the tool at each.

An attitude is a unit quaternion, or a pitch alone: then the tool is in the vertical plane through
axis 1 and the point, which is all that an arm with five axes can do and what a pen on a wall needs.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform, matrix_from_quaternion, slerp
from rapidsim.values import value_class

_ON_AXIS_1 = 1e-9
"""[m]; nearer to axis 1 a pitch has no direction, and forward is taken."""


@value_class(frozen=True, slots=True, eq=False)
class Points:
    """A sequence of points in the robot's base frame."""

    positions: Array
    """Shape (k, 3) [m]."""
    attitudes: Array | None
    """Quaternions (k, 4), scalar first, pitches (k, 1) [rad], or None: any pitch will do."""
    knots: Array | None = None
    """Shape (k,): parameter of a spline at each point; without it, the length of the chords."""
    times: Array | None = None
    """Shape (k,) [s]: when each is passed; without it, by the speed along the chords."""
    speeds: Array | None = None
    """Shape (k, n) [rad/s]: joint speeds at each; without it, 0."""
    accelerations: Array | None = None
    """Shape (k, n) [rad/s2]: joint accelerations at each; without it, 0."""
    numbers: npt.NDArray[np.int64] | None = None
    """Shape (k,): what messages call each; without it, they count from 1."""

    def __len__(self) -> int:
        """How many points there are."""
        return len(self.positions)

    def some(self, rows: npt.NDArray[np.int64]) -> Points:
        """A subset of the points, keeping their numbers."""
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
        """The number of a point in messages."""
        return row + 1 if self.numbers is None else int(self.numbers[row])

    def pair(self, row: int) -> str:
        """The name in messages of a point and the next."""
        return f"points {self.number(row)} and {self.number(row + 1)}"


def posed(positions: Array, attitudes: Array) -> Transform:
    """base_from_tcp at positions (k, 3) [m] in attitudes (k, 4) or (k, 1)."""
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
    """Attitudes (k, 4) or (k, 1), interpolated at shares (k,) from one to the other."""
    if len(start) == 4:
        return slerp(start, end, fraction)
    pitch: Array = start + np.asarray(fraction)[:, None] * (end - start)
    return pitch


def turn(start: Array, end: Array) -> float:
    """The angle [rad] between two attitudes of the same kind."""
    if len(start) == 4:
        near = -end if float(start @ end) < 0.0 else end
        chord, rest = np.linalg.norm(near - start), np.linalg.norm(near + start)
        return float(4.0 * np.arctan2(chord, rest))
    return float(abs(end[0] - start[0]))


def linear_turn_rates(angle: float) -> tuple[float, float]:
    """The rates of a rotation if quaternions are interpolated linearly, at its ends and middle.

    Args:
        angle: Of the whole rotation [rad], below a half turn.

    Returns:
        Rates [rad] per unit of the interpolation; `slerp` turns at `angle` throughout.
    """
    return 2.0 * float(np.sin(0.5 * angle)), 4.0 * float(np.tan(0.25 * angle))


def _rows(field: Array | None, rows: npt.NDArray[np.int64]) -> Array | None:
    return None if field is None else field[rows]
