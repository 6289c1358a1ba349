"""All programs of the repository, each run once: the law of motion, and what a check judged.

The law: on its curves exactly, within its limits. And what checking by value judges is, field by
field, what the run drives.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import pytest
from laws import cases, some
from motion_law import command_of, excess_of, off_curve, with_smoothed
from simulation_program import arm
from simulation_segments import MODEL, OPTIONS, agreeing, driven, judged
from test_simulation_reach_programs import PROGRAMS, names_a_move, read

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Severity
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate

ROOT = Path(__file__).parents[2]
LOOK_AT_AXES = cases(6_400)
"""So many samples of each program with smoothed axes, which take longer."""
LEAST_MOVING = {"tests/check/corpus": 3, "tests/rapid/motion": 8}
"""So many programs of a folder at least are run to their moves."""
LEAST_SEGMENTS = {"tests/check/corpus": 1, "tests/rapid/motion": 8}
"""So many segments of a folder at least are compared."""
LEAST_OF_RULES = (13, 17)


def by_folder(files: Iterable[Path]) -> dict[str, list[Path]]:
    """The programs of each folder of the repository that name an instruction that moves."""
    folders: dict[str, list[Path]] = {}
    for file in filter(names_a_move, files):
        folders.setdefault(file.parent.relative_to(ROOT).as_posix(), []).append(file)
    return folders


FOLDERS = by_folder(PROGRAMS)


def test_the_folders_with_most_programs_are_looked_at() -> None:
    assert {*LEAST_MOVING, *LEAST_SEGMENTS} <= set(FOLDERS)


@pytest.mark.parametrize("folder", FOLDERS)
def test_programs_of_the_repository(folder: str) -> None:
    moving, segments = assert_all(some(FOLDERS[folder], 4))
    assert moving >= LEAST_MOVING.get(folder, 0)
    assert segments >= LEAST_SEGMENTS.get(folder, 0)


def test_programs_of_rules(rule_programs: list[Path]) -> None:
    moving, segments = assert_all(some([*filter(names_a_move, rule_programs)], 6))
    least_moving, least_segments = LEAST_OF_RULES
    assert moving >= least_moving
    assert segments >= least_segments


def assert_all(files: Iterable[Path]) -> tuple[int, int]:
    """How many programs moved, and how many segments of checks were compared."""
    moving = segments = 0
    for file in files:
        text, loaded = file.read_bytes(), read(file)
        if loaded is None or loaded.program is None:
            continue
        # Those that wait for a partner would wait long.
        runs = "main" in loaded.program.routines and b"Socket" not in text
        # Where a trap clears the path, what comes next begins where it came up, which no text says.
        cleared = {b"TRAP", b"ClearPath"} <= set(re.findall(rb"\w+", text))
        reach = {} if cleared else judged(loaded.program)
        if not (runs or reach):
            continue
        ran = driven(loaded.program)
        segments += agreeing(reach, ran.segments)
        if runs:
            trajectory = trajectory_of(loaded.program, ran.run)
            if trajectory.pieces:
                moving += 1
                assert_kept(file, trajectory)
    return moving, segments


def trajectory_of(program: Program, run: Simulation | None) -> Trajectory:
    """What a program does in its first seconds, beyond targets whose configuration is not had."""
    if run is None or any(
        one.violation.code.startswith("K") and one.severity is Severity.ERROR
        for one in run.diagnostics
    ):
        run = simulate(program, arm(), options=replace(OPTIONS, nearest_configuration=True))
    return run.only.trajectory


def assert_kept(file: Path, trajectory: Trajectory) -> None:
    """The TCP off a line or circle by less than 1 um, as commanded and smoothed along the path;
    speeds over by less than 0.1 %; torques and accelerations of the command over by less than 1 %.

    With each axis smoothed by itself what is seen keeps speeds and accelerations, for a mean does;
    torques too, but for how far the inertia of the mean is from the mean of the inertia: 3 %.
    """
    limits = limits_of(arm(), MODEL)
    along = with_smoothed("path", trajectory)
    seen, off = excess_of(along, limits), off_curve(along)
    command = excess_of(command_of(trajectory), limits)
    axes = excess_of(with_smoothed("axes", trajectory), limits, LOOK_AT_AXES)
    kept = max(seen.axis_speed, seen.tcp_speed, command.axis_speed, command.tcp_speed) < 1.001
    kept &= axes.axis_speed < 1.001 and axes.axis_acceleration < 1.03
    kept &= command.axis_acceleration < 1.01 and off < 1e-6
    assert kept, (file, seen, command, axes, off)
