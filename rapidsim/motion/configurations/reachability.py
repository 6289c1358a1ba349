"""Reason why a pose is unreachable: as a value with numbers, never NaN."""

from __future__ import annotations

from math import degrees, radians

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.numerical.solver import Numerical
from rapidsim.motion.kinematics.unwrapping import whole_turns
from rapidsim.motion.robot.external_axes import ROUNDED_AWAY, ROUNDED_POSE
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

LIMIT_TOLERANCE = 1e-9
"""Excess [rad] up to which a revolute joint counts as within its limits, for rounding."""
POSE_TOLERANCE = radians(ROUNDED_POSE)
"""Excess [rad] of a revolute joint that is accepted, with a warning, at a pose of a program."""
SLIDING_TOLERANCE = radians(ROUNDED_AWAY)
"""Tolerance of a sliding joint, 0.05 mm: targets at the top of its stroke are usual, and are
written with as many digits as the position of the flange."""


@value_class(frozen=True, slots=True)
class Unreachable:
    """Reason why a pose is unreachable: geometry, or the joint limit with the smallest excess."""

    shortfall: float
    """Distance [m] of the wrist centre from the workspace; 0 if a joint limit is the cause."""
    branch: int | None = None
    """Branch with the smallest excess of limits; None if the geometry is the cause."""
    joint: int | None = None
    """Joint with the largest excess on that branch, counted from 1."""
    excess: float = 0.0
    """Excess [rad] of that joint: positive above its upper limit, negative below its lower one."""
    measure: str = "deg"
    """RAPID's unit of that joint's values."""
    tilt: float = 0.0
    """Angle [rad] from the orientation to the nearest one that an arm with few axes can reach."""
    searched: bool = False
    """Whether a numerical search failed; shortfall and tilt are then of its nearest result."""
    beyond: float = 0.0
    """Lower bound [m] of the distance of the flange from the stretched arm, if searched."""

    @property
    def message(self) -> str:
        """The reason in workshop units: mm and degrees."""
        off_mm, off_deg = 1000.0 * self.shortfall, degrees(self.tilt)
        if self.searched and self.joint is None:
            nearest = f"the search came no nearer than {off_mm:.3g} mm and {off_deg:.3g} deg"
            if self.beyond == 0.0:
                return nearest
            return f"flange at least {_amount(1000.0 * self.beyond)} mm beyond reach; {nearest}"
        if self.joint is None and off_deg > 0.0 and off_mm > 0.0:
            return f"wrist centre {_amount(off_mm)} mm beyond reach, and {_turned(off_deg)}"
        if self.joint is None and off_deg > 0.0:
            return _turned(off_deg)
        if self.joint is None:
            return f"wrist centre {_amount(off_mm)} mm beyond reach"
        limit = "upper" if self.excess > 0.0 else "lower"
        over = degrees(abs(self.excess))
        return f"joint {self.joint} over by {_amount(over)} {self.measure} at its {limit} limit"


def turns_within_limits(robot: Robot, joints: Array) -> Array:
    """Return joint vectors (..., n) [rad] with each joint in the whole turn closest to its range.

    A joint that is still outside its range has no turn within the limits.
    """
    endless = np.isinf(robot.lower) | np.isinf(robot.upper)
    lower, upper = (np.where(endless, 0.0, limits) for limits in (robot.lower, robot.upper))
    middle = 0.5 * (lower + upper)
    return joints + whole_turns(middle - joints, robot.kinematics.turns)


def limit_excess(robot: Robot, joints: Array) -> Array:
    """Excess of joint vectors (..., n) [rad] over the limits: + above, - below, 0 within."""
    return _excess(robot, joints, limit_tolerance(robot))


def pose_excess(robot: Robot, joints: Array) -> Array:
    """Excess like `limit_excess`, for joints at poses of programs, which are rounded."""
    return _excess(robot, joints, pose_tolerance(robot))


def _excess(robot: Robot, joints: Array, tolerance: Array) -> Array:
    # An excess above the tolerance counts in full, apart from rounding.
    tolerated = tolerance - LIMIT_TOLERANCE
    above = joints - robot.upper - LIMIT_TOLERANCE
    below = robot.lower - joints - LIMIT_TOLERANCE
    over: Array = np.where(above > tolerated, above, 0.0) - np.where(below > tolerated, below, 0.0)
    return over


def limit_tolerance(robot: Robot) -> Array:
    """Tolerance of each joint limit (n,) [rad]."""
    return np.where(robot.kinematics.slides, SLIDING_TOLERANCE, LIMIT_TOLERANCE)


def pose_tolerance(robot: Robot) -> Array:
    """Tolerance of each joint limit (n,) [rad] for poses of programs."""
    return np.where(robot.kinematics.slides, SLIDING_TOLERANCE, POSE_TOLERANCE)


def programmed_excess(robot: Robot, joints: Array) -> Array:
    """Excess like `limit_excess`, for axis positions written in programs, which are rounded."""
    excess = limit_excess(robot, joints)
    return np.where(np.abs(excess) > robot.axes.tolerances[: joints.shape[-1]], excess, 0.0)


def external_excess(robot: Robot, external: Array) -> Array:
    """Excess like `programmed_excess`, for external axes (..., e) [m or rad]."""
    axes, first = robot.axes, len(robot.joints)
    upper, lower = axes.upper[first:], axes.lower[first:]
    excess = np.maximum(external - upper, 0.0) + np.minimum(external - lower, 0.0)
    return np.where(np.abs(excess) > axes.tolerances[first:], excess, 0.0)


def unreachable_reason(
    robot: Robot, base_from_flange: Transform, branch: int | None = None
) -> Unreachable | None:
    """Return the reason why one pose is unreachable; None if it is reachable.

    Args:
        robot: The arm.
        base_from_flange: One pose.
        branch: The only branch to consider; None for all.
    """
    branches = robot.kinematics.inverse(base_from_flange)
    wanted = branches.exists.copy()
    if branch is not None:
        wanted[:] = False
        wanted[branch] = branches.exists[branch]
    if not wanted.any():
        return Unreachable(
            shortfall=float(branches.shortfall),
            tilt=0.0 if branches.tilt is None else float(branches.tilt),
            searched=branches.searched,
            beyond=_beyond(robot, base_from_flange),
        )
    excess = limit_excess(robot, turns_within_limits(robot, branches.joints))
    worst = np.where(wanted, np.max(np.abs(excess), axis=-1), np.inf)
    best = int(np.argmin(worst))
    if worst[best] == 0.0:
        return None
    return over_limit(robot, best, excess[best])


def over_limit(robot: Robot, branch: int, excess: Array) -> Unreachable:
    """Return the reason for a joint vector that exceeds limits (n,) [rad]: the largest excess."""
    joint = int(np.argmax(np.abs(excess)))
    measure = robot.axes.measure(joint)
    return Unreachable(0.0, branch, joint + 1, float(excess[joint]), measure)


def _beyond(robot: Robot, base_from_flange: Transform) -> float:
    """Lower bound [m] of a flange's distance from the stretched arm; 0 if closed formulas exist."""
    if not isinstance(robot.kinematics, Numerical):
        return 0.0
    foot, longest = robot.kinematics.stretched
    return max(float(np.linalg.norm(base_from_flange.translation - foot)) - longest, 0.0)


def _amount(value: float) -> str:
    """Format with one decimal, or with the first nonzero digit if that would read 0.0."""
    return f"{value:.1f}" if value >= 0.05 else f"{value:.1g}"


def _turned(off_deg: float) -> str:
    return f"orientation {off_deg:.3g} deg from what the axes of this arm can give"
