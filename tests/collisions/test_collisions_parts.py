"""Parts of a cell: what carries them, and what a run says where one is not as the program means.

Each procedure of `cells/shop/shop.mod` and `cells/tools/tools.mod` is a cell of its own: those
called good_ have no fault, the others one, on the line that says so.
"""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

import jsonschema
import pytest
from command_line import call

import rapidsim
from rapidsim.api.run import Run
from rapidsim.api.schemas import json_schema
from rapidsim.simulation import cell_bodies

CELLS = Path(__file__).parent / "cells"
SHOP, TOOLS = CELLS / "shop" / "shop.mod", CELLS / "tools" / "tools.mod"
HAND_OVER = Path(__file__).parents[2] / "programs" / "hand_over" / "Left.mod"
FAULTS = {
    "air": "C106",
    "turned_away": "C106",
    "vice_full": "C107",
    "conveyor_passed": "C106",
    "conveyor_missed": "C105",
    "early": "C105",
    "second_part": "C101",
    "source_empty": "C106",
    "source_blocked": "C107",
    "sink_full": "C107",
    "wrong_tool": "C106",
    "second_in_gripper": "C107",
    "without_the_tool": "C106",
}


@cache
def cell(file: Path) -> rapidsim.Cell:
    return rapidsim.load(file)


@cache
def run_of(file: Path, procedure: str) -> Run:
    return cell(file).run(proc=procedure)


def findings(run: Run) -> list[tuple[str, int | None]]:
    """Code and line of each finding about bodies."""
    return [(one.code, one.line) for one in run.simulation.diagnostics if one.code[0] == "C"]


def events(run: Run) -> list[tuple[str, str]]:
    """Kind and carrier of each event of a part."""
    assert run.simulation.collisions is not None
    return [(one.change.value, one.carrier) for one in run.simulation.collisions.part_events]


def procedures() -> list[tuple[Path, str]]:
    return [
        (file, name)
        for file in (SHOP, TOOLS)
        for name in re.findall(r"PROC (\w+)\(\)", file.read_text(encoding="utf-8"))
        if name != "up"
    ]


GOOD = [one for one in procedures() if one[1].startswith("good_")]
FAULTY = [one for one in procedures() if not one[1].startswith("good_")]


@pytest.mark.parametrize(("file", "procedure"), GOOD, ids=[name for _, name in GOOD])
def test_a_good_cell_is_silent(file: Path, procedure: str) -> None:
    run = run_of(file, procedure)
    assert run.end == "ended"
    assert not findings(run)


@pytest.mark.parametrize(("file", "procedure"), FAULTY, ids=[name for _, name in FAULTY])
def test_a_fault_is_found_on_its_line(file: Path, procedure: str) -> None:
    lines = file.read_text(encoding="utf-8").splitlines()
    begin = next(k for k, line in enumerate(lines) if f"PROC {procedure}()" in line)
    line = next(k for k in range(begin, len(lines)) if "! fault" in lines[k]) + 1
    assert findings(run_of(file, procedure)) == [(FAULTS[procedure], line)]


def test_a_check_of_all_tasks_knows_the_parts_of_the_others() -> None:
    assert not [one for one in cell(HAND_OVER).check().diagnostics if one.code[0] == "C"]


def test_parts_move_with_what_carries_them() -> None:
    assert events(run_of(SHOP, "good_turn")) == [
        ("gripped", "the gripper"),
        ("placed", "`plate`"),
        ("gripped", "the gripper"),
        ("placed", "`stand`"),
    ]
    assert events(run_of(SHOP, "good_clamp"))[1:3] == [("gripped", "`STN1`"), ("placed", "`plate`")]
    assert [carrier for _, carrier in events(run_of(TOOLS, "good_tool_change"))] == [
        "the gripper",
        "`sucker`",
        "`table`",
        "`stand`",
    ]


def test_sources_and_sinks_count(tmp_path: Path) -> None:
    simulation = run_of(SHOP, "good_box").simulation
    assert simulation.collisions is not None
    counts = simulation.collisions.part_counts
    assert (counts.total, counts.moved, counts.delivered, counts.lost) == (3, 3, 2, 0)
    assert events(run_of(SHOP, "good_outfeed"))[-1] == ("delivered", "")
    command = ("run", str(SHOP), "--proc", "good_box", "--no-record", "--assert")
    assert "3: 3 moved, 2 delivered" in call(*command, "parts_delivered = 2", cwd=tmp_path).out
    assert call(*command, "parts_lost > 0", cwd=tmp_path).code != 0


def test_a_run_records_its_parts_as_json(tmp_path: Path) -> None:
    command = ("run", str(SHOP), "--proc", "early", "--no-record", "--format", "json")
    ended = call(*command, cwd=tmp_path)
    assert ended.code == 1
    found = json.loads(ended.out)
    jsonschema.validate(found, json_schema("run"))
    parts = found["parts"]
    assert (parts["made"], parts["moved"], parts["delivered"], parts["lost"]) == (2, 0, 0, 1)
    assert [(one["change"], one["line"]) for one in parts["events"]] == [
        ("gripped", 23),
        ("dropped", found["diagnostics"][-1]["line"]),
    ]


HIGH = """MODULE high
  CONST robtarget pPick:=[[650,-300,520],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pDrop:=[[650,300,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    FOR n FROM 1 TO 3 DO
      MoveJ pPick,v1000,fine,tool0;
      SetDO doGrip,1;
      WaitTime 0.1;
      MoveL Offs(pPick,0,0,200),v1000,fine,tool0;
      MoveJ pDrop,v1000,fine,tool0;
      SetDO doGrip,0;   ! 300 mm above the pallet
      WaitTime 1;
    ENDFOR
  ENDPROC
ENDMODULE
"""
HIGH_CELL = """[robot]
model = "irb1600-6-1.2"
[signals]
doGrip = { type = "do" }
[[object]]
name = "pallet"
box = [300, 300, 40]
pose = { position = [650, 300, 300] }
[[object]]
name = "part"
box = [50, 50, 60]
pose = { position = [650, -300, 480] }
[[source]]
object = "part"
at = 0
every = 3
[[attach]]
when = "doGrip = 1"
object = "part*"
to = "tool"
"""


def test_several_faults_at_one_line_are_all_in_the_check(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text(HIGH_CELL)
    (tmp_path / "high.mod").write_text(HIGH)
    made = rapidsim.load(tmp_path / "high.mod")
    run = made.run()
    checked = [one for one in made.check().diagnostics if one.code[0] == "C"]
    expected = [("C101", 10), ("C105", 11), ("C107", 11), ("C107", 11)]
    assert [(one.code, one.line) for one in checked] == expected
    assert [one.message for one in checked] == [
        one.message for one in run.simulation.diagnostics if one.code[0] == "C"
    ]


def test_the_summary_names_the_crash_that_is_reported(tmp_path: Path) -> None:
    # The contact of the second part is that of a place that is taken, which is no crash.
    (tmp_path / "rapidsim.toml").write_text(HIGH_CELL)
    (tmp_path / "high.mod").write_text(HIGH.replace("Offs(pPick,0,0,200)", "Offs(pPick,0,0,20)"))
    ended = call("run", "high.mod", "--no-record", cwd=tmp_path)
    (crash,) = re.findall(r"collision: (`.*`) hits (`.*`) at ([0-9.]+) s", ended.out)
    assert f"once at {crash[2]} s at high.mod:" in ended.out
    assert f": {crash[0]} and {crash[1]}" in ended.out


WRONG = """
[[object]]
name = "part"
box = [50, 50, 80]

[[attach]]
when = "doGrip = 1"
object = "pert*"
to = "tool"

[[attach]]
when = "doGrip = 1"
object = "part"
to = "tool:griper"

[[attach]]
when = "doGrip = 1"
object = "part"
to = "world"

[[source]]
object = "part"

[[source]]
object = "port"
every = 2

[[sink]]
on = "bin"
"""


def test_mistakes_in_tables_of_parts_are_told_at_once(tmp_path: Path) -> None:
    (tmp_path / "rapidsim.toml").write_text(WRONG, encoding="utf-8")
    (tmp_path / "some.mod").write_text("MODULE some\nENDMODULE\n", encoding="utf-8")
    said = call("check", "some.mod", cwd=tmp_path)
    assert said.code == 2
    words = " ".join(said.err.split())
    for problem in (
        "there is no object `pert*`",
        "there is no object `griper`",
        "`world` is none of `tool`, `tool:NAME`",
        "give `at`, `every`, `times` or `when`",
        "there is no object `port`",
        "there is no object `bin`",
    ):
        assert problem in words, words


@pytest.mark.parametrize(
    ("first_s", "every_s", "end_s", "times"),
    [
        (0.5, 0.5, 2.0, [0.5, 1.0, 1.5, 2.0]),
        (0.5, 0.6, 2.0, [0.5, 1.1, 1.7]),
        (2.0, 0.5, 2.0, [2.0]),
        (2.1, 0.5, 2.0, []),
        (1.0, None, 2.0, [1.0]),
        (2.1, None, 2.0, []),
    ],
)
def test_copies_come_until_the_end_of_a_run(
    first_s: float, every_s: float | None, end_s: float, times: list[float]
) -> None:
    assert cell_bodies._series(first_s, every_s, end_s) == pytest.approx(times)


def test_motions_with_a_short_rest_between_them_are_one() -> None:
    rest_s = cell_bodies._STOPPING_S
    later = 3.0 + 2.0 * rest_s
    found = cell_bodies._merge_intervals([(later, 5.0), (1.0, 2.0), (0.0, 3.0), (5.0, 6.0)])
    assert found == ((0.0, 3.0), (later, 6.0))
    assert cell_bodies._merge_intervals([(0.0, 1.0), (1.0 + 0.5 * rest_s, 2.0)]) == ((0.0, 2.0),)
    most = cell_bodies._MOST_COPIES
    assert len(cell_bodies._series(0.0, 1e-6, 1e6)) == most + 1
