"""`rapidsim sweep`: findings of single checks, the same runs, tables, parts, wrong input."""

from __future__ import annotations

import csv
import json
from collections import Counter
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from command_line import call

from rapidsim.frames.transform import Transform
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import LoadedJob, loaded
from rapidsim.jobs.running.sweep import KEYS, axis_of, sweep
from rapidsim.reach.placements import reach_from
from rapidsim.reach.reach import check_reach
from rapidsim.simulation.options import RunOptions

PROGRAM = """MODULE parts
  PERS tooldata grip:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata table:=[FALSE,TRUE,"",[[100,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST extjoint none:=[9E9,9E9,9E9,9E9,9E9,9E9];
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,grip;
    MoveJ [[650,-250,450],[0,0,1,0],[-1,0,-1,0],none],v500,z10,grip\\WObj:=table;
    MoveJ [[750,250,500],[0,0,1,0],[0,0,0,0],none],v500,fine,grip\\WObj:=table;
    ConfL\\Off;
    MoveL [[750,250,450],[0,0,1,0],[0,0,0,0],none],v200,fine,grip\\WObj:=table;
    at [[700,0,400],[0,0.1,0.995,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    at [[500,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  ENDPROC
  PROC at(robtarget there)
    MoveJ there,v500,fine,grip;
  ENDPROC
ENDMODULE
"""
STATION = """[robot]
model = "irb1600-6-1.2"
base = { position = [10, 0, 0], quaternion = [1, 0, 0, 0] }
"""


@pytest.fixture
def cell(tmp_path: Path) -> Path:
    (tmp_path / "parts.mod").write_text(PROGRAM)
    (tmp_path / "rapidsim.toml").write_text(STATION)
    return tmp_path


def ready(cell: Path) -> LoadedJob:
    return loaded(job(RunRequest(paths=(str(cell),))))


def test_many_places_at_once_say_what_single_checks_say(cell: Path) -> None:
    made = ready(cell)
    program = made.tasks[0].program
    random = np.random.default_rng(7)
    places = Transform(np.tile(np.eye(3), (40, 1, 1)), random.uniform(-0.5, 0.5, (40, 3)))
    found = reach_from(program, made.robot, places)
    assert found.moves == 5
    for row in range(len(places)):
        options = RunOptions(world_from_base=places[row])
        report = check_reach(program, made.robot, options, run=False)
        count = Counter(one.code for one in report.diagnostics)
        assert found.unreachable[row] == count["K601"] + count["K602"]
        assert found.other_configuration[row] == count["K603"]
    assert 0 < (found.unreachable == 0).sum() < len(places)
    assert found.other_configuration.any()


def test_runs_are_those_of_each_place_however_many_processes(cell: Path) -> None:
    text = (cell / "parts.mod").read_text().replace("MoveJ there", "ConfJ\\Off;\n    MoveJ there")
    (cell / "parts.mod").write_text(
        text.replace("    MoveAbsJ", "    ConfJ\\Off;\n    MoveAbsJ", 1)
    )
    axes = [axis_of("base.x=-100:100:100"), axis_of("base.rz=-30:30:30")]
    one = sweep(ready(cell), axes)
    two = sweep(ready(cell), axes, processes=2)
    assert one.runs == two.runs
    assert np.array_equal(one.works, [run is not None for run in one.runs])
    assert one.works.any()
    row = int(np.flatnonzero(one.works)[0])
    x, rz = np.round(one.values[row], 9).tolist()
    half = np.radians(rz) / 2.0
    (cell / "rapidsim.toml").write_text(
        f'[robot]\nmodel = "irb1600-6-1.2"\nbase = {{ position = [{x}, 0, 0], '
        f"quaternion = [{np.cos(half)}, 0, 0, {np.sin(half)}] }}\n"
    )
    said = json.loads(call("run", cell, "--no-record", "--format", "json", cwd=cell).out)
    outcome = one.runs[row]
    assert outcome is not None
    assert said["end"] == outcome.end == "ended"
    assert said["time_s"] == pytest.approx(outcome.time_s, abs=1e-7)


def test_parts_make_the_whole(cell: Path, tmp_path: Path) -> None:
    vary = ("--vary", "base.x=-400:400:50", "--vary", "base.z=0:100:50", "--no-run")
    whole, rows = tmp_path / "whole.csv", []
    call("sweep", cell / "rapidsim.toml", *vary, "--out", whole, cwd=cell)
    for number in (1, 2, 3):
        part = tmp_path / f"part{number}.csv"
        call(
            "sweep",
            cell / "rapidsim.toml",
            *vary,
            "--shard",
            f"{number}/3",
            "--out",
            part,
            cwd=cell,
        )
        rows += list(csv.reader(part.read_text().splitlines()))[1:]
    expected = list(csv.reader(whole.read_text().splitlines()))
    assert sorted(rows, key=lambda row: int(row[0])) == expected[1:]
    assert expected[0] == [
        *("variant", "base.x", "base.z", "moves", "unreachable", "other_configuration"),
        *("margin_deg", "end", "time_s", "findings"),
    ]


def test_the_table_and_the_picture(cell: Path, tmp_path: Path) -> None:
    out, plots = tmp_path / "places.parquet", tmp_path / "pictures"
    said = call(
        *("sweep", cell / "rapidsim.toml", "--vary", "base.x=-400:2000:400", "--vary"),
        *("base.y=-100:100:100", "--no-run", "--out", out, "--plots", plots),
        cwd=cell,
    )
    assert said.code == 0
    table = pq.read_table(out).to_pydict()
    assert table["variant"] == list(range(21))
    assert table["unreachable"][-1] > 0
    assert sum(margin is not None for margin in table["margin_deg"]) == 7
    assert set(table["time_s"]) == {None}
    assert {one.name for one in plots.iterdir()} == {"sweep.png", "sweep-dark.png"}


@pytest.mark.parametrize(
    ("vary", "told"),
    {
        "base.w=1:2:1": "`base.w` cannot be varied",
        "base.x": "the values are FROM:TO:STEP",
        "base.x=1:2": "the values are FROM:TO:STEP",
        "base.x=nan:1:1": "the values are FROM:TO:STEP",
        "base.x=0:inf:1": "the values are FROM:TO:STEP",
        "base.x=0:1:0": "steps of 0 never get from 0 to 1",
        "base.x=0:1:-1": "steps of -1 never get from 0 to 1",
        "base.x=0:1e9:1e-3": "over 10000000 values",
        "base.x=0:1E308:1E-308": "over 10000000 values",
    }.items(),
)
def test_wrong_values_are_told(cell: Path, vary: str, told: str) -> None:
    said = call("sweep", cell / "rapidsim.toml", "--vary", vary, cwd=cell)
    assert said.code == 2
    assert told in said.err


def test_other_mistakes_are_told(cell: Path) -> None:
    twice = call("sweep", cell, "--vary", "base.x=1", "--vary", "base.x=2", cwd=cell)
    assert "a key is varied twice" in twice.err
    many = [f"--vary={key}=0:1000:1" for key in KEYS[:3]]
    assert "variants are over" in call("sweep", cell, *many, cwd=cell).err
    assert "1/4" in call("sweep", cell, "--vary", "base.x=1", "--shard", "5/4", cwd=cell).err
    (cell / "parts.mod").write_text(PROGRAM.replace("v200", "vFast"))
    assert "vFast" in call("sweep", cell, "--vary", "base.x=1", cwd=cell).out
    far = call("sweep", cell, "--vary", "base.x=1E30", cwd=cell)
    assert far.code == 1
