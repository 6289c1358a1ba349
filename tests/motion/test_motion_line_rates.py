"""Closed forms on lines give what the general way gives, in columns of numbers and compiled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from motion_programs import (
    LIMITS,
    MODEL,
    V500,
    Programmer,
    path_of,
    path_or_fault,
    programs,
    zone,
)

from rapidsim.frames.transform import Transform
from rapidsim.motion import compiled, line_formulas, line_rates, problem, solver_loops
from rapidsim.motion.following import PathFault
from rapidsim.motion.grid import Places
from rapidsim.motion.held_speeds import least_around, within
from rapidsim.motion.model import MotionModel
from rapidsim.motion.opw import OrthoParallel
from rapidsim.motion.path import Path, PathRates, build_path
from rapidsim.motion.robot import load_robot
from rapidsim.motion.segments import Geometry, Segment, Waypoint
from rapidsim.motion.timing import plan
from rapidsim.motion.turns import rotation_from_vector

PROGRAMMED_TURNS = MotionModel(orientation_zone="programmed")


def in_general(path: Path, places: Places) -> PathRates:
    """Derivatives as any arm gets them."""
    other = Path(
        path.segments, path.kinematics, path.layout, path.arms, path.active, path.nodes, path.model
    )
    other.__dict__["_lines"] = None
    return other.rates(places.s, places.piece)


def spread(path: Path, count: int = 300) -> Places:
    """Places all over a path, both sides of its breakpoints among them."""
    inside = path.length * (np.arange(count) + 0.5) / count
    piece = np.arange(len(path.layout.row))
    s = np.concatenate([inside, path.layout.bounds[:-1], path.layout.bounds[1:]])
    pieces = np.concatenate([path.layout.piece_at(inside), piece, piece])
    return Places(s, pieces, path.rates(s, pieces))


@settings(max_examples=40)
@given(program=programs())
@pytest.mark.parametrize("model", [MODEL, PROGRAMMED_TURNS])
def test_closed_forms_are_the_general_derivatives(program: Programmer, model: MotionModel) -> None:
    path = path_or_fault(program, model)
    if isinstance(path, PathFault):
        return
    places = spread(path)
    general = in_general(path, places)
    assert places.rates.first == pytest.approx(general.first, rel=1e-9, abs=1e-9)
    assert places.rates.tcp_rate == pytest.approx(general.tcp_rate, abs=1e-9)
    assert places.rates.turn_rate == pytest.approx(general.turn_rate, abs=1e-9)
    # The general way takes differences over a millionth of a turn.
    scale = np.abs(general.second).max()
    assert np.abs(places.rates.second - general.second).max() < 1e-6 * max(scale, 1.0)


def test_all_of_a_program_of_lines_is_closed() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0), (0, 0, 0.2), zone(5))
    path = path_of(program.line((0.1, 0, 0)))
    lines = line_rates.lines_of(path.layout, path.arms)
    assert lines is not None
    assert lines.pieces.all()


def test_joint_moves_and_their_corners_are_not_lines() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0), z=zone(10))
    path = path_of(program.move((0.1, 0.1, 0, 0, 0, 0)))
    lines = line_rates.lines_of(path.layout, path.arms)
    assert lines is not None
    joint = path.layout.curves.in_joints[path.layout.row] | (path.layout.joint_corner >= 0)
    assert np.array_equal(lines.pieces, ~joint)


def test_loops_do_what_columns_do() -> None:
    """Not compiled, place after place: the code that numba gets."""
    program = Programmer().line((0.05, 0, 0), (0, 0.1, 0), zone(10))
    path = path_of(program.line((0, 0.05, 0), (0.1, 0, 0), zone(5)).line((0, 0, 0.05)))
    lines = line_rates.lines_of(path.layout, path.arms)
    assert lines is not None
    places = spread(path, 40)
    columns = lines.rates(places.s, places.piece)
    count = len(places.s)
    first, second, speeds = np.empty((count, 6)), np.empty((count, 6)), np.empty((count, 2))
    regular = np.empty(count, dtype=bool)
    corners = lines._corners(
        path.layout.position_corner[places.piece], places.s, places.piece, turning=False
    )
    g = lines.arm.geometry
    line_formulas.rates_one_by_one(
        (g.a1, g.a2, g.b, g.c1, g.c2, g.c3),
        lines.table,
        path.layout.row[places.piece],
        corners,
        corners,
        first,
        second,
        speeds,
        regular,
    )
    for ours, theirs in zip((first, second, speeds, regular), columns, strict=True):
        assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-12)


def test_the_least_around_is_found_alike() -> None:
    random = np.random.default_rng(1)
    for _ in range(50):
        count = int(random.integers(1, 60))
        places = np.sort(random.integers(0, 40, count) * 0.1)
        speeds = random.uniform(0.0, 2.0, count)
        stacked = np.empty(count)
        solver_loops.least_around(places, speeds, 0.5, stacked)
        assert np.array_equal(stacked, least_around(places, speeds, 0.5, within(places, 0.5)))


def test_loops_of_the_solver_do_what_columns_do() -> None:
    random = np.random.default_rng(2)
    slack, tilt = random.uniform(0.1, 5.0, (200, 12)), random.uniform(-50.0, 50.0, (200, 12))
    span = random.uniform(1e-4, 0.1, 200)
    loops = np.empty(200)
    solver_loops.widest(slack, tilt, span, problem.LARGEST_X, loops)
    assert np.array_equal(loops, problem._widest(slack, tilt, span))


def long_program() -> Programmer:
    """Enough small moves for compiled code."""
    program = Programmer()
    for i in range(120):
        turn = 0.01 * np.sin(i)
        way = ((0.002, 0, 0), (0, 0.002, 0), (-0.002, 0, 0), (0, 0.002, 0))[i % 4]
        program.line(way, (0.0, turn, 0.0), zone(1))
    return program


def test_compiled_plans_are_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("numba", reason="numba is not installed")
    model = MotionModel()
    monkeypatch.setenv("RAPIDSIM_NUMBA", "0")
    plain = plan(path_of(long_program(), model), LIMITS)
    monkeypatch.setenv("RAPIDSIM_NUMBA", "1")
    monkeypatch.setattr(compiled, "WORTH_COMPILING", 1)
    fast = plan(path_of(long_program(), model), LIMITS)
    assert fast.s == pytest.approx(plain.s, abs=1e-12)
    assert fast.times == pytest.approx(plain.times, rel=1e-12)
    assert fast.speed == pytest.approx(plain.speed, rel=1e-12)
    assert fast.limited_by == plain.limited_by


def test_few_rows_and_a_switch_keep_numba_away(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiled, "_loaded", False)
    assert compiled.compiled(solver_loops, "widest", 10) is None
    monkeypatch.setenv("RAPIDSIM_NUMBA", "0")
    assert compiled.compiled(solver_loops, "widest", 10**9) is None
    monkeypatch.setenv("RAPIDSIM_NUMBA", "1")
    monkeypatch.setattr(compiled, "find_spec", lambda name: None)
    assert compiled.compiled(solver_loops, "widest", 10**9) is None


def test_what_is_listed_to_be_compiled_is_all_there_is() -> None:
    for module in (line_formulas, solver_loops):
        functions = {
            name
            for name, value in vars(module).items()
            if callable(value) and getattr(value, "__module__", "") == module.__name__
        }
        assert {function.__name__ for function in module.COMPILED} == functions


@pytest.mark.parametrize("name", ["irb2400-10-1.55", "kr10-r900-2", "irb120"])
@pytest.mark.parametrize("branch", range(8))
def test_arms_with_rods_and_other_signs_and_all_branches(name: str, branch: int) -> None:
    robot = load_robot(name)
    kinematics = robot.kinematics
    assert isinstance(kinematics, OrthoParallel)
    bent = np.array([0.1, -0.4, 1.9, 0.3, 0.6, 0.2])
    pose = kinematics.forward(kinematics.joints_from_theta(bent))
    solutions = kinematics.inverse(pose)
    if not solutions.exists[branch]:
        pytest.skip(f"{name} does not reach this pose in configuration {branch}")
    joints = solutions.joints[branch]
    # Two lines of 10 mm with a corner, wherever that leads: limits do not matter here.
    ways = np.array([[0, 0, 0], [0.01, 0, 0], [0.01, 0.01, 0]])
    turns = rotation_from_vector(np.array([[0, 0, 0], [0, 0.02, 0], [0.03, 0.02, 0]]))
    poses = Transform(turns @ pose.rotation, pose.translation + ways)
    followed = kinematics.inverse_on_branch(poses, branch, joints)
    points = [
        Waypoint(q, p) for q, p in zip(followed.joints, [poses[i] for i in range(3)], strict=True)
    ]
    nowhere = replace(
        robot,
        joints=tuple(replace(joint, lower=-9.0, upper=9.0) for joint in robot.joints),
    )
    segments = [
        Segment(i, Geometry.LINE, points[i], points[i + 1], Transform.identity(), branch, V500, z)
        for i, z in enumerate((zone(5), None))
    ]
    path = build_path(nowhere, segments, MODEL)
    assert isinstance(path, Path)
    places = spread(path, 50)
    general = in_general(path, places)
    assert places.rates.first == pytest.approx(general.first, rel=1e-8, abs=1e-8)
    scale = np.abs(general.second).max()
    assert np.abs(places.rates.second - general.second).max() < 1e-5 * scale
