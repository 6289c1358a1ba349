"""Joints without poses at points of a path, which smoothing needs in large numbers.

They equal the joints of `Path.evaluate`; without derivatives and poses they cost a third.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rapidsim.frames.moving_frames import Twists
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.geometry.joint_mapping import JointMapper
from rapidsim.motion.geometry.parameterisation import PathParameterisation
from rapidsim.motion.kinematics.unwrapping import in_turn_of
from rapidsim.motion.path.along_curves import NodeJoints
from rapidsim.motion.path.line_derivatives import Lines
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class JointSpacePoints:
    """Points (k,) on joint moves, and in corners in joint space, mapped to their curves.

    In a corner the joints are the sum of both curves that it joins, minus the joints at their
    junction.
    All are evaluated at once, because few points cost as much as many.
    """

    all_rows: Index
    """Indices of the points on joint moves."""
    cut: Index
    """Indices of the points in corners."""
    corner: Index
    """Curve before the corner of each of those points."""
    row: Index
    """Curves to evaluate: those of `all_rows`, then before the corners, then after them."""
    x: Array
    """Position [m] on each of these curves."""
    rates: tuple[tuple[Array, Array], tuple[Array, Array]]
    """Derivatives by s of the position on the curve before each corner, and on the next."""

    def split(self, values: Array) -> list[Array]:
        """Split values on curves into those on joint moves, before corners, after them."""
        return np.split(values, np.cumsum([len(self.all_rows), len(self.cut)]))


def in_joint_space(layout: PathParameterisation, s: Array, piece: Index) -> JointSpacePoints:
    """Return the curves on which points (k,) of joint moves and joint-space corners depend."""
    corner, row = layout.joint_corner[piece], layout.row[piece]
    whole, cut = np.flatnonzero(corner < 0), np.flatnonzero(corner >= 0)
    at = corner[cut]
    before, after = layout.sides(at, layout.corners.radius[at], s[cut], layout.shape)
    return JointSpacePoints(
        whole,
        cut,
        at,
        np.concatenate([row[whole], at, at + 1]),
        np.concatenate([s[whole] - layout.places[row[whole]], before[0], after[0]]),
        (before[1:], after[1:]),
    )


def joints_at_corners(
    layout: PathParameterisation, corner: Index, s: Array, on_curve: Callable[[Index, Array], Array]
) -> tuple[Array, Array | float, Array | float]:
    """Return junction joints of joint-space corners (k,), and their derivatives, at s (k,).

    If another robot carries the work object and blends its own corner, the end of one curve differs
    from the start of the next; the joints then blend from the latter to the former.

    Args:
        layout: The path.
        corner: The corners.
        s: Path parameters in them [m].
        on_curve: Function that returns the joints at positions of curves.
    """
    if layout.carrier_axes is None:
        return layout.curves.start_joints[corner + 1], 0.0, 0.0
    own, at = np.unique(corner, return_inverse=True)
    rows = np.concatenate([own, own + 1])
    ends = np.concatenate([layout.curves.length[own], np.zeros(len(own))])
    end, begin = np.split(on_curve(rows, ends), 2)
    width = 2.0 * layout.corners.radius[corner]
    share = np.clip(0.5 + (s - layout.places[corner + 1]) / width, 0.0, 1.0)
    passed = share**2 * (3.0 - 2.0 * share)
    rate, bend = 6.0 * share * (1.0 - share) / width, (6.0 - 12.0 * share) / width**2
    way = (end - begin)[at]
    return begin[at] + way * passed[:, None], way * rate[:, None], way * bend[:, None]


@value_class(frozen=True, slots=True, eq=False)
class JointsOnPath:
    """Inverse kinematics of a path."""

    layout: PathParameterisation
    arms: JointMapper
    nodes: NodeJoints
    lines: Lines | None = None
    """Lines with closed-form joints; None if there are none."""

    def spaces(self, piece: Index) -> tuple[Index, Index]:
        """Return indices of pieces (k,) in Cartesian space, and of pieces in joint space.

        Interpolated wrist axes count as joint space: only there do the joints determine the pose.
        """
        row = self.layout.row[piece]
        joint = self.layout.curves.in_joints[row]
        joint = joint | self.arms.wrist_rows[row] | self.arms.pair_rows[row]
        joint = joint | (self.layout.joint_corner[piece] >= 0)
        return np.flatnonzero(~joint), np.flatnonzero(joint)

    def near(self, s: Array, external: Array) -> Array:
        """Return joints (k, n + e) close to those at points (k,) of Cartesian curves."""
        nodes = self.nodes
        joints = [np.interp(s, nodes.place, joint) for joint in nodes.joints.T]
        near = np.stack(joints, axis=-1)
        near[:, self.arms.kinematics.joint_count :] = external
        return near

    def in_space(self, s: Array, piece: Index) -> tuple[Twists, Array]:
        """Motion at points (k,) of Cartesian curves and corners, and joints (k, n + e)."""
        motion = self.layout.motion(s, piece)
        near = self.near(s, self.layout.course(s, piece).value)
        return motion, self.arms.joints(motion, self.layout.row[piece], near)[0]

    def at(self, s: Array, *, quick: bool = False) -> Array:
        """Return joints, followed by external axes, (k, n + e) at s (k,) [m] on the path.

        With `quick`, those on lines are of the closed form, which rounds otherwise.
        """
        piece = self.layout.piece_at(s)
        joints = np.empty((len(s), self.nodes.joints.shape[1]))
        on_curve, in_joints = self.spaces(piece)
        if len(on_curve):
            reach = self._on_lines if quick else self._in_space
            joints[on_curve] = reach(s[on_curve], piece[on_curve])
        if len(in_joints):
            joints[in_joints] = self._in_joint_space(s[in_joints], piece[in_joints])
        return joints

    def _in_space(self, s: Array, piece: Index) -> Array:
        """Return joints (k, n + e) on Cartesian curves and in their corners."""
        return self.in_space(s, piece)[1]

    def _on_lines(self, s: Array, piece: Index) -> Array:
        """Return the same by the closed form where there is one."""
        if self.lines is None:
            return self._in_space(s, piece)
        joints, holds = self.lines.joints(s, piece)
        # Arms with such lines have no external axes.
        joints = in_turn_of(joints, holds, self.near(s, np.zeros((len(s), 0))))
        others = np.flatnonzero(~holds)
        if len(others):
            joints[others] = self._in_space(s[others], piece[others])
        return joints

    def _in_joint_space(self, s: Array, piece: Index) -> Array:
        """Return joints (k, n + e) on joint moves and in corners in joint space."""
        places = in_joint_space(self.layout, s, piece)
        own, into, out = places.split(self._on_curve(places.row, places.x))
        joints = np.empty((len(s), self.nodes.joints.shape[1]))
        joints[places.all_rows] = own
        meet, _, _ = joints_at_corners(self.layout, places.corner, s[places.cut], self._on_curve)
        joints[places.cut] = into + out - meet
        return joints

    def _on_curve(self, row: Index, x: Array) -> Array:
        """Return joints (k, n + e) at positions x (k,) [m] of programmed curves (k,)."""
        curves = self.layout.curves
        x = np.clip(x, 0.0, curves.length[row])
        joints = curves.joints_at(row, x)
        line = np.flatnonzero(~curves.in_joints[row])
        if len(line):
            row, x = row[line], x[line]
            s = self.layout.places[row] + x
            external = joints[line, self.arms.kinematics.joint_count :]
            self.layout.fill_carrier_axes(s, self.layout.piece_at(s), external)
            near = self.near(s, external)
            joints[line] = self.arms.joints(curves.at(row, x), row, near)[0]
        return joints
