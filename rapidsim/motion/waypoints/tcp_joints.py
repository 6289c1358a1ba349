"""Joints along a TCP path: in the configuration with the least motion, or a refusal."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from math import degrees

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.branch_choice import least_motion
from rapidsim.motion.configurations.confdata import confdata_of, has_branches
from rapidsim.motion.configurations.reachability import limit_excess, unreachable_reason
from rapidsim.motion.kinematics.unwrapping import turning
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.waypoints.branch_jumps import DECIDED_S, jump_on, with_small_steps
from rapidsim.motion.waypoints.branch_paths import BranchPath, branch_paths, steps_of_branches
from rapidsim.motion.waypoints.plan import Refused, TcpMotion
from rapidsim.motion.waypoints.points import Points
from rapidsim.repeated_rows import divided
from rapidsim.values import value_class

NOT_FROM_THERE = "it can be reached, but not in the configuration in which the arm arrives"
_SEARCHED_AT_ONCE = 8


@value_class(frozen=True, slots=True, eq=False)
class TcpJoints:
    """Joints along a motion of the TCP."""

    joints: Array
    """Shape (k, n) [rad]"""
    peaks: Array
    """Shape (n,) [rad/s]: largest speeds."""


def joints_of_tcp(
    robot: Robot,
    points: Points,
    motion: TcpMotion,
    sampled: Array,
    tcp_from_flange: Transform,
    start: Array | None,
    first: Array | None,
) -> TcpJoints | Refused:
    """Return joints at times (k,) [s] of a motion of the TCP.

    Args:
        robot: The arm.
        points: The points of the motion, for messages.
        motion: The motion of the TCP.
        sampled: The times.
        tcp_from_flange: Inverse of the tool.
        start: Joints (n,) [rad] near which to begin.
        first: Joints (n,) [rad] at the first point; if None and the solution with the least
            motion would have to change configurations, a configuration that works throughout is
            used.
    """

    def flange_at(times: Array) -> Transform:
        return motion.at(times)[0] @ tcp_from_flange

    def steps_of_solution(joints: Array | int) -> Array:
        if isinstance(joints, int):
            return np.zeros(1)
        steps = np.abs(turning(np.diff(joints, axis=0), robot.kinematics.turns))
        largest: Array = steps.max(axis=1)
        return largest

    times, joints = with_small_steps(
        _grid(sampled),
        lambda tried: solved(robot, flange_at(tried), start, first),
        steps_of_solution,
    )
    jump = None
    if not isinstance(joints, int):
        jump = jump_on(robot, motion, tcp_from_flange, times, joints)
        if jump is None:
            return _at_samples(times, joints, sampled)
    if not has_branches(robot.kinematics):
        wanted, segment = motion.at(times)
        poses = wanted @ tcp_from_flange
        return _not_searched(robot, points, poses, segment, times, joints, jump)
    # Without first joints, the message is about the configuration with the least motion.
    begin = first if first is not None or isinstance(joints, int) else joints[0]
    times, ways = with_small_steps(
        times,
        lambda tried: branch_paths(robot, tried, flange_at(tried), begin),
        partial(steps_of_branches, robot),
    )
    if first is None:
        for way in sorted(ways, key=lambda one: one.travel):
            free = way.message is None
            if free and jump_on(robot, motion, tcp_from_flange, times, way.joints) is None:
                return _at_samples(times, way.joints, sampled)
    return _path_failure(robot, points, motion.at(times)[1], times, ways, begin)


def _grid(sampled: Array) -> Array:
    """Return times (k,) with more where they are farther apart than those of a decision."""
    wide = np.maximum(np.ceil(np.diff(sampled) / DECIDED_S - 1e-9).astype(np.int64), 1)
    return divided(sampled, wide)


def _at_samples(times: Array, joints: Array, sampled: Array) -> TcpJoints:
    """Return joints (k, n) of times (k,) at those that are sampled, with the peaks of all."""
    speeds = np.abs(np.diff(joints, axis=0)) / np.diff(times)[:, None]
    return TcpJoints(joints[np.searchsorted(times, sampled)], speeds.max(axis=0))


def _path_failure(
    robot: Robot,
    points: Points,
    segment: npt.NDArray[np.int64],
    times: Array,
    candidates: Sequence[BranchPath],
    begin: Array | None,
) -> Refused:
    """Return the refusal of a path that no configuration follows, or not the initial one."""
    if not candidates:
        return Refused(f"point {points.number(0)} is out of reach", None, 0)
    conf = None if begin is None else tuple(confdata_of(robot.kinematics, begin).tolist())
    told = next((way for way in candidates if way.confdata == conf), candidates[0])
    others = tuple((way.confdata, way.message) for way in candidates if way is not told)
    free = next((way for way in candidates if way.message is None), None)
    help = "move the points, or take another attitude or --path joint"
    if free is not None:
        help = f"begin with --conf={','.join(map(str, free.confdata))}, which works all the way"
    return Refused(
        f"{when(points, segment, times, told.row)}: in configuration "
        f"{_brackets(told.confdata)} {told.message or 'the arm comes too near to a singularity'}",
        help,
        int(segment[told.row]),
        others,
    )


def _not_searched(
    robot: Robot,
    points: Points,
    base_from_flange: Transform,
    segment: npt.NDArray[np.int64],
    times: Array,
    joints: Array | int,
    jump: tuple[int, int, float] | None,
) -> Refused:
    """Return the refusal of a path for an arm solved by search, at the point of failure."""
    if isinstance(joints, int):
        why = unreachable_reason(robot, base_from_flange[joints])
        said, row = why.message if why else NOT_FROM_THERE, joints
        help = "use points closer together, another attitude, or another --path"
    else:
        assert jump is not None
        row, joint, size = jump
        said = (
            f"joint {joint + 1} would have to jump by {degrees(size):.0f} deg: the path passes a "
            "singularity"
        )
        help = "begin with other joints with --start, move the points, or use --path joint"
    return Refused(f"{when(points, segment, times, row)}: {said}", help, int(segment[row]))


def _brackets(conf: Sequence[int]) -> str:
    return f"[{','.join(map(str, conf))}]"


def solved(
    robot: Robot, base_from_flange: Transform, start: Array | None, first: Array | None
) -> Array | int:
    """Return joints (k, n) of poses (k,), or the index of the first unreachable pose."""
    if not has_branches(robot.kinematics):
        return _searched(robot, base_from_flange, start, first)
    if first is None:
        found = least_motion(robot, base_from_flange, start)
        return found if isinstance(found, int) else found.joints
    if len(base_from_flange) == 1:
        return first[None]
    rest = least_motion(robot, base_from_flange[1:], first)
    if isinstance(rest, int):
        return rest + 1
    return np.concatenate([first[None], rest.joints])


def _searched(
    robot: Robot, base_from_flange: Transform, start: Array | None, first: Array | None
) -> Array | int:
    """Return joints for an arm solved by search: each pose seeded with the previous one.

    Searching all solutions of every pose, to choose among them, would take a hundred times longer
    and find different ones each time.
    """
    if first is None:
        chosen = least_motion(robot, base_from_flange[:1], start)
        if isinstance(chosen, int):
            return 0
        first = chosen.joints[0]
    rows, before = [], first
    # Not all at once: after the first unreachable pose every search is long and without effect.
    for begin in range(0, len(base_from_flange), _SEARCHED_AT_ONCE):
        some = base_from_flange[begin : begin + _SEARCHED_AT_ONCE]
        found = robot.kinematics.inverse_on_branch(some, 0, before)
        missed = ~found.exists | limit_excess(robot, found.joints).any(axis=1)
        if missed.any():
            return begin + int(np.argmax(missed))
        rows.append(found.joints)
        before = found.joints[-1]
    return np.concatenate(rows)


def when(points: Points, segment: npt.NDArray[np.int64], times: Array, row: int) -> str:
    """Return the points before and after a sample, and its time [s], for messages."""
    return f"between {points.pair(int(segment[row]))} at {times[row]:.3f} s"
