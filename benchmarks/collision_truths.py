"""Whether distances and contacts are true: closed forms, another library, looking far too often.

    python benchmarks/collision_truths.py pairs --count 10000
    python benchmarks/collision_truths.py arms --count 10000 [--robot irb1600-6-1.2 ...]
    python benchmarks/collision_truths.py sheets --count 1000
    python benchmarks/collision_truths.py grazes --count 1000

The tests ask for a few of each. `pairs` compares spheres, boxes and capsules with their formulas;
`arms` what ten arms touch in random postures, themselves and a box, with python-fcl; `sheets` lets
an arm cross a plate of 0.5 mm as fast as its axes can, and looks for the contact a thousand times
as often; `grazes` lets it turn back in a wall, between any two samples.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from itertools import combinations_with_replacement

import fcl
import numpy as np

from rapidsim import load_robot
from rapidsim.collisions import shape
from rapidsim.collisions.along_motion import search
from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.convex import ConvexParts
from rapidsim.collisions.distance import distances
from rapidsim.collisions.link_shapes import link_shapes
from rapidsim.collisions.meshes.triangles import Triangles
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.collisions.scene import WORLD, Arm, AttachedBody, Body, Pair, Scene, SceneFrame
from rapidsim.collisions.self_pairs import judged_pairs, link_frame, random_postures
from rapidsim.collisions.shape import Filling, Shape
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import JointSamples

TEN_ARMS = (
    "irb120-3-0.58", "irb140-6-0.81", "irb1200-7-0.7", "irb1600-6-1.2", "irb2600-12-1.85",
    "irb4600-60-2.05", "irb6640-180-2.55", "crb15000-5-0.95", "kr16-2", "kr10-r1100-sixx",
)  # fmt: skip
KINDS = ("sphere", "box", "capsule")
CLOSE_M = 1e-5
"""Nearer to touching than this both answers are right."""
_CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=float)
_EDGES = np.array(
    [(i, j) for i in range(8) for j in range(i) if np.abs(_CORNERS[i] - _CORNERS[j]).sum() == 2]
)
_SPEED = 1.6
"""Of a motion from rest to rest along a polynomial, its peak over its mean and a little more."""


def random_poses(rng: np.random.Generator, count: int, reach: float = 1.2) -> Transform:
    """Poses (k,) at random."""
    return Transform.from_quaternion(
        rng.normal(size=(count, 4)), rng.uniform(-reach, reach, (count, 3))
    )


def pairs_apart(
    rng: np.random.Generator, first: str, second: str, count: int
) -> tuple[Array, Array]:
    """What is found of pairs of two kinds, and what their formula says (k,) [m].

    Where bodies that are not round overlap, both are -inf.
    """
    where = random_poses(rng, count)
    sizes = rng.uniform(0.02, 0.5, (2, count, 3))
    radius = rng.uniform(0.01, 0.2, (2, count))
    kinds = (first, second)
    made = [
        [_made(kind, size, r) for size, r in zip(sizes[k], radius[k], strict=True)]
        for k, kind in enumerate(kinds)
    ]
    parts = ConvexParts([one.parts[0] for some in made for one in some])
    row = np.arange(count)
    found = distances(parts, row, row + count, where).distances_found
    round_off = sum(np.where(kind == "box", 0.0, radius[k]) for k, kind in enumerate(kinds))
    bones = [_bones(kind, sizes[k]) for k, kind in enumerate(kinds)]
    bones[0] = where.apply(bones[0].swapaxes(0, 1)).swapaxes(0, 1)
    apart = np.full(count, np.inf)
    for k, kind in enumerate(kinds):
        if kind == "box":
            seen = where[:, None].inverse().apply(bones[1]) if k == 0 else bones[0]
            outside = np.maximum(np.abs(seen) - sizes[k][:, None], 0.0)
            apart = np.minimum(apart, np.linalg.norm(outside, axis=2).min(axis=1))
    for a in _segments(bones[0]):
        for b in _segments(bones[1]):
            apart = np.minimum(apart, segments_apart(*a, *b))
    if "box" in kinds:
        apart[_crosses(bones, kinds, sizes, where)] = 0.0
    return found, np.where(apart > 0.0, apart - round_off, -np.inf)


def _made(kind: str, size: Array, radius: float) -> Shape:
    if kind == "box":
        return shape.box(2.0 * size)
    return shape.sphere(radius) if kind == "sphere" else shape.capsule(radius, 2.0 * size[2])


def _bones(kind: str, size: Array) -> Array:
    """The points (k, n, 3) that a body is around: a middle, two ends, eight corners."""
    bones = {"sphere": np.zeros((1, 3)), "capsule": np.array([[0, 0, -1.0], [0, 0, 1.0]])}
    found: Array = bones.get(kind, _CORNERS) * size[:, None]
    return found


def _segments(bones: Array) -> list[tuple[Array, Array]]:
    ends = _EDGES if bones.shape[1] == 8 else np.array([[0, bones.shape[1] - 1]])
    return [(bones[:, i], bones[:, j]) for i, j in ends]


def segments_apart(p: Array, q: Array, r: Array, s: Array) -> Array:
    """Distances of the segments p q and r s, (k,); Ericson (2005), section 5.1.9."""
    d, e, apart = q - p, s - r, p - r
    a, f, c = (np.einsum("kj,kj->k", x, y) for x, y in ((d, d), (e, apart), (d, apart)))
    b, g = np.einsum("kj,kj->k", d, e), np.einsum("kj,kj->k", e, e)
    a, g = np.maximum(a, 1e-300), np.maximum(g, 1e-300)
    crossing = a * g - b * b
    share = np.where(crossing > 1e-14, (b * f - c * g) / np.maximum(crossing, 1e-14), 0.0)
    share = np.clip(share, 0.0, 1.0)
    other = (b * share + f) / g
    share = np.where(other < 0.0, np.clip(-c / a, 0.0, 1.0), share)
    share = np.where(other > 1.0, np.clip((b - c) / a, 0.0, 1.0), share)
    other = np.clip(other, 0.0, 1.0)
    apart = p + d * share[:, None] - r - e * other[:, None]
    length: Array = np.linalg.norm(apart, axis=1)
    return length


def _crosses(
    bones: list[Array], kinds: tuple[str, str], sizes: Array, where: Transform
) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
    """Where no plane square to a face, an edge or two edges parts the bones of two bodies."""
    axes = [where.rotation[:, :, k] for k in range(3)] if kinds[0] == "box" else []
    other = [np.tile(np.eye(3)[k], (len(where), 1)) for k in range(3)] if kinds[1] == "box" else []
    bone = [
        some[:, -1] - some[:, 0]
        for some, kind in zip(bones, kinds, strict=True)
        if kind == "capsule"
    ]
    tried = [*axes, *other]
    tried += [np.cross(a, b) for a in (*axes, *bone) for b in (*other, *bone) if a is not b]
    tried += [np.cross(a, b) for a in axes for b in bone]
    overlap = np.ones(len(where), dtype=np.bool_)
    for axis in tried:
        length = np.linalg.norm(axis, axis=1)
        reach = [np.einsum("knj,kj->kn", some, axis) for some in bones]
        gap = np.maximum(
            reach[0].min(axis=1) - reach[1].max(axis=1), reach[1].min(axis=1) - reach[0].max(axis=1)
        )
        overlap &= (gap <= 0.0) | (length < 1e-12)
    return overlap


@dataclass(slots=True)
class Tally:
    """How often two libraries were asked, and what they said."""

    asked: int = 0
    touching: int = 0
    within: int = 0
    """One body inside the other, whose surfaces do not meet: python-fcl sees surfaces of links."""
    close: int = 0
    wrong: int = 0

    def count(self, gap: float, deep: Callable[[], float], met: bool) -> None:
        """Take up one answer."""
        self.asked += 1
        self.touching += gap < -TOUCH_M
        if met == (gap < 0.0):
            return
        if abs(gap) <= CLOSE_M or (gap < 0.0 and deep() <= CLOSE_M):
            self.close += 1
        elif gap < 0.0 and deep() > 1e-3:
            self.within += 1
        else:
            self.wrong += 1


def model(one: Shape) -> fcl.BVHModel:
    """A shape for python-fcl: the surface that is drawn."""
    made = fcl.BVHModel()
    made.beginModel(len(one.vertices), len(one.faces))
    made.addSubModel(one.vertices, one.faces)
    made.endModel()
    return made


def arm_touches(robot: Robot, count: int, seed: int) -> Tally:
    """What an arm touches in random postures, and what python-fcl says."""
    rng = np.random.default_rng(seed)
    shapes = link_shapes(robot)
    links = shapes.links
    size = rng.uniform(0.1, 0.5, 3)
    bodies = Bodies([*(one.shape for one in links), shape.box(size)])
    of_link = {one.number: k for k, one in enumerate(links)}
    frames = robot.kinematics.link_frames(random_postures(robot, count, seed))
    reach = float(np.linalg.norm(frames.translation, axis=2).max())
    placed = random_poses(rng, count, 0.5 * reach)
    where = {k: link_frame(frames, one.number) for k, one in enumerate(links)} | {
        len(links): placed
    }
    models = [*(model(one.shape) for one in links), fcl.Box(*size)]
    pairs = [(of_link[a], of_link[b]) for a, b in judged_pairs(robot, shapes)]
    pairs += [(k, len(links)) for k in range(len(links))]
    tally, request, row = Tally(), fcl.CollisionRequest(), np.arange(count)
    for a, b in pairs:
        seen = where[b].inverse() @ where[a]
        gaps = bodies.gaps(0 * row + a, 0 * row + b, seen, np.full(count, 0.001))
        first, second = (fcl.CollisionObject(models[k]) for k in (a, b))
        for k in range(count):
            for moved, body in ((first, a), (second, b)):
                moved.setTransform(
                    fcl.Transform(where[body].rotation[k], where[body].translation[k])
                )
            met = fcl.collide(first, second, request, fcl.CollisionResult()) > 0

            def deep(k: int = k, a: int = a, b: int = b, seen: Transform = seen) -> float:
                one = np.array([a]), np.array([b])
                return float(bodies.depths(*one, seen[[k]], exact=True)[0])

            gap = float(gaps.distances_found[k])
            tally.count(gap if np.isfinite(gap) or gap < 0.0 else 1.0, deep, met)
    return tally


def swing(robot: Robot, start: Array, end: Array) -> tuple[Callable[[Array], JointSamples], float]:
    """A motion as fast as the axes can, from rest to rest, and how long [s] it lasts."""
    way = end - start
    speed = np.array([joint.max_speed for joint in robot.joints], dtype=np.float64)
    lasts = max(float((_SPEED * np.abs(way) / speed).max()), 0.2)

    def at(times: Array) -> JointSamples:
        share = np.clip(times / lasts, 0.0, 1.0)
        joints = start + (10.0 * share**3 - 15.0 * share**4 + 6.0 * share**5)[:, None] * way
        count = len(times)
        return JointSamples(np.zeros(count, dtype=np.int64), joints, np.zeros((count, 0)))

    return at, lasts


def sheet_error(robot: Robot, rng: np.random.Generator) -> float:
    """How far [s] the first contact with a sheet is from the instant that it is; inf if missed.

    The tip of the flange, a ball of 2 mm, crosses a sheet of 0.5 mm, squarely or at a slant.
    """
    while True:
        ends = robot.lower + rng.random((2, 6)) * (robot.upper - robot.lower)
        at, lasts = swing(robot, *(0.6 * ends))
        instant = lasts * rng.uniform(0.3, 0.7)
        before, here, after = robot.forward(
            at(instant + np.array([-1e-4, 0.0, 1e-4])).joints
        ).translation
        speed = float(np.linalg.norm(after - before)) / 2e-4
        if speed > 1.0:
            break
    z = (after - before) / (2e-4 * speed) + 0.5 * rng.uniform(-1.0, 1.0, 3)
    z /= np.linalg.norm(z)
    x = np.cross(z, np.eye(3)[np.abs(z).argmin()])
    x /= np.linalg.norm(x)
    place = Transform(np.column_stack([x, np.cross(z, x), z]), here)
    flange = SceneFrame(0, len(robot.joints) + 1)
    sheet = shape.box(np.array([0.06, 0.06, 5e-4]))
    bodies = (
        Body(
            BodyName("tip", 0),
            shape.sphere(0.002),
            (AttachedBody(0.0, flange, Transform.identity()),),
        ),
        Body(BodyName("sheet"), sheet, (AttachedBody(0.0, WORLD, place),)),
    )
    arm = Arm(robot, Transform.identity(), at, ((0.0, lasts),))
    found = search(Scene((arm,), bodies, (Pair(0, 1, 0, touch_only=False),)), lasts)
    if not found.contacts:
        return np.inf
    first = found.contacts[0].time_s
    # Nothing may touch before; and here it does, looked at a thousand times as often.
    times = np.concatenate(
        [np.arange(0.0, first - 0.01, 2e-4), first + np.arange(-600.0, 20.0) * 1.6e-5]
    )
    tips = place.inverse().apply(robot.forward(at(times).joints).translation)
    outside = np.maximum(np.abs(tips) - [0.03, 0.03, 2.5e-4], 0.0)
    touching = np.linalg.norm(outside, axis=1) - 0.002 < -TOUCH_M
    return abs(first - float(times[touching.argmax()]))


def graze_error(robot: Robot, rng: np.random.Generator, *, surface: bool = False) -> float:
    """How far [s] the contact with a wall is from the interval in which it is; inf if missed.

    All axes turn back at one instant, somewhere between two samples; there, and nowhere else, the
    tip of the flange, a ball of 2 mm, is 15 to 100 micrometres deep in the wall, for milliseconds.
    The wall is a convex part, or a surface of triangles.
    """
    while True:
        middle = robot.lower + (0.3 + 0.4 * rng.random(6)) * (robot.upper - robot.lower)
        swings, pull = rng.uniform(-0.2, 0.2, 6), 10.0 ** rng.uniform(0.0, 1.8)
        phase = np.append([0.0, np.arccos(0.999)], np.linspace(0.1, np.pi, 200))
        peak, near, *others = robot.forward(middle + np.cos(phase)[:, None] * swings).translation
        out = 1000.0 * (peak - near)
        rate = np.sqrt(pull / np.linalg.norm(out))
        out /= np.linalg.norm(out)
        if ((np.array(others) - peak) @ out < -1e-3).all():
            break
    instant, depth = np.pi / rate + rng.uniform(0.0, 0.1), rng.uniform(1.5e-5, 1e-4)
    lasts = instant + np.pi / rate

    def at(times: Array) -> JointSamples:
        joints = middle + np.cos(rate * (times - instant))[:, None] * swings
        count = len(times)
        return JointSamples(np.zeros(count, dtype=np.int64), joints, np.zeros((count, 0)))

    across = np.cross(out, np.eye(3)[np.abs(out).argmin()])
    across /= np.linalg.norm(across)
    turn = np.column_stack([across, np.cross(out, across), out])
    place = Transform(turn, peak + (0.002 - depth + 0.01) * out)
    flange = SceneFrame(0, len(robot.joints) + 1)
    tip, wall = shape.sphere(0.002), shape.box(np.array([2.0, 2.0, 0.02]))
    if surface:
        wall = shape.of_mesh(Triangles(wall.vertices, wall.faces, closed=True), Filling.SURFACE)
    bodies = (
        Body(BodyName("tip", 0), tip, (AttachedBody(0.0, flange, Transform.identity()),)),
        Body(BodyName("wall"), wall, (AttachedBody(0.0, WORLD, place),)),
    )
    arm = Arm(robot, Transform.identity(), at, ((0.0, lasts),))
    # A pair may exist for a part of the run only.
    around = (instant - 0.03, instant + 0.03) if rng.random() < 0.5 else (0.0, lasts)
    found = search(Scene((arm,), bodies, (Pair(0, 1, 0, False, *around),)), lasts)
    times = instant + np.arange(-20_000.0, 20_001.0) * 1e-6
    deep = (robot.forward(at(times).joints).translation - peak) @ out + depth
    touching = times[deep > TOUCH_M]
    if not found.contacts:
        return np.inf
    first = found.contacts[0].time_s
    return max(float(touching[0]) - first, first - float(touching[-1]), 0.0)


def main() -> None:
    """Count."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("pairs", "arms", "sheets", "grazes"))
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--robot", nargs="*", default=TEN_ARMS)
    asked = parser.parse_args()
    rng = np.random.default_rng(asked.seed)
    if asked.what == "pairs":
        for first, second in combinations_with_replacement(KINDS, 2):
            found, exact = pairs_apart(rng, first, second, asked.count)
            over = np.isneginf(exact)
            same = (np.isneginf(found) | (np.abs(found) < 1e-6))[over].all()
            worst = np.abs(found[~over] - exact[~over]).max()
            print(f"{first} and {second}: {asked.count} pairs, {over.sum()} overlap, ", end="")
            print(f"worst error {worst:.1e} m; overlap told alike: {same}")
    elif asked.what == "arms":
        for name in asked.robot:
            print(name, arm_touches(load_robot(name), asked.count, asked.seed), flush=True)
    else:
        robot = load_robot("irb1600-6-1.2")
        errors = np.array(
            [
                sheet_error(robot, rng)
                if asked.what == "sheets"
                else graze_error(robot, rng, surface=bool(number % 2))
                for number in range(asked.count)
            ]
        )
        print(f"{asked.count} {asked.what}, {np.isinf(errors).sum()} missed, ", end="")
        print(f"contact time off by {1e3 * errors[np.isfinite(errors)].max():.3f} ms at most")


if __name__ == "__main__":
    main()
