"""What a run says of a cell: first contact, clearance, carried parts, pairs that may touch."""

from __future__ import annotations

import re
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from collision_cells import ARM, TABLE, cell, codes, report
from command_line import call

import rapidsim
from rapidsim.api.schemas import json_schema
from rapidsim.collisions import along_motion
from rapidsim.collisions.geometry import CellGeometry
from rapidsim.colours import DARK
from rapidsim.controller.cell.watchdog import Watchdog
from rapidsim.plots import write
from rapidsim.simulation.dry_run import dry_run
from rapidsim.simulation.options import RunOptions

DOWN = "    MoveL Offs(over,0,0,{0}),v200,fine,tool0;"


def test_the_flange_hits_a_table_when_it_is_there(tmp_path: Path) -> None:
    cell(tmp_path, DOWN.format(-150), TABLE)
    found = report(tmp_path, 1)
    jsonschema.validate(found, json_schema("run"))
    assert codes(found) == ["C101"]
    first = found["collisions"][0]
    assert (first["first"], first["second"], first["line"]) == ("link 6", "`table`", 6)
    # The flange, and what stands out of its likeness by a little more than 1 mm, is the lowest of
    # the arm: it comes to the table's plane, and its rim is 30 mm deep at the end.
    assert first["tcp"]["position_mm"][2] == pytest.approx(501.0, abs=0.5)
    assert first["depth_mm"] == pytest.approx(30.0, abs=0.1)
    assert found["clearance_mm"] == 0.0
    assert found["end"] == "ended"


def test_a_move_that_stays_above_says_how_near_it_came(tmp_path: Path) -> None:
    cell(tmp_path, DOWN.format(-100), f"[collisions]\nclearance = 30\n{TABLE}")
    found = report(tmp_path, 0)
    assert codes(found) == ["C102"]
    assert found["clearance_mm"] == pytest.approx(19.0, abs=1.0)
    assert found["clearances"][0]["line"] == 6
    assert not found["collisions"]


def test_without_bodies_in_the_station_nothing_is_said(tmp_path: Path) -> None:
    cell(tmp_path, DOWN.format(-150), "")
    found = report(tmp_path, 0)
    assert "collisions" not in found
    assert "clearance_mm" not in found


def test_the_summary_says_what_happened_and_what_the_shapes_are_worth(tmp_path: Path) -> None:
    cell(tmp_path, DOWN.format(-150), TABLE)
    ended = call("run", "cell.mod", "--no-record", cwd=tmp_path)
    assert ended.code == 1
    assert "approximations" in ended.out
    cell(tmp_path, DOWN.format(-100), TABLE)
    ended = call("run", "cell.mod", "--no-record", cwd=tmp_path)
    assert ended.code == 0
    assert "none; closest 18.8 mm, link 6 and `table`" in " ".join(ended.out.split())


def test_a_report_lists_contacts_and_the_nearest_of_each_move(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The tests of `plots` draw all pictures, in both themes; a run without bodies has not this one.
    monkeypatch.setattr(write, "THEMES", (DARK,))
    monkeypatch.setattr(write, "PICTURES", {"clearance": write.PICTURES["clearance"]})
    cell(tmp_path, DOWN.format(-150), f"[collisions]\nclearance = 30\n{TABLE}")
    shown = ("--no-record", "--report", "run.html", "--plots", "plots")
    ended = call("run", "cell.mod", *shown, cwd=tmp_path)
    assert ended.code == 1
    assert (tmp_path / "plots/clearance-dark.png").is_file()
    page = (tmp_path / "run.html").read_text(encoding="utf-8")
    section = page.partition('<section id="collisions">')[2].partition("</section>")[0]
    assert "link 6 and <code>table</code>" in section
    assert "cell.mod:6 in main" in section
    assert "less than the 30 mm to keep" in section
    assert "approximations" in section
    # Nothing of it where the station says nothing of bodies.
    cell(tmp_path, DOWN.format(-150), "")
    assert call("run", "cell.mod", "--no-record", "--report", "run.html", cwd=tmp_path).code == 0
    assert 'id="collisions"' not in (tmp_path / "run.html").read_text(encoding="utf-8")


def test_the_search_ends_at_the_limit_on_the_clock(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It took minutes beyond `--max-wall` for slow moves among hundreds of bodies."""
    cell(tmp_path, DOWN.format(-150), TABLE)
    # The limit has passed when the first of the two moves has been searched.
    left = [10.0]
    monkeypatch.setattr(along_motion, "_BLOCK", 10)
    monkeypatch.setattr(Watchdog, "left_s", property(lambda _: left.pop() if left else 0.0))
    found = report(tmp_path, 3)
    assert found["end"] == "time_limit"
    (unsearched,) = found["not_judged"]
    assert re.fullmatch(r"all motion from 0\.\d+ s on", unsearched)
    said = {one["code"]: one["message"] for one in found["diagnostics"]}
    assert said == {
        "C103": f"not checked for collisions: {unsearched}",
        "R109": "the search for collisions was cut off after 0 s on the computer's clock",
    }
    left = [10.0]
    ended = call("run", "cell.mod", "--no-record", cwd=tmp_path)
    assert ended.code == 3
    assert f"not checked: {unsearched}" in " ".join(ended.out.split())
    assert re.search(r"up to 0\.\d+ s: none; closest \d+", " ".join(ended.out.split()))


def test_a_check_finds_what_a_run_hits(tmp_path: Path) -> None:
    cell(tmp_path, DOWN.format(-150), TABLE)
    ended = call("check", "cell.mod", cwd=tmp_path)
    assert ended.code == 1
    assert "C101" in ended.out


def test_pairs_that_may_touch_are_left_out_and_unknown_ones_told(tmp_path: Path) -> None:
    ignored = """
[collisions]
ignore = [
  { between = ["table", "robot"], reason = "it is soft" },
  { between = ["tabel", "robot"], reason = "a slip of the pen" },
]
"""
    cell(tmp_path, DOWN.format(-150), ignored + TABLE)
    found = report(tmp_path, 0)
    assert codes(found) == ["C103"]
    assert "`tabel`" in found["not_judged"][0]


def test_a_tool_has_a_body(tmp_path: Path) -> None:
    tool = """
[[object]]
name = "gripper"
cylinder = { diameter = 60, length = 100 }
pose = { position = [0, 0, 50] }
parent = "tool"
"""
    cell(tmp_path, DOWN.format(-80), tool + TABLE)
    found = report(tmp_path, 1)
    assert {one["first"] for one in found["collisions"]} == {"`gripper`"}
    # Its end is 100 mm below the flange.
    assert found["collisions"][0]["tcp"]["position_mm"][2] == pytest.approx(600.0, abs=0.03)


PART = """
[signals]
doGrip = { type = "do" }

[[object]]
name = "part"
box = [60, 60, 100]
pose = { position = [700, 0, 550] }

[[attach]]
when = "doGrip = 1"
object = "part"
to = "tool"

[[object]]
name = "gripper"
box = [40, 40, 20]
pose = { position = [0, 0, 10] }
parent = "tool"
"""
GRIP = """    SetDO doGrip,1;
    WaitTime 0.1;
    MoveL Offs(over,0,200,0),v200,fine,tool0;
    SetDO doGrip,0;
    WaitTime 0.1;
    MoveL Offs(over,0,200,60),v200,fine,tool0;
    MoveL Offs(over,0,0,60),v200,fine,tool0;
"""
WALL = """
[[object]]
name = "wall"
box = [400, 10, 40]
pose = { position = [700, 100, 530] }
"""


def test_a_part_is_carried_and_hits_what_is_in_its_way(tmp_path: Path) -> None:
    cell(tmp_path, GRIP, PART + WALL + TABLE)
    found = report(tmp_path, 1)
    assert codes(found) == ["C101"]
    (hit,) = found["collisions"]
    assert {hit["first"], hit["second"]} == {"`part`", "`wall`"}
    # The part's edge is 30 mm before its middle, the wall's 5 mm before its own.
    assert hit["tcp"]["position_mm"][1] == pytest.approx(65.0, abs=0.05)


def test_a_part_that_lies_on_a_table_and_is_put_on_another_touches_nothing(tmp_path: Path) -> None:
    cell(tmp_path, GRIP, f"{PART}{TABLE}")
    found = report(tmp_path, 0)
    assert not codes(found)


def test_an_object_follows_its_work_object(tmp_path: Path) -> None:
    station = '[[object]]\nname = "vice"\nbox = [100, 100, 100]\nparent = "wobj:wVice"\n'
    head = """MODULE cell
  PERS wobjdata wVice:=[FALSE,TRUE,"",[[700,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget over:=[[0,0,320],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ over,v500,fine,tool0\\WObj:=wVice;
"""
    moves = "    MoveL Offs(over,0,0,{0}),v200,fine,tool0\\WObj:=wVice;"
    cell(tmp_path, moves.format(-260), station, head)
    assert report(tmp_path, 0)["clearance_mm"] == pytest.approx(9.0, abs=1.0)
    cell(tmp_path, moves.format(-275), station, head)
    assert "C101" in codes(report(tmp_path, 1))


def test_two_robots_hit_each_other(tmp_path: Path) -> None:
    station = """
[collisions]

[[robot]]
name = "left"
model = "irb1600-6-1.2"

[[robot]]
name = "right"
model = "irb1600-6-1.2"
base = { position = [1400, 0, 0], quaternion = [0, 0, 0, 1] }

[[task]]
name = "T_LEFT"
robot = "left"
modules = ["left.mod"]

[[task]]
name = "T_RIGHT"
robot = "right"
modules = ["right.mod"]
"""
    moves = "    WaitTime 0.1;\n    MoveJ Offs(over,0,{0},0),v500,fine,tool0;"
    file = cell(tmp_path, moves.format(0), station)
    (tmp_path / "rapidsim.toml").write_text(station.replace(ARM, ""), encoding="utf-8")
    file.rename(tmp_path / "left.mod")
    right = (tmp_path / "left.mod").read_text(encoding="utf-8").replace("cell", "other")
    (tmp_path / "right.mod").write_text(right, encoding="utf-8")
    ended = call("run", "left.mod", "--no-record", "--format", "json", cwd=tmp_path)
    assert ended.code == 1, ended
    assert "of T_LEFT" in ended.out
    assert "of T_RIGHT" in ended.out


def test_a_contact_ends_the_run_where_the_station_says_so(tmp_path: Path) -> None:
    moves = f'{DOWN.format(-150)}\n    TPWrite "over";'
    station = f"[collisions]\nstop-on-collision = true\n{TABLE}"
    cell(tmp_path, moves, TABLE)
    goes_on = report(tmp_path, 1)
    cell(tmp_path, moves, station)
    stops = report(tmp_path, 1)
    assert goes_on["end"] == "ended"
    assert [one["message"] for one in goes_on["events"]] == ["over"]
    assert stops["end"] == "error"
    assert stops["time_s"] == goes_on["collisions"][0]["time_s"]
    assert stops["diagnostics"][0]["message"].endswith("deep when the arm has braked")
    assert not stops["events"]
    assert codes(stops) == ["C101"]


def test_the_dry_run_measures_no_depths() -> None:
    options = RunOptions(geometry=CellGeometry(stops=True))
    with dry_run(options) as (rehearsal, again):
        assert again.geometry is not None
        assert again.geometry.has_depths
        assert rehearsal.geometry is not None
        assert not rehearsal.geometry.has_depths


AT_REST = """
[collisions]
clearance = 100

[[object]]
name = "carriage"
box = [300, 60, 60]
pose = { position = [300, 0, 100] }
parent = "unit:TABLE"

[[object]]
name = "post"
box = [40, 40, 400]
pose = { position = [700, 340, 500] }
"""


def test_only_bodies_that_move_against_each_other_come_near(tmp_path: Path) -> None:
    """The table turns its arm beside a post and stays there while the robot moves."""
    station = POSITIONER.partition("[[object]]")[0] + AT_REST
    moves = """    MoveExtJ [[9E9,9E9,9E9,9E9,9E9,9E9],[9E9,70,9E9,9E9,9E9,9E9]],vrot50,fine;
    MoveL [[0,0,560],[0,0,1,0],[0,0,0,0],[9E9,70,9E9,9E9,9E9,9E9]],v500,fine,tool0\\WObj:=turned;"""
    head = TURNED.rpartition("    MoveExtJ")[0]
    cell(tmp_path, moves.replace("\\\\", "\\"), station, head)
    found = report(tmp_path, 0)
    near = [one for one in found["clearances"] if one["second"] == "`post`"]
    assert {one["line"] for one in near if one["first"] == "`carriage`"} == {6}


POSITIONER = """
[[external_axis]]
name = "TABLE"
axis = "b"
kind = "rotational"
limits = [-180, 180]
speed = 90
acceleration = 360
carries = "wobj"
frame = { position = [700, 0, 400] }

[[object]]
name = "arm of the table"
box = [300, 60, 60]
pose = { position = [300, 0, 100] }
parent = "%s"
"""
POST = """
[collisions]
ignore = [
  { between = ["robot", "post"], reason = "of the arm no test asks" },
  { between = ["robot", "arm of the table"], reason = "of the arm no test asks" },
]
[[object]]
name = "post"
box = [40, 40, 400]
pose = { position = [340, 0, 500] }
"""
TURNED = r"""MODULE cell
  PERS wobjdata turned:=[FALSE,FALSE,"TABLE",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PROC main()
    ConfJ \Off;
    MoveJ [[0,0,500],[0,0,1,0],[0,0,0,0],[9E9,0,9E9,9E9,9E9,9E9]],v500,fine,tool0\WObj:=turned;
    MoveExtJ [[9E9,9E9,9E9,9E9,9E9,9E9],[9E9,-179,9E9,9E9,9E9,9E9]],vrot50,fine;
"""


@pytest.mark.parametrize("parent", ["unit:TABLE", "unit:TABLE:1", "wobj:turned"])
def test_what_a_positioner_carries_turns_with_it(parent: str, tmp_path: Path) -> None:
    """Its end, 450 mm from the axis, is turned half around to a post 360 mm from the axis."""
    cell(tmp_path, "", POSITIONER % parent + POST, TURNED)
    found = report(tmp_path, 1)
    first = found["collisions"][0]
    assert {first["first"], first["second"]} == {"`arm of the table`", "`post`"}
    assert not found.get("not_judged")
    # Its side comes round to the near corner of the post.
    assert first["point_mm"][:2] == pytest.approx([360.0, -20.0], abs=0.1)


def test_a_part_that_stands_on_what_turns_turns_with_it(tmp_path: Path) -> None:
    station = POSITIONER.partition("[[object]]")[0] + PART.replace("700, 0, 550", "950, 0, 580")
    carrier = POSITIONER[POSITIONER.index("[[object]]") :] % "unit:TABLE"
    file = cell(tmp_path, "", station + carrier, TURNED.replace("-179", "90"))
    collisions = rapidsim.load(file).run().simulation.collisions
    assert collisions is not None
    (part,) = collisions.parts
    place = collisions.scene.poses(np.array([0.0, 60.0])).of(part).translation
    np.testing.assert_allclose(place, [[0.95, 0.0, 0.58], [0.7, 0.25, 0.58]], atol=1e-6)


FIXTURE = """
[[object]]
name = "fixture"
box = [60, 60, 60]
pose = { position = [300, 0, 155] }
parent = "unit:TABLE"
"""


def test_what_stands_on_what_a_positioner_carries_is_not_judged_against_it(tmp_path: Path) -> None:
    alone = POSITIONER % "unit:TABLE:1" + POST.partition("[[object]]")[0]
    cell(tmp_path, "", alone.replace('"post"', '"fixture"') + FIXTURE, TURNED)
    assert not report(tmp_path, 0)["collisions"]


def test_a_positioner_that_is_not_there_is_told(tmp_path: Path) -> None:
    cell(tmp_path, DOWN.format(-10), TABLE + 'parent = "unit:TABLES:1"')
    found = report(tmp_path, 0)
    assert "no positioner of the run has axis 1 of `TABLES`" in found["not_judged"][0]
