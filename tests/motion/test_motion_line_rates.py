"""Closed forms on lines give what the general way gives, in columns of numbers and compiled."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given
from laws import examples
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
from plain_segments import plain_segment

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion import numba_jit
from rapidsim.motion.geometry import blend_shape
from rapidsim.motion.geometry.segments import Geometry, Waypoint
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.model import MODELS, MotionModel
from rapidsim.motion.path import curve_following, line_derivatives, line_formulas, line_loops
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.path_derivatives import PathRates
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.timing import smoothed_speed_limits as held_speeds_module
from rapidsim.motion.timing import smoothed_speed_loops, stages, two_pass, two_pass_loops
from rapidsim.motion.timing.constraints import acceleration_rows
from rapidsim.motion.timing.discretisation import GridPoints, cells_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.problem import problem_of
from rapidsim.motion.timing.smoothed_speed_limits import held_speeds
from rapidsim.motion.timing.time_optimal import fastest_drive

PROGRAMMED_TURNS = replace(MODELS["1"], orientation_zone="programmed")


def in_general(path: Path, places: GridPoints) -> PathRates:
    """Derivatives as any arm gets them."""
    return replace(path, lines=None).rates(places.s, places.piece)


def spread(path: Path, count: int = 300) -> GridPoints:
    """Places all over a path, both sides of its breakpoints among them."""
    inside = path.length * (np.arange(count) + 0.5) / count
    piece = np.arange(len(path.layout.row))
    s = np.concatenate([inside, path.layout.bounds[:-1], path.layout.bounds[1:]])
    pieces = np.concatenate([path.layout.piece_at(inside), piece, piece])
    return GridPoints(s, pieces, path.rates(s, pieces))


@examples(40)
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
    assert places.rates.stance == pytest.approx(general.stance, abs=1e-9)
    # The general way takes differences over a millionth of a turn; 1.2e-6 is the largest seen.
    scale = np.abs(general.second).max()
    assert np.abs(places.rates.second - general.second).max() < 3e-6 * max(scale, 1.0)


def test_all_of_a_program_of_lines_is_closed() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0), (0, 0, 0.2), zone(5))
    path = path_of(program.line((0.1, 0, 0)))
    assert path.lines is not None
    assert path.lines.pieces.all()


def test_joint_moves_and_their_corners_are_not_lines() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0), z=zone(10))
    path = path_of(program.move((0.1, 0.1, 0, 0, 0, 0)))
    lines = path.lines
    assert lines is not None
    joint = path.layout.curves.in_joints[path.layout.row] | (path.layout.joint_corner >= 0)
    assert np.array_equal(lines.pieces, ~joint)


def some_lines(model: MotionModel = MODEL) -> line_derivatives.Lines:
    """Three lines that turn the tool, with corners."""
    program = Programmer().line((0.05, 0, 0), (0, 0.1, 0), zone(10))
    program.line((0, 0.05, 0), (0.1, 0, 0), zone(5)).line((0, 0, 0.05))
    lines = path_of(program, model).lines
    assert lines is not None
    return lines


@pytest.mark.parametrize("model", [MODEL, PROGRAMMED_TURNS, MotionModel(corner="parabola")])
def test_loops_do_what_columns_do(model: MotionModel, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not compiled, place after place: the code that numba gets."""
    lines = some_lines(model)
    bounds = lines.layout.bounds
    s = np.concatenate([np.linspace(0.0, bounds[-1], 40), bounds[:-1], bounds[1:]])
    own = np.arange(len(bounds) - 1)
    piece = np.concatenate([lines.layout.piece_at(s[:40]), own, own])
    columns, _ = lines.rates(s, piece)
    joints, _ = lines.joints(s, piece)
    monkeypatch.setattr(
        line_derivatives, "jit_function", lambda module, name, rows: vars(module)[name]
    )
    loops, regular = lines.rates(s, piece)
    assert regular.all()
    for ours, theirs in zip(loops.columns, columns.columns, strict=True):
        assert ours == pytest.approx(theirs, rel=1e-12, abs=1e-12)
    assert lines.joints(s, piece)[0] == pytest.approx(joints, abs=1e-12)


@examples(40)
@given(program=programs())
def test_joints_on_lines_are_those_of_inverse_kinematics(program: Programmer) -> None:
    path = path_or_fault(program, MODEL)
    if isinstance(path, PathFault) or path.lines is None:
        return
    s = path.nodes.place
    piece = path.layout.piece_at(s)
    joints, holds = path.lines.joints(s, piece)
    expected, exists = curve_following._joints_in_general(path.layout, path.arms, s, piece)
    assert exists[holds].all()
    assert joints[holds] == pytest.approx(expected[holds], abs=1e-9)


def test_speeds_are_held_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    random = np.random.default_rng(1)
    for number in range(150):
        count = int(random.integers(1, 80))
        steps = np.array([0.0, 0.01, 0.05, 0.5])
        places: Array = np.cumsum(random.choice(steps, count, p=[0.2, 0.4, 0.3, 0.1]))
        speeds = random.uniform(0.1, 2.0, count)
        if number % 2:
            # Even enough for lines.
            speeds = 0.5 + 0.4 * np.sin(0.5 * places) + 0.001 * speeds
        needed = random.random(count) < 0.6
        columns = held_speeds(places, speeds, needed, 0.3)
        with monkeypatch.context() as patch:
            patch.setattr(
                held_speeds_module, "jit_function", lambda module, name, _: vars(module)[name]
            )
            loops = held_speeds(places, speeds, needed, 0.3)
        assert np.array_equal(loops, columns)
        assert (columns < speeds).any() or not needed.any() or count < 20


@examples(20)
@given(program=programs())
def test_loops_of_the_solver_do_what_columns_do(program: Programmer) -> None:
    """Not compiled, stage after stage: the code that numba gets."""
    path = path_or_fault(program, MODEL)
    if isinstance(path, PathFault):
        return
    cells = cells_of(path, LIMITS, 0.0)
    rows = acceleration_rows(path, cells.places, LIMITS)
    columns = stages.stages_of(cells, rows, 3)
    slack, tilt = np.empty_like(columns.slack), np.empty_like(columns.tilt)
    widest = np.empty_like(columns.widest)
    span = 2.0 * (columns.end - columns.begin) * cells.width[columns.cell]
    two_pass_loops.limit_stages(
        (cells.at, rows.slope, rows.bend),
        (columns.cell, columns.begin, columns.end, span),
        (stages.LARGEST_X, np.arange(len(span))),
        (slack, tilt, widest),
    )
    assert slack == pytest.approx(columns.slack, rel=1e-12)
    assert tilt == pytest.approx(columns.tilt, rel=1e-12, abs=1e-12)
    assert widest == pytest.approx(columns.widest, rel=1e-12)


@examples(20)
@given(program=programs())
def test_loops_over_a_motion_do_what_columns_do(program: Programmer) -> None:
    path = path_or_fault(program, MODEL)
    if isinstance(path, PathFault):
        return
    problem = problem_of(path, cells_of(path, LIMITS, 0.0), LIMITS)
    cells, rows = problem.cells, problem.accelerations
    _, motion = fastest_drive(problem, 0.0)
    both = []
    for module in (None, two_pass_loops):
        with pytest.MonkeyPatch.context() as patch:
            if module is not None:
                patch.setattr(
                    stages, "jit_function", lambda _, name, rows: vars(two_pass_loops)[name]
                )
            both.append(
                (
                    stages.loads(motion.stages, cells, rows, motion.x),
                    stages.fastest(motion.stages, cells, problem.slowness),
                )
            )
    columns, loops = both
    assert loops[0] == pytest.approx(columns[0], rel=1e-12, abs=1e-12)
    assert loops[1] == pytest.approx(columns[1], rel=1e-12)


def test_both_passes_in_loops_are_those_in_columns(monkeypatch: pytest.MonkeyPatch) -> None:
    random = np.random.default_rng(3)
    for first in (0.0, 0.2, 50.0):
        count, rows = 60, 4
        limits = stages.Stages(
            cell=np.arange(count),
            begin=np.zeros(count),
            end=np.ones(count),
            nodes=np.concatenate([[0.0], np.cumsum(random.uniform(0.001, 0.2, count))]),
            slack=random.uniform(0.1, 2.0, (count, rows)),
            tilt=random.uniform(-2.0, 5.0, (count, rows)),
            widest=np.full(count, 5.0),
        )
        caps = np.append(random.choice([0.05, 0.5, 5.0], count), 0.0)
        columns, fastest = two_pass._both_passes(limits, caps, first)
        with monkeypatch.context() as patch:
            patch.setattr(two_pass, "jit_function", lambda module, name, _: vars(module)[name])
            loops, of_loops = two_pass._both_passes(limits, caps, first)
        assert loops == pytest.approx(columns, rel=1e-12, abs=1e-14)
        assert of_loops == pytest.approx(fastest, rel=1e-12)
        assert 0.0 < fastest <= caps[0]


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
    monkeypatch.setattr(numba_jit, "WORTH_COMPILING", 1)
    fast = plan(path_of(long_program(), model), LIMITS)
    assert fast.s == pytest.approx(plain.s, abs=1e-12)
    assert fast.times == pytest.approx(plain.times, rel=1e-12)
    assert fast.speed == pytest.approx(plain.speed, rel=1e-12)
    assert fast.active is not None
    assert plain.active is not None
    assert (fast.active == plain.active).all()
    assert fast.limiters == plain.limiters


def test_few_rows_and_a_switch_keep_numba_away(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numba_jit, "_loaded", False)
    assert numba_jit.jit_function(two_pass_loops, "widest", 10) is None
    monkeypatch.setenv("RAPIDSIM_NUMBA", "0")
    assert numba_jit.jit_function(two_pass_loops, "both_passes", 10**9) is None
    monkeypatch.setenv("RAPIDSIM_NUMBA", "1")
    monkeypatch.setattr(numba_jit, "is_installed", lambda name: False)
    assert numba_jit.jit_function(two_pass_loops, "both_passes", 10**9) is None


@pytest.mark.parametrize(
    "module", [blend_shape, smoothed_speed_loops, line_formulas, line_loops, two_pass_loops]
)
def test_what_is_listed_to_be_compiled_is_all_there_is(module: ModuleType) -> None:
    functions = {
        name
        for name, value in vars(module).items()
        if callable(value) and getattr(value, "__module__", "") == module.__name__
    }
    listed = {one.__name__ for one in module.COMPILED if one.__module__ == module.__name__}
    assert listed == functions


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
        plain_segment(
            Geometry.LINE, points[i], points[i + 1], Transform.identity(), branch, V500, z
        )
        for i, z in enumerate((zone(5), None))
    ]
    path = build_path(nowhere, segments, MODEL)
    assert isinstance(path, Path)
    places = spread(path, 50)
    general = in_general(path, places)
    assert places.rates.first == pytest.approx(general.first, rel=1e-8, abs=1e-8)
    scale = np.abs(general.second).max()
    assert np.abs(places.rates.second - general.second).max() < 1e-5 * scale
