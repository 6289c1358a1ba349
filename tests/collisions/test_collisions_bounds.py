"""What the search for contacts rests on: bounds of travel, of overlaps and of what is inside."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from collision_truths import swing
from fuzzing.readers import READERS
from laws import cases

from rapidsim import load_robot
from rapidsim.collisions import shape
from rapidsim.collisions.along_motion import _stepped
from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.bounds import around_triangles
from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.convex import ConvexParts
from rapidsim.collisions.meshes.read import read_mesh
from rapidsim.collisions.meshes.triangles import checked_triangles
from rapidsim.collisions.overlap import depths, shortest
from rapidsim.collisions.scene import (
    STEP_S,
    WORLD,
    Arm,
    AttachedBody,
    Belt,
    Body,
    Pair,
    Scene,
    SceneFrame,
)
from rapidsim.collisions.self_pairs import random_postures
from rapidsim.collisions.shape import Filling
from rapidsim.collisions.travel import LONGEST, Travel
from rapidsim.frames.euler import Convention, rotation_from_euler
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.trajectory.samples import JointSamples

ROBOT = load_robot("irb1600-6-1.2")
CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float) - 0.5
BOX_FACES = np.array(
    [
        *([0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]),
        *([2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]),
    ]
)


def scene_of(at: object, lasts: float) -> Scene:
    """A tip beside the flange, and a box in its way."""
    flange = SceneFrame(0, len(ROBOT.joints) + 1)
    beside = Transform(np.eye(3), np.array([0.1, 0.0, 0.05]))
    box = Transform(np.eye(3), np.array([0.6, 0.3, 0.8]))
    bodies = (
        Body(BodyName("tip", 0), shape.capsule(0.03, 0.2), (AttachedBody(0.0, flange, beside),)),
        Body(BodyName("box"), shape.box(np.full(3, 0.3)), (AttachedBody(0.0, WORLD, box),)),
    )
    arm = Arm(ROBOT, Transform.identity(), at, ((0.0, lasts),))  # type: ignore[arg-type]
    return Scene((arm,), bodies, (Pair(0, 1, 0, touch_only=False),))


def test_no_gap_between_instants_is_below_its_bound() -> None:
    rng = np.random.default_rng(5)
    pair = np.zeros(1, dtype=np.int64)
    for _ in range(cases(100)):
        ends = ROBOT.lower + rng.random((2, 6)) * (ROBOT.upper - ROBOT.lower)
        at, lasts = swing(ROBOT, *(0.5 * ends))
        times = np.arange(0.0, lasts, STEP_S)
        scene = scene_of(at, lasts)
        bodies, poses = scene.shapes(), scene.poses(times)
        travel = Travel(scene, bodies.bounds, poses, pair)
        steps = np.arange(len(times) - 1)
        slacks = travel.slack(0 * steps, steps, steps + 1)
        for length in (1, 2, 5, LONGEST):
            start = int(rng.integers(max(1, len(times) - length - 1)))
            end = min(start + length, len(times) - 1)
            way = travel.between(pair, pair + start, pair + end)
            slack = travel.slack(pair, pair + start, pair + end)
            assert slack[0] == slacks[start:end].max()
            dense = np.linspace(times[start], times[end], 60)
            row = np.zeros(len(dense), dtype=np.int64)
            seen = scene.poses(dense).seen(0, 1)
            gaps = bodies.gaps(row, row + 1, seen, np.full(len(dense), 9.0)).distances_found
            if gaps.min() > 0.0:
                assert gaps.min() > 0.5 * (gaps[0] + gaps[-1] - way[0]) - slack[0] - 1e-9


def test_bounds_of_travel_are_no_larger_than_need_be() -> None:
    """Of an axis that turns evenly: arc and angle, and twice the acceleration on the circle."""
    rate, lasts = 2.0, 1.0

    def at(times: Array) -> JointSamples:
        joints = np.zeros((len(times), 6))
        joints[:, 0] = rate * times
        return JointSamples(np.zeros(len(times), dtype=np.int64), joints, np.zeros((len(times), 0)))

    scene = scene_of(at, lasts)
    bodies, poses = scene.shapes(), scene.poses(np.arange(0.0, lasts, STEP_S))
    pair = np.zeros(1, dtype=np.int64)
    travel = Travel(scene, bodies.bounds, poses, pair)
    centre = poses.of(0).apply(bodies.bounds.centre[0])[0]
    reach = float(np.hypot(*centre[:2]) + bodies.bounds.bound[0])
    way = travel.between(pair, pair + 3, pair + 11)
    assert way[0] == pytest.approx(8 * rate * STEP_S * reach, rel=1e-3)
    assert travel.bend(pair, pair + 5)[0] == pytest.approx(2.1 * rate**2 * reach, rel=1e-3)
    slack = travel.slack(pair, pair + 3, pair + 11)
    assert slack[0] == pytest.approx(2.1 * rate**2 * reach * STEP_S**2 / 8.0, rel=1e-3)


def test_bodies_stir_in_a_move_in_which_they_travel() -> None:
    def at(times: Array) -> JointSamples:
        joints = np.zeros((len(times), 6))
        joints[:, 0] = np.maximum(times - 0.5, 0.0)
        moves = (times > 0.5).astype(np.int64)
        return JointSamples(moves, joints, np.zeros((len(times), 0)))

    scene = scene_of(at, 1.0)
    poses = scene.poses(np.arange(0.0, 1.0, STEP_S))
    pair = np.zeros(2, dtype=np.int64)
    travel = Travel(scene, scene.shapes().bounds, poses, pair[:1])
    assert travel.stirs(pair, pair, np.array([0, 1])).tolist() == [False, True]


def test_a_move_of_few_instants_counts_the_steps_around_it() -> None:
    def at(times: Array) -> JointSamples:
        joints = np.zeros((len(times), 6))
        joints[:, 0] = (times > 0.5).astype(float)
        moves = (times > 0.49).astype(np.int64) + (times > 0.51)
        return JointSamples(moves, joints, np.zeros((len(times), 0)))

    scene = scene_of(at, 1.0)
    poses = scene.poses(np.array([*np.arange(0.0, 0.49, STEP_S), 0.5, *np.arange(0.52, 1.0, 0.1)]))
    pair = np.zeros(3, dtype=np.int64)
    travel = Travel(scene, scene.shapes().bounds, poses, pair[:1])
    assert travel.stirs(pair, pair, np.arange(3)).tolist() == [False, True, False]


def test_boxes_of_thin_triangles_contain_them() -> None:
    rng = np.random.default_rng(8)
    a, b = rng.normal(size=(2, 200, 3))
    c = a + rng.random((200, 1)) * (b - a) + 10.0 ** rng.uniform(-13, 0, (200, 1)) * b[::-1]
    triangles = np.stack([a, b, c], axis=1)
    boxes = around_triangles(triangles)
    for corner in range(3):
        outside = boxes.from_points(np.arange(200), triangles[:, corner])
        assert outside.max() < 1e-12
    assert boxes.axes is not None
    np.testing.assert_allclose(
        np.swapaxes(boxes.axes, 1, 2) @ boxes.axes, np.tile(np.eye(3), (200, 1, 1)), atol=1e-12
    )


def test_instants_are_a_step_apart_and_every_brief_move_has_one() -> None:
    brief = np.array([0.1, 0.103, 0.3])
    times = _stepped(0.05, brief, 0.4)
    assert times[0] == 0.05
    assert times[-1] == 0.4
    assert (np.diff(times) > 0.0).all()
    assert np.diff(times).max() <= STEP_S + 1e-12
    assert np.isin(brief, times).all()


def test_the_separation_of_crossing_capsules_is_refined() -> None:
    parts = ConvexParts([shape.capsule(0.3, 2.0).parts[0]])
    turn = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    pose = Transform(turn[None], np.array([[0.0, 0.37, 0.0]]))
    pair = np.zeros(1, dtype=np.int64)
    assert shortest(parts, pair, pair, pose)[0] == pytest.approx(0.23, abs=1e-3)
    skew = rotation_from_euler(np.array([[0.4, 0.9, 0.3]]), Convention.ZYX)[0]
    pose = Transform((skew @ turn)[None], (skew @ [0.0, 0.37, 0.0])[None])
    deep = shortest(parts, pair, pair, pose)[0]
    assert deep <= depths(parts, pair, pair, pose)[0][0]


def test_a_belt_travels_along_the_x_axis_of_its_switch() -> None:
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    belt = Belt(
        Transform(turn, np.array([1.0, 2.0, 3.0])), np.array([0.0, 2.0]), np.array([0.0, 0.5])
    )
    frames = belt.frames(np.array([0.0, 1.0, 9.0]))
    assert np.allclose(frames.translation, [[1.0, 2.0, 3.0], [1.0, 2.25, 3.0], [1.0, 2.5, 3.0]])
    assert np.allclose(frames.rotation, turn)


def test_gltf_without_scenes_is_all_its_meshes(tmp_path: Path) -> None:
    (seed,) = READERS["gltf"].seeds
    tree = json.loads(seed)

    def heights() -> list[float]:
        (tmp_path / "a.gltf").write_text(json.dumps(tree))
        return sorted(set(read_mesh(tmp_path / "a.gltf", tmp_path).vertices[:, 2].tolist()))

    assert heights() == [1.0]
    tree["nodes"] = [{"children": [1], "translation": [0, 0, 2]}, tree["nodes"][0]]
    assert heights() == [3.0]
    tree["scenes"].append({"nodes": [1]})
    tree["scene"] = 1
    assert heights() == [1.0]
    del tree["scenes"]
    assert heights() == [0.0]


def test_depths_of_balls_and_boxes_are_known() -> None:
    rng = np.random.default_rng(3)
    parts = ConvexParts(
        [shape.sphere(0.3).parts[0], shape.sphere(0.2).parts[0], shape.box(np.ones(3)).parts[0]]
    )
    out = rng.normal(size=(20, 3))
    out /= np.linalg.norm(out, axis=1)[:, None]
    apart = rng.uniform(0.05, 0.45, 20)
    first = np.zeros(20, dtype=np.int64)
    where = Transform(np.tile(np.eye(3), (20, 1, 1)), out * apart[:, None])
    deep, way = depths(parts, first, first + 1, where)
    assert np.allclose(deep, 0.5 - apart)
    assert np.allclose(way, out)
    assert np.allclose(shortest(parts, first, first + 1, where), 0.5 - apart)
    along = np.array([[0.7, 0.1, 0.0], [0.0, -0.9, 0.2], [0.0, 0.0, 0.0]])
    where = Transform(np.tile(np.eye(3), (3, 1, 1)), along)
    deep, way = depths(parts, first[:3] + 2, first[:3] + 2, where)
    assert np.allclose(deep, [0.3, 0.1, 1.0])
    assert np.allclose(way[:2], [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


def test_inside_is_where_a_ray_crosses_the_surface_an_odd_number_of_times() -> None:
    rng = np.random.default_rng(4)
    solid = checked_triangles("box", CORNERS, BOX_FACES)
    assert solid.closed
    for point in rng.uniform(-0.9, 0.9, (cases(800), 3)):
        assert shape.is_inside(solid, point) == bool((np.abs(point) < 0.5).all())


def test_only_a_piece_inside_another_is_left_out() -> None:
    def pieces(*boxes: tuple[float, float]) -> int:
        corners = np.concatenate([CORNERS * size + [at, 0.0, 0.0] for size, at in boxes])
        faces = np.concatenate([BOX_FACES + 8 * number for number in range(len(boxes))])
        mesh = checked_triangles("boxes", corners, faces)
        return len(shape.hull_of_each_piece(mesh).parts)

    assert pieces((1.0, 0.0), (0.5, 0.0)) == 1
    assert pieces((1.0, 0.0), (0.5, 0.4)) == 2
    assert pieces((0.5, 0.0), (1.0, 0.0), (0.5, 2.0)) == 2


def test_a_ball_of_many_triangles_is_as_far_off_as_a_ball() -> None:
    ball = shape.sphere(0.5)
    mesh = checked_triangles("ball", ball.vertices, ball.faces)
    surface = shape.of_mesh(mesh, Filling.SURFACE)
    assert len(surface.triangles) > 300
    bodies = Bodies([surface, shape.sphere(0.1)])
    out = np.random.default_rng(6).normal(size=(20, 3))
    out /= np.linalg.norm(out, axis=1)[:, None]
    row = np.zeros(20, dtype=np.int64)
    where = Transform(np.tile(np.eye(3), (20, 1, 1)), -1.0 * out)
    gaps = bodies.gaps(row, row + 1, where, np.full(20, 5.0)).distances_found
    assert np.allclose(gaps, 0.4, atol=0.03)


def test_random_postures_lie_within_limits() -> None:
    postures = random_postures(ROBOT, 500)
    assert ((postures >= ROBOT.lower) & (postures <= ROBOT.upper)).all()
    share = (postures - ROBOT.lower) / (ROBOT.upper - ROBOT.lower)
    assert (share.min(axis=0) < 0.05).all()
    assert (share.max(axis=0) > 0.95).all()


def test_a_joint_without_limits_is_tried_within_a_turn() -> None:
    endless = replace(ROBOT.joints[5], lower=-np.inf, upper=np.inf)
    postures = random_postures(replace(ROBOT, joints=(*ROBOT.joints[:5], endless)), 500)[:, 5]
    assert postures.min() == pytest.approx(-np.pi, abs=0.1)
    assert postures.max() == pytest.approx(np.pi, abs=0.1)


def test_a_half_space_has_the_cell_above_it() -> None:
    ground = shape.half_space()
    assert ground.vertices[:, 2].max() == 0.0
    assert (ground.vertices[:, :2].min(axis=0) < -20.0).all()
    assert (ground.vertices[:, :2].max(axis=0) > 20.0).all()
