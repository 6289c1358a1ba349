"""Follow the Cartesian curves of a path on their branches, or say where the arm cannot.

Nodes are put as densely as the joints turn, so that near a singularity, where a few micrometres
may ask for half a turn of a wrist axis, a steep passage can be told from a jump.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.curves import Index, Motion
from rapidsim.motion.kinematics import Kinematics, Mask
from rapidsim.motion.layout import Layout
from rapidsim.motion.segments import Segment

_LONGEST_CELL = 0.05
_WIDEST_CELL = 0.2
_LARGEST_STEP = 0.15
_JUMP = 0.5
_SHORTEST_CELL = 1e-6
_LIMIT_TOLERANCE = 1e-6
_MATCH_TOLERANCE = 1e-3


@dataclass(frozen=True, slots=True)
class PathFault:
    """Where a path cannot be driven, and why."""

    segment: int
    """Position in the row of segments that the path was built from."""
    fraction: float
    """Share of that segment, 0 to 1."""
    place: float
    """s of the path [m]."""
    distance: float
    """TCP travel [m] on that segment before it fails."""
    reason: str
    """What is wrong, with numbers."""


@dataclass(frozen=True, slots=True, eq=False)
class Arms:
    """How the flange is found from TCP poses on curves, one row a curve."""

    kinematics: Kinematics
    branch: Index
    """Shape (m,)."""
    tcp_from_flange: Transform
    """Shape (m,)."""

    def joints(self, motion: Motion, row: Index, near: Array) -> tuple[Array, Mask]:
        """Joints (k, n) of TCP poses (k,) on curves (k,), and whether the branch reaches them.

        Where it does not, `near` stands instead.
        """
        base_from_flange = motion.base_from_tcp @ self.tcp_from_flange[row]
        joints = near.copy()
        exists = np.zeros(len(row), dtype=bool)
        branches = self.branch[row]
        for branch in np.unique(branches):
            at = np.flatnonzero(branches == branch)
            followed = self.kinematics.inverse_on_branch(
                base_from_flange[at], int(branch), near[at]
            )
            reached = at[followed.exists]
            joints[reached] = followed.joints[followed.exists]
            exists[reached] = True
        return joints, exists


@dataclass(frozen=True, slots=True, eq=False)
class Nodes:
    """Joints along the Cartesian curves of a path, rows in the order of s."""

    s: Array
    """Shape (k,)."""
    piece: Index
    joints: Array
    """Shape (k, n) [rad]; continuous along each curve, whole turns included."""


def follow(
    layout: Layout, arms: Arms, segments: Sequence[Segment], lower: Array, upper: Array
) -> Nodes | PathFault:
    """Follow every Cartesian curve of a path.

    Args:
        layout: The path.
        arms: Branch and tool of each curve.
        segments: The segment of each curve.
        lower: Lower joint limits (n,) [rad].
        upper: Upper joint limits (n,) [rad].

    Returns:
        The joints, or the first place where the branch ends, jumps, misses the joints of a
        segment's start or end, or leaves the limits. `PathFault.segment` counts curves.
    """
    s, piece = _first_nodes(layout)
    joints, exists = _raw_joints(layout, arms, s, piece)
    while True:
        row = layout.row[piece]
        step = np.abs(_short_way(np.diff(joints, axis=0))).max(axis=-1, initial=0.0)
        gap = np.diff(s)
        steep = (row[1:] == row[:-1]) & exists[1:] & exists[:-1] & (step > _LARGEST_STEP)
        steep &= gap > np.minimum(_SHORTEST_CELL, 1e-4 * layout.curves.length[row[1:]])
        at = np.flatnonzero(steep)
        if not len(at):
            break
        middle = 0.5 * (s[at] + s[at + 1])
        new_joints, new_exists = _raw_joints(layout, arms, middle, piece[at])
        s = np.insert(s, at + 1, middle)
        piece = np.insert(piece, at + 1, piece[at])
        joints = np.insert(joints, at + 1, new_joints, axis=0)
        exists = np.insert(exists, at + 1, new_exists)
    joints = _continuous(joints, layout.row[piece])
    nodes = Nodes(s, piece, joints)
    # In corners made in joint space the arm is not on the curve.
    on_path = np.flatnonzero(layout.joint_corner[piece] < 0)
    candidates = (
        _unreached(layout, arms, nodes, exists),
        _jump(layout, nodes, exists),
        _missed_waypoint(layout, nodes, segments),
        limit_fault(layout, s[on_path], layout.row[piece[on_path]], joints[on_path], lower, upper),
    )
    faults = [fault for fault in candidates if fault is not None]
    return min(faults, key=lambda fault: fault.place) if faults else nodes


def limit_fault(
    layout: Layout, s: Array, row: Index, joints: Array, lower: Array, upper: Array
) -> PathFault | None:
    """The first of some places (k,) whose joints (k, n) [rad] are outside the limits (n,)."""
    over = np.maximum(lower - joints, joints - upper)
    bad = np.flatnonzero((over > _LIMIT_TOLERANCE).any(axis=-1))
    if not len(bad):
        return None
    first = int(bad[0])
    axis = int(over[first].argmax())
    # The worst of the same curve says more than the first node past the limit.
    same = bad[row[bad] == row[first]]
    worst = int(same[over[same, axis].argmax()])
    limit = lower[axis] if joints[worst, axis] < lower[axis] else upper[axis]
    reason = (
        f"axis {axis + 1} goes to {math.degrees(joints[worst, axis]):.1f} deg, "
        f"{math.degrees(over[worst, axis]):.1f} deg past its limit of {math.degrees(limit):.1f} deg"
    )
    place = float(s[first])
    if first and row[first - 1] == row[first] and over[first - 1, axis] <= 0.0:
        before, after = over[first - 1, axis], over[first, axis]
        place -= float((s[first] - s[first - 1]) * after / (after - before))
    return _fault(layout, int(row[first]), place, reason)


def _first_nodes(layout: Layout) -> tuple[Array, Index]:
    """Places and pieces along all Cartesian curves, each curve with both ends."""
    pieces = np.flatnonzero(~layout.curves.in_joints[layout.row])
    row = layout.row[pieces]
    width = np.diff(layout.bounds)[pieces]
    length = np.maximum(layout.curves.length[row], 1e-300)
    turn = np.linalg.norm(layout.curves.tool_turn[row], axis=-1)
    turn += np.linalg.norm(layout.curves.frame_turn[row], axis=-1)
    cells = np.maximum(width / _LONGEST_CELL, turn * width / length / _WIDEST_CELL)
    cells = np.ceil(np.maximum(cells, 2.0)).astype(np.int64)
    last = np.append(row[1:] != row[:-1], True) if len(row) else np.zeros(0, dtype=bool)
    count = cells + last
    owner = np.repeat(np.arange(len(pieces)), count)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    s = layout.bounds[pieces][owner] + width[owner] * (number / cells[owner])
    return s, pieces[owner].astype(np.int64)


def _raw_joints(layout: Layout, arms: Arms, s: Array, piece: Index) -> tuple[Array, Mask]:
    """Joints near the straight way in joint space; whole turns may be off in between."""
    row = layout.row[piece]
    near = layout.curves.joints_at(row, s - layout.places[row])
    return arms.joints(layout.motion(s, piece), row, near)


def _continuous(joints: Array, row: Index) -> Array:
    """Take the turn of each curve's first node along the whole curve."""
    if len(joints) < 2:
        return joints
    step = np.diff(joints, axis=0)
    turns = np.cumsum(np.round((step - _short_way(step)) / (2.0 * np.pi)), axis=0)
    turns = np.concatenate([np.zeros((1, joints.shape[1])), turns])
    first = np.searchsorted(row, row, side="left")
    continuous: Array = joints - 2.0 * np.pi * (turns - turns[first])
    return continuous


def _short_way(step: Array) -> Array:
    """Steps of joints without whole turns."""
    short: Array = step - 2.0 * np.pi * np.round(step / (2.0 * np.pi))
    return short


def _unreached(layout: Layout, arms: Arms, nodes: Nodes, exists: Mask) -> PathFault | None:
    missing = np.flatnonzero(~exists)
    if not len(missing):
        return None
    first = int(missing[0])
    row = layout.row[nodes.piece]
    place = float(nodes.s[first])
    if first and row[first - 1] == row[first]:
        reached = float(nodes.s[first - 1])
        piece = nodes.piece[first - 1 : first]
        for _ in range(30):
            middle = 0.5 * (reached + place)
            if _raw_joints(layout, arms, np.array([middle]), piece)[1][0]:
                reached = middle
            else:
                place = middle
    same = missing[row[missing] == row[first]]
    motion = layout.motion(nodes.s[same], nodes.piece[same])
    base_from_flange = motion.base_from_tcp @ arms.tcp_from_flange[row[same]]
    shortfall = float(arms.kinematics.inverse(base_from_flange).shortfall.max())
    if shortfall > 0.0:
        reason = f"the wrist centre is up to {shortfall * 1e3:.1f} mm beyond the arm's reach"
    else:
        reason = f"configuration {int(arms.branch[row[first]])} of the arm does not reach it"
    return _fault(layout, int(row[first]), place, reason)


def _jump(layout: Layout, nodes: Nodes, exists: Mask) -> PathFault | None:
    row = layout.row[nodes.piece]
    step = np.abs(np.diff(nodes.joints, axis=0))
    jump = (row[1:] == row[:-1]) & exists[1:] & exists[:-1]
    jump &= (step > _JUMP).any(axis=-1)
    at = np.flatnonzero(jump)
    if not len(at):
        return None
    first = int(at[0])
    axis = int(step[first].argmax())
    reason = (
        f"axis {axis + 1} would have to jump by {math.degrees(step[first, axis]):.0f} deg: "
        "the path goes through a singularity"
    )
    return _fault(layout, int(row[first]), float(nodes.s[first]), reason)


def _missed_waypoint(layout: Layout, nodes: Nodes, segments: Sequence[Segment]) -> PathFault | None:
    """Where the branch does not lead from a segment's start joints to its end joints."""
    row = layout.row[nodes.piece]
    rows = np.unique(row)
    first = np.searchsorted(row, rows, side="left")
    last = np.searchsorted(row, rows, side="right") - 1
    cut = (layout.position_corner >= 0) | (layout.orientation_corner >= 0)
    for i, at_first, at_last in zip(rows, first, last, strict=True):
        ends = (
            (at_first, segments[i].start.joints, "starts", "the arm stands"),
            (at_last, segments[i].end.joints, "arrives", "its end has"),
        )
        for node, waypoint, verb, other in ends:
            miss = np.abs(nodes.joints[node] - waypoint)
            # Within a corner path the node is not the waypoint; only a whole turn can be told.
            allowed = 1.5 * math.pi if cut[nodes.piece[node]] else _MATCH_TOLERANCE
            axis = int(miss.argmax())
            if miss[axis] > allowed:
                reason = (
                    f"the move {verb} with axis {axis + 1} at "
                    f"{math.degrees(nodes.joints[node, axis]):.1f} deg where {other} "
                    f"{math.degrees(waypoint[axis]):.1f} deg"
                )
                return _fault(layout, int(i), float(nodes.s[node]), reason)
    return None


def _fault(layout: Layout, row: int, place: float, reason: str) -> PathFault:
    length = float(layout.curves.length[row])
    fraction = (place - float(layout.places[row])) / length if length > 0.0 else 0.0
    fraction = min(max(fraction, 0.0), 1.0)
    return PathFault(row, fraction, place, fraction * float(layout.curves.travel[row]), reason)
