"""The cells with parts: a fault that is planted is found on its line, and cured."""

from __future__ import annotations

from pathlib import Path

import pytest

import rapidsim

PROGRAMS = Path(__file__).parents[2] / "programs"


def found(program: str) -> list[tuple[str, int | None]]:
    """Code and line of the findings about bodies of a run."""
    run = rapidsim.load(PROGRAMS / program).run()
    assert run.end == "ended"
    return [(one.code, one.line) for one in run.simulation.diagnostics if one.code[0] == "C"]


@pytest.mark.parametrize(
    "program", ["turntable/Load.mod", "belt_pick/Pick.mod", "hand_over/Left.mod"]
)
def test_a_cell_loses_no_part(program: str) -> None:
    assert not found(program)


@pytest.mark.parametrize(
    ("program", "code", "mark"),
    [
        ("turntable/faulty/Forgetful.mod", "C106", "! grips nothing"),
        ("belt_pick/faulty/Running.mod", "C106", "! grips nothing"),
        ("hand_over/faulty/Trusting.mod", "C105", "! drops the part"),
    ],
)
def test_a_planted_fault_is_found_on_its_line(program: str, code: str, mark: str) -> None:
    lines = (PROGRAMS / program).read_text(encoding="utf-8").splitlines()
    (line,) = (number for number, text in enumerate(lines, start=1) if mark in text)
    assert found(program) == [(code, line)]
