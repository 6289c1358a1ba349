"""Why a pose cannot be reached: as a value with numbers, never NaN."""

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
"""A joint that turns counts as within its limits up to this [rad], for rounding."""
POSE_TOLERANCE = radians(ROUNDED_POSE)
"""A joint that turns may be past its limit by this [rad] at a pose of a program, with a warning."""
SLIDING_TOLERANCE = radians(ROUNDED_AWAY)
"""The same of a joint that slides, 0.05 mm: targets on top of its stroke are usual, and are written
with as many digits as the way of the flange."""


@value_class(frozen=True, slots=True)
class Unreachable:
    """What keeps an arm from a pose: its geometry, or the joint limit with the smallest excess."""

    shortfall: float
    """How far [m] the wrist centre is outside what the arm can reach; 0 if a limit is the cause."""
    branch: int | None = None
    """The branch that comes nearest to its limits; None if the geometry is the cause."""
    joint: int | None = None
    """The joint that is furthest over on that branch, counted from 1."""
    excess: float = 0.0
    """How far [rad] that joint is above its upper limit, or, if negative, below its lower one."""
    measure: str = "deg"
    """RAPID's unit of that joint's values."""
    tilt: float = 0.0
    """How far [rad] the orientation is from those that an arm with few axes can give."""
    searched: bool = False
    """Whether nothing was found by searching; shortfall and tilt are of the nearest found."""
    beyond: float = 0.0
    """How far [m] at least the flange is beyond the stretched arm, where that was searched."""

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
    """Joint vectors (..., n) [rad] with each joint in the whole turn closest to its range.

    A joint still outside its range then has no turn within the limits.
    """
    endless = np.isinf(robot.lower) | np.isinf(robot.upper)
    lower, upper = (np.where(endless, 0.0, limits) for limits in (robot.lower, robot.upper))
    middle = 0.5 * (lower + upper)
    return joints + whole_turns(middle - joints, robot.kinematics.turns)


def limit_excess(robot: Robot, joints: Array) -> Array:
    """By how much joint vectors (..., n) [rad] exceed limits: + above, - below, 0 within."""
    return _excess(robot, joints, limit_tolerance(robot))


def pose_excess(robot: Robot, joints: Array) -> Array:
    """Like `limit_excess`, for joints at poses of programs, which are rounded."""
    return _excess(robot, joints, pose_tolerance(robot))


def _excess(robot: Robot, joints: Array, tolerance: Array) -> Array:
    # What is over by more than is tolerated is over by all of it but rounding.
    tolerated = tolerance - LIMIT_TOLERANCE
    above = joints - robot.upper - LIMIT_TOLERANCE
    below = robot.lower - joints - LIMIT_TOLERANCE
    over: Array = np.where(above > tolerated, above, 0.0) - np.where(below > tolerated, below, 0.0)
    return over


def limit_tolerance(robot: Robot) -> Array:
    """The tolerance of each joint limit (n,) [rad]."""
    return np.where(robot.kinematics.slides, SLIDING_TOLERANCE, LIMIT_TOLERANCE)


def pose_tolerance(robot: Robot) -> Array:
    """The tolerance of each joint limit (n,) [rad] for poses of programs."""
    return np.where(robot.kinematics.slides, SLIDING_TOLERANCE, POSE_TOLERANCE)


def programmed_excess(robot: Robot, joints: Array) -> Array:
    """Like `limit_excess`, for axis positions written in programs, which are rounded."""
    excess = limit_excess(robot, joints)
    return np.where(np.abs(excess) > robot.axes.tolerances[: joints.shape[-1]], excess, 0.0)


def unreachable_reason(
    robot: Robot, base_from_flange: Transform, branch: int | None = None
) -> Unreachable | None:
    """Why one pose cannot be reached; None if it can.

    Args:
        robot: The arm.
        base_from_flange: One pose.
        branch: The only branch to consider; all if not given.
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
    """The reason for a joint vector that exceeds limits (n,) [rad]: the worst of them."""
    joint = int(np.argmax(np.abs(excess)))
    measure = robot.axes.measure(joint)
    return Unreachable(0.0, branch, joint + 1, float(excess[joint]), measure)


def _beyond(robot: Robot, base_from_flange: Transform) -> float:
    """How far [m] at least a flange is beyond the stretched arm; 0 where formulas tell better."""
    if not isinstance(robot.kinematics, Numerical):
        return 0.0
    foot, longest = robot.kinematics.stretched
    return max(float(np.linalg.norm(base_from_flange.translation - foot)) - longest, 0.0)


def _amount(value: float) -> str:
    """One decimal, and for what that would call 0.0 the first digit that is not 0."""
    return f"{value:.1f}" if value >= 0.05 else f"{value:.1g}"


def _turned(off_deg: float) -> str:
    return f"orientation {off_deg:.3g} deg from what the axes of this arm can give"
