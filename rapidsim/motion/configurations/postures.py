"""Postures of an arm for display: one for given joints, or all that reach a pose."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.singularities import Differential
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

_MOVES = 0.2
"""Linear share [m/rad] of a direction from which on it is displayed as a velocity."""


@value_class(frozen=True, slots=True, eq=False)
class Posture:
    """One posture."""

    joints: Array
    """Shape (n,) [rad]."""
    name: str
    within_limits: bool = True


@value_class(frozen=True, slots=True, eq=False)
class Postures:
    """An arm in one or more postures."""

    robot: Robot
    world_from_base: Transform
    flange_from_tcp: Transform
    rows: tuple[Posture, ...]
    """At least one posture."""
    title: str
    differential: Differential | None = None
    """Jacobian and singularities of the first posture; None if not requested."""

    @property
    def world_from_tcp(self) -> Transform:
        """The pose of the TCP in the first posture."""
        return self.world_from_base @ self.robot.forward(self.rows[0].joints) @ self.flange_from_tcp

    def frames(self, row: int) -> Transform:
        """world_from_frame (n + 2,): the links, the flange and the TCP of a posture."""
        joints = self.rows[row].joints
        links = self.robot.kinematics.link_frames(joints)
        flange = self.robot.forward(joints)
        tcp = flange @ self.flange_from_tcp
        base_from_frames = Transform(
            np.concatenate([links.rotation, flange.rotation[None], tcp.rotation[None]]),
            np.concatenate([links.translation, flange.translation[None], tcp.translation[None]]),
        )
        return self.world_from_base @ base_from_frames

    @property
    def relative_frames(self) -> list[tuple[str, Transform]]:
        """Poses of each link in the link before it, and of the TCP in the last, with names.

        Of the first posture. Link 0 is the base; the product is the pose of the TCP in the base.
        """
        links = self.robot.kinematics.link_frames(self.rows[0].joints)
        tcp = self.world_from_base.inverse() @ self.world_from_tcp
        frames = [Transform.identity(), *(links[k] for k in range(len(links))), tcp]
        names = [*map(str, range(len(links) + 1)), "TCP"]
        return [
            (f"T({names[k]},{names[k + 1]})", frames[k].inverse() @ frames[k + 1])
            for k in range(len(frames) - 1)
        ]

    @property
    def size(self) -> float:
        """The approximate size of the arm [m]."""
        places = [self.frames(row).translation for row in range(len(self.rows))]
        foot = self.world_from_base.translation
        return max(float(np.linalg.norm(np.concatenate(places) - foot, axis=1).max()), 0.05)

    @property
    def weakest(self) -> tuple[Array, str] | None:
        """Direction (3,) in the world in which, or about which, joints move the TCP least.

        Returned with a description in words; None if no Jacobian was requested.
        """
        if self.differential is None:
            return None
        directions, values, _ = np.linalg.svd(self.differential.jacobian)
        rank = min(self.differential.jacobian.shape)
        # With fewer than six joints some directions are never moved: use the weakest of the others.
        velocity, turning = np.split(directions[:, rank - 1], 2)
        moves = float(np.linalg.norm(velocity)) >= _MOVES
        direction = velocity if moves else turning
        said = "moved least" if moves else "turned least about this"
        along: Array = self.world_from_base.rotation @ (direction / np.linalg.norm(direction))
        return along, f"{said}: singular value {values[rank - 1]:.3g}"
