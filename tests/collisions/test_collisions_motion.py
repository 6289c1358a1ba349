"""Nothing slips through: a sheet of half a millimetre crossed at full speed is found, and when."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from castings import ring
from collision_truths import graze_error, sheet_error, swing
from laws import cases

from rapidsim import load_robot
from rapidsim.collisions import shape
from rapidsim.collisions.along_motion import search
from rapidsim.collisions.body_distance import Bodies, Gaps
from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.convex import Index
from rapidsim.collisions.scene import (
    STEP_S,
    WORLD,
    Arm,
    AttachedBody,
    Body,
    Pair,
    Scene,
    SceneFrame,
)
from rapidsim.collisions.shape import Filling, Shape
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.trajectory.samples import JointSamples

ROBOT = load_robot("irb1600-6-1.2")
FLANGE = SceneFrame(0, len(ROBOT.joints) + 1)


def test_a_sheet_is_found_at_any_speed_and_in_time() -> None:
    rng = np.random.default_rng(7)
    assert max(sheet_error(ROBOT, rng) for _ in range(cases(40))) < 1e-4


@pytest.mark.parametrize("surface", [False, True], ids=["part", "surface"])
def test_a_contact_between_any_two_samples_is_found_while_it_lasts(*, surface: bool) -> None:
    """The bound of what may happen in between rests on the square of the time."""
    rng = np.random.default_rng(9)
    assert max(graze_error(ROBOT, rng, surface=surface) for _ in range(cases(200))) < 1e-4


@pytest.mark.parametrize(
    ("tool", "accuracy"),
    [(shape.capsule(0.03, 0.1), 1.0), (shape.of_mesh(ring(600), Filling.SURFACE), 2.5)],
    ids=["part", "surface"],
)
def test_the_nearest_of_each_move_is_what_looking_all_the_time_finds(
    tool: Shape, accuracy: float
) -> None:
    """Among boxes, in moves that are shorter than a step of the first look."""
    rng = np.random.default_rng(11)
    tip = Body(
        BodyName("tip", 0),
        tool,
        (AttachedBody(0.0, FLANGE, Transform.identity()),),
    )
    boxes = [
        Body(
            BodyName(f"box {number}"),
            shape.box(rng.uniform(0.02, 0.6, 3)),
            (
                AttachedBody(
                    0.0,
                    WORLD,
                    Transform.from_quaternion(rng.normal(size=4), rng.uniform(-1.5, 1.5, 3)),
                ),
            ),
        )
        for number in range(8)
    ]
    pairs = tuple(Pair(0, 1 + number, 0, touch_only=False) for number in range(len(boxes)))
    for _ in range(cases(5)):
        ends = ROBOT.lower + rng.random((2, 6)) * (ROBOT.upper - ROBOT.lower)
        at, lasts = swing(ROBOT, *(0.6 * ends))
        move_s = lasts / 40.0

        def many(
            times: Array, at: Callable[[Array], JointSamples] = at, move_s: float = move_s
        ) -> JointSamples:
            return replace(at(times), move=np.minimum(times // move_s, 39).astype(np.int64))

        middles = move_s * np.arange(0.5, 40.0, dtype=np.float64)
        brief = middles if move_s < STEP_S else middles[:0]
        arm = Arm(ROBOT, Transform.identity(), many, ((0.0, lasts),), brief)
        scene = Scene((arm,), (tip, *boxes), pairs)
        found = search(scene, lasts)
        times = lasts * np.arange(2000.0) / 1999.0
        poses, bodies = scene.poses(times), scene.shapes()
        nearest = np.full(40, np.inf)
        for pair in pairs:
            row = np.arange(len(times))
            gaps = bodies.gaps(
                0 * row, 0 * row + pair.second, poses.seen(0, pair.second), np.full(len(row), 0.5)
            )
            np.minimum.at(nearest, poses.moves[:, 0], np.maximum(gaps.distances_found, 0.0))
        for move in np.flatnonzero(nearest < 0.49).tolist():
            (known,) = [one for one in found.clearances if one.move == move]
            exact = accuracy * max(5e-4, 0.02 * nearest[move])
            assert known.distance_m == pytest.approx(nearest[move], abs=exact + 1e-3)


def test_a_contact_leaves_the_others_of_its_move_as_cheap_as_alone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A move hits a sheet, then passes through a ring: that is not tried at every instant."""
    measured = 0
    gaps = Bodies.gaps

    def counted(
        self: Bodies,
        first: Index,
        second: Index,
        seen: Transform,
        enough: Array,
        *tolerances: Array | float,
    ) -> Gaps:
        nonlocal measured
        measured += len(first)
        return gaps(self, first, second, seen, enough, *tolerances)  # type: ignore[arg-type]

    monkeypatch.setattr(Bodies, "gaps", counted)
    along = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    at, lasts = swing(ROBOT, 0.0 * along, along)
    early, late = (ROBOT.kinematics.forward(turn * along) for turn in (0.3, 0.8))
    upright = late.rotation @ Transform.from_quaternion([1, 1, 0, 0], [0, 0, 0]).rotation
    shapes = {
        "tip": (shape.box(np.full(3, 0.04)), FLANGE, Transform.identity()),
        "sheet": (shape.box(np.full(3, 0.02)), WORLD, early),
        "ring": (
            shape.of_mesh(ring(600), Filling.SURFACE),
            WORLD,
            Transform(upright, late.translation),
        ),
    }
    bodies = tuple(
        Body(BodyName(name), body, (AttachedBody(0.0, frame, pose),))
        for name, (body, frame, pose) in shapes.items()
    )
    pairs = tuple(Pair(0, other, 0, touch_only=False) for other in (1, 2))
    arm = Arm(ROBOT, Transform.identity(), at, ((0.0, lasts),))
    scene = Scene((arm,), bodies, pairs)
    (contact,) = search(scene, lasts).contacts
    assert contact.second.name == "sheet"
    assert measured < 100
    (shallow,) = search(scene, lasts, has_depths=False).contacts
    assert (shallow.time_s, shallow.depth_m) == (contact.time_s, None)
