"""Common industrial arm: three axes position the wrist centre, three intersect in it.

An ortho-parallel basis (axis 2 perpendicular to axis 1, axis 3 parallel to axis 2) with a spherical
wrist, described by seven lengths. The angles theta of the formulas are zero with the arm straight
up; the joint values differ from them by a sign, an offset and, for arms that move axis 3 through a
rod, by the angle of axis 2.

Source:
    Brandstötter, Angerer, Hofbaur (2014), An analytical solution of the inverse kinematics problem
    of industrial serial manipulators with an ortho-parallel basis and a spherical wrist. The
    inverse differs from theirs where theirs loses solutions; see `opw_inverse`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from rapidsim.frames import rigid
from rapidsim.frames.rotation_vectors import cross
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Branches, BranchJoints, Kinematics
from rapidsim.motion.kinematics.closed_form import opw_inverse
from rapidsim.motion.kinematics.closed_form.opw_geometry import JOINT_COUNT, ROUNDING, OpwGeometry
from rapidsim.motion.kinematics.closed_form.opw_scalar import SinglePose
from rapidsim.motion.kinematics.singularity import Singularity
from rapidsim.motion.kinematics.unwrapping import in_turn_of, principal

_JOINT = np.arange(JOINT_COUNT)
_AXIS = np.array([2, 1, 1, 2, 1, 2])
"""Column of its frame that each axis is: z, or y for axes 2, 3 and 5."""
_BENT_WRIST = np.radians(30.0)
"""Axis 5 of the initial posture [rad]: at 0 the arm would be singular."""


@dataclass(frozen=True, eq=False)
class OrthoParallel(Kinematics):
    """Kinematics of an ortho-parallel arm with a spherical wrist.

    The branch is ABB's cfx for arms whose signs are ABB's, all +1: 4 if the wrist centre is behind
    axis 1, plus 2 if it is behind the lower arm, plus 1 if axis 5 is negative.
    """

    geometry: OpwGeometry
    base_from_opw: Transform
    """Frame of the formulas: z is axis 1, x points forward."""
    opw_from_link: Transform
    """From link frames to the frames of the formulas, shape (6,): naming, no motion."""
    opw6_from_flange: Transform
    """Flange relative to the wrist centre, z along axis 6."""

    @property
    def joint_count(self) -> int:
        """Six joints."""
        return JOINT_COUNT

    @property
    def branch_count(self) -> int:
        """Eight: two sides of axis 1, two elbows, two wrists."""
        return 8

    @property
    def spherical_wrist(self) -> bool:
        """True: axes 4 to 6 intersect in one point."""
        return True

    @property
    def posture(self) -> Array:
        """Lower arm upright, forearm level, axis 5 bent, for any zero position of the maker."""
        return self.joints_from_theta(np.array([0.0, 0.0, np.pi / 2.0, 0.0, _BENT_WRIST, 0.0]))

    @cached_property
    def _signs(self) -> Array:
        return np.array(self.geometry.signs, dtype=np.float64)

    @cached_property
    def _offsets(self) -> Array:
        return np.array(self.geometry.offsets, dtype=np.float64)

    @cached_property
    def _flange_from_opw6(self) -> Transform:
        return self.opw6_from_flange.inverse()

    @cached_property
    def _opw_from_base(self) -> Transform:
        return self.base_from_opw.inverse()

    @cached_property
    def single(self) -> SinglePose:
        """Implementation for one pose, in plain floats."""
        frames = map(
            rigid.from_transform,
            (
                self.base_from_opw,
                self._opw_from_base,
                self.opw6_from_flange,
                self._flange_from_opw6,
            ),
        )
        return SinglePose(self.geometry, *frames)

    def theta_from_joints(self, joints: Array) -> Array:
        """Return angles of the formulas (..., 6) [rad] for joint vectors (..., 6) [rad]."""
        serial = np.array(joints, dtype=np.float64)
        serial[..., 2] += self.geometry.coupling * serial[..., 1]
        return self._signs * serial - self._offsets

    def joints_from_theta(self, theta: Array) -> Array:
        """Return joint vectors (..., 6) [rad], each joint in its principal turn -180..180 deg."""
        joints = (theta + self._offsets) * self._signs
        joints[..., 2] -= self.geometry.coupling * joints[..., 1]
        return principal(joints)

    def stance(self, joints: Array) -> Array:
        """Directions of lower arm and forearm, shape (k, 4), for joints (k, 6); see `PathRates`."""
        theta = self.theta_from_joints(joints)
        lower, fore = theta[:, 1], theta[:, 1] + theta[:, 2]
        columns = np.sin(lower), np.cos(lower), np.sin(fore), np.cos(fore)
        return np.stack(columns, axis=-1)

    def forward(self, joints: Array) -> Transform:
        """base_from_flange of joint vectors (..., 6) [rad]; the flange is ABB's tool0."""
        if joints.ndim == 1:
            return rigid.to_transform(self.single.forward(joints.tolist()))
        return self.base_from_opw @ self._last_opw_frame(joints) @ self.opw6_from_flange

    def link_frames(self, joints: Array) -> Transform:
        """base_from_link of each moving link, shape (..., 6), of joint vectors (..., 6) [rad]."""
        return self.base_from_opw @ self._opw_frames(joints) @ self.opw_from_link

    def jacobian(self, joints: Array) -> Array:
        """Twist of the flange per joint speed, (..., 6, 6): [m/rad] over [rad/rad], in base."""
        frames = self.base_from_opw @ self._opw_frames(joints)
        flange = frames[..., 5] @ self.opw6_from_flange
        columns_of_axes = frames.rotation[..., _JOINT, :, _AXIS]  # (6, ..., 3)
        axes = np.moveaxis(columns_of_axes, 0, -2)
        arms = flange.translation[..., None, :] - frames.translation
        columns = np.concatenate([cross(axes, arms), axes], axis=-1) * self._signs[:, None]
        columns[..., 1, :] += self.geometry.coupling * columns[..., 2, :]
        return np.swapaxes(columns, -1, -2)

    def inverse(self, base_from_flange: Transform) -> Branches:
        """Return all eight branches of a batch of poses (...,).

        Joints that a pose does not determine are 0: axis 1 if the wrist centre is on it, axis 4 if
        axis 5 is 0.
        """
        theta, exists, shortfall = opw_inverse.all_branches(
            self.geometry, self._opw6(base_from_flange)
        )
        joints = np.where(exists[..., None], self.joints_from_theta(theta), 0.0)
        return Branches(joints, exists, shortfall)

    def inverse_on_branch(
        self, base_from_flange: Transform, branch: int, near: Array
    ) -> BranchJoints:
        """Joints of poses (k,) on one branch; see `Kinematics.inverse_on_branch`."""
        near = np.asarray(near, dtype=np.float64)
        if near.ndim == 1 and len(base_from_flange) == 1:
            pose = rigid.from_transform(base_from_flange[0])
            single = self.single.inverse_on_branch(pose, branch, near.tolist())
            exists = np.array([single is not None])
            return BranchJoints(np.array([single or (0.0,) * JOINT_COUNT]), exists)
        theta, exists = opw_inverse.one_branch(
            self.geometry, self._opw6(base_from_flange), branch, self.theta_from_joints(near)
        )
        joints = in_turn_of(self.joints_from_theta(theta), exists, near)
        return BranchJoints(joints, exists)

    def branch_of(self, joints: Array) -> npt.NDArray[np.int64]:
        """Return the branch of joint vectors (..., 6); on a border, the front or positive one."""
        if joints.ndim == 1:
            return np.array(self.single.branch_of(joints.tolist()))
        shoulder, elbow, wrist = (factor < -ROUNDING for factor in self._factors(joints))
        branch: npt.NDArray[np.int64] = 4 * shoulder + 2 * elbow + wrist
        return branch

    def singularities(self, joints: Array) -> tuple[Singularity, ...]:
        """Return the singularities; the Jacobian determinant is their product times lengths."""
        shoulder, elbow, wrist = (abs(float(factor)) for factor in self._factors(joints))
        return (
            Singularity("wrist", wrist, "axes 4 and 6 are in line"),
            Singularity("elbow", elbow, "the wrist centre is in line with axes 2 and 3"),
            Singularity("shoulder", shoulder, "the wrist centre is on axis 1"),
        )

    def limiting_length(self, base_from_flange: Transform) -> str | None:
        """Describe the length that makes the wrist centre unreachable; None if none does."""
        return self.geometry.limiting_length(*self._opw6(base_from_flange).translation.tolist())

    def _factors(self, joints: Array) -> tuple[Array, Array, Array]:
        """Return the factors of branches and singularities: singular at 0, branch by sign.

        Distance (...) of the wrist centre in front of axis 1, as a share of the reach; sine (...)
        of the elbow from stretched; sine (...) of axis 5.
        """
        g = self.geometry
        theta = self.theta_from_joints(joints)
        t2, t3, t23 = theta[..., 1], theta[..., 2], theta[..., 1] + theta[..., 2]
        forward = g.wrist_forward(np.sin(t2), np.cos(t23), np.sin(t23))
        return forward / g.reach, np.sin(t3 + g.fore_lean), np.sin(theta[..., 4])

    def _opw6(self, base_from_flange: Transform) -> Transform:
        """Return the last frame of the formulas: its origin is the wrist centre."""
        return self._opw_from_base @ base_from_flange @ self._flange_from_opw6

    def _last_opw_frame(self, joints: Array) -> Transform:
        """Return the last of `_opw_frames`, several times as fast as all of them."""
        g = self.geometry
        theta = self.theta_from_joints(joints)
        c, s = np.cos(theta), np.sin(theta)
        t23 = theta[..., 1] + theta[..., 2]
        c1, s1, c23, s23 = c[..., 0], s[..., 0], np.cos(t23), np.sin(t23)
        c4, s4, c5, s5, c6, s6 = (f[..., i] for i in (3, 4, 5) for f in (c, s))
        elbow = opw_inverse.elbow_rotation(c1, s1, c23, s23)
        wrist = np.empty_like(elbow)  # Rz(t4) Ry(t5) Rz(t6)
        wrist[..., 0, 0] = c4 * c5 * c6 - s4 * s6
        wrist[..., 0, 1] = -c4 * c5 * s6 - s4 * c6
        wrist[..., 0, 2] = c4 * s5
        wrist[..., 1, 0] = s4 * c5 * c6 + c4 * s6
        wrist[..., 1, 1] = -s4 * c5 * s6 + c4 * c6
        wrist[..., 1, 2] = s4 * s5
        wrist[..., 2, 0] = -s5 * c6
        wrist[..., 2, 1] = s5 * s6
        wrist[..., 2, 2] = c5
        forward, up = g.wrist_forward(s[..., 1], c23, s23), g.wrist_up(c[..., 1], c23, s23)
        centre = np.stack([forward * c1 - g.b * s1, forward * s1 + g.b * c1, up], axis=-1)
        return Transform(elbow @ wrist, centre)

    def _opw_frames(self, joints: Array) -> Transform:
        """Return the frames (..., 6) of the formulas in their base.

        Frame 1 is at the foot of axis 1, 2 and 3 are on their axes, 4 is on axis 4 next to the
        elbow, 5 and 6 are in the wrist centre. z is the axis, but y for 2, 3 and 5.
        """
        g = self.geometry
        theta = self.theta_from_joints(joints)
        t1, t2, t4, t5, t6 = (theta[..., i] for i in (0, 1, 3, 4, 5))
        t23 = t2 + theta[..., 2]
        turned = _about_z(t1)
        upper = turned @ _about_y(t2)
        elbow = turned @ _about_y(t23)
        rolled = elbow @ _about_z(t4)
        bent = rolled @ _about_y(t5)
        rotation = np.stack([turned, upper, elbow, rolled, bent, bent @ _about_z(t6)], axis=-3)

        foot = np.zeros_like(turned[..., 0])
        shoulder = turned @ np.array([g.a1, 0.0, g.c1])
        elbow_origin = shoulder + g.c2 * upper[..., 2] + g.b * turned[..., 1]
        forearm = elbow_origin + g.a2 * elbow[..., 0]
        wrist = forearm + g.c3 * elbow[..., 2]
        translation = np.stack([foot, shoulder, elbow_origin, forearm, wrist, wrist], axis=-2)
        return Transform(rotation, translation)


def _about_z(angle: Array) -> Array:
    """Return rotation matrices (..., 3, 3) about z."""
    c, s, zero = np.cos(angle), np.sin(angle), np.zeros_like(angle)
    rows = [c, -s, zero, s, c, zero, zero, zero, np.ones_like(angle)]
    return np.stack(rows, axis=-1).reshape(*angle.shape, 3, 3)


def _about_y(angle: Array) -> Array:
    """Return rotation matrices (..., 3, 3) about y."""
    c, s, zero = np.cos(angle), np.sin(angle), np.zeros_like(angle)
    rows = [c, zero, s, zero, np.ones_like(angle), zero, -s, zero, c]
    return np.stack(rows, axis=-1).reshape(*angle.shape, 3, 3)
