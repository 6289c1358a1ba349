"""Joints along curves of the TCP, at nodes as dense as the joint motion requires.

Near a singularity a few micrometres may require half a turn of a wrist axis; only nodes close
together distinguish a steep passage from a jump there.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.unwrapping import principal, turning
from rapidsim.repeated_rows import repeated
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]
Solve = Callable[[Array, Index], tuple[Array, Mask]]
"""Returns joints (k, n + e) [rad] at places (k,) of parts (k,), up to whole turns, and a mask (k,)
of the places that the branch of the curve reaches."""

LONGEST_CELL = 0.05
"""Initial distance [m] of the TCP between two nodes."""
WIDEST_CELL = 0.2
"""Initial rotation [rad] of tool or frame between two nodes."""
_LARGEST_STEP = 0.15
_JUMP = 0.5
_MANY = 1024
"""Number of nodes from which on those that determine nothing are dropped."""
_SMALL_BEND = 0.1
"""Deviation [rad] of joints from a proportional course that leaves their whole turns clear."""


@value_class(frozen=True, slots=True, eq=False)
class NodeJoints:
    """Joints at places of a path, in order."""

    place: Array
    """Shape (k,): position on the path or curve."""
    joints: Array
    """Shape (k, n + e) [rad]; continuous along each curve, whole turns included."""


@value_class(frozen=True, slots=True, eq=False)
class Nodes:
    """Joints along curves, rows in the order of curves and positions."""

    course: NodeJoints
    part: Index
    """Shape (k,): part of a curve that contains the place."""
    curve: Index
    """Shape (k,)."""
    exists: Mask
    """Shape (k,): whether the branch of the curve reaches the place."""

    @property
    def place(self) -> Array:
        """Shape (k,): see `NodeJoints`."""
        return self.course.place

    @property
    def joints(self) -> Array:
        """Shape (k, n + e) [rad]: see `NodeJoints`."""
        return self.course.joints

    def jumps(self, turns: Array) -> Mask:
        """Mask (k - 1,) of jumps of an arm joint between successive nodes.

        Args:
            turns: Turn of each joint (n,), see `Kinematics.turns`.
        """
        step = np.abs(turning(np.diff(self.joints[:, : len(turns)], axis=0), turns))
        both = (self.curve[1:] == self.curve[:-1]) & self.exists[1:] & self.exists[:-1]
        jump: Mask = both & (step > _JUMP).any(axis=-1)
        return jump


def spread(cells: Index, closed: Mask) -> tuple[Index, Array]:
    """Return evenly spaced nodes over parts (p,).

    Args:
        cells: Number of cells of each part, shape (p,).
        closed: Mask (p,) of the parts with a node at their end, as there is at their beginning.

    Returns:
        Part of each node, and its position as a share of the part, 0 to 1.
    """
    part, number = repeated(cells + closed)
    return part, number / cells[part]


def nodes_along(
    place: Array,
    part: Index,
    curve_of: Index,
    shortest: Array,
    solve: Solve,
    turns: Array,
) -> Nodes:
    """Solve nodes, and insert others where joints turn far in between.

    Args:
        place: First nodes (k,), in order along each curve.
        part: The part (k,) that contains each.
        curve_of: The curve of each part (p,).
        shortest: Cells of a curve (m,) no longer than this are not halved.
        solve: Function that finds joints.
        turns: Turn of each joint of the arm (n,), see `Kinematics.turns`; other axes need no nodes.
    """
    joint_count = len(turns)
    joints, exists = solve(place, part)
    while True:
        curve = curve_of[part]
        step = principal(turning(np.diff(joints[:, :joint_count], axis=0), turns))
        steep = np.abs(step).max(axis=-1, initial=0.0) > _LARGEST_STEP
        steep &= (curve[1:] == curve[:-1]) & exists[1:] & exists[:-1]
        at = np.flatnonzero(steep & (np.diff(place) > shortest[curve[1:]]))
        if not len(at):
            break
        middle = 0.5 * (place[at] + place[at + 1])
        new_joints, new_exists = solve(middle, part[at])
        place = np.insert(place, at + 1, middle)
        part = np.insert(part, at + 1, part[at])
        joints = np.insert(joints, at + 1, new_joints, axis=0)
        exists = np.insert(exists, at + 1, new_exists)
    of_arm = _continuous(joints[:, :joint_count], curve, turns)
    joints = np.concatenate([of_arm, joints[:, joint_count:]], axis=1)
    return Nodes(NodeJoints(place, joints), part, curve, exists)


def course_of(nodes: Nodes, regular: Mask) -> NodeJoints:
    """Return the joints of nodes; of many, without those that determine no whole turn.

    Those are inside curves along which joints are nearly proportional to the path.

    Args:
        nodes: The nodes (k,).
        regular: Mask (k,) of nodes where a pose determines the joints but for whole turns.
    """
    place, joints, curve = nodes.place, nodes.joints, nodes.curve
    if len(place) < _MANY:
        return nodes.course
    begins = np.flatnonzero(np.diff(curve, prepend=-1))
    ends = np.append(begins[1:], len(curve)) - 1
    number = np.repeat(np.arange(len(begins)), ends - begins + 1)
    first, last = begins[number], ends[number]
    share = (place - place[first]) / np.maximum(place[last] - place[first], 1e-300)
    off = joints - joints[first] - share[:, None] * (joints[last] - joints[first])
    plain = regular & (np.abs(off).max(axis=1) < _SMALL_BEND)
    needed = ~np.logical_and.reduceat(plain, begins)[number]
    needed[begins] = needed[ends] = True
    return NodeJoints(place[needed], joints[needed])


def _continuous(joints: Array, curve: Index, turns: Array) -> Array:
    """Unwrap joints along each curve, starting in the turn of its first node."""
    if len(joints) < 2:
        return joints
    gone = np.cumsum(np.round(np.diff(joints, axis=0) / turns), axis=0)
    gone = np.concatenate([np.zeros((1, joints.shape[1])), gone])
    first = np.searchsorted(curve, curve, side="left")
    continuous: Array = joints - turns * (gone - gone[first])
    return continuous
