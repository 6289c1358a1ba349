"""The cells with parts: a fault that is planted is found on its line, and cured."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

import rapidsim
from rapidsim.api.run import Run

PROGRAMS = Path(__file__).parents[2] / "programs"


@cache
def run_of(program: str) -> Run:
    return rapidsim.load(PROGRAMS / program).run()


def line_of(program: str, mark: str) -> int:
    lines = (PROGRAMS / program).read_text(encoding="utf-8").splitlines()
    (line,) = (number for number, text in enumerate(lines, start=1) if mark in text)
    return line


def found(program: str) -> list[tuple[str, int | None]]:
    """Code and line of the findings about bodies of a run."""
    run = run_of(program)
    assert run.end == "ended"
    return [(one.code, one.line) for one in run.simulation.diagnostics if one.code[0] == "C"]


@pytest.mark.parametrize(
    "program",
    ["turntable/Load.mod", "belt_pick/Pick.mod", "belt_track/Track.mod", "hand_over/Left.mod"],
)
def test_a_cell_loses_no_part(program: str) -> None:
    assert not found(program)


@pytest.mark.parametrize(
    ("program", "code", "mark"),
    [
        ("turntable/faulty/Forgetful.mod", "C106", "! grips nothing"),
        ("belt_pick/faulty/Running.mod", "C106", "! grips nothing"),
        ("belt_track/faulty/Standing.mod", "C106", "! grips nothing"),
        ("hand_over/faulty/Trusting.mod", "C105", "! drops the part"),
    ],
)
def test_a_planted_fault_is_found_on_its_line(program: str, code: str, mark: str) -> None:
    assert found(program) == [(code, line_of(program, mark))]


def test_a_robot_takes_thirty_parts_a_minute_from_a_running_belt() -> None:
    """A part comes every 2 s, and none is missed."""
    run = run_of("belt_track/Track.mod")
    assert run.signals["doGrip"].rises_s == pytest.approx(
        [1.2 + 2.0 * n for n in range(6)], abs=0.2
    )
    assert run.time_s < 12.5
    assert run.simulation.robots[0].trajectory.follows_belts


def test_an_object_behind_the_end_of_tracking_is_dropped() -> None:
    run = run_of("belt_track/faulty/Late.mod")
    (found,) = (one for one in run.simulation.diagnostics if one.severity == "error")
    line = line_of("belt_track/faulty/Late.mod", "! comes too late")
    assert (found.code, found.line, "ERR_CNV_DROPPED" in found.message) == ("R101", line, True)
