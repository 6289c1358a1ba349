"""Which links of an arm are judged against each other.

Neighbours share a joint and touch always. Of the others those are left out that touch in almost
every posture (the shapes overlap by their making) or in none at all; random postures tell. Arms of
the catalogue have the answer beside them in `self_pairs.toml`, with how it was found.
"""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from functools import lru_cache
from itertools import combinations

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.link_shapes import LinkShape, LinkShapes
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.files import input_text
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import dataclass

FILE_NAME = "self_pairs.toml"
SEED = 21
_ALWAYS = 0.9
"""Share of the postures from which on a pair touches by the making of its shapes."""
_NEVER_M = 0.02
"""A pair that never came as near as this never touches."""
_POSTURES = 300
_TURN = np.pi


@dataclass(frozen=True, slots=True)
class SelfPair:
    """Two links that are no neighbours, by their numbers."""

    first: int
    second: int
    touching: float
    """Share of the postures in which they touch."""
    nearest_m: float
    """The least distance of the other postures."""

    @property
    def left_out(self) -> str | None:
        """Why nobody judges them; None where they are judged."""
        if self.touching >= _ALWAYS:
            return "their shapes overlap"
        if not self.touching and self.nearest_m > _NEVER_M:
            return "they never come near each other"
        return None


def judged_pairs(robot: Robot, shapes: LinkShapes) -> tuple[tuple[int, int], ...]:
    """The links of an arm that are judged against each other."""
    stored = None if robot.urdf is None else robot.urdf.parent / FILE_NAME
    if robot.maker is not None and stored is not None and stored.is_file():
        return tuple((a, b) for a, b in tomllib.loads(input_text(stored))["judged"])
    return _by_postures(robot, shapes.links)


@lru_cache(maxsize=8)
def _by_postures(robot: Robot, links: tuple[LinkShape, ...]) -> tuple[tuple[int, int], ...]:
    found = self_pairs(robot, links, _POSTURES)
    return tuple((one.first, one.second) for one in found if one.left_out is None)


def self_pairs(robot: Robot, links: Sequence[LinkShape], postures: int) -> tuple[SelfPair, ...]:
    """How links that are no neighbours stand to each other in random postures within limits."""
    bodies = Bodies([link.shape.parts for link in links])
    joints = random_postures(robot, postures)
    base_from_link = robot.kinematics.link_frames(joints)
    found = []
    for a, b in combinations(range(len(links)), 2):
        first, second = links[a].number, links[b].number
        if second - first <= 1:
            continue
        seen = link_frame(base_from_link, second).inverse() @ link_frame(base_from_link, first)
        enough = np.full(postures, 2.0 * _NEVER_M)
        gaps = bodies.gaps(np.full(postures, a), np.full(postures, b), seen, enough)
        touching = gaps.found < -TOUCH_M
        apart = np.where(touching, np.inf, np.maximum(gaps.least, 0.0))
        found.append(SelfPair(first, second, float(touching.mean()), float(apart.min())))
    return tuple(found)


def random_postures(robot: Robot, count: int, seed: int = SEED) -> Array:
    """Joints (count, n) [rad] within limits, those without limits within a turn."""
    lower = np.where(np.isfinite(robot.lower), robot.lower, -_TURN)
    upper = np.where(np.isfinite(robot.upper), robot.upper, _TURN)
    # Plain numbers of a fixed seed: the same postures on every machine.
    share = np.random.default_rng(seed).random((count, len(lower)))
    joints: Array = lower + share * (upper - lower)
    return joints


def link_frame(base_from_link: Transform, number: int) -> Transform:
    """base_from_link (k,) of a link by its number; that of the base stands still."""
    if number:
        return base_from_link[:, number - 1]
    count = len(base_from_link)
    return Transform(np.tile(np.eye(3), (count, 1, 1)), np.zeros((count, 3)))
