"""Arms with five axes: waist, shoulder, elbow, wrist pitch, wrist roll, such as the RV-M1.

The flange point, the wrist and the direction of the roll axis lie in the vertical plane that the
waist turns. A pose whose roll axis leaves that plane is unreachable; the deviation is reported.

Joints are 0 with the arm stretched forward, the roll axis in line with it. The frame of the flange
has z out of it, y up and x to the left there.

Source: Standard DH table of the Mitsubishi RV-M1 with joint 4 from -90 to 90 deg. The inverse is
    derived here; formulas printed for this arm elsewhere have wrong signs.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Branches, BranchJoints, Kinematics, Mask
from rapidsim.motion.kinematics.closed_form.two_link import REACH_TOLERANCE, close_triangle
from rapidsim.motion.kinematics.serial_chain import AxesAtZero, SerialChain
from rapidsim.motion.kinematics.singularity import Singularity
from rapidsim.motion.kinematics.unwrapping import in_turn_of, principal
from rapidsim.values import value_class

JOINT_COUNT = 5
ALIGNED = 1e-4
"""Largest angle [rad] between the roll axis and the plane of the arm: printed targets are no more
exact."""
ON_WAIST = 1e-9
"""Share of the reach within which a point counts as lying on axis 1."""
_LEFT_UP_OUT = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""The flange with all joints at 0."""


@value_class(frozen=True, slots=True)
class FiveAxisGeometry:
    """Lengths [m]; the names are those in the DH table."""

    d1: float
    """Base to shoulder, upward."""
    a2: float
    """Shoulder to elbow."""
    a3: float
    """Elbow to wrist."""
    d5: float
    """Wrist to flange, along the roll axis."""

    @property
    def reach(self) -> float:
        """Maximum distance [m] of the flange from the shoulder."""
        return self.a2 + self.a3 + self.d5


@value_class(frozen=True, eq=False)
class FiveAxis(Kinematics):
    """Kinematics of a five-axis arm.

    Four branches: plus 2 where the wrist is behind the waist, plus 1 where joint 3 is positive (the
    elbow hangs below the line from shoulder to wrist, with the wrist in front).
    """

    geometry: FiveAxisGeometry

    @property
    def joint_count(self) -> int:
        """Five joints."""
        return JOINT_COUNT

    @property
    def branch_count(self) -> int:
        """Four: two sides of the waist, two elbows."""
        return 4

    @cached_property
    def chain(self) -> SerialChain:
        """The axes."""
        g = self.geometry
        elbow, wrist = g.a2, g.a2 + g.a3
        points = np.array([[0.0, 0.0, 0.0], *([x, 0.0, g.d1] for x in (0.0, elbow, wrist, wrist))])
        right = [0.0, -1.0, 0.0]
        directions = np.array([[0.0, 0.0, 1.0], right, right, right, [1.0, 0.0, 0.0]])
        flange = np.array([g.reach, 0.0, g.d1])
        places = np.concatenate([points[:-1], flange[None]])
        turns = np.broadcast_to(np.eye(3), (JOINT_COUNT, 3, 3))
        home = Transform(_LEFT_UP_OUT, flange)
        return SerialChain.uncoupled(AxesAtZero(directions, points, Transform(turns, places), home))

    def forward(self, joints: Array) -> Transform:
        """base_from_flange of joint vectors (..., 5) [rad]."""
        return self.chain.forward(joints)

    def link_frames(self, joints: Array) -> Transform:
        """base_from_link of each moving link, shape (..., 5), parallel to the base at zero."""
        return self.chain.link_frames(joints)

    def jacobian(self, joints: Array) -> Array:
        """Twist of the flange per joint speed, (..., 6, 5): [m/rad] over [rad/rad], in base."""
        return self.chain.jacobian(joints)

    def inverse(self, base_from_flange: Transform) -> Branches:
        """Return all four branches; axis 1 is 0 if the pose does not determine it."""
        angles, shortfall, tilt = self._angles(base_from_flange, np.array(0.0))
        exists = self._exists(shortfall, tilt)
        joints = np.where(exists[..., None], principal(angles), 0.0)
        return Branches(joints, exists, shortfall, tilt)

    def inverse_on_branch(
        self, base_from_flange: Transform, branch: int, near: Array
    ) -> BranchJoints:
        """Joints of poses (k,) on one branch; see `Kinematics.inverse_on_branch`."""
        near = np.asarray(near, dtype=np.float64)
        flip = np.pi if branch & 2 else 0.0
        angles, shortfall, tilt = self._angles(base_from_flange, near[..., 0] - flip)
        exists = self._exists(shortfall, tilt)[..., branch]
        return BranchJoints(in_turn_of(principal(angles[..., branch, :]), exists, near), exists)

    def branch_of(self, joints: Array) -> npt.NDArray[np.int64]:
        """Return the branch of joint vectors (..., 5); on a border the front, the negative elbow.

        With the wrist above or below the waist, the flange position determines the front.
        """
        joints = np.asarray(joints, dtype=np.float64)
        nothing = ON_WAIST * self.geometry.reach
        wrist = self.wrist_forward(joints)
        leads = np.where(np.abs(wrist) < nothing, self.flange_forward(joints), wrist)
        behind = leads < -nothing
        positive = np.sin(joints[..., 2]) > ON_WAIST
        branch: npt.NDArray[np.int64] = 2 * behind + positive
        return branch

    def singularities(self, joints: Array) -> tuple[Singularity, ...]:
        """Return the singularities: elbow stretched, or roll axis on the waist axis.

        The first three rows of the Jacobian, the velocity, lose rank already if the flange is on
        the waist axis, for any roll axis: then no joint moves the flange sideways.
        """
        elbow = abs(float(np.sin(joints[2])))
        aside = abs(float(self.flange_forward(joints))) / self.geometry.reach
        return (
            Singularity("elbow", elbow, "axes 2, 3 and 4 are in one plane: the arm is straight"),
            Singularity("shoulder", aside, "the flange is on axis 1"),
        )

    def wrist_forward(self, joints: Array) -> Array:
        """Distance (...) [m] of the wrist in front of the waist."""
        q2, q23 = joints[..., 1], joints[..., 1] + joints[..., 2]
        forward: Array = self.geometry.a2 * np.cos(q2) + self.geometry.a3 * np.cos(q23)
        return forward

    def flange_forward(self, joints: Array) -> Array:
        """Distance (...) [m] of the flange in front of the waist."""
        pitch = joints[..., 1] + joints[..., 2] + joints[..., 3]
        forward: Array = self.wrist_forward(joints) + self.geometry.d5 * np.cos(pitch)
        return forward

    def _exists(self, shortfall: Array, tilt: Array) -> Mask:
        reached = (shortfall <= REACH_TOLERANCE * self.geometry.reach) & (tilt <= ALIGNED)
        return np.broadcast_to(reached[..., None], (*reached.shape, 4))

    def _angles(self, pose: Transform, near_1: Array) -> tuple[Array, Array, Array]:
        """Angles (..., 4, 5) [rad] of all branches, shortfall (...) [m] and tilt (...) [rad].

        The flange point lies in the plane of the arm for any orientation, so it determines axis 1;
        the roll axis is projected into the plane, and tilt is the angle of the projection.
        """
        g = self.geometry
        x, y = pose.translation[..., 0], pose.translation[..., 1]
        out = pose.rotation[..., :, 2]
        level = np.hypot(out[..., 0], out[..., 1])
        # For a flange above the waist the roll axis determines axis 1; if that is vertical, `near`.
        above_waist = np.hypot(x, y) < ON_WAIST * g.reach
        ahead = np.where(level < ON_WAIST, near_1, np.arctan2(out[..., 1], out[..., 0]))
        ahead = np.where(above_waist, ahead, np.arctan2(y, x))
        c, s = np.cos(ahead), np.sin(ahead)
        out_forward = c * out[..., 0] + s * out[..., 1]
        out_sideways = np.abs(c * out[..., 1] - s * out[..., 0])
        tilt = np.arctan2(out_sideways, np.hypot(out_forward, out[..., 2]))
        pitch = np.arctan2(out[..., 2], out_forward)
        wrist = c * x + s * y - g.d5 * np.cos(pitch)
        up = pose.translation[..., 2] - g.d1 - g.d5 * np.sin(pitch)
        in_front = wrist >= -ON_WAIST * g.reach

        shape = (*ahead.shape, 4)
        forwards = np.where([True, True, False, False], in_front[..., None], ~in_front[..., None])
        side = np.where(forwards, 1.0, -1.0)  # -1: the waist is turned away from the flange
        bend = np.broadcast_to([1.0, -1.0, 1.0, -1.0], shape)
        lean, elbow, shortfall = close_triangle(
            side * wrist[..., None], up[..., None], g.a2, g.a3, bend
        )
        q1 = np.where(forwards, ahead[..., None], ahead[..., None] + np.pi)
        # The triangle leans forward from straight up; joints 2 and 3 turn upward from level.
        q2, q3 = 0.5 * np.pi - lean, -elbow
        pitches = np.where(forwards, pitch[..., None], np.pi - pitch[..., None])
        q5 = _roll(pose.rotation[..., None, :, :], q1, pitches)
        angles = np.stack([q1, q2, q3, pitches - q2 - q3, q5], axis=-1)
        return angles, shortfall[..., 0], tilt


def _roll(rotation: Array, q1: Array, pitch: Array) -> Array:
    """Return the roll (...) [rad] that remains of rotations (..., 3, 3) after waist and pitch."""
    c1, s1, cp, sp = np.cos(q1), np.sin(q1), np.cos(pitch), np.sin(pitch)
    left = np.stack([-s1, c1, np.zeros_like(c1)], axis=-1)
    up = np.stack([-c1 * sp, -s1 * sp, cp], axis=-1)
    x, y = rotation[..., :, 0], rotation[..., :, 1]
    # x of the flange points left and y up at roll 0; both determine the roll, to share a tilt.
    sine = np.sum(x * up - y * left, axis=-1)
    cosine = np.sum(x * left + y * up, axis=-1)
    roll: Array = np.arctan2(sine, cosine)
    return roll
