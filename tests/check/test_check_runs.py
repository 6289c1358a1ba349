"""Long runs of moves are looked at as runs; what is found is what looking at each one finds."""

from __future__ import annotations

import random
import re
from typing import Any

import pytest
from exports import export
from laws import cases
from run_law import assert_runs_change_nothing, rows_in_runs
from run_texts import harmed, program

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.names.name_violations import UndefinedName
from rapidsim.jobs.checking.check_result import CheckResult

_COUNT = 40
_AT = 21
"""The move that something is done to."""


def _text(form: str = "inline") -> str:
    return export(form, "raster", _COUNT)


def _at(old: str, new: str) -> str:
    """A program with one of its moves changed."""
    lines = _text().split("\n")
    move = lines[2 + _AT]
    lines[2 + _AT] = re.sub(old, lambda match: match.expand(new), move, count=1)
    assert lines[2 + _AT] != move
    return "\n".join(lines)


def test_moves_are_looked_at_as_a_run() -> None:
    found = assert_runs_change_nothing(_text())
    assert not found.diagnostics
    assert found.coverage.by_value == _COUNT
    # The first move is a MoveJ, the last one stops; of a run three lines are parsed.
    assert rows_in_runs(found) == _COUNT - 2 - 3


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        (r"\[\[[0-9.]+", "[[9000.000", "K601"),
        (r"MoveL", "MovL", "N209"),
        (r"\]\],v", "],v", "E1"),
        (r";", "", "E1"),
        (r"1\.000000", "1.100000", "M501"),
        (r"\[\[[^]]*\]", "[[0.5,0.1,0.4]", "M516"),
        (r"9E9", "9E39", "T3"),
        (r"\[0,0,0,0\]", "[0,0,0]", "T3"),
        (r"z1", "zz1", "N2"),
        (r"tool0", "undefined", "N2"),
    ],
)
def test_a_planted_fault_is_found_where_it_stands(old: str, new: str, code: str) -> None:
    found = assert_runs_change_nothing(_at(old, new))
    assert rows_in_runs(found)
    assert any(one.code.startswith(code) and one.line == 3 + _AT for one in found.diagnostics), (
        found.diagnostics
    )


@pytest.mark.parametrize(
    ("old", "new"), [(r"\]\],v", "],v"), (r"\[\[", "Offs([["), (r"\],\[", ",[")]
)
def test_a_missing_bracket_is_said_once(old: str, new: str) -> None:
    (found,) = assert_runs_change_nothing(_at(old, new)).diagnostics
    assert (found.code, found.line) == ("E113", 3 + _AT)


@pytest.mark.parametrize(
    ("old", "new", "is_run"),
    [
        # What is said of all of them is said of each.
        ("z1", "zz1", True),
        ("z1", "v1000", False),
        ("MODULE export\n", "MODULE export\nPROC MoveL(robtarget a,speeddata b,zonedata c,"
         "PERS tooldata d\\PERS wobjdata WObj)\nENDPROC\n", False),
        ("ConfL\\Off;", "PDispSet [[5,0,0],[1,0,0,0]];", False),
        ("ConfL\\Off;", "IF reg1=1 THEN", False),
        ("ConfL\\Off;", "ConfL\\Off;\n    reg1:=1;", True),
        ("ConfL\\Off;", "", True),
        ("\n", "\r\n", True),
        ("\n", "\r\r\n", False),
        (",", ", ", True),
        ("WObj", "wobj", True),
        ("    MoveL", "\tmovel", True),
        ("tool0\\WObj:=wobj0", "tool0 \\WObj := wobj0 ", True),
        ("wobj0;", "wobj0; ! here", False),
        ("wobj0;", "wobj0; Stop;", False),
    ],
)  # fmt: skip
def test_other_ways_to_write_it(old: str, new: str, is_run: bool) -> None:
    text = _text().replace(old, new)
    if "IF" in new:
        text = text.replace("  ENDPROC", "    ENDIF\n  ENDPROC")
    assert bool(rows_in_runs(assert_runs_change_nothing(text))) is is_run


def test_a_routine_that_is_called_twice_makes_its_moves_twice() -> None:
    text = _text().replace("main()", "path()")
    calls = "FOR i FROM 1 TO 2 DO\npath;\nENDFOR\npath;"
    main = f"MODULE other\nPROC main()\n{calls}\nENDPROC\nENDMODULE\n"
    assert rows_in_runs(assert_runs_change_nothing(main, text))


def test_what_is_said_of_each_module_of_a_file_is_said_of_its_runs() -> None:
    wrong = _text().replace("main()", "first()").replace("z1", "zz1")
    right = _text().replace("MODULE export", "MODULE other")
    for text in (wrong + right, right + wrong):
        found = assert_runs_change_nothing(text)
        assert rows_in_runs(found) == 2 * (_COUNT - 2 - 3)
        assert _undeclared(found) == ["zz1"] * (_COUNT - 1)


@pytest.mark.parametrize(
    ("old", "new", "is_run"),
    [
        ("", "", True),
        ("MoveL p21,", "MoveL p21x,", True),
        ("MoveL p21,", "MoveL p20,", False),
        ("MoveL p21,", "MoveL Offs(p21,0,0,1),", True),
        ("CONST robtarget p21:", "PERS robtarget p21:", True),
        ("CONST robtarget p21:", "CONST robtarget p20:", True),
        ("CONST robtarget p21:", "CONST robtarget stop:", True),
        ("CONST", "LOCAL CONST", True),
        ("p21:=[[", "p21:=[[9", True),
        ("0,0],[9E9", "0,9],[9E9", False),
        ("9E9]];\n  CONST robtarget p21:", "0]];\n  CONST robtarget p21:", True),
        ("9E9]];\n  CONST robtarget p21:", "1]];\n  CONST robtarget p21:", False),
        ("ConfL\\Off;", "", True),
        ("ConfL\\Off;", "VAR robtarget p21;", False),
        ("ConfL\\Off;", 'TPWrite "p21";', True),
        ("ConfL\\Off;", 'SetAllDataVal "robtarget",wobj0;', False),
        ("ConfL\\Off;", "! p21", True),
        ("p21", "v100", False),
        ("p21", "IF", False),
        ("p21", "p" + 33 * "1", False),
    ],
)  # fmt: skip
def test_targets_that_are_declared(old: str, new: str, is_run: bool) -> None:
    text = _text("named")
    found = assert_runs_change_nothing(text.replace(old, new) if old else text)
    assert bool(rows_in_runs(found)) is is_run


def test_a_name_that_another_file_says_is_no_row_of_a_run() -> None:
    other = "MODULE other\nPROC park()\nMoveJ {},v100,fine,tool0;\nENDPROC\nENDMODULE\n"
    assert rows_in_runs(assert_runs_change_nothing(_text("named"), other.format("p1")))
    assert not rows_in_runs(assert_runs_change_nothing(_text("named"), other.format("p21")))


_TOOL, _WOBJ = "tool0\\WObj:=wobj0", "\\WObj:=wobj0"


def _undeclared(found: CheckResult) -> list[str]:
    violations = (one.violation for one in found.diagnostics)
    return [one.undefined for one in violations if isinstance(one, UndefinedName)]


def _sixty(form: str) -> str:
    """A program of 60 alike moves between a MoveJ and a move that stops."""
    return export(form, "raster", 62)


@pytest.mark.parametrize("form", ["inline", "named"])
@pytest.mark.parametrize(
    ("old", "new", "names"),
    [
        pytest.param(_TOOL, "tMissing", ["tMissing"], id="tool"),
        pytest.param(_WOBJ, "\\WObj:=wMissing", ["wMissing"], id="work-object"),
        pytest.param("v200", "v200x", ["v200x"], id="speed"),
        pytest.param("z1", "zz1", ["zz1"], id="zone"),
        pytest.param("wobj0", "wobjO", ["wobjO"], id="another-name-is-near"),
        pytest.param(_TOOL, "tMissing\\WObj:=wNone", ["tMissing", "wNone"], id="two-in-each"),
    ],
)
def test_an_undeclared_name_in_alike_moves_is_found_in_each(
    form: str, old: str, new: str, names: list[str]
) -> None:
    text = _sixty(form)
    rows = [line for line in text.split("\n") if "MoveL" in line and old in line]
    assert len(rows) >= 60
    for row in rows:
        text = text.replace(row, row.replace(old, new))
    found = assert_runs_change_nothing(text)
    assert rows_in_runs(found)
    assert _undeclared(found) == names * len(rows)
    unchecked = {one.span.line for one in found.coverage.unchecked}
    assert len(unchecked) == len(rows)
    # The error does not touch the first move.
    assert found.coverage.by_value == 62 - len(rows)


def test_undeclared_names_of_several_runs_leave_the_moves_between_them_checked() -> None:
    lines = _sixty("inline").split("\n")
    lines = [
        line.replace(_TOOL, "tFirst" if k < 22 else _TOOL if k < 43 else "tSecond")
        for k, line in enumerate(lines)
    ]
    found = assert_runs_change_nothing("\n".join(lines))
    assert rows_in_runs(found) == 60 - 3 * 3
    assert sorted(set(_undeclared(found))) == ["tFirst", "tSecond"]
    assert found.coverage.by_value == 21


@pytest.mark.parametrize(
    "task",
    [
        {"unseen": ("Tools",)},
        {"refers_late": True},
        {"cell": CellNames(assumes=True)},
        {"cell": CellNames(assumes=True), "refers_late": True},
    ],
    ids=["unread-module", "unresolved-references", "assumed", "assumed-late"],
)
@pytest.mark.parametrize("form", ["inline", "named"])
def test_names_that_another_module_may_declare(form: str, task: dict[str, Any]) -> None:
    text = _sixty(form).replace(_TOOL, "tMissing")
    assert rows_in_runs(assert_runs_change_nothing(text, **task))


# Each case checks a program twice; that is the law.
@pytest.mark.parametrize("seed", range(4, 4 + cases(30)))
def test_whatever_goes_wrong_in_a_program(seed: int) -> None:
    dice = random.Random(f"runs {seed}")
    text = program(dice)
    for _ in range(dice.randrange(4)):
        text = harmed(text, dice)
    assert_runs_change_nothing(text)
