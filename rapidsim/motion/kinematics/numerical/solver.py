"""Arms without a closed form: damped least squares from many seeds.

Such arms have no branches that a sign could identify. `inverse` returns the distinct solutions that
the search finds; others may exist. A path is followed from each pose to the next, which keeps it on
the equivalent of a branch.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Branches, BranchJoints, Kinematics
from rapidsim.motion.kinematics.numerical.damped_least_squares import descend
from rapidsim.motion.kinematics.numerical.offset_wrist import NearArm, point_nearest
from rapidsim.motion.kinematics.numerical.seeds import spread_starts
from rapidsim.motion.kinematics.serial_chain import SerialChain
from rapidsim.motion.kinematics.unwrapping import in_turn_of, principal

MOST_SOLUTIONS = 16
STARTS = 32
SAME = 1e-5
"""Difference [rad] of every joint below which two solutions count as one."""


@dataclass(frozen=True, eq=False)
class Numerical(Kinematics):
    """Kinematics of any chain of revolute joints, by search."""

    chain: SerialChain
    lower: Array
    """Lower limits (n,) [rad] of the search for solutions."""
    upper: Array
    near: NearArm | None = None
    """Closed-form arm that moves almost the same, for better seeds; None if there is none."""

    @property
    def joint_count(self) -> int:
        """Number of joints of the chain."""
        return self.chain.joint_count

    @property
    def branch_count(self) -> int:
        """Maximum number of solutions that `inverse` returns."""
        return MOST_SOLUTIONS

    @property
    def posture(self) -> Array | None:
        """Initial posture of the near arm; None without a near arm."""
        return None if self.near is None else self.near.arm.posture

    def stance(self, joints: Array) -> Array:
        """Directions of lower arm and forearm (k, 4) if axes 2 and 3 are along y; see `PathRates`.

        With all joints at 0 the lower arm is upright and the forearm level.
        """
        lower, fore = joints[:, 1], joints[:, 1] + joints[:, 2]
        return np.stack([np.sin(lower), np.cos(lower), np.cos(fore), -np.sin(fore)], axis=-1)

    @cached_property
    def starts(self) -> Array:
        """Joint vectors (STARTS, n) [rad] used as seeds in every search."""
        return spread_starts(self.lower, self.upper, STARTS)

    @cached_property
    def stretched(self) -> tuple[Array, float]:
        """Point (3,) [m] that no joint moves, and the flange's maximum distance [m] from it.

        It is an upper bound: the length of a path from axis to axis through points fixed to
        both their links, so no joint changes the length of its parts; a tighter one may exist.
        """
        axes = self.chain.axes
        stations = [
            point_nearest(axes.points[k : k + 2], axes.directions[k : k + 2])
            for k in range(len(axes.points) - 1)
        ]
        flange = axes.base_from_flange.translation
        last, along = axes.points[-1], axes.directions[-1]
        way = np.array([*stations, last + along * float((flange - last) @ along), flange])
        return way[0], float(np.linalg.norm(np.diff(way, axis=0), axis=-1).sum())

    def forward(self, joints: Array) -> Transform:
        """base_from_flange of joint vectors (..., n) [rad]."""
        return self.chain.forward(joints)

    def link_frames(self, joints: Array) -> Transform:
        """base_from_link of each moving link, shape (..., n), of joint vectors (..., n) [rad]."""
        return self.chain.link_frames(joints)

    def jacobian(self, joints: Array) -> Array:
        """Twist of the flange per joint speed, (..., 6, n): [m/rad] over [rad/rad], in base."""
        return self.chain.jacobian(joints)

    def inverse(self, base_from_flange: Transform) -> Branches:
        """Return solutions within the limits that the search finds for poses (...,).

        At most `MOST_SOLUTIONS`, sorted by distance from the middle of the limits. Arms with more
        than six joints have infinitely many; the selection is arbitrary, but identical in every
        run.
        """
        leading = base_from_flange.translation.shape[:-1]
        poses = Transform(
            base_from_flange.rotation.reshape(-1, 3, 3),
            base_from_flange.translation.reshape(-1, 3),
        )
        count = len(poses)
        joints = np.zeros((count, MOST_SOLUTIONS, self.joint_count))
        exists = np.zeros((count, MOST_SOLUTIONS), dtype=np.bool_)
        distance, angle = np.zeros(count), np.zeros(count)
        for row in range(count):
            found, distance[row], angle[row] = self._search(poses[row])
            joints[row, : len(found)] = found
            exists[row, : len(found)] = True
        return Branches(
            joints.reshape(*leading, MOST_SOLUTIONS, self.joint_count),
            exists.reshape(*leading, MOST_SOLUTIONS),
            distance.reshape(leading),
            angle.reshape(leading),
            searched=True,
        )

    def inverse_on_branch(
        self, base_from_flange: Transform, branch: int, near: Array
    ) -> BranchJoints:
        """Return joints for poses (k,) that continue the joints of `near`; `branch` is ignored.

        With a single vector, the search for each row is seeded with the previous row.
        """
        near = np.asarray(near, dtype=np.float64)
        if near.ndim == 2:
            ended = descend(self.chain, base_from_flange, near)
            joints, exists = ended.joints, ended.reached
        else:
            joints = np.zeros((len(base_from_flange), self.joint_count))
            exists = np.zeros(len(joints), dtype=np.bool_)
            before = near
            for row in range(len(joints)):
                ended = descend(self.chain, base_from_flange[row : row + 1], before[None])
                joints[row], exists[row] = ended.joints[0], ended.reached[0]
                before = joints[row] if exists[row] else before
        return BranchJoints(in_turn_of(joints, exists, near), exists)

    def branch_of(self, joints: Array) -> npt.NDArray[np.int64]:
        """Return 0: there are no branches to distinguish."""
        return np.zeros(np.shape(joints)[:-1], dtype=np.int64)

    def _search(self, pose: Transform) -> tuple[Array, float, float]:
        """Return solutions (s, n) of one pose; if s is 0, with the remaining distance and angle."""
        starts = self.starts
        if self.near is not None:
            starts = np.concatenate([self._within(self.near.starts(pose)), starts])
        poses = Transform(
            np.broadcast_to(pose.rotation, (len(starts), 3, 3)),
            np.broadcast_to(pose.translation, (len(starts), 3)),
        )
        ended = descend(self.chain, poses, starts, self.lower, self.upper)
        reached = ended.joints[ended.reached]
        if not len(reached):
            best = int(np.argmin(ended.distance + ended.angle))
            return reached, float(ended.distance[best]), float(ended.angle[best])
        from_middle = np.abs(reached - self.starts[0]).sum(axis=-1)
        found: list[Array] = []
        for joints in reached[np.argsort(from_middle, kind="stable")]:
            if all(np.abs(principal(joints - other)).max() > SAME for other in found):
                found.append(joints)
        return np.array(found[:MOST_SOLUTIONS]), 0.0, 0.0

    def _within(self, joints: Array) -> Array:
        """Return seeds (k, n) [rad] in the turn that is nearest to the middle of the limits."""
        turned: Array = self.starts[0] + principal(joints - self.starts[0])
        return turned
