"""Inverse kinematics along the Cartesian curves of a path on their branches, with path faults."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from enum import Enum

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.joint_mapping import Index, JointMapper
from rapidsim.motion.geometry.parameterisation import PathParameterisation
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.unwrapping import turning
from rapidsim.motion.path.along_curves import LONGEST_CELL, WIDEST_CELL, Nodes, nodes_along, spread
from rapidsim.motion.path.line_derivatives import Lines
from rapidsim.motion.path.wrist_circle import wrist_circle_refusal
from rapidsim.motion.robot.external_axes import Axes
from rapidsim.values import value_class

_SHORT_PIECE = 0.005
"""Length [m] of a piece up to which only its ends are solved at first, not its middle."""
_SHORTEST_CELL = 2e-5
_SHORTEST_SHARE = 1e-2
"""TCP distance [m], or share of a short curve, within which an axis that turns by half a radian has
to jump: with axis 5 nearer to 0 than 0.006 deg on most arms. The controller stops earlier."""
_LIMIT_TOLERANCE = 1e-6
_MATCH_TOLERANCE = 1e-3
_BRANCH_TOLERANCE = 0.02
_SAME_PLACE = 1e-9


class FaultKind(Enum):
    """Cause that prevents an arm from following a path."""

    REACH = "reach"
    """Reach or a limit of the arm."""
    SINGULARITY = "singularity"
    """The path passes through it, or so close that a wrist axis would have to jump."""
    CONFIGURATION = "configuration"
    """The branch at the start does not lead to the end joints."""
    WRIST_PAIR = "wrist pair"
    """Two wrist axes alone cannot guide the tool along the arc, or not within their limits."""
    SET_UP = "set-up"
    """The geometry of the move is undefined."""
    NOT_SIMULATED = "not simulated"
    """Paths of this kind of arm are not simulated."""


@value_class(frozen=True, slots=True)
class PathFault:
    """First point where a path is infeasible, with the reason."""

    segment: int
    """Index in the sequence of segments from which the path was built."""
    fraction: float
    """Share of that segment, 0 to 1."""
    place: float
    """s of the path [m]."""
    distance: float
    """TCP travel [m] on that segment before the fault."""
    reason: str
    """Cause, with numbers."""
    kind: FaultKind = FaultKind.REACH
    cure: str | None = None
    """Remedy, if that depends on the numbers; else None."""
    robot: int = 0
    """Index of the robot, if several share the path."""


def follow(
    layout: PathParameterisation,
    arms: JointMapper,
    lines: Lines | None,
    segments: Sequence[Segment],
    axes: Axes,
    check_deadline: Look = undisturbed,
) -> Nodes | PathFault:
    """Solve the joints along every Cartesian curve of a path.

    Args:
        layout: The path.
        arms: Branch and tool of each curve.
        lines: The lines with closed-form derivatives.
        segments: The segment of each curve.
        axes: Limits of the arm's joints and of the external axes.
        check_deadline: Called regularly.

    Returns:
        The joints, or the first point where the branch ends, jumps, does not match the joints at a
        segment's start or end, or exceeds the limits. `PathFault.segment` counts curves.
    """
    place, piece = _first_nodes(layout)
    shortest = np.minimum(_SHORTEST_CELL, _SHORTEST_SHARE * layout.curves.length)

    def solve(place: Array, piece: Index) -> tuple[Array, Mask]:
        check_deadline()
        return _raw_joints(layout, arms, lines, place, piece)

    nodes = nodes_along(place, piece, layout.row, shortest, solve, arms.kinematics.turns)
    # In corners in joint space the arm is not on the curve.
    on_path = np.flatnonzero(layout.joint_corner[nodes.part] < 0)
    candidates = (
        _unreached(layout, arms, nodes),
        _jump(layout, nodes, arms.kinematics.turns),
        _missed_waypoint(layout, nodes, segments, axes),
        _other_branch(layout, nodes, len(segments[0].start.joints), axes),
        limit_fault(
            layout, nodes.place[on_path], nodes.curve[on_path], nodes.joints[on_path], axes
        ),
    )
    faults = [fault for fault in candidates if fault is not None]
    if not faults:
        return nodes
    first = min(faults, key=lambda fault: fault.place)
    return replace(first, kind=FaultKind.WRIST_PAIR) if arms.pair_rows[first.segment] else first


def limit_fault(
    layout: PathParameterisation, s: Array, row: Index, joints: Array, axes: Axes
) -> PathFault | None:
    """Return the first of points (k,) whose joints (k, n + e) are outside the limits, or None."""
    lower, upper = axes.lower, axes.upper
    # The remaining columns are axes of other robots, whose limits are checked for those robots.
    joints = joints[:, : len(lower)]
    over = np.maximum(lower - joints, joints - upper)
    bad = np.flatnonzero((over > _LIMIT_TOLERANCE).any(axis=-1))
    if not len(bad) or not (over > axes.path_tolerances).any():
        return None
    first = int(bad[0])
    axis = int(over[first].argmax())
    # The worst point on this curve is more informative than the first node past the limit.
    same = bad[row[bad] == row[first]]
    worst = int(same[over[same, axis].argmax()])
    limit = lower[axis] if joints[worst, axis] < lower[axis] else upper[axis]
    reason = (
        f"{axes.name(axis)} goes to {axes.text(axis, joints[worst, axis])}, "
        f"{axes.text(axis, over[worst, axis])} past its limit of {axes.text(axis, limit)}"
    )
    place = float(s[first])
    if first and row[first - 1] == row[first] and over[first - 1, axis] <= 0.0:
        before, after = over[first - 1, axis], over[first, axis]
        place -= float((s[first] - s[first - 1]) * after / (after - before))
    return _fault(layout, int(row[first]), place, reason)


def _first_nodes(layout: PathParameterisation) -> tuple[Array, Index]:
    """Return initial places and pieces along all Cartesian curves, each curve with both ends."""
    pieces = np.flatnonzero(~layout.curves.in_joints[layout.row])
    row = layout.row[pieces]
    width = np.diff(layout.bounds)[pieces]
    length = np.maximum(layout.curves.length[row], 1e-300)
    turn = np.linalg.norm(layout.curves.tool_turn[row], axis=-1)
    turn += np.linalg.norm(layout.curves.frame_turn[row], axis=-1)
    cells = np.maximum(width / LONGEST_CELL, turn * width / length / WIDEST_CELL)
    cells = np.ceil(np.maximum(cells, np.where(width > _SHORT_PIECE, 2.0, 1.0))).astype(np.int64)
    last = np.append(row[1:] != row[:-1], True) if len(row) else np.zeros(0, dtype=bool)
    owner, share = spread(cells, last)
    return layout.bounds[pieces][owner] + width[owner] * share, pieces[owner].astype(np.int64)


def _raw_joints(
    layout: PathParameterisation, arms: JointMapper, lines: Lines | None, s: Array, piece: Index
) -> tuple[Array, Mask]:
    """Return joints near linear interpolation in joint space, up to whole turns, and a mask."""
    if lines is None:
        return _joints_in_general(layout, arms, s, piece)
    joints, exists = lines.joints(s, piece)
    others = np.flatnonzero(~exists)
    if len(others):
        joints[others], exists[others] = _joints_in_general(layout, arms, s[others], piece[others])
    return joints, exists


def _joints_in_general(
    layout: PathParameterisation, arms: JointMapper, s: Array, piece: Index
) -> tuple[Array, Mask]:
    """Return joints near linear interpolation for any arm and curve, and a mask."""
    row = layout.row[piece]
    near = layout.curves.joints_at(row, s - layout.places[row])
    near[:, arms.kinematics.joint_count :] = layout.course(s, piece).value
    return arms.joints(layout.motion(s, piece), row, near)


def _unreached(layout: PathParameterisation, arms: JointMapper, nodes: Nodes) -> PathFault | None:
    missing = np.flatnonzero(~nodes.exists)
    if not len(missing):
        return None
    first = int(missing[0])
    row = nodes.curve
    place = float(nodes.place[first])
    if first and row[first - 1] == row[first]:
        reached = float(nodes.place[first - 1])
        piece = nodes.part[first - 1 : first]
        for _ in range(30):
            middle = 0.5 * (reached + place)
            if _joints_in_general(layout, arms, np.array([middle]), piece)[1][0]:
                reached = middle
            else:
                place = middle
    same = missing[row[missing] == row[first]]
    if arms.pair_rows[row[first]]:
        refusal = wrist_circle_refusal(
            arms, layout.motion(nodes.place[same], nodes.part[same]).position, row[same]
        )
        return replace(_fault(layout, int(row[first]), place, refusal.reason), cure=refusal.cure)
    base_from_flange = arms.base_from_flange(
        layout.motion(nodes.place[same], nodes.part[same]), row[same], nodes.joints[same]
    )
    shortfall = float(arms.kinematics.inverse(base_from_flange).shortfall.max())
    if shortfall > 0.0:
        reason = f"the wrist centre is up to {shortfall * 1e3:.1f} mm beyond the arm's reach"
    else:
        reason = f"configuration {int(arms.branch[row[first]])} of the arm does not reach it"
    return _fault(layout, int(row[first]), place, reason)


def _jump(layout: PathParameterisation, nodes: Nodes, turns: Array) -> PathFault | None:
    at = np.flatnonzero(nodes.jumps(turns))
    if not len(at):
        return None
    first = int(at[0])
    count = len(turns)
    step = nodes.joints[first + 1, :count] - nodes.joints[first, :count]
    step = np.abs(turning(step, turns))
    axis = int(step.argmax())
    reason = (
        f"axis {axis + 1} would have to jump by {math.degrees(step[axis]):.0f} deg: "
        "the path goes through a singularity"
    )
    fault = _fault(layout, int(nodes.curve[first]), float(nodes.place[first]), reason)
    return replace(fault, kind=FaultKind.SINGULARITY)


def _missed_waypoint(
    layout: PathParameterisation, nodes: Nodes, segments: Sequence[Segment], axes: Axes
) -> PathFault | None:
    """Return the first segment whose branch misses its start or end joints, or None."""
    row = nodes.curve
    rows = np.unique(row)
    first = np.searchsorted(row, rows, side="left")
    last = np.searchsorted(row, rows, side="right") - 1
    cut = (layout.position_corner >= 0) | (layout.orientation_corner >= 0)
    if layout.carrier_axes is not None:
        # With a carrier the programmed point is reached only if the carrier is at its own one.
        cut = cut | (layout.joint_corner >= 0)
    start = layout.curves.start_joints[rows]
    end = start + layout.curves.joint_travel[rows]
    arm = len(segments[0].start.joints)
    ends = ((first, start, "starts", "the arm stands"), (last, end, "arrives", "its end has"))
    faults = []
    for node, waypoint, verb, other in ends:
        miss = np.abs(nodes.joints[node] - waypoint)[:, :arm]
        # Within a corner path the node is not the waypoint; only a whole turn can be detected.
        allowed = np.where(cut[nodes.part[node]], 1.5 * math.pi, _MATCH_TOLERANCE)
        missed = np.flatnonzero(miss.max(axis=-1) > allowed)
        if len(missed):
            i = int(missed[0])
            axis = int(miss[i].argmax())
            reason = (
                f"the move {verb} with axis {axis + 1} at "
                f"{math.degrees(nodes.joints[node[i], axis]):.1f} {axes.measure(axis)} where "
                f"{other} {math.degrees(waypoint[i, axis]):.1f} {axes.measure(axis)}"
            )
            faults.append(_fault(layout, int(rows[i]), float(nodes.place[node[i]]), reason))
    return min(faults, key=lambda fault: fault.place, default=None)


def _other_branch(
    layout: PathParameterisation, nodes: Nodes, arm: int, axes: Axes
) -> PathFault | None:
    """Return the first corner in which the arm would change to another branch, or None.

    In its middle the poses of both curves are equal, so their joints must be. `arm` is the number
    of joints of the arm.
    """
    cut = (layout.position_corner >= 0) | (layout.orientation_corner >= 0)
    cut &= layout.joint_corner < 0
    meets = (np.diff(nodes.curve) != 0) & cut[nodes.part[:-1]] & cut[nodes.part[1:]]
    meets &= np.diff(nodes.place) <= _SAME_PLACE
    miss = np.abs(np.diff(nodes.joints[:, :arm], axis=0))
    others = np.flatnonzero(meets & (miss.max(axis=-1) > _BRANCH_TOLERANCE))
    if not len(others):
        return None
    first = int(others[0])
    axis = int(miss[first].argmax())
    here, there = nodes.joints[first : first + 2, axis]
    reason = (
        f"in the corner {axes.name(axis)} would have to jump from {axes.text(axis, here)} to "
        f"{axes.text(axis, there)}, the configuration of the end"
    )
    return _fault(layout, int(nodes.curve[first]), float(nodes.place[first]), reason)


def _fault(layout: PathParameterisation, row: int, place: float, reason: str) -> PathFault:
    length = float(layout.curves.length[row])
    fraction = (place - float(layout.places[row])) / length if length > 0.0 else 0.0
    fraction = min(max(fraction, 0.0), 1.0)
    return PathFault(row, fraction, place, fraction * float(layout.curves.travel[row]), reason)
