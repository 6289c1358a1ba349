"""SCARA arms: two parallel turning axes, a sliding axis 3 and a turning axis 4, all vertical.

Joints are 0 with both arms stretched forward, the spline up. Axes 1 and 2 turn counterclockwise
seen from above, axis 4 clockwise: about z of the flange, which points down. Axis 3 goes down from
0, so within its stroke it is negative.

RAPID's unit of axis 3 is mm and that of the others degrees; see `Kinematics.slides`.

Source: x = a1 cos q1 + a2 cos(q1 + q2), y = a1 sin q1 + a2 sin(q1 + q2), z = flange_up + q3,
    yaw = q1 + q2 - q4. The sign of axis 4 and the branches agree with targets that a controller
    of an IRB 910SC stored.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import (
    METRES_PER_UNIT,
    Branches,
    BranchJoints,
    Kinematics,
    Mask,
)
from rapidsim.motion.kinematics.closed_form.two_link import REACH_TOLERANCE, close_triangle
from rapidsim.motion.kinematics.singularity import Singularity
from rapidsim.motion.kinematics.unwrapping import in_turn_of, principal
from rapidsim.values import value_class

JOINT_COUNT = 4
SLIDING = 2
"""Index of the joint that slides, counted from 0."""
UPRIGHT = 1e-4
"""Largest angle [rad] of a pose off upright: printed targets are no more exact."""
ON_AXIS_1 = 1e-10
"""Share of the reach within which the flange counts as lying on axis 1."""
ROUNDING = 1e-12
"""Sines up to this are zero with rounding errors."""
AXIS_2_NEGATIVE = 1
"""Branch, RAPID's cfx, of arms with a negative axis 2; 0 for the others."""
_RAPID_AXES = (0, 1, 2, 3)
_SLIDES: Mask = np.arange(JOINT_COUNT) == SLIDING
_TURNS_UP = np.array([1.0, 1.0, 0.0, -1.0])
"""Rotation of the flange about the vertical per joint value."""
_DOWN = np.diag([1.0, -1.0, -1.0])
"""Flange with all joints at 0: x forward, z down."""


@value_class(frozen=True, slots=True)
class ScaraGeometry:
    """Lengths [m] of a SCARA."""

    a1: float
    """Axis 1 to axis 2."""
    a2: float
    """Axis 2 to axes 3 and 4."""
    arm_1_up: float
    """Base to the underside of arm 1; no motion depends on it."""
    arm_2_up: float
    """Base to the underside of arm 2; no motion depends on it."""
    flange_up: float
    """Base to the flange with axis 3 at 0."""

    @property
    def reach(self) -> float:
        """Length [m] of the stretched arm; the scale of every tolerance."""
        return self.a1 + self.a2


@value_class(frozen=True, eq=False)
class Scara(Kinematics):
    """Kinematics of a SCARA.

    Two branches: 0 where axis 2 is positive or 0, 1 where it is negative.
    """

    geometry: ScaraGeometry

    @property
    def joint_count(self) -> int:
        """Four joints."""
        return JOINT_COUNT

    @property
    def branch_count(self) -> int:
        """Two elbows."""
        return 2

    @property
    def slides(self) -> Mask:
        """Mask of joint 3."""
        return _SLIDES

    @property
    def rapid_axes(self) -> tuple[int, ...]:
        """First four axes; axes 5 and 6 do not exist."""
        return _RAPID_AXES

    @property
    def posture(self) -> Array:
        """Elbow at a right angle, flange forward and 50 mm below its highest position."""
        return np.radians([-45.0, 90.0, -50.0, 45.0])

    def stance(self, joints: Array) -> Array:
        """Sine and cosine of joint 2 in the first two columns (k, 4); see `PathRates`."""
        stance = np.zeros((len(joints), 4))
        stance[:, 0], stance[:, 1] = np.sin(joints[:, 1]), np.cos(joints[:, 1])
        return stance

    def forward(self, joints: Array) -> Transform:
        """base_from_flange of joint vectors (..., 4) [rad]."""
        return self.link_frames(joints)[..., -1] @ Transform(_DOWN, np.zeros(3))

    def link_frames(self, joints: Array) -> Transform:
        """base_from_link of each moving link, shape (..., 4), parallel to the base at zero."""
        g = self.geometry
        joints = np.asarray(joints, dtype=np.float64)
        elbow, end = self._elbow_and_end(joints)
        foot = np.zeros_like(elbow)
        height = g.flange_up + METRES_PER_UNIT * joints[..., SLIDING]
        places = [
            _raised(foot, np.full(height.shape, g.arm_1_up)),
            _raised(elbow, np.full(height.shape, g.arm_2_up)),
            _raised(end, height),
            _raised(end, height),
        ]
        q1, q12 = joints[..., 0], joints[..., 0] + joints[..., 1]
        turns = [_about_z(angle) for angle in (q1, q12, q12, q12 - joints[..., 3])]
        return Transform(np.stack(turns, axis=-3), np.stack(places, axis=-2))

    def jacobian(self, joints: Array) -> Array:
        """Twist of the flange per joint speed, (..., 6, 4); see `Kinematics.jacobian`."""
        joints = np.asarray(joints, dtype=np.float64)
        elbow, end = self._elbow_and_end(joints)
        twist = np.zeros((*joints.shape[:-1], 6, JOINT_COUNT))
        for joint, arm in ((0, end), (1, end - elbow)):
            twist[..., 0, joint], twist[..., 1, joint] = -arm[..., 1], arm[..., 0]
        twist[..., 2, SLIDING] = METRES_PER_UNIT
        twist[..., 5, :] = _TURNS_UP
        return twist

    def inverse(self, base_from_flange: Transform) -> Branches:
        """Return both branches; axis 1 is 0 where the flange is on it."""
        joints, shortfall, tilt = self._joints(base_from_flange, np.array(0.0))
        exists = self._exists(shortfall, tilt)
        joints = np.where(exists[..., None], principal(joints, self.turns), 0.0)
        return Branches(joints, exists, shortfall, tilt)

    def inverse_on_branch(
        self, base_from_flange: Transform, branch: int, near: Array
    ) -> BranchJoints:
        """Joints of poses (k,) on one branch; see `Kinematics.inverse_on_branch`."""
        near = np.asarray(near, dtype=np.float64)
        joints, shortfall, tilt = self._joints(base_from_flange, near[..., 0])
        exists = self._exists(shortfall, tilt)[..., branch]
        turns = self.turns
        found = in_turn_of(principal(joints[..., branch, :], turns), exists, near, turns)
        return BranchJoints(found, exists)

    def branch_of(self, joints: Array) -> npt.NDArray[np.int64]:
        """Return the branch of joints (..., 4); stretched or folded, that of a positive axis 2."""
        negative = np.sin(np.asarray(joints, dtype=np.float64)[..., 1]) < -ROUNDING
        branch: npt.NDArray[np.int64] = AXIS_2_NEGATIVE * negative.astype(np.int64)
        return branch

    def singularities(self, joints: Array) -> tuple[Singularity, ...]:
        """Return the elbow singularity; the determinant of the Jacobian is a1 a2 sin q2."""
        elbow = abs(float(np.sin(joints[1])))
        return (Singularity("elbow", elbow, "both arms are in line"),)

    def limiting_length(self, base_from_flange: Transform) -> str | None:
        """Describe whether the arms are too short for a pose or too long; None if neither."""
        g = self.geometry
        x, y = base_from_flange.translation[:2].tolist()
        distance = float(np.hypot(x, y))
        if distance > g.reach:
            return (
                f"it is {1e3 * distance:.0f} mm from axis 1, and both arms stretched reach "
                f"{1e3 * g.reach:.0f} mm"
            )
        if distance < abs(g.a1 - g.a2):
            return (
                f"it is {1e3 * distance:.0f} mm from axis 1, and the arms folded come no nearer "
                f"than {1e3 * abs(g.a1 - g.a2):.0f} mm"
            )
        return None

    def _elbow_and_end(self, joints: Array) -> tuple[Array, Array]:
        """Return the positions (..., 2) [m] of axis 2 and axis 4, seen from above."""
        q1, q12 = joints[..., 0], joints[..., 0] + joints[..., 1]
        elbow = self.geometry.a1 * np.stack([np.cos(q1), np.sin(q1)], axis=-1)
        return elbow, elbow + self.geometry.a2 * np.stack([np.cos(q12), np.sin(q12)], axis=-1)

    def _exists(self, shortfall: Array, tilt: Array) -> Mask:
        reached = (shortfall <= REACH_TOLERANCE * self.geometry.reach) & (tilt <= UPRIGHT)
        return np.broadcast_to(reached[..., None], (*reached.shape, 2))

    def _joints(self, pose: Transform, near_1: Array) -> tuple[Array, Array, Array]:
        """Return joints (..., 2, 4) of both branches, shortfall (...) [m] and tilt (...) [rad]."""
        g = self.geometry
        x, y, z = (pose.translation[..., i] for i in range(3))
        bend = np.array([1.0, 1.0])
        bend[AXIS_2_NEGATIVE] = -1.0
        # Seen from above, x is the `up` of the triangle, and y its `forward`.
        q1, q2, shortfall = close_triangle(y[..., None], x[..., None], g.a1, g.a2, bend)
        on_axis_1 = np.hypot(x, y) < ON_AXIS_1 * g.reach
        q1 = np.where(on_axis_1[..., None], near_1[..., None], q1)
        q3 = np.broadcast_to(((z - g.flange_up) / METRES_PER_UNIT)[..., None], q1.shape)
        r = pose.rotation
        yaw = np.arctan2(r[..., 1, 0], r[..., 0, 0])[..., None]
        joints = np.stack([q1, q2, q3, q1 + q2 - yaw], axis=-1)
        tilt = np.arctan2(np.hypot(r[..., 0, 2], r[..., 1, 2]), -r[..., 2, 2])
        return joints, shortfall[..., 0], tilt


def _raised(place: Array, height: Array) -> Array:
    return np.concatenate([place, height[..., None]], axis=-1)


def _about_z(angle: Array) -> Array:
    """Return rotations (..., 3, 3) about the vertical by angles (...) [rad]."""
    rotation = np.zeros((*angle.shape, 3, 3))
    rotation[..., 0, 0] = rotation[..., 1, 1] = np.cos(angle)
    rotation[..., 1, 0] = np.sin(angle)
    rotation[..., 0, 1] = -rotation[..., 1, 0]
    rotation[..., 2, 2] = 1.0
    return rotation
