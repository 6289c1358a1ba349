"""The law of motion: on its curves exactly, within its limits, in every program there is."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path as FilePath

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import cases, examples
from motion_law import Excess, command_of, excess_of, off_curve, with_smoothed
from motion_programs import LIMITS, ROBOT, Programmer, path_or_fault, programs, zone

from rapidsim.files import SourceFile, decode
from rapidsim.jobs.checked_program import load
from rapidsim.motion.geometry.segments import Speed
from rapidsim.motion.model import MODELS, Keeper, MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

ROOT = FilePath(__file__).parents[2]
_LOOK_AT_AXES = cases(3_000)
"""So many samples of each program with smoothed axes, which take longer."""


LEAST = {"tests/check/corpus": 8, "tests/rapid/motion": 20}
"""So many programs of a folder at least are run to their moves."""
LEAST_OF_RULES = 40


def moving(files: Iterable[FilePath]) -> list[FilePath]:
    """The programs that move a robot, but those that wait for a partner."""
    moves = (b"MoveL", b"MoveJ", b"MoveC", b"MoveAbsJ")
    texts = ((file, file.read_bytes()) for file in files)
    return [
        file
        for file, text in texts
        if any(move in text for move in moves) and b"Socket" not in text
    ]


def by_folder(files: Iterable[FilePath]) -> dict[str, list[FilePath]]:
    """The programs of each folder of the repository."""
    folders: dict[str, list[FilePath]] = {}
    for file in files:
        folders.setdefault(file.parent.relative_to(ROOT).as_posix(), []).append(file)
    return folders


FOLDERS = by_folder(moving(sorted([*ROOT.glob("programs/**/*.mod"), *ROOT.glob("tests/**/*.mod")])))


def trajectory_of(file: FilePath) -> Trajectory | None:
    """What a program does in its first seconds; None where it does not move."""
    loaded = load([SourceFile(file.name, decode(file.read_bytes())[0], "utf-8")])
    if loaded.program is None or "main" not in loaded.program.routines:
        return None
    options = RunOptions(max_time_s=20.0, answers=lambda prompt: None, nearest_configuration=True)
    trajectory = simulate(loaded.program, ROBOT, options=options).only.trajectory
    return trajectory if trajectory.pieces else None


def test_the_folders_with_most_programs_are_looked_at() -> None:
    assert set(LEAST) <= set(FOLDERS)


@pytest.mark.parametrize("folder", FOLDERS)
def test_programs_of_the_repository_keep_curves_and_limits(folder: str) -> None:
    assert_kept(FOLDERS[folder], LEAST.get(folder, 0))


def test_programs_of_rules_keep_curves_and_limits(rule_programs: list[FilePath]) -> None:
    assert_kept(moving(rule_programs), LEAST_OF_RULES)


def assert_kept(files: Iterable[FilePath], least: int) -> None:
    """The TCP off a line or circle by less than 1 um, as commanded and smoothed along the path;
    speeds over by less than 0.1 %; torques and accelerations of the command over by less than 1 %.

    With each axis smoothed by itself what is seen keeps speeds and accelerations, for a mean does;
    torques too, but for how far the inertia of the mean is from the mean of the inertia: 3 %.
    """
    limits = limits_of(ROBOT, MotionModel())
    looked_at = 0
    broken = []
    for file in files:
        trajectory = trajectory_of(file)
        if trajectory is None:
            continue
        looked_at += 1
        along = with_smoothed("path", trajectory)
        seen, command = excess_of(along, limits), excess_of(command_of(trajectory), limits)
        axes = excess_of(with_smoothed("axes", trajectory), limits, _LOOK_AT_AXES)
        off = off_curve(along)
        kept = max(seen.axis_speed, seen.tcp_speed, command.axis_speed, command.tcp_speed) < 1.001
        kept &= axes.axis_speed < 1.001 and axes.axis_acceleration < 1.03
        if not (kept and command.axis_acceleration < 1.01 and off < 1e-6):
            broken.append((file.name, seen, command, axes, off))
    assert not broken
    assert looked_at >= least


def driven(program: Programmer, speed: float, model: MotionModel) -> Trajectory | None:
    """A program without stops in between, at one speed."""
    segments = [
        replace(segment, speed=Speed(speed, np.radians(500.0)), zone=segment.zone or zone(2.0))
        for segment in program.segments
    ]
    path = path_or_fault(segments, model)
    if isinstance(path, PathFault):
        return None
    trajectory = Trajectory(segments[0].start, model.window, model.smoothing)
    trajectory.append(Piece(0.0, path, plan(path, LIMITS), 0.0, path.length))
    return trajectory


@examples(60)
@given(
    program=programs(),
    speed=st.sampled_from([0.1, 0.5, 2.0, 7.0]),
    keeper=st.sampled_from(["command", "motion"]),
)
def test_random_programs_keep_curves_and_limits(
    program: Programmer, speed: float, keeper: Keeper
) -> None:
    """With `motion` the smoothed motion keeps the accelerations, too."""
    trajectory = driven(program, speed, MotionModel(smoothing="path", accelerations_kept_by=keeper))
    if trajectory is None:
        return
    command, seen = excess_of(command_of(trajectory), LIMITS), excess_of(trajectory, LIMITS)
    keeps = seen if keeper == "motion" else Excess(0.0, 0.0, 0.0)
    assert max(command.axis_speed, command.tcp_speed, seen.axis_speed, seen.tcp_speed) < 1.001
    assert command.axis_acceleration < 1.01
    # The torque of a mean is not quite the mean of torques, as above.
    assert keeps.axis_acceleration < 1.03
    assert off_curve(trajectory) < 1e-6


def test_smoothing_along_the_path_takes_speed_into_a_tight_corner_unless_it_must_not() -> None:
    """What that does not keep, and what keeping it costs: a right angle with z1 at v500."""
    program = Programmer().line((0.15, 0, 0), z=zone(1)).line((0, 0.15, 0))
    fast = driven(program, 0.5, MODELS["1"])
    kept = driven(program, 0.5, replace(MODELS["1"], accelerations_kept_by="motion"))
    assert fast is not None
    assert kept is not None
    assert excess_of(fast, LIMITS).axis_acceleration > 2.0
    assert excess_of(kept, LIMITS).axis_acceleration < 1.01
    assert 1.2 * fast.duration < kept.duration < 2.5 * fast.duration


def test_a_kink_without_a_corner_is_a_standstill_also_when_smoothed() -> None:
    program = Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0, 0), (0, 0, 0.3), z=zone(10))
    trajectory = driven(program.line((0, 0.1, 0)), 0.5, MODELS["1"])
    assert trajectory is not None
    (piece,) = trajectory.pieces
    stops = piece.path.stops
    assert len(stops) == 2
    times = trajectory.time_at_place(stops)
    speeds = trajectory.at(np.concatenate([times - 1e-3, times, times + 1e-3])).joints
    moved = np.abs(np.diff(speeds.reshape(3, 2, -1), axis=0)).max()
    assert moved < 1e-4
    assert excess_of(trajectory, LIMITS).axis_acceleration < 1.01
