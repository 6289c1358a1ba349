"""Bodies that touch at postures of an arm, while everything else in the cell stands."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.link_shapes import link_shapes
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.collisions.scene import Arm, AttachedBody, Body, Pair, Poses, Scene, SceneFrame
from rapidsim.collisions.self_pairs import judged_pairs
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import JointSamples
from rapidsim.values import value_class

_STILL_S: Final = 0.0


@value_class(frozen=True, slots=True, eq=False)
class Nearness:
    """Two bodies that touch or are near each other."""

    first: str
    second: str
    distance_m: float
    """Smallest distance [m] over the postures; 0 if they touch in one."""


class PostureContacts:
    """The bodies of a cell, of which one arm moves."""

    def __init__(self, scene: Scene, external: Array) -> None:
        """Select the pairs that exist at the start and that the arm may move.

        Args:
            scene: Bodies; the motion of its first arm, which is jogged, has no effect.
            external: Its external axes (e,) [m or rad].
        """
        self.scene, self._external = scene, external
        self._bodies = scene.shapes()
        pairs = {
            (pair.first, pair.second): pair.touch_only
            for pair in scene.pairs
            if pair.from_s <= _STILL_S < pair.until_s
            and all(scene.bodies[at].exists(_STILL_S) for at in (pair.first, pair.second))
        }
        self._pairs = np.array([*pairs], dtype=np.int64).reshape(-1, 2)
        self._touch_only = np.array([*pairs.values()], dtype=np.bool_)

    def poses(self, joints: Array) -> Poses:
        """Return the poses of all bodies at postures (k, n) [rad]."""
        count = len(joints)
        external = np.tile(self._external, (count, 1))
        samples = JointSamples(np.zeros(count, dtype=np.int64), joints, external)
        jogged, *others = self.scene.arms
        arms = (replace(jogged, at=lambda times: samples), *others)
        return replace(self.scene, arms=arms).poses(np.full(count, _STILL_S))

    def near(self, joints: Array, within_m: float) -> tuple[Nearness, ...]:
        """Return the pairs within a distance [m] at any of some postures (k, n), nearest first."""
        if not len(self._pairs):
            return ()
        poses, count = self.poses(joints), len(joints)
        first, second = np.repeat(self._pairs, count, axis=0).T
        at = np.tile(np.arange(count), len(self._pairs))
        second_in_world = Transform(poses.rotation[at, second], poses.translation[at, second])
        first_in_world = Transform(poses.rotation[at, first], poses.translation[at, first])
        seen = second_in_world.inverse() @ first_in_world
        wanted = np.where(self._touch_only, 0.0, within_m)
        gaps = self._bodies.gaps(first, second, seen, np.repeat(wanted, count))
        least = gaps.distances_found.reshape(len(self._pairs), count).min(axis=1)
        order = np.argsort(least, kind="stable")
        return tuple(
            Nearness(
                *self._names(row), 0.0 if least[row] < -TOUCH_M else max(0.0, float(least[row]))
            )
            for row in order.tolist()
            if least[row] < (-TOUCH_M if self._touch_only[row] else within_m)
        )

    def _names(self, row: int) -> tuple[str, str]:
        first, second = self._pairs[row].tolist()
        bodies = self.scene.bodies
        return bodies[first].label.name, bodies[second].label.name


def bare_scene(robot: Robot) -> Scene:
    """Return an arm alone, whose links must not touch each other."""
    shapes = link_shapes(robot)
    numbers = {link.number: at for at, link in enumerate(shapes.links)}
    bodies = tuple(
        Body(
            BodyName("the base" if link.number == 0 else f"link {link.number}", 0),
            link.shape,
            (AttachedBody(_STILL_S, SceneFrame(0, link.number), Transform.identity()),),
        )
        for link in shapes.links
    )
    pairs = tuple(
        Pair(numbers[a], numbers[b], 0, touch_only=True) for a, b in judged_pairs(robot, shapes)
    )
    return Scene((Arm(robot, Transform.identity(), _nowhere, ()),), bodies, pairs)


def _nowhere(times: Array) -> JointSamples:
    """Motion of an arm that is moved by hand only."""
    raise AssertionError("the arm has no motion of its own")
