"""Distances between convex parts: closed forms, and another library as the oracle."""

from __future__ import annotations

import fcl
import numpy as np
import pytest
from laws import cases

from rapidsim import load_robot
from rapidsim.collisions import shape
from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.convex import ConvexPart, Parts
from rapidsim.collisions.distance import distances
from rapidsim.collisions.link_shapes import link_shapes
from rapidsim.collisions.overlap import TOUCH_M, shortest
from rapidsim.collisions.self_pairs import link_frame, random_postures
from rapidsim.frames.transform import Array, Transform

COUNT = 2000


def poses(rng: np.random.Generator, count: int, reach: float = 1.2) -> Transform:
    return Transform.from_quaternion(
        rng.normal(size=(count, 4)), rng.uniform(-reach, reach, (count, 3))
    )


def pairs_of(first: list[ConvexPart], second: list[ConvexPart], where: Transform) -> Array:
    """The distances of parts, one of each list after the other."""
    count = len(first)
    parts = Parts([*first, *second])
    one = np.arange(count)
    found = distances(parts, one, one + count, where)
    apart = ~np.isneginf(found.found)
    assert (found.found[apart] - found.least[apart]).max() < 1e-9
    return found.found


def segments_apart(p: Array, q: Array, r: Array, s: Array) -> Array:
    """Distances of the segments p q and r s, (k,); Ericson (2005), section 5.1.9."""
    d, e, apart = q - p, s - r, p - r
    a, f, c = (np.einsum("kj,kj->k", x, y) for x, y in ((d, d), (e, apart), (d, apart)))
    b, g = np.einsum("kj,kj->k", d, e), np.einsum("kj,kj->k", e, e)
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


def test_a_sphere_is_as_far_from_a_box_as_its_formula_says() -> None:
    rng = np.random.default_rng(1)
    half, radius = rng.uniform(0.02, 0.5, (COUNT, 3)), rng.uniform(0.01, 0.3, COUNT)
    where = poses(rng, COUNT)
    spheres = [ConvexPart(np.zeros((1, 3)), radius=one) for one in radius]
    boxes = [shape.box(2.0 * one).parts[0] for one in half]
    centre = np.linalg.norm(np.maximum(np.abs(where.translation) - half, 0.0), axis=1)
    found = pairs_of(spheres, boxes, where)
    outside = centre > 1e-6
    np.testing.assert_allclose(found[outside], (centre - radius)[outside], atol=1e-9)
    assert np.isneginf(found[centre == 0.0]).all()


def test_capsules_are_as_far_apart_as_their_formula_says() -> None:
    rng = np.random.default_rng(2)
    length, radius = rng.uniform(0.05, 0.6, (2, COUNT)), rng.uniform(0.01, 0.1, (2, COUNT))
    where = poses(rng, COUNT)
    first, second = (
        [shape.capsule(r, 2.0 * h).parts[0] for h, r in zip(*both, strict=True)]
        for both in zip(length, radius, strict=True)
    )
    z = np.array([0.0, 0.0, 1.0])
    here, there = length[:, :, None] * z
    exact = segments_apart(where.apply(-here), where.apply(here), -there, there)
    found = pairs_of(first, second, where)
    np.testing.assert_allclose(found, exact - radius.sum(axis=0), atol=1e-9)


def test_a_cylinder_stands_on_a_box_and_a_sphere_beside_it() -> None:
    parts = Parts(
        [
            shape.cylinder(0.1, 0.4).parts[0],
            shape.box(np.array([1.0, 1.0, 0.2])).parts[0],
            shape.sphere(0.05).parts[0],
        ]
    )
    beside = Transform(np.eye(3)[None], np.array([[0.3, 0.0, 0.1]]))
    above = Transform(np.eye(3)[None], np.array([[0.0, 0.0, 0.35]]))
    one, two, three = (np.array([k]) for k in range(3))
    assert distances(parts, one, two, above).found[0] == pytest.approx(0.05, abs=1e-9)
    assert distances(parts, three, one, beside).found[0] == pytest.approx(0.15, abs=1e-9)
    deeper = Transform(np.eye(3)[None], np.array([[0.0, 0.0, 0.28]]))
    assert shortest(parts, one, two, deeper)[0] == pytest.approx(0.02, abs=1e-9)


def test_what_is_all_but_above_the_middle_of_a_sheet_is_measured_to_the_end() -> None:
    """The shortest way is known to the last digit before the bound on it is."""
    parts = Parts([shape.sphere(0.002).parts[0], shape.box(np.array([0.06, 0.06, 5e-4])).parts[0]])
    above = Transform(np.eye(3)[None], np.array([[-3.7e-7, 3.8e-7, -9.715702e-4]]))
    found = distances(parts, np.array([0]), np.array([1]), above)
    assert found.found[0] == pytest.approx(9.715702e-4 - 2.5e-4 - 0.002, abs=1e-12)
    assert found.least[0] == pytest.approx(found.found[0], abs=1e-9)


def oracle(one: shape.Shape) -> fcl.BVHModel:
    model = fcl.BVHModel()
    model.beginModel(len(one.vertices), len(one.faces))
    model.addSubModel(one.vertices, one.faces)
    model.endModel()
    return model


@pytest.mark.parametrize("name", ["irb1600-6-1.2", "irb140-6-0.81", "kr16-2"])
def test_links_and_a_table_touch_where_another_library_says_so(name: str) -> None:
    robot, count = load_robot(name), cases(60)
    links = link_shapes(robot).links
    table = shape.box(np.array([0.4, 0.5, 0.3])).moved(
        Transform(np.eye(3), np.array([0.5, 0.1, 0.4]))
    )
    bodies = Bodies([*(link.shape.parts for link in links), table.parts])
    base_from_link = robot.kinematics.link_frames(random_postures(robot, count))
    stands, touched = fcl.CollisionObject(oracle(table)), 0
    for number, link in enumerate(links[1:], start=1):
        where = link_frame(base_from_link, link.number)
        rows = np.arange(count)
        gaps = bodies.gaps(0 * rows + number, 0 * rows + len(links), where, np.full(count, np.inf))
        model = oracle(link.shape)
        for k in range(count):
            moved = fcl.CollisionObject(
                model, fcl.Transform(where.rotation[k], where.translation[k])
            )
            result = fcl.DistanceResult()
            apart = fcl.distance(moved, stands, fcl.DistanceRequest(), result)
            # Of surfaces: a body inside another has a distance, and hits all the same.
            if gaps.found[k] > TOUCH_M:
                assert apart == pytest.approx(gaps.found[k], abs=1e-6)
            elif gaps.found[k] < -TOUCH_M:
                touched += 1
                pair = np.array([number]), np.array([len(links)])
                deep = bodies.depths(*pair, where[[k]], exact=False)[0]
                assert apart <= 0.0 or deep > TOUCH_M
    assert touched
