"""Feasibility of many programmed lines and arcs, and the axes that limit their speed.

A survey for checking: each path is tested separately, from its start joints on their branch,
without corners and without dynamics. Poses are as dense as the joint motion requires. For failures
found here, `building.build_path` returns the exact place, one path at a time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from operator import attrgetter

import numpy as np
import numpy.typing as npt

from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array
from rapidsim.motion.configurations.confdata import has_branches
from rapidsim.motion.configurations.reachability import pose_excess
from rapidsim.motion.geometry.curves import Curves, curves_of
from rapidsim.motion.geometry.joint_mapping import JointMapper, arms_of
from rapidsim.motion.geometry.segment_rows import of_each
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.path.along_curves import LONGEST_CELL, WIDEST_CELL, Nodes, nodes_along, spread
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]

_MOST_CELLS = 200
_HALVINGS = 14
"""Bisections of a steep cell: 50 mm become 3 micrometres."""
_PAST_LIMIT = 1e-6
_NEARLY = 0.99
"""Share of an axis's speed from which on its use is computed exactly."""
_DIGITS = 6
"""Decimals of that share in which places differ; the rest depends on the processor."""
_NEAR = {"wrist": np.sin(np.radians(10.0)), "elbow": np.sin(np.radians(6.0)), "shoulder": 0.15}
"""`Singularity.distance` below which an axis may be limited by a singularity."""


@value_class(frozen=True, slots=True)
class SpeedBottleneck:
    """Point where an axis limits the programmed speed most."""

    axis: int
    """Axis, counted from 1."""
    share: float
    """Share of the programmed speed that this axis allows; below 1."""
    fraction: float
    """Share of the path before this point, 0 to 1."""
    singularity: str | None
    """Name of the nearby singularity; None if there is none."""


@value_class(frozen=True, slots=True, eq=False)
class SurveyedCurves:
    """Survey results for lines and arcs (m,)."""

    travel: Array
    """Path length of the TCP [m]."""
    turned: Array
    """Reorientation [rad]."""
    arrival: Array
    """Joints (m, n) [rad] at the end, whole turns included."""
    arrives: Mask
    """Whether the branch exists there."""
    broken: Mask
    """Whether the branch ends, jumps, or exceeds a joint limit along the path."""
    bottlenecks: Mapping[int, SpeedBottleneck]
    """By row; none where the axes allow the programmed speed along the whole path."""


def survey_curves(
    robot: Robot, segments: Sequence[Segment], max_speed: Array | None
) -> SurveyedCurves:
    """Survey lines and arcs that have passed `circle_fault`, each separately.

    Args:
        robot: The arm.
        segments: The paths to survey; the joints at their ends are ignored.
        max_speed: Axis speeds (n,) [rad/s]; None if unknown.
    """
    curves = curves_of(segments, robot.kinematics)
    arms = arms_of(segments, robot.kinematics, curves.joint_travel, curves.length)
    nodes = _nodes(curves, arms)
    row, joints = nodes.curve, nodes.joints[:, : robot.kinematics.joint_count]
    last = np.append(np.flatnonzero(np.diff(row)), len(row) - 1)
    past = (np.abs(pose_excess(robot, joints)) > _PAST_LIMIT).any(axis=-1) | ~nodes.exists
    broken = np.zeros(len(segments), dtype=bool)
    np.logical_or.at(broken, row, past)
    np.logical_or.at(broken, row[1:], nodes.jumps(robot.kinematics.turns))
    found = {} if max_speed is None else _hold_ups(robot, segments, curves, arms, nodes, max_speed)
    return SurveyedCurves(
        curves.travel,
        curves.angle,
        joints[last],
        nodes.exists[last],
        broken,
        {at: one for at, one in found.items() if not broken[at]},
    )


def _nodes(curves: Curves, arms: JointMapper) -> Nodes:
    """Return nodes on each curve's branch; places are shares of the curve."""
    turn = np.linalg.norm(curves.tool_turn, axis=-1) + np.linalg.norm(curves.frame_turn, axis=-1)
    cells = np.ceil(np.maximum(curves.travel / LONGEST_CELL, turn / WIDEST_CELL))
    cells = np.clip(cells, 2, _MOST_CELLS).astype(np.int64)
    row, share = spread(cells, np.ones(len(cells), dtype=np.bool_))

    def solve(share: Array, row: Index) -> tuple[Array, Mask]:
        motion = curves.at(row, share * curves.length[row])
        return arms.joints(motion, row, curves.start_joints[row])

    shortest = 1.5 * 0.5**_HALVINGS / cells
    turns = arms.kinematics.turns
    return nodes_along(share, row, np.arange(len(cells)), shortest, solve, turns)


def _hold_ups(
    robot: Robot,
    segments: Sequence[Segment],
    curves: Curves,
    arms: JointMapper,
    nodes: Nodes,
    max_speed: Array,
) -> dict[int, SpeedBottleneck]:
    """Return, by path, the point where an axis most exceeds its speed; only paths that have one."""
    joints, all_rows = nodes.joints[:, : robot.kinematics.joint_count], nodes.curve
    speed = of_each(segments, attrgetter("speed.tcp", "speed.reorientation"))
    near = np.flatnonzero(_may_be_held_up(curves, arms, nodes, joints / max_speed, speed)[all_rows])
    if not len(near):
        return {}
    joints, all_rows, places = joints[near], all_rows[near], nodes.place[near]
    row = all_rows[1:]
    motion = curves.at(all_rows, places * curves.length[all_rows])
    flange = arms.base_from_flange(motion, all_rows, curves.start_joints[all_rows])
    tcp = flange @ arms.tcp_from_flange[all_rows].inverse()
    way = np.linalg.norm(np.diff(tcp.translation, axis=0), axis=-1)
    before, after = tcp.rotation[:-1], tcp.rotation[1:]
    turn = np.linalg.norm(vector_from_rotation(after @ np.swapaxes(before, -1, -2)), axis=-1)
    time = np.maximum(way / speed[row, 0], turn / speed[row, 1])
    timed = of_each(segments, lambda segment: segment.duration is not None)[row]
    # With a carrier the speed is that in its frame, and external axes take part in it.
    counts = (row == all_rows[:-1]) & (time > 0.0) & ~timed & ~arms.carried_rows[row]
    usage = np.abs(np.diff(joints, axis=0)) / max_speed / np.where(counts, time, np.inf)[:, None]
    worst = usage.max(axis=-1)
    found: dict[int, SpeedBottleneck] = {}
    over = np.flatnonzero(worst > 1.0)
    # In ascending order, so that the largest of each path is stored last; of places that differ by
    # rounding only, as where an axis turns evenly, the first.
    for at in over[np.lexsort((-over, np.round(worst[over], _DIGITS)))].tolist():
        axis = int(usage[at].argmax())
        middle = 0.5 * (joints[at] + joints[at + 1])
        found[int(row[at])] = SpeedBottleneck(
            axis + 1,
            1.0 / float(worst[at]),
            0.5 * float(places[at] + places[at + 1]),
            near_singularity(robot, middle),
        )
    return found


def _may_be_held_up(
    curves: Curves, arms: JointMapper, nodes: Nodes, full_speed_s: Array, speed: Array
) -> Mask:
    """Mask of the paths (m,) on which an axis may exceed its speed.

    Path and orientation of a line proceed evenly, so their time follows without the pose of the
    tool. Arcs, and lines whose frame moves, are not decided here.

    Args:
        curves: The paths.
        arms: What the arm carries on them.
        nodes: Nodes (k,) on all of them.
        full_speed_s: Joints at the nodes, divided by their speeds, shape (k, n).
        speed: Programmed speeds of the TCP [m/s] and of the orientation [rad/s], shape (m, 2).
    """
    uneven = curves.frame_turn.any(axis=-1) | curves.detour.any(axis=-1) | arms.carried_rows
    turn = np.linalg.norm(curves.tool_turn, axis=-1)
    whole_s = np.maximum(curves.travel / speed[:, 0], turn / speed[:, 1])
    row, step = nodes.curve[1:], np.diff(nodes.place)
    needed_s = np.abs(np.diff(full_speed_s, axis=0)).max(axis=-1)
    held = (row == nodes.curve[:-1]) & (needed_s > _NEARLY * step * whole_s[row])
    uneven[row[held]] = True
    return uneven


def near_singularity(robot: Robot, joints: Array) -> str | None:
    """Name of the singularity near joints (n,) [rad]; None if none, or if solved by search."""
    if not has_branches(robot.kinematics):
        return None
    found = robot.kinematics.singularities(joints)
    return next((one.name for one in found if one.distance < _NEAR[one.name]), None)
