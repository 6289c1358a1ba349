"""Kinematics of an ortho-parallel arm for one pose, ten times as fast as a batch of one.

The formulas are those of `opw` and `opw_inverse` for single numbers: programs produce moves one at
a time. Poses are `Rigid`, joint vectors sequences of six floats [rad].
"""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, cos, hypot, pi, sin, sqrt

from rapidsim.frames.rigid import Rigid, composed
from rapidsim.motion.kinematics.closed_form.opw_geometry import ROUNDING, OpwGeometry
from rapidsim.motion.kinematics.closed_form.opw_inverse import HELD_WRIST, ON_AXIS
from rapidsim.motion.kinematics.closed_form.two_link import REACH_TOLERANCE
from rapidsim.motion.kinematics.unwrapping import TURN, turned_towards
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class SinglePose:
    """Computations of `OrthoParallel` for one pose; its frames and their inverses."""

    geometry: OpwGeometry
    base_from_opw: Rigid
    opw_from_base: Rigid
    opw6_from_flange: Rigid
    flange_from_opw6: Rigid

    def forward(self, joints: Sequence[float]) -> Rigid:
        """base_from_flange of a joint vector."""
        g = self.geometry
        t1, t2, t3, t4, t5, t6 = self._theta(joints)
        c1, s1, c23, s23 = cos(t1), sin(t1), cos(t2 + t3), sin(t2 + t3)
        c4, s4, c5, s5, c6, s6 = cos(t4), sin(t4), cos(t5), sin(t5), cos(t6), sin(t6)
        # Rz(t4) Ry(t5) Rz(t6), then Ry(t2 + t3), then Rz(t1).
        xx, xy, xz = c4 * c5 * c6 - s4 * s6, -c4 * c5 * s6 - s4 * c6, c4 * s5
        yx, yy, yz = s4 * c5 * c6 + c4 * s6, -s4 * c5 * s6 + c4 * c6, s4 * s5
        zx, zy, zz = -s5 * c6, s5 * s6, c5
        xx, xy, xz, zx, zy, zz = (
            c23 * xx + s23 * zx,
            c23 * xy + s23 * zy,
            c23 * xz + s23 * zz,
            c23 * zx - s23 * xx,
            c23 * zy - s23 * xy,
            c23 * zz - s23 * xz,
        )
        rotation = (
            c1 * xx - s1 * yx,
            c1 * xy - s1 * yy,
            c1 * xz - s1 * yz,
            s1 * xx + c1 * yx,
            s1 * xy + c1 * yy,
            s1 * xz + c1 * yz,
            zx,
            zy,
            zz,
        )
        out, up = g.wrist_forward(sin(t2), c23, s23), g.wrist_up(cos(t2), c23, s23)
        centre = (out * c1 - g.b * s1, out * s1 + g.b * c1, up)
        return composed(composed(self.base_from_opw, (rotation, centre)), self.opw6_from_flange)

    def inverse_on_branch(
        self, base_from_flange: Rigid, branch: int, near: Sequence[float] | None
    ) -> list[float] | None:
        """Return joints on a branch; None if it does not reach the pose.

        Args:
            base_from_flange: The pose.
            branch: 0 to 7.
            near: Joints take the turns closest to these, and keep these values if the pose does
                not determine an axis. Without them joints are in their principal turns, and the
                result is None if an axis is undetermined.
        """
        g = self.geometry
        opw6 = composed(composed(self.opw_from_base, base_from_flange), self.flange_from_opw6)
        (xx, xy, xz, yx, yy, yz, zx, zy, zz), (x, y, z) = opw6
        held = None if near is None else self._theta(near)

        side, bend = -1.0 if branch & 4 else 1.0, -1.0 if branch & 2 else 1.0
        reach, radius = g.reach, hypot(x, y)
        out = side * sqrt(max(radius * radius - g.b * g.b, 0.0))
        t1 = atan2(y, x) - atan2(g.b, out)
        if radius < ON_AXIS * reach:
            if held is None:
                return None
            t1 = held[0]

        # The triangle of both arms; see `two_link.close_triangle`.
        upper, fore = g.c2, g.fore
        ahead, height = out - g.a1, z - g.c1
        distance, folded = hypot(ahead, height), abs(upper - fore)
        outside = max(distance - (upper + fore), folded - distance, 0.0)
        if outside + max(abs(g.b) - radius, 0.0) > REACH_TOLERANCE * reach:
            return None
        short_of_stretched = (upper + fore - distance) * (upper + fore + distance)
        beyond_folded = (distance - folded) * (distance + folded)
        elbow = (
            2.0 * bend * atan2(sqrt(max(short_of_stretched, 0.0)), sqrt(max(beyond_folded, 0.0)))
        )
        t2 = atan2(ahead, height) - atan2(fore * sin(elbow), upper + fore * cos(elbow))
        t3 = elbow - g.fore_lean

        # Remaining rotation of axes 4 to 6, Rz(t4) Ry(t5) Rz(t6), without the two entries not
        # needed.
        c1, s1, c23, s23 = cos(t1), sin(t1), cos(t2 + t3), sin(t2 + t3)
        ox, oy, oz = c1 * xx + s1 * yx, c1 * xy + s1 * yy, c1 * xz + s1 * yz
        yx, yy, yz = c1 * yx - s1 * xx, c1 * yy - s1 * xy, c1 * yz - s1 * xz
        xx, xy, xz, zz = (
            c23 * ox - s23 * zx,
            c23 * oy - s23 * zy,
            c23 * oz - s23 * zz,
            s23 * oz + c23 * zz,
        )
        flip = pi if branch & 1 else 0.0
        t4 = atan2(yz, xz)
        if hypot(xz, yz) < HELD_WRIST:
            if held is None:
                return None
            t4 = held[3] - flip
        c4, s4 = cos(t4), sin(t4)
        t5 = atan2(c4 * xz + s4 * yz, zz)
        t6 = atan2(c4 * yx - s4 * xx, c4 * yy - s4 * xy)
        if flip:
            t4, t5, t6 = t4 + flip, -t5, t6 + flip
        joints = self._joints(t1, t2, t3, t4, t5, t6)
        if near is None:
            return joints
        return [turned_towards(before, joint) for before, joint in zip(near, joints, strict=True)]

    def branch_of(self, joints: Sequence[float]) -> int:
        """Return the branch of a joint vector; on a border, the front or positive one."""
        g = self.geometry
        _, t2, t3, _, t5, _ = self._theta(joints)
        out = g.wrist_forward(sin(t2), cos(t2 + t3), sin(t2 + t3))
        branch = 4 if out < -ROUNDING * g.reach else 0
        if sin(t3 + g.fore_lean) < -ROUNDING:
            branch += 2
        return branch + 1 if sin(t5) < -ROUNDING else branch

    def _theta(self, joints: Sequence[float]) -> tuple[float, float, float, float, float, float]:
        """Return the angles of the formulas."""
        g = self.geometry
        j1, j2, j3, j4, j5, j6 = joints
        s1, s2, s3, s4, s5, s6 = g.signs
        o1, o2, o3, o4, o5, o6 = g.offsets
        return (
            s1 * j1 - o1,
            s2 * j2 - o2,
            s3 * (j3 + g.coupling * j2) - o3,
            s4 * j4 - o4,
            s5 * j5 - o5,
            s6 * j6 - o6,
        )

    def _joints(
        self, t1: float, t2: float, t3: float, t4: float, t5: float, t6: float
    ) -> list[float]:
        """Return the joint vector for angles of the formulas, each joint in its principal turn."""
        g = self.geometry
        s1, s2, s3, s4, s5, s6 = g.signs
        o1, o2, o3, o4, o5, o6 = g.offsets
        j2 = (t2 + o2) * s2
        joints = (
            (t1 + o1) * s1,
            j2,
            (t3 + o3) * s3 - g.coupling * j2,
            (t4 + o4) * s4,
            (t5 + o5) * s5,
            (t6 + o6) * s6,
        )
        return [j if -pi <= j <= pi else j - TURN * round(j / TURN) for j in joints]
