"""Surveys of many curves: where an axis holds up the programmed speed, and what breaks a curve."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from motion_programs import LIMITS, ROBOT, Programmer, path_of

from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import Segment, Speed
from rapidsim.motion.path.along_curves import NodeJoints, Nodes, course_of
from rapidsim.motion.path.curve_feasibility import SurveyedCurves, survey_curves

FAST = Speed(2.0, math.radians(500.0))


def survey(*segments: Segment) -> SurveyedCurves:
    return survey_curves(ROBOT, segments, LIMITS.max_speed)


def past_the_wrist(degrees: float = 1.0) -> Segment:
    """A vertical line of 300 mm; in its middle axis 5 is at its smallest."""
    nearest = np.radians([0.0, -10.0, 20.0, 90.0, degrees, 0.0])
    flange = ROBOT.kinematics.forward(nearest)
    down = np.linspace(0.0, -0.15, 2001)[:, None] * np.array([0.0, 0.0, 1.0])
    way = Transform(np.tile(flange.rotation, (2001, 1, 1)), flange.translation + down)
    start = ROBOT.kinematics.inverse_on_branch(way, 0, nearest).joints[-1]
    program = Programmer(joints=start, tool=Transform.identity(), speed=FAST)
    return program.line((0.0, 0.0, 0.3)).segments[0]


def plain(way: tuple[float, float, float], turn: tuple[float, float, float]) -> Segment:
    return Programmer(speed=FAST).line(way, turn).segments[0]


def test_what_a_survey_measures_of_each_curve() -> None:
    segments = [plain((0.2, 0.1, 0.0), (0.0, 0.0, 0.0)), plain((0.0, 0.05, 0.0), (0.0, 0.3, 0.0))]
    found = survey(*segments)
    assert found.travel == pytest.approx([math.hypot(0.2, 0.1), 0.05])
    assert found.turned == pytest.approx([0.0, 0.3])
    assert found.arrives.tolist() == [True, True]
    assert found.broken.tolist() == [False, False]
    for arrival, segment in zip(found.arrival, segments, strict=True):
        assert arrival == pytest.approx(segment.end.joints, abs=1e-9)


@pytest.mark.parametrize(
    ("segment", "near"),
    [
        (past_the_wrist(), "wrist"),
        (past_the_wrist(12.0), None),
        (plain((0.1, 0.0, 0.0), (0.0, 0.0, 0.4)), None),
    ],
    ids=["wrist", "beside", "turn"],
)
def test_the_bottleneck_is_where_an_axis_is_fastest(segment: Segment, near: str | None) -> None:
    """Against the rates of the path, which are exact."""
    path = path_of([segment])
    s = np.linspace(0.0, path.length, 20_001)[1:-1]
    rates = path.rates(s, path.layout.piece_at(s))
    pace = np.minimum(
        segment.speed.tcp / np.maximum(rates.tcp_rate, 1e-9),
        segment.speed.reorientation / np.maximum(rates.turn_rate, 1e-9),
    )
    usage = np.abs(rates.first) / LIMITS.max_speed * pace[:, None]
    row, axis = np.unravel_index(np.argmax(usage), usage.shape)
    beside = plain((0.01, 0.0, 0.0), (0.0, 0.0, 0.0))
    slow = replace(segment, speed=Speed(1e-3, 1e-3))
    timed = replace(segment, duration=0.01)
    found = survey(beside, slow, segment, timed)
    assert set(found.bottlenecks) - {0} == ({2} if usage.max() > 1.0 else set())
    if 2 in found.bottlenecks:
        one = found.bottlenecks[2]
        assert one.axis == axis + 1
        # A survey has steps of up to 0.15 rad.
        assert one.share == pytest.approx(1.0 / usage.max(), rel=0.1)
        assert one.fraction == pytest.approx(s[row] / path.length, abs=0.13)
        assert one.singularity == near


def test_a_curve_through_a_singularity_or_past_a_limit_is_broken() -> None:
    through, good = past_the_wrist(0.0), plain((0.1, 0.0, 0.0), (0.0, 0.0, 0.0))
    far = good.end.base_from_tcp.translation + np.array([2.0, 0.0, 0.0])
    away = replace(
        good,
        end=replace(good.end, base_from_tcp=Transform(good.end.base_from_tcp.rotation, far)),
    )
    found = survey(good, through, away, good)
    assert found.broken.tolist() == [False, True, True, False]
    assert found.arrives.tolist() == [True, True, False, True]
    assert not {1, 2} & set(found.bottlenecks)
    near_limit = Programmer(joints=np.append(ROBOT.upper[:1] - 0.02, [0.0, 0.2, 0.1, 1.0, 0.2]))
    sideways = near_limit.line((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)).segments[0]
    pose = sideways.end.base_from_tcp
    across = np.array([-pose.translation[1], pose.translation[0], 0.0])
    step = 0.15 * across / np.linalg.norm(across)
    beyond = near_limit.line(tuple(step.tolist())).segments[-1]
    assert survey(beyond).broken.tolist() == [True]


def test_nodes_that_determine_no_turn_are_dropped() -> None:
    """Of three curves the bent one keeps all of its nodes, the others their ends."""
    count = 600
    share = np.linspace(0.0, 1.0, count)
    straight = np.outer(share, [1.0, -2.0])
    bent = straight + 0.3 * np.sin(np.pi * share)[:, None]
    odd = straight + 0.09 * np.sin(np.pi * share)[:, None]
    place = np.concatenate([share, 1.0 + share, 2.0 + share])
    joints = np.concatenate([straight, bent, odd])
    curve = np.repeat(np.arange(3), count)
    nodes = Nodes(NodeJoints(place, joints), curve, curve, np.ones(3 * count, dtype=bool))
    kept = course_of(nodes, np.ones(3 * count, dtype=bool))
    first, last = np.array([0, count - 1]), np.array([2 * count, 3 * count - 1])
    rows = np.concatenate([first, np.arange(count, 2 * count), last])
    assert np.array_equal(kept.place, place[rows])
    assert np.array_equal(kept.joints, joints[rows])
    irregular = np.ones(3 * count, dtype=bool)
    irregular[2 * count + 7] = False
    assert len(course_of(nodes, irregular).place) == 2 + 2 * count
    few = Nodes(NodeJoints(place[:900], joints[:900]), curve[:900], curve[:900], irregular[:900])
    assert course_of(few, irregular[:900]) is few.course
