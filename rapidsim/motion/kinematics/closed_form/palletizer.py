"""Palletizers with four axes, whose rods keep the flange level, such as the IRB 460 and 660.

Rods drive the forearm and the flange: joint 3 is the angle of the forearm from horizontal,
independent of joint 2, and the flange points down. Joints are 0 with the upper arm straight up and
the forearm level. RAPID stores the fourth joint as axis 6; axes 4 and 5 do not exist.

Source: r = a1 + c2 sin q2 + c3 cos q3 + wrist, z = c1 + c2 cos q2 - c3 sin q3 - drop.
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

JOINT_COUNT = 4
LEVEL = 1e-4
"""Largest angle [rad] of a pose off level: printed targets are no more exact."""
ON_AXIS_1 = 1e-10
"""Share of the reach within which the flange counts as lying on axis 1."""
ROUNDING = 1e-12
"""Angles [rad] and shares of the reach up to this are zero with rounding errors."""
_AXIS_FROM_JOINT = np.array(
    [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, -1.0, 1.0, 0.0],
        [0.0, 0.0, -1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ]
)
"""Shape (5, 4): angles of waist, shoulder, elbow, levelling axis and flange per joint value."""
_LINKS = (0, 1, 2, 4)
_DOWN = np.diag([1.0, -1.0, -1.0])
"""Flange with all joints at 0: x forward, z down."""


@value_class(frozen=True, slots=True)
class PalletizerGeometry:
    """Lengths [m] of a palletizer."""

    a1: float
    """Axis 1 to axis 2, forward."""
    c1: float
    """Base to axis 2, upward."""
    c2: float
    """Upper arm."""
    c3: float
    """Forearm."""
    wrist_forward: float
    """End of the forearm to the flange, forward."""
    flange_down: float
    """End of the forearm to the flange, downward."""

    @property
    def reach(self) -> float:
        """Length [m] of the stretched arm; the scale of every tolerance."""
        return self.c2 + self.c3


@value_class(frozen=True, eq=False)
class Palletizer(Kinematics):
    """Kinematics of a palletizer.

    Four branches: plus 2 if the flange is behind axis 1, plus 1 if the forearm turns backward from
    the upper arm. The rods of real arms allow hardly more than branch 0 within the limits.
    """

    geometry: PalletizerGeometry

    @property
    def joint_count(self) -> int:
        """Four joints."""
        return JOINT_COUNT

    @property
    def branch_count(self) -> int:
        """Four: two sides of axis 1, two elbows."""
        return 4

    @cached_property
    def chain(self) -> SerialChain:
        """The axes, rods included."""
        g = self.geometry
        top = g.c1 + g.c2
        wrist = [g.a1 + g.c3, 0.0, top]
        flange = np.array([g.a1 + g.c3 + g.wrist_forward, 0.0, top - g.flange_down])
        points = np.array([[0.0] * 3, [g.a1, 0.0, g.c1], [g.a1, 0.0, top], wrist, flange])
        left = [0.0, 1.0, 0.0]
        directions = np.array([[0.0, 0.0, 1.0], left, left, left, [0.0, 0.0, -1.0]])
        turns = np.broadcast_to(np.eye(3), (len(points), 3, 3))
        home = Transform(_DOWN, flange)
        axes = AxesAtZero(directions, points, Transform(turns, points), home)
        return SerialChain(axes, _AXIS_FROM_JOINT, _LINKS)

    def forward(self, joints: Array) -> Transform:
        """base_from_flange of joint vectors (..., 4) [rad]."""
        return self.chain.forward(joints)

    def link_frames(self, joints: Array) -> Transform:
        """base_from_link of each moving link, shape (..., 4), parallel to the base at zero."""
        return self.chain.link_frames(joints)

    def jacobian(self, joints: Array) -> Array:
        """Twist of the flange per joint speed, (..., 6, 4): [m/rad] over [rad/rad], in base."""
        return self.chain.jacobian(joints)

    def inverse(self, base_from_flange: Transform) -> Branches:
        """Return all four branches; axis 1 is 0 where the flange is on it."""
        angles, shortfall, tilt = self._angles(base_from_flange, np.array(0.0))
        exists = self._exists(shortfall, tilt)
        joints = np.where(exists[..., None], principal(angles), 0.0)
        return Branches(joints, exists, shortfall.min(axis=-1), tilt)

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
        """Return the branch of joints (..., 4); on a border, the front or the forward elbow."""
        joints = np.asarray(joints, dtype=np.float64)
        behind = self.flange_forward(joints) < -ROUNDING * self.geometry.reach
        backward = np.cos(joints[..., 2] - joints[..., 1]) < -ROUNDING
        branch: npt.NDArray[np.int64] = 2 * behind + backward
        return branch

    def singularities(self, joints: Array) -> tuple[Singularity, ...]:
        """Return the singularities of elbow and waist."""
        elbow = abs(float(np.cos(joints[2] - joints[1])))
        aside = abs(float(self.flange_forward(joints))) / self.geometry.reach
        return (
            Singularity("elbow", elbow, "upper arm and forearm are in line"),
            Singularity("shoulder", aside, "the flange is on axis 1"),
        )

    def flange_forward(self, joints: Array) -> Array:
        """Distance (...) [m] of the flange in front of axis 1."""
        g = self.geometry
        arm = g.c2 * np.sin(joints[..., 1]) + g.c3 * np.cos(joints[..., 2])
        forward: Array = g.a1 + arm + g.wrist_forward
        return forward

    def _exists(self, shortfall: Array, tilt: Array) -> Mask:
        reached: Mask = shortfall <= REACH_TOLERANCE * self.geometry.reach
        return reached & (tilt <= LEVEL)[..., None]

    def _angles(self, pose: Transform, near_1: Array) -> tuple[Array, Array, Array]:
        """Angles (..., 4, 4) [rad], shortfall (..., 4) [m] of all branches, tilt (...) [rad]."""
        g = self.geometry
        x, y, z = (pose.translation[..., i] for i in range(3))
        radius = np.hypot(x, y)
        ahead = np.where(radius < ON_AXIS_1 * g.reach, near_1, np.arctan2(y, x))[..., None]
        side = np.array([1.0, 1.0, -1.0, -1.0])
        bend = np.array([1.0, -1.0, 1.0, -1.0])
        forward = side * radius[..., None] - g.wrist_forward - g.a1
        up = (z + g.flange_down - g.c1)[..., None]
        q2, elbow, shortfall = close_triangle(forward, up, g.c2, g.c3, bend)
        q1 = ahead + np.array([0.0, 0.0, np.pi, np.pi])
        q3 = q2 + elbow - 0.5 * np.pi
        r = pose.rotation
        yaw = np.arctan2(r[..., 1, 0], r[..., 0, 0])
        angles = np.stack([q1, q2, q3, q1 - yaw[..., None]], axis=-1)
        tilt = np.arctan2(np.hypot(r[..., 0, 2], r[..., 1, 2]), -r[..., 2, 2])
        return angles, shortfall, tilt
