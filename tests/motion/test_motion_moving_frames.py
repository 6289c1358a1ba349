"""Frames that move: the product rule against differences, and screws against their picture."""

from collections.abc import Callable

import numpy as np
import pytest

from rapidsim.frames.moving_frames import ExternalCourse, Screw, Twists, standing
from rapidsim.frames.rotation_vectors import rotation_from_vector, vector_from_rotation
from rapidsim.frames.transform import Array, Transform

STEP = 1e-4
CHANCE = np.random.default_rng(5)


def some() -> Twists:
    vectors = [CHANCE.normal(size=(3, 3)) for _ in range(6)]
    return Twists(vectors[0], rotation_from_vector(vectors[1]), *vectors[2:])


def moved(motion: Twists, by: float) -> Twists:
    """A motion a step further, without its derivatives."""
    turn = motion.turning * by + 0.5 * motion.turning_change * by**2
    place = motion.position + motion.velocity * by + 0.5 * motion.acceleration * by**2
    still = np.zeros_like(place)
    return Twists(place, rotation_from_vector(turn) @ motion.rotation, *[still] * 4)


def turned(before: Twists, after: Twists) -> Array:
    return vector_from_rotation(after.rotation @ np.swapaxes(before.rotation, -1, -2))


TOOL = Transform(rotation_from_vector(np.array([0.3, -0.2, 0.5])), np.array([0.1, 0.2, 0.3]))


@pytest.mark.parametrize(
    "make",
    [lambda a, b: a @ b, lambda a, b: a.inverse(), lambda a, b: a.before(TOOL)],
    ids=["product", "inverse", "constant"],
)
def test_derivatives_are_those_of_the_poses(make: Callable[[Twists, Twists], Twists]) -> None:
    a, b = some(), some()
    now = make(a, b)
    early, late = (make(moved(a, step), moved(b, step)) for step in (-STEP, STEP))
    assert (late.position - early.position) / (2 * STEP) == pytest.approx(now.velocity, abs=1e-6)
    bend = (late.position - 2 * now.position + early.position) / STEP**2
    assert bend == pytest.approx(now.acceleration, abs=1e-5)
    assert turned(early, late) / (2 * STEP) == pytest.approx(now.turning, abs=1e-6)
    change = (turned(now, late) - turned(early, now)) / STEP**2
    assert change == pytest.approx(now.turning_change, abs=1e-5)


def test_a_turntable_carries_points_round_its_axis() -> None:
    table = Screw(0, np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.5]))
    quarter = np.array([[np.pi / 2]])
    motion = table.motion(ExternalCourse(quarter, np.ones((1, 1)), np.zeros((1, 1))))
    # A point 0.2 m in front of the axis comes to its left, and is on its way backwards.
    point = motion.before(Transform(np.eye(3), np.array([1.2, 0.0, 0.5])))
    assert point.position[0] == pytest.approx([1.0, 0.2, 0.5])
    assert point.velocity[0] == pytest.approx([-0.2, 0.0, 0.0], abs=1e-12)
    assert point.acceleration[0] == pytest.approx([0.0, -0.2, 0.0], abs=1e-12)


def test_a_track_carries_without_turning() -> None:
    track = Screw(1, np.array([0.0, 1.0, 0.0]), None)
    course = ExternalCourse(np.array([[9.0, 2.0]]), np.array([[9.0, 0.5]]), np.array([[9.0, -1.0]]))
    motion = track.motion(course)
    assert motion.position[0] == pytest.approx([0.0, 2.0, 0.0])
    assert motion.velocity[0] == pytest.approx([0.0, 0.5, 0.0])
    assert motion.acceleration[0] == pytest.approx([0.0, -1.0, 0.0])
    assert not motion.turning.any()


def test_what_stands_and_its_inverse_cancel() -> None:
    frame = standing(TOOL, 2)
    identity = frame @ frame.inverse()
    assert identity.position == pytest.approx(np.zeros((2, 3)), abs=1e-12)
    assert identity.rotation == pytest.approx(np.tile(np.eye(3), (2, 1, 1)))
