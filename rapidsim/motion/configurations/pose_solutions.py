"""All solutions of an arm for one pose, or the reason for none: for interactive queries."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import (
    Integers,
    confdata_of,
    distinct,
    select,
    within_limits,
)
from rapidsim.motion.configurations.reachability import (
    Unreachable,
    limit_excess,
    over_limit,
    turns_within_limits,
    unreachable_reason,
)
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class PoseSolution:
    """Joints that bring the flange to a pose."""

    joints: Array
    """Shape (n,) [rad]."""
    confdata: tuple[int, int, int, int]
    """cf1, cf4, cf6, cfx."""
    within_limits: bool
    distance: float
    """Distance [m] from the pose, by forward kinematics."""
    angle: float
    """Angle [rad] of the rotation from the pose."""


@value_class(frozen=True, slots=True, eq=False)
class PoseSolutions:
    """The solutions of an arm for a pose."""

    solutions: tuple[PoseSolution, ...]
    reason: str | None
    """Reason why none of them is within the limits; None if one is."""


def solve_pose(robot: Robot, base_from_flange: Transform, *, everything: bool) -> PoseSolutions:
    """Solve one pose on all branches.

    Args:
        robot: The arm.
        base_from_flange: One pose.
        everything: Also all whole turns within the limits, and branches outside the limits.

    Returns:
        The solutions by branch; without `everything` one for each branch within the limits, in the
        turn closest to joint values 0.
    """
    branches = robot.inverse(base_from_flange)
    found: list[Array] = []
    for joints in distinct(branches.joints[branches.exists], robot.kinematics.turns):
        turns = list(within_limits(robot, joints))
        if everything:
            found += [np.array(turned) for turned in turns]
            found += [] if turns else [turns_within_limits(robot, joints)]
        elif turns:
            found.append(np.array(min(turns, key=lambda turned: sum(map(abs, turned)))))
    why = unreachable_reason(robot, base_from_flange)
    solutions = tuple(solution(robot, base_from_flange, joints) for joints in found)
    return PoseSolutions(solutions, why.message if why else None)


def solve_pose_as(
    robot: Robot, base_from_flange: Transform, confdata: Sequence[int]
) -> PoseSolutions:
    """Solve one pose in the configuration of a confdata: cf1, cf4, cf6 and cfx."""
    near = turns_within_limits(robot, np.zeros(len(robot.joints)))
    wanted: Integers = np.array([confdata], dtype=np.int64)
    selected = select(robot, base_from_flange[None], wanted, near)
    cfx = int(wanted[0, 3])
    if not 0 <= cfx < robot.kinematics.branch_count:
        last = robot.kinematics.branch_count - 1
        return PoseSolutions((), f"cfx {cfx} is not a branch; this arm has 0 to {last}")
    if not selected.exists[0]:
        why = unreachable_reason(robot, base_from_flange)
        if why is None or why.joint is not None:
            why = Unreachable(float(robot.inverse(base_from_flange).shortfall))
        return PoseSolutions((), f"branch cfx {cfx} does not reach the pose: {why.message}")
    there = solution(robot, base_from_flange, selected.joints[0])
    off = [
        f"cf{axis} is {stored + quarters}, not {stored}"
        for axis, stored, quarters in zip(
            (1, 4, 6), confdata[:3], selected.quarters_off[0].tolist(), strict=True
        )
        if quarters
    ]
    excess = limit_excess(robot, selected.joints[0])
    if off:
        return PoseSolutions((there,), f"on branch cfx {cfx} {', '.join(off)}")
    if excess.any():
        return PoseSolutions((there,), over_limit(robot, cfx, excess).message)
    return PoseSolutions((there,), None)


def solution(robot: Robot, base_from_flange: Transform, joints: Array) -> PoseSolution:
    """Return joints (n,) [rad] as a solution of a pose, with errors, confdata and limits."""
    flange = robot.forward(joints)
    turn = vector_from_rotation(base_from_flange.rotation @ flange.rotation.T)
    cf1, cf4, cf6, cfx = confdata_of(robot.kinematics, joints).tolist()
    return PoseSolution(
        joints=joints,
        confdata=(cf1, cf4, cf6, cfx),
        within_limits=not limit_excess(robot, joints).any(),
        distance=float(np.linalg.norm(base_from_flange.translation - flange.translation)),
        angle=float(np.linalg.norm(turn)),
    )
