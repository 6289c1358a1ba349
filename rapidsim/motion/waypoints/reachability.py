"""Which points an arm reaches, how far off the others are, and the pitch of a free tool.

A tool with free pitch is kept in the middle of what the joints allow, point by point.
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
    """The reach of an arm at one point."""

    reason: Unreachable | None
    """What keeps it from it; None if it is reached."""
    pitch: float | None = None
    """The pitch [rad] that was chosen where it is free, or where least is missing."""
    pitches: tuple[float, float] | None = None
    """From which pitch to which [rad] the point is reached, where it is free."""

    @property
    def reachable(self) -> bool:
        """Whether the arm can be there, within its limits."""
        return self.reason is None

    @property
    def message(self) -> str | None:
        """By how much the point is missed, in mm and degrees."""
        if self.reason is None:
            return None
        if self.pitch is None:
            return self.reason.message
        return f"at no pitch; closest at {degrees(self.pitch):g} deg: {self.reason.message}"


def reach(
    robot: Robot, points: Points, flange_from_tcp: Transform
) -> tuple[tuple[PointReach, ...], Array]:
    """Examine every point by itself.

    Returns:
        The reach at each, and the attitudes (k, 4) or (k, 1), chosen where they are free.
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
    """First and last of the longest run of True in a circle; the last may be beyond its end."""
    count = len(possible)
    if possible.all():
        return 0, count - 1
    shift = int(np.argmin(possible))
    edges = np.diff(np.concatenate([[0], np.roll(possible, -shift).astype(np.int64), [0]]))
    first, behind = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    widest = int(np.argmax(behind - first))
    start = (int(first[widest]) + shift) % count
    return start, start + int(behind[widest] - first[widest]) - 1
