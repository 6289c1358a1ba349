r"""CirPathMode \Wrist45, \Wrist46, \Wrist56: two wrist axes guide the tool's z axis on a circle.

All other axes rest. The circle is followed by the intersection of the tool's z axis with the cut
plane, the plane of the circle; the TCP leaves that plane slightly and the tool turns.

Both axes pass through one point, the centre. The point m of the z axis that reaches a point u of
the circle (both relative to the centre) has the same distance from the centre, so it is known, and
with it the rotations alpha about the axis a nearer to the base and beta about the other axis b,
both axes in their start directions:

    turn(a, alpha) turn(b, beta) m = u

There are two solutions, one for each side of the plane through both axes; in that plane the pair is
singular.

Source: Technical reference manual RAPID Instructions, "CirPathMode"; Murray, Li, Sastry (1994), A
Mathematical Introduction to Robotic Manipulation, section 3.2, subproblem 2.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from rapidsim.frames.rotation_vectors import cross, rotate, rotation_from_vector
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segment_rows import of_each
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.kinematics.arm import Kinematics, Mask
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]

_SIX_AXES = 6
_WRIST = slice(3, 6)
_MEET = 1e-6
"""Distance [m] within which axes count as intersecting."""
_SINGULAR = 1e-4
"""Sine of the angle to the plane through both axes, or to the tangency of the z axis with the
sphere about the centre, below which the pair is singular: one axis would turn by a radian on less
than 0.1 mm at 1 m."""
_IN_LINE = 1e-6
"""Sine of the angle between both axes below which they count as one."""
FLATTEST = np.radians(10.0)
"""Smallest angle [rad] between the tool's z axis and the cut plane for a usable intersection."""


class PairTurns(NamedTuple):
    """Rotations by which a pair aims the tool's z axis at points (k,)."""

    turns: Array
    """Shape (k, 2) [rad]: relative to the start of the curve."""
    exists: Mask
    beyond: Array
    """Angle (k,) [rad] of the point outside the range of both axes; 0 or less within."""
    grazes: Array
    """Distance (k,) [m] by which the point is nearer to the centre than the z axis ever is."""
    steepness: Array
    """Sine (k,) of the angle between the z axis and the cut plane."""


@value_class(frozen=True, slots=True, eq=False)
class WristPairs:
    """Wrist pairs of some of m curves, one row per curve; rows of other curves are empty."""

    axes: Index
    """Shape (m, 2): indices of both joints, -1 for curves without a pair."""
    start: Array
    """Shape (m, n) [rad]: joints at the start of the curve."""
    centre: Array
    """Shape (m, 3) [m]: intersection of both axes, in base."""
    first: Array
    """Shape (m, 3): direction of the axis nearer to the base."""
    second: Array
    """Shape (m, 3): direction of the other axis at the start."""
    aim: Array
    """Shape (m, 3) [m]: from the centre to the intersection of z axis and plane at the start."""
    tool_z: Array
    """Shape (m, 3): direction of the tool's z axis at the start."""
    normal: Array
    """Shape (m, 3): normal of the cut plane."""

    def joints(self, place: Array, row: Index, near: Array) -> tuple[Array, Mask]:
        """Return joints (k, n) that aim the z axis at (k, 3) in base, in the turns of `near`.

        Unreachable rows contain `near` (k, n).
        """
        aimed = self.aimed(place, row)
        joints = self.start[row].copy()
        at, axes = np.arange(len(row))[:, None], self.axes[row]
        joints[at, axes] += aimed.turns
        away = near[at, axes] - joints[at, axes]
        joints[at, axes] += 2.0 * np.pi * np.round(away / (2.0 * np.pi))
        return np.where(aimed.exists[:, None], joints, near), aimed.exists

    def rates(
        self, joints: Array, row: Index, place: Array, velocity: Array, acceleration: Array
    ) -> tuple[Array, Array]:
        """Return derivatives (k, n) of joints (k, n) that aim the z axis at moving points (k, 3).

        Each is a point of the z axis that turns with the tool and slides along it at a rate l:
        u' = w x u + l z with w = a alpha' + b beta'. The components across u yield both turns, the
        component along u yields l; the second derivative has the same unknowns and otherwise known
        terms.
        """
        at, axes = np.arange(len(row))[:, None], self.axes[row]
        turns = joints[at, axes] - self.start[row][at, axes]
        a, u = self.first[row], place - self.centre[row]
        by_first = rotation_from_vector(a * turns[:, :1])
        b = rotate(by_first, self.second[row])
        z = rotate(by_first, self._turned_z(row, turns[:, 1:]))
        along, between = _dot(u, z), cross(a, b)
        volume = _dot(u, between)

        def both(motion: Array) -> tuple[Array, Array]:
            """Return rotations (k, 2) and slide (k, 1) for a motion of the point."""
            slide = _dot(u, motion) / along
            across = motion - slide * z
            return np.hstack([-_dot(b, across), _dot(a, across)]) / volume, slide

        first, second = np.zeros_like(joints), np.zeros_like(joints)
        rate, slide = both(velocity)
        turning = a * rate[:, :1] + b * rate[:, 1:]
        known = cross(rate[:, :1] * rate[:, 1:] * between, u)
        known += cross(turning, velocity) + slide * cross(turning, z)
        first[at, axes], second[at, axes] = rate, both(acceleration - known)[0]
        return first, second

    def aimed(self, place: Array, row: Index) -> PairTurns:
        """Return the rotations by which pairs of rows (k,) aim the z axis at (k, 3) in base."""
        a, b, z = self.first[row], self.second[row], self.tool_z[row]
        aim, u = self.aim[row], place - self.centre[row]
        distance = np.maximum(np.linalg.norm(u, axis=-1, keepdims=True), 1e-12)
        foot = aim - _dot(aim, z) * z
        nearest = np.linalg.norm(foot, axis=-1, keepdims=True)
        along = np.sqrt(np.maximum(distance**2 - nearest**2, 0.0))
        m = foot + np.copysign(along, _dot(aim, z)) * z
        # Both rotations meet in a point at the height of u along one axis and of m along the other.
        between, cosine = cross(a, b), _dot(a, b)
        square = np.maximum(_dot(between, between), _IN_LINE**2)
        over_a, over_b = _dot(a, u), _dot(b, m)
        of_a, of_b = (over_a - cosine * over_b) / square, (over_b - cosine * over_a) / square
        rest = distance**2 - of_a**2 - of_b**2 - 2.0 * of_a * of_b * cosine
        volume = np.sqrt(np.maximum(rest * square, 0.0))
        side = np.where(_dot(aim, between) < 0.0, -volume, volume)
        middle = of_a * a + of_b * b + side / square * between
        turns = np.hstack([_turn_about(a, middle, u), _turn_about(b, m, middle)])
        z_now = rotate(rotation_from_vector(a * turns[:, :1]), self._turned_z(row, turns[:, 1:]))
        steepness = np.abs(_dot(z_now, self.normal[row]))[:, 0]
        regular = (volume > _SINGULAR * distance) & (along > _SINGULAR * distance)
        angle_u, angle_m, apart = (
            np.arccos(np.clip(part, -1.0, 1.0))
            for part in (over_a / distance, over_b / distance, cosine)
        )
        widest = np.minimum(apart + angle_m, 2.0 * np.pi - apart - angle_m)
        beyond = np.maximum(np.abs(apart - angle_m) - angle_u, angle_u - widest)
        return PairTurns(
            turns,
            regular[:, 0] & (steepness > np.sin(FLATTEST)),
            beyond[:, 0],
            (nearest - distance)[:, 0],
            steepness,
        )

    def _turned_z(self, row: Index, turn: Array) -> Array:
        """Return the tool's z axis (k, 3) after rotations (k, 1) about the second axis alone."""
        return rotate(rotation_from_vector(self.second[row] * turn), self.tool_z[row])


def wrist_pairs_of(segments: Sequence[Segment], kinematics: Kinematics) -> WristPairs | None:
    """Return the wrist pairs of the curves of segments; None if no segment has a pair."""
    count, n = len(segments), kinematics.joint_count
    axes = np.full((count, 2), -1)
    start, vectors = np.zeros((count, n)), np.zeros((6, count, 3))
    for row in np.flatnonzero(of_each(segments, lambda one: one.wrist_pair is not None)).tolist():
        segment = segments[row]
        assert segment.wrist_pair is not None
        assert segment.via is not None
        axes[row], start[row] = segment.wrist_pair, segment.start.joints
        direction, through = _axes_of(kinematics, segment.start.joints)
        centre, _ = _wrist_centre(direction, through)
        pose = segment.start.base_from_tcp
        to_via = segment.via.translation - pose.translation
        normal = np.cross(to_via, segment.end.base_from_tcp.translation - pose.translation)
        vectors[:, row] = (
            centre,
            *direction[list(segment.wrist_pair)],
            pose.translation - centre,
            pose.rotation[:, 2],
            normal / np.linalg.norm(normal),
        )
    return WristPairs(axes, start, *vectors) if (axes >= 0).any() else None


def wrist_meets(kinematics: Kinematics, joints: Array) -> bool:
    """Whether an arm has six axes, the last three of which intersect in one point."""
    if kinematics.joint_count != _SIX_AXES:
        return False
    return _wrist_centre(*_axes_of(kinematics, joints))[1] < _MEET


def _axes_of(kinematics: Kinematics, joints: Array) -> tuple[Array, Array]:
    """Return directions of all axes (n, 3), and a point of each (n, 3) [m], at joints (n,)."""
    moving, direction = np.split(kinematics.jacobian(joints), 2)
    direction = direction.T
    return direction, kinematics.forward(joints).translation + cross(direction, moving.T)


def _wrist_centre(direction: Array, through: Array) -> tuple[Array, float]:
    """Return the point (3,) [m] nearest to the wrist axes, and its distance from them [m]."""
    direction, through = direction[_WRIST], through[_WRIST]
    across = np.eye(3) - direction[:, :, None] * direction[:, None, :]
    sides = (across @ through[..., None])[..., 0]
    # With axis 5 at 0 two of them are collinear, and the third still crosses them.
    centre: Array = np.linalg.solve(across.sum(axis=0), sides.sum(axis=0))
    away = np.linalg.norm((across @ centre) - sides, axis=-1)
    return centre, float(away.max())


def _turn_about(axis: Array, before: Array, after: Array) -> Array:
    """Return the rotation (k, 1) [rad] about an axis that maps one vector (k, 3) to another."""
    before = before - _dot(axis, before) * axis
    after = after - _dot(axis, after) * axis
    turn: Array = np.arctan2(_dot(axis, cross(before, after)), _dot(before, after))
    return turn


def _dot(a: Array, b: Array) -> Array:
    """Return dot products (k, 1) of vectors (k, 3)."""
    product: Array = np.einsum("ij,ij->i", a, b)[:, None]
    return product
