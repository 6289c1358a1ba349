"""Selection of the links of an arm that are checked against each other.

Adjacent links share a joint and always touch. Other pairs are skipped if they touch in almost every
posture (their shapes overlap by construction) or never. This is determined from random postures;
for links that came close without touching, it is proved if possible that they touch in no posture
within
limits: every posture is near a sampled one, nearer than the distance of the links there. For
    arms of the catalogue the result, and its derivation, is stored in `self_pairs.toml`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import combinations

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.link_shapes import LinkShape, LinkShapes
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.files import input_text
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

FILE_NAME = "self_pairs.toml"
SEED = 21
_ALWAYS = 0.9
"""Share of the postures above which a pair touches by the construction of its shapes."""
_NEVER_M = 0.02
"""Smallest distance [m] above which a pair never touches."""
_POSTURES = 300
_HALF_TURN = np.pi
_LOOKS = 3000
"""Number of postures, for an arm outside the catalogue, to prove that a pair never touches."""
_SHOWN_M = 0.002
"""Distance [m] of links below which no proof is attempted: it takes too many postures."""
_SEEN_RAD = 0.1


@value_class(frozen=True, slots=True)
class SelfPair:
    """Two links that are not adjacent, by their numbers."""

    first: int
    second: int
    touching: float
    """Share of the postures in which they touch."""
    nearest_m: float
    """Smallest distance in the other postures."""
    proven_separate: bool = False
    """Whether it is proved that they touch in no posture within limits."""

    @property
    def left_out(self) -> str | None:
        """Reason why the pair is not checked; None if it is."""
        if self.touching >= _ALWAYS:
            return "their shapes overlap"
        if not self.touching and self.nearest_m > _NEVER_M:
            return "they never come near each other"
        if self.proven_separate:
            return "no posture lets them touch"
        return None


def judged_pairs(robot: Robot, shapes: LinkShapes) -> tuple[tuple[int, int], ...]:
    """Return the pairs of links of an arm that are checked against each other."""
    stored = None if robot.urdf is None or robot.meshes else robot.urdf.parent / FILE_NAME
    if robot.maker is not None and stored is not None and stored.is_file():
        # A shape that cannot be read is reported, and its link is not checked.
        numbers = {link.number for link in shapes.links}
        pairs = tomllib.loads(input_text(stored))["judged"]
        return tuple((a, b) for a, b in pairs if a in numbers and b in numbers)
    return _by_postures(robot, shapes.links)


@lru_cache(maxsize=8)
def _by_postures(robot: Robot, links: tuple[LinkShape, ...]) -> tuple[tuple[int, int], ...]:
    found = self_pairs(robot, links, _POSTURES)
    return tuple((one.first, one.second) for one in found if one.left_out is None)


def self_pairs(
    robot: Robot, links: Sequence[LinkShape], postures: int, sample_count: int = _LOOKS
) -> tuple[SelfPair, ...]:
    """Measure how often and how closely non-adjacent links meet in random postures within limits.

    Args:
        robot: The arm.
        links: Its bodies.
        postures: Number of postures to sample.
        sample_count: Maximum number of further postures for a proof, else the pair is undecided.
    """
    bodies = Bodies([link.shape for link in links])
    joints = random_postures(robot, postures)
    base_from_link = robot.kinematics.link_frames(joints)
    found = []
    for a, b in combinations(range(len(links)), 2):
        first, second = links[a].number, links[b].number
        if second - first <= 1:
            continue
        seen = _seen(base_from_link, first, second)
        pair = _seen_often(bodies, (a, b), (first, second), seen[:_POSTURES])
        if pair.touching < _ALWAYS and postures > _POSTURES:
            pair = _seen_often(bodies, (a, b), (first, second), seen)
        if not pair.touching and pair.left_out is None:
            pair = replace(
                pair,
                proven_separate=_is_proven_separate(robot, links, bodies, (a, b), sample_count),
            )
        found.append(pair)
    return tuple(found)


def _seen_often(
    bodies: Bodies, pair: tuple[int, int], numbers: tuple[int, int], seen: Transform
) -> SelfPair:
    """Return contact share and distance of two links; `seen` is the first in the second (k,)."""
    row = np.zeros(len(seen), dtype=np.int64)
    apart = bodies.bounds.gaps(row + pair[0], row + pair[1], seen)
    near = np.flatnonzero(apart < _NEVER_M)
    row, enough = row[near], np.full(len(near), 2.0 * _NEVER_M)
    gaps = bodies.gaps(row + pair[0], row + pair[1], seen[near], enough)
    touching = gaps.distances_found < -TOUCH_M
    apart[near] = np.where(touching, np.inf, np.maximum(gaps.least, 0.0))
    return SelfPair(*numbers, float(touching.sum() / len(seen)), float(apart.min()))


def _is_proven_separate(
    robot: Robot,
    links: Sequence[LinkShape],
    bodies: Bodies,
    pair: tuple[int, int],
    sample_count: int,
) -> bool:
    """Whether it can be proved that two links touch in no posture within limits.

    The joints between them are divided into boxes. From the middle of a box no point of the second
    link, in the frame of the first, moves farther than the sum over the joints of half the box
    times the link's greatest distance from the joint. A box with a larger distance in its middle is
    done; the others are bisected.
    """
    if any(joint.slides for joint in robot.joints):
        return False  # Distances between joints differ between postures.
    a, b = pair
    first, second = links[a].number, links[b].number
    zero = np.zeros(len(robot.joints))
    tried = np.vstack([zero, _SEEN_RAD * np.eye(len(zero))])
    frames = robot.kinematics.link_frames(tried)
    seen = _seen(frames, first, second)
    others = np.abs(seen.rotation[1:] - seen.rotation[0]).max(axis=(1, 2))
    others += np.abs(seen.translation[1:] - seen.translation[0]).max(axis=1)
    turning = np.flatnonzero(others > 1e-9)
    origins = np.vstack([np.zeros(3), frames.translation[0]])
    own = float(np.linalg.norm(bodies.bounds.centre[b]) + bodies.bounds.bound[b])
    steps = np.linalg.norm(np.diff(origins, axis=0), axis=1)
    arms = np.array([own + steps[joint + 1 : second].sum() for joint in turning])
    lower, upper = (limit[turning] for limit in _limits(robot))
    # Poses repeat beyond 360 degrees.
    whole = upper - lower > 2.0 * _HALF_TURN
    lower, upper = np.where(whole, -_HALF_TURN, lower), np.where(whole, _HALF_TURN, upper)
    middle, half = 0.5 * (lower + upper)[None], 0.5 * (upper - lower)[None]
    while len(middle):
        sample_count -= len(middle)
        if sample_count < 0:
            return False
        joints = np.tile(zero, (len(middle), 1))
        joints[:, turning] = middle
        room = half @ arms + TOUCH_M
        row = np.zeros(len(middle), dtype=np.int64)
        seen = _seen(robot.kinematics.link_frames(joints), first, second)
        gaps = bodies.gaps(row + a, row + b, seen, room)
        if gaps.distances_found.min() < _SHOWN_M:
            return False
        open_ones = gaps.least < room
        middle, half = middle[open_ones], half[open_ones]
        widest = np.arange(len(middle)), (half * arms).argmax(axis=1)
        half[widest] *= 0.5
        shift = np.zeros_like(half)
        shift[widest] = half[widest]
        middle, half = np.concatenate([middle - shift, middle + shift]), np.tile(half, (2, 1))
    return True


def _seen(base_from_link: Transform, first: int, second: int) -> Transform:
    """Return second_from_first (k,) of two links."""
    return link_frame(base_from_link, second).inverse() @ link_frame(base_from_link, first)


def random_postures(robot: Robot, count: int, seed: int = SEED) -> Array:
    """Return joints (count, n) [rad] within limits; unlimited ones within one turn."""
    lower, upper = _limits(robot)
    # Uniform numbers of a fixed seed: equal postures on every machine.
    share = np.random.default_rng(seed).random((count, len(lower)))
    joints: Array = lower + share * (upper - lower)
    return joints


def _limits(robot: Robot) -> tuple[Array, Array]:
    """Return lower and upper limits (n,) [rad]; of one turn for joints without limits."""
    lower = np.where(np.isfinite(robot.lower), robot.lower, -_HALF_TURN)
    upper = np.where(np.isfinite(robot.upper), robot.upper, _HALF_TURN)
    return lower, upper


def link_frame(base_from_link: Transform, number: int) -> Transform:
    """Return base_from_link (k,) of a link by its number; that of the base is fixed."""
    if number:
        return base_from_link[:, number - 1]
    count = len(base_from_link)
    return Transform(np.tile(np.eye(3), (count, 1, 1)), np.zeros((count, 3)))
