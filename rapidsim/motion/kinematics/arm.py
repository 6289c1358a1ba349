"""Queries that path planning needs from an arm: forward, inverse on a branch, all branches.

Everything is batch first: N poses in one call, one pose is N = 1. `Kinematics.single` is for one
pose at a time. Every query has a default implementation here, which an arm with closed formulas can
override by a better one.

A sliding joint appears among rotating joints, and where these are in rad or degrees its millimetres
are treated like degrees: `value [rad] = distance [mm] * pi / 180`. So one conversion yields RAPID's
number for every joint. `Kinematics.slides` marks the sliding joints.
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
"""Distance [m] per unit of a sliding joint's value: 57.3 mm correspond to the rad of a rotating
joint."""
_RAPID_AXES = {4: (0, 1, 2, 5), 7: (0, 1, 6, 2, 3, 4, 5)}
"""`Kinematics.rapid_axes` by the number of joints, where it is not the identity."""


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
    """Shape (...,) [m]: distance of the wrist centre outside the reach of the arm; 0 inside."""
    tilt: Array | None = None
    """Shape (...,) [rad]: angle from the orientation to the nearest one that the arm can reach;
    None for arms that reach all orientations."""
    searched: bool = False
    """Whether the joints result from an iterative search: other solutions may exist, and
    `shortfall` and `tilt` are the residuals of the search."""


@value_class(frozen=True, slots=True)
class BranchJoints:
    """Joint vectors along a sequence of poses on one branch."""

    joints: Array
    """Shape (k, n) [rad]; continuous, whole turns included."""
    exists: Mask
    """Shape (k,): False where the branch does not reach the pose."""


class ScalarKinematics(Protocol):
    """Queries of `Kinematics` for one pose or joint vector, in plain floats."""

    def forward(self, joints: Sequence[float]) -> Rigid:
        """Return base_from_flange of a joint vector [rad]."""
        ...

    def inverse_on_branch(
        self, base_from_flange: Rigid, branch: int, near: Sequence[float] | None
    ) -> list[float] | None:
        """Return joints [rad] on a branch, each in the turn closest to `near`; None if unreachable.

        Without `near` they are in their principal turns; None also if the pose does not determine
        an axis or the arm has no closed formulas for one pose.
        """
        ...

    def branch_of(self, joints: Sequence[float]) -> int:
        """Return the branch of a joint vector."""
        ...


class Kinematics(Protocol):
    """Geometry of an arm, without limits and names."""

    @property
    def spherical_wrist(self) -> bool:
        """Whether the last three axes intersect, so that with axis 5 at 0 axes 4 and 6 coincide."""
        return False

    @property
    def posture(self) -> Array | None:
        """Preferred initial joints (n,) [rad], away from singularities; None if undefined."""
        return None

    def stance(self, joints: Array) -> Array:
        """Return link directions (k, 4) at joints (k, n) [rad]; see `PathRates`; 0 if unknown."""
        return np.zeros((len(joints), 4))

    @property
    def slides(self) -> Mask:
        """Mask (n,) of the joints that slide along their axis: their values are mm * pi / 180."""
        return np.zeros(self.joint_count, dtype=np.bool_)

    @property
    def turns(self) -> Array:
        """Period of each joint (n,) [rad]: shift that does not change the arm's pose.

        A whole turn; `ENDLESS` for a sliding joint, which has none.
        """
        return np.where(self.slides, ENDLESS, TURN)

    @property
    def rapid_axes(self) -> tuple[int, ...]:
        """RAPID axis of each joint, from base to flange: 0 to 5 `robax`, 6 `eax_a`.

        The additional joint of seven-axis arms is the third in their chain. The last of four joints
        is axis 6, as on palletizers; other arms override this.
        """
        return _RAPID_AXES.get(self.joint_count) or tuple(range(self.joint_count))

    @property
    def single(self) -> ScalarKinematics:
        """Kinematics of the arm for one pose, in plain floats."""
        return ScalarFromBatch(self)

    def singularities(self, joints: Array) -> tuple[Singularity, ...]:
        """Return the singularities of the arm and the distance of joints (n,) [rad] from each."""
        return by_idle_motion(self.jacobian(joints))

    def limiting_length(self, base_from_flange: Transform) -> str | None:
        """Describe the part of the arm that limits it at a pose, with lengths; None if unknown."""
        del base_from_flange
        return None

    @property
    def joint_count(self) -> int:
        """Number of joints of the arm."""
        ...

    @property
    def branch_count(self) -> int:
        """Number of branches that `inverse` returns."""
        ...

    def forward(self, joints: Array) -> Transform:
        """Return base_from_flange of joint vectors (..., n) [rad]; the flange is ABB's tool0."""
        ...

    def link_frames(self, joints: Array) -> Transform:
        """base_from_link of each moving link, shape (..., n), for joints (..., n) [rad]."""
        ...

    def jacobian(self, joints: Array) -> Array:
        """Return the twist of the flange per joint speed, (..., 6, n): [m/rad], [rad/rad], in base.

        For a sliding joint, m per unit of its value and no rotation.
        """
        ...

    def inverse(self, base_from_flange: Transform) -> Branches:
        """Return all branches of a batch of poses (...,)."""
        ...

    def inverse_on_branch(
        self, base_from_flange: Transform, branch: int, near: Array
    ) -> BranchJoints:
        """Return joints of poses (k,) on one branch.

        Args:
            base_from_flange: Poses (k,).
            branch: Index into `Branches.joints`.
            near: Joint vectors (k, n) [rad], or one (n,) that precedes the first row. Each joint
                takes the whole turn closest to its own row of `near`, or, with a single vector, to
                the previous row. Axes that the pose does not determine (4 and 6 where axis 5
                is 0, 1 where the wrist centre is on it) keep that value.
        """
        ...

    def branch_of(self, joints: Array) -> npt.NDArray[np.int64]:
        """Return the branch of joint vectors (..., n), shape (...,)."""
        ...


@value_class(frozen=True, slots=True)
class ScalarFromBatch:
    """`ScalarKinematics` for arms without closed formulas for one pose."""

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
