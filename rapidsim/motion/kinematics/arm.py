"""What path planning needs from an arm: forward, inverse on a branch, all branches.

Everything is batch first: N poses in one call, one pose is N = 1. `Kinematics.single` is for one
pose at a time. Every query has a default implementation here, which an arm with formulas can
replace by a better one.

A sliding joint appears among rotating joints, and wherever these are in rad or degrees its
millimetres are treated like degrees: `value [rad] = distance [mm] * pi / 180`. So the same
conversion gives RAPID's number for every joint. `Kinematics.slides` tells which joints slide.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import Protocol

import numpy as np
import numpy.typing as npt

from rapidsim.frames import rigid
from rapidsim.frames.rigid import Rigid
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.singularity import Singularity, by_idle_motion
from rapidsim.motion.kinematics.unwrapping import ENDLESS, TURN
from rapidsim.values import value_class

Mask = npt.NDArray[np.bool_]

METRES_PER_UNIT = 1e-3 * degrees(1.0)
"""The way [m] of a joint that slides where its value is 1: what a joint that turns calls a rad is
57.3 mm."""
_RAPID_AXES = {4: (0, 1, 2, 5), 7: (0, 1, 6, 2, 3, 4, 5)}
"""See `Kinematics.rapid_axes`, by the number of joints, where it is not one by one."""


@value_class(frozen=True, slots=True)
class Branches:
    """Every joint vector that reaches a pose, before limits, ordered by branch.

    For arms with a spherical wrist the branch is ABB's cfx, 0 to 7.
    """

    joints: Array
    """Shape (..., branches, n) [rad], each joint in its principal turn."""
    exists: Mask
    """Shape (..., branches): whether the branch reaches the pose; joints are 0 if not."""
    shortfall: Array
    """Shape (...,) [m]: how far the wrist centre lies outside what the arm can reach; 0 inside."""
    tilt: Array | None = None
    """Shape (...,) [rad]: how far the orientation is from those that the arm can give; None for
    arms that can give all."""
    searched: bool = False
    """Whether the joints were searched for step by step: then there may be others than those found,
    and `shortfall` and `tilt` say how near the search came to the pose."""


@value_class(frozen=True, slots=True)
class BranchJoints:
    """Joint vectors along a sequence of poses on one branch."""

    joints: Array
    """Shape (k, n) [rad]; continuous, whole turns included."""
    exists: Mask
    """Shape (k,): False where the branch does not reach the pose."""


class ScalarKinematics(Protocol):
    """The same queries for one pose or joint vector, in plain floats."""

    def forward(self, joints: Sequence[float]) -> Rigid:
        """base_from_flange of a joint vector [rad]."""
        ...

    def inverse_on_branch(
        self, base_from_flange: Rigid, branch: int, near: Sequence[float] | None
    ) -> list[float] | None:
        """Joints [rad] on a branch, each in the turn closest to `near`; None if there are none.

        Without `near` they are in their principal turns, and there are none if the pose leaves an
        axis undetermined or the arm has no formulas for one pose.
        """
        ...

    def branch_of(self, joints: Sequence[float]) -> int:
        """The branch of a joint vector."""
        ...


class Kinematics(Protocol):
    """The geometry of an arm, without limits and names."""

    @property
    def spherical_wrist(self) -> bool:
        """Whether the last three axes intersect, so that with axis 5 at 0 axes 4 and 6 coincide."""
        return False

    @property
    def posture(self) -> Array | None:
        """Joints (n,) [rad] to start in, away from singularities; None without a preference."""
        return None

    def stance(self, joints: Array) -> Array:
        """How arms (k, n) [rad] stand, shape (k, 4); see `PathRates`. Zeros if not known."""
        return np.zeros((len(joints), 4))

    @property
    def slides(self) -> Mask:
        """Which joints (n,) slide along their axis: their values are millimetres * pi / 180."""
        return np.zeros(self.joint_count, dtype=np.bool_)

    @property
    def turns(self) -> Array:
        """By how much each joint (n,) [rad] may be shifted without changing the arm's pose.

        A whole turn; `ENDLESS` for a sliding joint, which has none.
        """
        return np.where(self.slides, ENDLESS, TURN)

    @property
    def rapid_axes(self) -> tuple[int, ...]:
        """Which of RAPID's axes each joint is, from base to flange: 0 to 5 `robax`, 6 `eax_a`.

        The additional joint of seven-axis arms is the third in their chain. The last of four joints
        is axis 6, as on palletizers, unless the arm says otherwise.
        """
        return _RAPID_AXES.get(self.joint_count) or tuple(range(self.joint_count))

    @property
    def single(self) -> ScalarKinematics:
        """The same queries for one pose."""
        return ScalarFromBatch(self)

    def singularities(self, joints: Array) -> tuple[Singularity, ...]:
        """The singularities of the arm and how far joints (n,) [rad] are from each."""
        return by_idle_motion(self.jacobian(joints))

    def limiting_length(self, base_from_flange: Transform) -> str | None:
        """Which part of the arm keeps it from one pose, with lengths; None if not known."""
        del base_from_flange
        return None

    @property
    def joint_count(self) -> int:
        """How many joints the arm has."""
        ...

    @property
    def branch_count(self) -> int:
        """How many branches `inverse` returns."""
        ...

    def forward(self, joints: Array) -> Transform:
        """base_from_flange of joint vectors (..., n) [rad]; the flange is ABB's tool0."""
        ...

    def link_frames(self, joints: Array) -> Transform:
        """base_from_link of each moving link, shape (..., n), of joint vectors (..., n) [rad]."""
        ...

    def jacobian(self, joints: Array) -> Array:
        """Twist of the flange per joint speed, (..., 6, n): [m/rad] over [rad/rad], in base.

        For a sliding joint, m per unit of its value and no rotation.
        """
        ...

    def inverse(self, base_from_flange: Transform) -> Branches:
        """All branches of a batch of poses (...,)."""
        ...

    def inverse_on_branch(
        self, base_from_flange: Transform, branch: int, near: Array
    ) -> BranchJoints:
        """Joints of poses (k,) on one branch.

        Args:
            base_from_flange: Poses (k,).
            branch: Index into `Branches.joints`.
            near: Joint vectors (k, n) [rad], or one (n,) that precedes the first row. Each joint
                takes the whole turn closest to its own row of `near`, or, with a single vector, to
                the previous row. What the pose leaves undetermined (axes 4 and 6 where axis 5 is 0,
                axis 1 where the wrist centre is on it) keeps that value.
        """
        ...

    def branch_of(self, joints: Array) -> npt.NDArray[np.int64]:
        """The branch of joint vectors (..., n), shape (...,)."""
        ...


@value_class(frozen=True, slots=True)
class ScalarFromBatch:
    """`ScalarKinematics` for arms without formulas of their own for one pose."""

    kinematics: Kinematics

    def forward(self, joints: Sequence[float]) -> Rigid:
        """base_from_flange of a joint vector [rad]."""
        return rigid.from_transform(self.kinematics.forward(np.array(joints)))

    def inverse_on_branch(
        self, base_from_flange: Rigid, branch: int, near: Sequence[float] | None
    ) -> list[float] | None:
        """See `ScalarKinematics.inverse_on_branch`."""
        if near is None:
            return None
        poses = rigid.to_transform(base_from_flange)[None]
        followed = self.kinematics.inverse_on_branch(poses, branch, np.array(near))
        joints: list[float] = followed.joints[0].tolist()
        return joints if followed.exists[0] else None

    def branch_of(self, joints: Sequence[float]) -> int:
        """The branch of a joint vector."""
        return int(self.kinematics.branch_of(np.array(joints)))
