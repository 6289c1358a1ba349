"""Calls between moves of a run are checked with it; what is found is what each by itself has."""

from __future__ import annotations

import random

import pytest
from calls_between import with_calls, with_random_calls
from laws import cases
from run_law import assert_runs_change_nothing, rows_in_runs
from run_texts import harmed

from rapidsim.analysis.cell_names import CellNames, cell_names
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.library.predefined import TYPES

_CELL = cell_names([("do1", TYPES["signaldo"]), ("ao1", TYPES["signalao"])])
_COUNT, _EVERY = 120, 6
_ALL = (_COUNT - 1) // _EVERY
"""Number of calls."""


def _repeated(found: CheckResult) -> int:
    """Number of calls that are not in the tree."""
    runs = [run for file in found.trees for module in file.modules for run in module.runs]
    return sum(len(one.starts) for run in runs for one in run.between)


@pytest.mark.parametrize(
    "calls",
    [
        ["SetDO do1,1;"],
        ["SetDO do1,1;", "SetDO do1,0;"],
        ["SetDO do1,1;\nSetAO ao1,0.5;"],
        ["Set do1;", "Reset do1;", "InvertDO do1;"],
        ["SetAO ao1,reg1;"],
        ["PulseDO do1;"],
    ],
)
def test_outputs_are_checked_with_the_moves(calls: list[str]) -> None:
    found = assert_runs_change_nothing(with_calls(calls, _COUNT, _EVERY), cell=_CELL)
    # Each text is parsed twice, with the few moves up to it; then all are skipped but for the first
    # two and the last two.
    assert _repeated(found) == sum(
        len(call.splitlines()) * (_ALL // len(calls) + (_ALL % len(calls) > number) - 2)
        for number, call in enumerate(calls)
    )
    assert rows_in_runs(found) == _COUNT - 2 * _EVERY * len(calls) - 4


@pytest.mark.parametrize(
    "call",
    ["WaitTime 0.1;", "TPErase;", "ConfL\\On;", "PDispOff;", "reg1:=1;", "MoveDO p,v9,z1,t,do1,1;"],
)
def test_what_is_not_only_an_output_is_parsed(call: str) -> None:
    found = assert_runs_change_nothing(with_calls([call], _COUNT, _EVERY), cell=_CELL)
    assert _repeated(found) == 0


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("z1,", "fine,"),
        ("z1,", "z100,"),
        ("do1,1", "doMissing,1"),
        ("do1,1", "reg1,1"),
        ("do1,1", "do1,7"),
        ("do1,1", "do1,missing"),
        ("do1,1", "do1"),
        ("do1,1", "do1,1,1"),
        ("tool0", "tMissing"),
        ("ConfL\\Off;", "PDispSet [[5,0,0],[1,0,0,0]];"),
        ("  PROC main", "  PROC SetDO(signaldo a,num b)\n    MoveJ p,v100,fine,tool0;\n"
         "  ENDPROC\n  CONST robtarget p:=[[1150,0,700],[0,0,1,0],[0,0,0,0],"
         "[9E9,9E9,9E9,9E9,9E9,9E9]];\n  PROC main"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("cell", [_CELL, CellNames(), CellNames(assumes=True)])
def test_what_is_said_of_each_of_them(old: str, new: str, cell: CellNames) -> None:
    text = with_calls(["SetDO do1,1;", "SetDO do1,0;"], _COUNT, _EVERY).replace(old, new)
    assert_runs_change_nothing(text, cell=cell)


def test_an_output_in_a_zone_is_found_at_each_with_the_move_before_it() -> None:
    text = with_calls(["SetDO do1,1;", "SetDO do1,0;\nSetAO ao1,1;"], _COUNT, _EVERY)
    found = assert_runs_change_nothing(text, cell=_CELL)
    assert _repeated(found) == 28 - 6
    lines = text.splitlines()
    said = [(one.line, one.related[0].span.line) for one in found.diagnostics if one.code == "M503"]
    assert [line for line, _ in said] == [n for n, line in enumerate(lines, 1) if "Set" in line]
    for line, move in said:
        assert line is not None
        assert move is not None
        assert "Move" in lines[move - 1]
        assert line - move == (2 if "ao1" in lines[line - 1] else 1)


def test_a_call_that_is_different_once_is_parsed() -> None:
    text = with_calls(["SetDO do1,1;"], _COUNT, _EVERY)
    lines = text.splitlines(keepends=True)
    at = [n for n, line in enumerate(lines) if "Set" in line][11]
    lines[at] = "    SetDO do2,1;\n"
    found = assert_runs_change_nothing("".join(lines), cell=_CELL)
    assert _repeated(found) == _ALL - 2 - 1
    assert any(one.line == at + 1 and "do2" in str(one.message) for one in found.diagnostics)


@pytest.mark.parametrize("seed", range(cases(30)))
def test_whatever_goes_wrong_in_a_program(seed: int) -> None:
    dice = random.Random(f"calls {seed}")
    texts = ["SetDO do1,1;", "SetDO do1,0;", "Set do1;\nSetAO ao1,2;", "WaitTime 0;", "Reset do1;"]
    calls = dice.sample(texts, dice.randrange(1, 4))
    text = with_random_calls(calls, dice.choice((60, 90)), dice)
    for _ in range(dice.randrange(3)):
        text = harmed(text, dice)
    assert_runs_change_nothing(text, cell=_CELL)
