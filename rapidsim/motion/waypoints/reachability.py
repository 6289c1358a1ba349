"""Reachability of points, the distance of unreachable ones, and the pitch of a free tool.

A free pitch is chosen in the middle of the range that the joints allow, point by point.
"""

from __future__ import annotations

from math import degrees, radians

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.reachability import (
    Unreachable,
    limit_excess,
    turns_within_limits,
    unreachable_reason,
)
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.unwrapping import principal
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.waypoints.points import Points, posed
from rapidsim.values import value_class

_PITCH_STEP = radians(0.5)
_PITCHES: Array = _PITCH_STEP * np.arange(-360.0, 360.0)
"""All pitches that are tried, -180 to 179.5 deg."""


@value_class(frozen=True, slots=True)
class PointReach:
    """Reachability of one point for an arm."""

    reason: Unreachable | None
    """Reason why the point is unreachable; None if it is reached."""
    pitch: float | None = None
    """Pitch [rad] that was chosen if free, or with the smallest deviation."""
    pitches: tuple[float, float] | None = None
    """Range of pitches [rad] in which the point is reached, if the pitch is free."""

    @property
    def reachable(self) -> bool:
        """Whether the arm reaches the point within its limits."""
        return self.reason is None

    @property
    def message(self) -> str | None:
        """Description of the deviation in mm and degrees; None if the point is reached."""
        if self.reason is None:
            return None
        if self.pitch is None:
            return self.reason.message
        return f"at no pitch; closest at {degrees(self.pitch):g} deg: {self.reason.message}"


def reach(
    robot: Robot, points: Points, flange_from_tcp: Transform
) -> tuple[tuple[PointReach, ...], Array]:
    """Return the reachability of every point separately.

    Returns:
        Reachability of each point, and the attitudes (k, 4) or (k, 1), chosen if free.
    """
    if points.attitudes is not None:
        base_from_flange = posed(points.positions, points.attitudes) @ flange_from_tcp.inverse()
        found = tuple(
            PointReach(unreachable_reason(robot, base_from_flange[row]))
            for row in range(len(points))
        )
        return found, points.attitudes
    free = tuple(_in_any_pitch(robot, at, flange_from_tcp) for at in points.positions)
    return free, np.array([[point.pitch] for point in free], dtype=np.float64)


def _in_any_pitch(robot: Robot, position: Array, flange_from_tcp: Transform) -> PointReach:
    positions = np.broadcast_to(position, (len(_PITCHES), 3))
    base_from_flange = posed(positions, _PITCHES[:, None]) @ flange_from_tcp.inverse()
    branches = robot.inverse(base_from_flange)
    excess = np.abs(limit_excess(robot, turns_within_limits(robot, branches.joints))).max(axis=-1)
    excess = np.where(branches.exists, excess, np.inf).min(axis=-1)
    possible = excess == 0.0
    if possible.any():
        first, last = _widest_run(possible)
        low, high = first * _PITCH_STEP - np.pi, last * _PITCH_STEP - np.pi
        middle = _PITCH_STEP * ((first + last) // 2) - np.pi
        return PointReach(None, float(principal(np.array(middle))), (low, high))
    if np.isfinite(excess).any():
        best = int(np.argmin(excess))
    else:
        tilt = 0.0 if branches.tilt is None else branches.tilt
        best = int(np.argmin(branches.shortfall + 1e-6 * tilt))
    return PointReach(unreachable_reason(robot, base_from_flange[best]), float(_PITCHES[best]))


def _widest_run(possible: Mask) -> tuple[int, int]:
    """Return ends of the longest cyclic run of True; the last may be past the end of the array."""
    count = len(possible)
    if possible.all():
        return 0, count - 1
    shift = int(np.argmin(possible))
    edges = np.diff(np.concatenate([[0], np.roll(possible, -shift).astype(np.int64), [0]]))
    first, behind = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    widest = int(np.argmax(behind - first))
    start = (int(first[widest]) + shift) % count
    return start, start + int(behind[widest] - first[widest]) - 1
