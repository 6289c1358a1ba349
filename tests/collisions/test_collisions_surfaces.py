"""Surfaces of many triangles: another library as the oracle, and no cost by the square."""

from __future__ import annotations

import numpy as np
import pytest
from castings import compared, ring
from collision_truths import random_poses
from laws import cases

from rapidsim.collisions import shape
from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.convex import ConvexParts
from rapidsim.collisions.distance import distances
from rapidsim.collisions.meshes.triangles import Triangles, hollowness
from rapidsim.collisions.outer_hull import outer_hull
from rapidsim.collisions.overlap import depths
from rapidsim.collisions.shape import Filling
from rapidsim.frames.transform import Transform


@pytest.mark.parametrize("two_rings", [False, True], ids=["box", "ring"])
@pytest.mark.parametrize("close_m", [0.0, 0.005], ids=["exact", "coarse"])
def test_rings_are_as_far_apart_as_another_library_says(*, two_rings: bool, close_m: float) -> None:
    """Gaps are within the tolerance, and lower bounds below the distance, also where it is wide."""
    found = compared(cases(80), 3000, two_rings=two_rings, close_m=close_m)
    assert found.touching
    assert found.differing == 0
    assert found.too_high_m < 1e-6
    assert found.error < 0.005 or found.error_m < 2.0 * close_m


def test_bodies_of_many_triangles_are_read_without_comparing_each_with_each() -> None:
    """A ring and a ball of 40,000: the one has a hole, the other is one convex part."""
    hole = shape.of_mesh(ring(40_000), Filling.SOLID)
    assert (len(hole.parts), len(hole.triangles)) == (0, len(hole.faces))
    solid = _ball(40_000)
    assert len(shape.of_mesh(solid, Filling.SOLID).parts) == 1
    small = _ball(8000)
    dented = small.vertices.copy()
    dented[7] *= 0.99
    assert hollowness(dented, small.faces) > 1e-4


def test_the_body_around_a_shape_contains_it_and_little_more() -> None:
    surface = shape.of_mesh(ring(20_000), Filling.SOLID)
    around = outer_hull(surface)
    directions = np.random.default_rng(4).normal(size=(cases(200), 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    reach = (directions @ surface.vertices.T).max(axis=1)
    bound = (directions @ around.points.T).max(axis=1) + around.radius
    assert (bound >= reach).all()
    assert (bound - reach).max() < 5e-4
    assert len(around.points) <= 2000


def test_the_depth_of_surfaces_is_that_of_their_deepest_triangles() -> None:
    """Trees and planes leave out only triangles that are less deep: here each pair is tried."""
    surface = shape.of_mesh(ring(120), Filling.SURFACE)
    count, apart = len(surface.triangles), random_poses(np.random.default_rng(3), cases(6), 0.2)
    shifts = np.arange(3.0)[None, :, None] * np.array([0.001, 0.002, 0.0])
    poses = Transform(
        np.repeat(apart.rotation, 3, axis=0), (apart.translation[:, None] + shifts).reshape(-1, 3)
    )
    parts = ConvexParts([], surface.triangles)
    first, second = (one.reshape(-1) for one in np.indices((count, count)))
    row = np.zeros(len(poses), dtype=np.int64)
    found = Bodies([surface, surface]).depths(row, row + 1, poses, exact=False)
    assert (found > 0.0).sum() > len(found) // 2
    for number, deepest in enumerate(found.tolist()):
        pose = poses[number]
        every = Transform(
            np.broadcast_to(pose.rotation, (count**2, 3, 3)),
            np.broadcast_to(pose.translation, (count**2, 3)),
        )
        over = np.isneginf(distances(parts, first, second, every, 0.0).distances_found)
        deep, _ = depths(parts, first[over], second[over], every[over])
        assert deepest == deep.max(initial=0.0)


def test_a_body_moved_is_where_its_triangles_are() -> None:
    moved = shape.of_mesh(ring(500), Filling.SURFACE).moved(
        Transform(np.eye(3), np.array([0.0, 0.0, 2.0]))
    )
    np.testing.assert_allclose(moved.triangles, moved.vertices[moved.faces])


def _ball(triangles: int) -> Triangles:
    """Return a sphere of about so many triangles with the precision that STL files have."""
    around = round(triangles**0.5)
    heights = np.linspace(0.0, np.pi, around // 2 + 1)[1:-1, None]
    angles = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)[None]
    rows = np.stack(
        [
            np.sin(heights) * np.cos(angles),
            np.sin(heights) * np.sin(angles),
            np.cos(heights + 0 * angles),
        ],
        axis=-1,
    ).reshape(-1, 3)
    points = np.concatenate([rows, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    row, column = np.arange(len(heights) - 1)[:, None] * around, np.arange(around)[None]
    then = (column + 1) % around
    a, b = row + column, row + then
    c, d = a + around, b + around
    first, last = np.arange(around), np.arange(around) + (len(heights) - 1) * around
    faces = [
        np.stack([a, c, d], axis=-1).reshape(-1, 3),
        np.stack([a, d, b], axis=-1).reshape(-1, 3),
        np.stack([np.full(around, len(rows)), first, np.roll(first, -1)], axis=-1),
        np.stack([np.full(around, len(rows) + 1), np.roll(last, -1), last], axis=-1),
    ]
    vertices = (0.25 * points).astype(np.float32).astype(np.float64)
    return Triangles(vertices, np.concatenate(faces), closed=True)
