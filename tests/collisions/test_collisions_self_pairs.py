"""Which links of an arm are judged against each other: what is shown to stay apart does."""

from __future__ import annotations

from dataclasses import replace
from math import cos, radians, sin

import numpy as np
import pytest

from rapidsim import load_robot
from rapidsim.collisions.link_shapes import LinkShape, LinkShapes, link_shapes
from rapidsim.collisions.self_pairs import judged_pairs, self_pairs
from rapidsim.collisions.shape import sphere
from rapidsim.frames.transform import Transform

ROBOT = load_robot("irb120-3-0.58")
ELBOW_M = 0.27
"""From joint 2 to joint 3, which all postures keep."""


@pytest.mark.parametrize(
    ("room", "beside", "said"),
    [
        (0.018, 0.0, "no posture lets them touch"),
        (0.030, 0.0, "they never come near each other"),
        (-0.010, 0.0, "their shapes overlap"),
        # Off the elbow by more than there is room, it comes near in some postures alone.
        (0.010, 0.02, None),
        (0.0005, 0.0, None),
    ],
)
def test_pairs_are_left_out_for_what_all_postures_say(
    room: float, beside: float, said: str | None
) -> None:
    """A ball around joint 2 and one at the elbow, with some room between them."""
    (found,) = self_pairs(ROBOT, _balls(room, (0.0, 0.0, -beside)), 30)
    assert found.left_out == said


@pytest.mark.parametrize(
    ("lower", "said"), [(-230.0, None), (-180.0, "no posture lets them touch")]
)
def test_all_of_a_range_is_looked_at_that_goes_beyond_half_a_turn(
    lower: float, said: str | None
) -> None:
    """The ball beside the elbow meets the other one where axis 3 stands at -225 degrees."""
    limits = replace(ROBOT.joints[2], lower=radians(lower), upper=radians(50.0))
    robot = replace(ROBOT, joints=(*ROBOT.joints[:2], limits, *ROBOT.joints[3:]))
    there = radians(-225.0)
    (found,) = self_pairs(robot, _balls(0.0199, (0.02 * sin(there), 0.0, -0.02 * cos(there))), 30)
    assert not found.touching
    assert found.left_out == said


def _balls(room: float, beside: tuple[float, float, float]) -> tuple[LinkShape, LinkShape]:
    shoulder = Transform(np.eye(3), np.array([0.0, 0.0, 0.29]))
    elbow = Transform(np.eye(3), np.array(beside))
    return (
        LinkShape(1, sphere(0.2).moved(shoulder)),
        LinkShape(3, sphere(ELBOW_M - 0.2 - room).moved(elbow)),
    )


def test_a_link_whose_shape_cannot_be_read_is_judged_against_none() -> None:
    """Its file is refused by the system; the run says so, and goes on with the other links."""
    whole = link_shapes(ROBOT)
    pairs = judged_pairs(ROBOT, whole)
    number = pairs[0][0]
    rest = LinkShapes(tuple(link for link in whole.links if link.number != number))
    assert judged_pairs(ROBOT, rest) == tuple(pair for pair in pairs if number not in pair)
