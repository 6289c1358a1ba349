"""Motion of a run as those who draw it see it: samples, shares of limits, the line that was not."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from simulation_program import ran

from rapidsim.motion.model import MotionModel
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.simulation.results import sampling
from rapidsim.simulation.results.linear_alternative import linear_alternative, segments_of
from rapidsim.simulation.results.persistents import literal_places, parts_of
from rapidsim.simulation.results.sampling import (
    SampledRun,
    evaluate,
    joint_rates,
    rates_between,
    sampled,
)
from rapidsim.simulation.results.simulation import RobotRun, Simulation

STEP_S = 0.02
PROGRAM = """MODULE cell
  CONST robtarget p1:=[[700,-200,700],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2:=[[700,100,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p3:=[[900,100,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
    WaitTime 0.5;
    MoveJ p1,v1000,fine,tool0;
    MoveL p2,v500,z50,tool0;
    MoveL p3,v500,fine,tool0;
    WaitTime 1;
  ENDPROC
ENDMODULE
"""


@cache
def run() -> tuple[Simulation, RobotRun]:
    simulation = ran(PROGRAM).run
    return simulation, simulation.only


@cache
def drawn() -> SampledRun:
    return sampled(*run(), STEP_S)


def test_samples_are_every_step_and_at_the_ends_of_moves() -> None:
    _, robot = run()
    times, columns = drawn().samples.times, robot.moves.columns
    for edge in (*columns.start_s, *columns.end_s, drawn().end_s):
        assert np.abs(times - edge).min() < 1e-9
    assert (np.diff(times) > 0.0).all()
    assert times[0] == 0.0
    moving = (times > columns.start_s[2]) & (times < columns.end_s[3])
    assert np.diff(times[moving]).max() < STEP_S + 1e-9
    # At rest two samples at each end remain, and the edges of moves.
    rests = (times > columns.end_s[0] + 0.15) & (times < columns.start_s[1])
    assert rests.sum() <= 3
    assert drawn().samples.joints.shape == (len(times), 6)
    few = sampled(*run(), STEP_S, most_moves=3).samples.times
    assert np.abs(few - columns.end_s[2]).min() > 1e-6
    assert len(sampled(*run(), STEP_S, most_moves=4).samples.times) == len(times)


def test_samples_are_the_same_in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    _, robot = run()
    times = np.linspace(0.0, 2.0, 23)
    whole = evaluate(robot.trajectory, times)
    monkeypatch.setattr(sampling, "_BLOCK", 7)
    parts = evaluate(robot.trajectory, times)
    for name in ("times", "move", "joints", "tcp_speed", "external"):
        assert getattr(parts, name) == pytest.approx(getattr(whole, name), abs=1e-12)
    assert parts.base_from_tcp.translation == pytest.approx(whole.base_from_tcp.translation)
    assert parts.base_from_tcp.rotation == pytest.approx(whole.base_from_tcp.rotation)


def test_rates_are_those_of_the_joints() -> None:
    _, robot = run()
    begin, end = robot.moves.columns.start_s[2], robot.moves.columns.end_s[3]
    times = np.linspace(begin + 0.1, end - 0.1, 50)
    fine = 1e-4
    before, now, after = (robot.trajectory.at(times + step).joints for step in (-fine, 0.0, fine))
    speed, acceleration = joint_rates(robot.trajectory, robot.trajectory.at(times))
    assert speed == pytest.approx((after - before) / (2.0 * fine), abs=5e-3)
    largest = np.abs(acceleration).max()
    assert acceleration == pytest.approx(
        (after - 2.0 * now + before) / fine**2, abs=0.05 * largest + 0.1
    )
    # Of a parabola over uneven times, the slopes through neighbours are exact.
    t = np.array([0.0, 0.001, 0.02, 0.05, 0.06, 0.1, 0.101, 0.15])
    curve = np.stack([3.0 + 2.0 * t - 5.0 * t**2, t], axis=1)
    samples = replace(robot.trajectory.at(t), joints=curve)
    slopes, bends = rates_between(samples)
    inner = slice(2, -1)
    assert slopes[inner] == pytest.approx(np.stack([2.0 - 10.0 * t, 0 * t + 1.0], 1)[inner])
    assert bends[inner] == pytest.approx(np.tile([-10.0, 0.0], (8, 1))[inner], abs=1e-9)
    assert not slopes[[0, -1]].any()
    assert not bends[[0, -1]].any()


def test_shares_of_limits_are_percent() -> None:
    simulation, robot = run()
    arm, limits = robot.robot, limits_of(robot.robot, simulation.model)
    one = drawn()
    joints = one.samples.joints
    wanted = 200.0 * (joints - arm.lower) / (arm.upper - arm.lower) - 100.0
    assert one.range_shares == pytest.approx(wanted)
    assert one.speed_shares == pytest.approx(100.0 * one.joint_speed / limits.max_speed)
    shares = one.acceleration_shares
    turning = 100.0 * one.joint_acceleration / limits.max_acceleration
    main = [axis for group in limits.arms for axis in range(6)[group.axes]]
    others = [axis for axis in range(6) if axis not in main]
    assert shares[:, others] == pytest.approx(turning[:, others])
    # The torques of the main axes are used and hardly exceeded.
    assert 60.0 < np.abs(shares[:, main]).max() < 130.0


def test_corners_are_within_zones_at_both_ends_of_a_move() -> None:
    tcp = drawn().samples.base_from_tcp.translation
    distance = np.linalg.norm(tcp - np.array([0.7, 0.1, 0.7]), axis=1)
    move = drawn().samples.move
    assert np.array_equal(drawn().in_corner, (distance < 0.05) & np.isin(move, (2, 3)))
    assert drawn().in_corner[move == 2].any()
    assert drawn().in_corner[move == 3].any()
    stands = ran("MODULE cell\nPROC main()\nENDPROC\nENDMODULE\n").run.only.moves.columns
    assert not sampling.in_corner(drawn().samples, stands).any()


def test_the_line_beside_a_joint_move_is_straight_as_far_as_it_goes() -> None:
    _, robot = run()
    segments = segments_of(robot)
    assert sorted(segments) == [0, 1, 2, 3]
    segment = segments[1]
    line = linear_alternative(robot.robot, segment, MotionModel())
    assert line is not None
    assert line.start == pytest.approx(segment.start.base_from_tcp.translation)
    assert line.end == pytest.approx([0.7, -0.2, 0.7])
    if line.fault is None:
        assert line.fails_at is None
        assert line.arrival is not None
        assert line.arrival.joints == pytest.approx(segment.end.joints, abs=1e-6)
        share = np.linspace(0.0, 1.0, len(line.tcp))[:, None]
        assert line.tcp == pytest.approx(line.start + share * (line.end - line.start), abs=1e-9)
    turn = replace(segment.end.base_from_tcp, translation=np.array([-0.7, 0.1, 0.7]))
    behind = replace(segment, end=replace(segment.end, base_from_tcp=turn))
    broken = linear_alternative(robot.robot, behind, MotionModel())
    assert broken is not None
    assert broken.fault is not None
    assert broken.arrival is None
    assert broken.fails_at == pytest.approx(
        broken.start + broken.fault.fraction * (broken.end - broken.start)
    )
    assert 0.0 < broken.fault.fraction < 1.0
    way = broken.tcp - broken.start
    along = (broken.end - broken.start) / np.linalg.norm(broken.end - broken.start)
    assert np.linalg.norm(np.cross(way, along), axis=1).max() < 1e-6
    assert np.linalg.norm(way[-1]) <= np.linalg.norm(broken.fails_at - broken.start) + 1e-6


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("5", ("5",)),
        ("[1,-2.5, +3E-2]", ("1", "-2.5", "+3E-2")),
        ('["a,1","say ""2""",TRUE]', ('"a,1"', '"say ""2"""', "TRUE")),
        ("[[.5,1.],[9E+09,false]]", (".5", "1.", "9E+09", "false")),
        ("[INF,-INF,NAN]", ("INF", "-INF", "NAN")),
        ("", ()),
    ],
)
def test_leaves_of_a_value(text: str, parts: tuple[str, ...]) -> None:
    assert parts_of(text) == parts
    if "INF" not in text:
        places = literal_places(text)
        assert places is not None
        assert tuple(text[begin:end] for begin, end in places) == parts


def test_what_is_not_literal_has_no_places() -> None:
    text = "[1, ! the first 7\n  2]"
    places = literal_places(text)
    assert places is not None
    assert [text[begin:end] for begin, end in places] == ["1", "2"]
    assert literal_places("[1,height]") is None
    assert literal_places("1+1") == ((0, 1), (1, 3))
    assert literal_places("2*3") is None
