"""Several tasks from the command line: station files, backups, traces, JSON."""

import csv
import json
from pathlib import Path

import pytest
from cli_helper import Ended, rapidsim

from rapidsim.files import InputError
from rapidsim.jobs.running.run_files import simulate
from rapidsim.station.read import read_station
from rapidsim.station.task_kind import TaskKind

AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
STATION = """
[[robot]]
name = "left"
model = "irb1600"
[[robot]]
name = "right"
model = "irb120"
base = { position = [1500, 0, 0], quaternion = [0, 0, 0, 1] }
[[task]]
name = "T_LEFT"
modules = ["left.mod"]
robot = "left"
[[task]]
name = "T_RIGHT"
modules = ["right.mod"]
robot = "right"
[[task]]
name = "T_BACK"
type = "semistatic"
modules = ["back.mod"]
"""


def module(name: str, *statements: str) -> str:
    lines = "\n".join(f"    {one}" for one in statements)
    return f"MODULE {name}\n  PROC main()\n{lines}\n  ENDPROC\nENDMODULE\n"


def turn(degrees: float) -> str:
    return f"MoveAbsJ [[{degrees},0,0,0,30,0],{AXES}],v100,fine,tool0;"


@pytest.fixture
def cell(tmp_path: Path) -> Path:
    (tmp_path / "rapidsim.toml").write_text(STATION)
    (tmp_path / "left.mod").write_text(module("left", turn(20), "SetDO go,1;"))
    (tmp_path / "right.mod").write_text(module("right", "WaitDO go,1;", turn(10), turn(0)))
    (tmp_path / "back.mod").write_text(module("back", "WaitTime 0.5;", 'TPWrite "alive";'))
    return tmp_path


def run(folder: Path, *arguments: str) -> Ended:
    return rapidsim("run", ".", "--no-record", *arguments, cwd=folder)


def test_each_task_moves_its_robot_and_json_says_which(cell: Path) -> None:
    ended = run(cell, "--format", "json")
    report = json.loads(ended.out)
    assert (ended.code, report["end"]) == (0, "ended")
    assert [(one["task"], one["robot"]) for one in report["robots"]] == [
        ("T_LEFT", "irb1600-6-1.2"),
        ("T_RIGHT", "irb120-3-0.58"),
    ]
    assert report["robots"][1]["position_mm"] == [1500.0, 0.0, 0.0]
    assert [(move["index"], move["task"]) for move in report["moves"]] == [
        (0, "T_LEFT"),
        (1, "T_RIGHT"),
        (2, "T_RIGHT"),
    ]
    assert report["moves"][1]["start_s"] == pytest.approx(report["moves"][0]["end_s"], abs=1e-3)
    assert {event["task"] for event in report["events"]} == {"T_LEFT", "T_BACK"}


def test_the_trace_has_a_row_for_each_robot_and_instant(cell: Path) -> None:
    run(cell, "--trace", "t.csv", "--dt", "0.1")
    with (cell / "t.csv").open() as file:
        rows = list(csv.DictReader(file))
    left = [row for row in rows if row["task"] == "T_LEFT"]
    right = [row for row in rows if row["task"] == "T_RIGHT"]
    assert [row["time_s"] for row in left] == [row["time_s"] for row in right]
    assert (left[-1]["move"], right[-1]["move"]) == ("0", "2")
    assert float(left[-1]["j1"]) == pytest.approx(20.0)
    assert float(right[0]["j5"]) == pytest.approx(30.0)


def test_the_summary_names_every_robot(cell: Path) -> None:
    out = run(cell).out
    assert "irb120-3-0.58 of T_RIGHT" in out
    assert "3 (3 MoveAbsJ)" in out


def test_tasks_without_a_robot_have_a_table_of_their_own(cell: Path) -> None:
    (cell / "back.mod").write_text(module("back", "WaitTime 0.25;", "WaitTime 0.75;"))
    table = rapidsim("run", "left.mod", "--no-record", cwd=cell).out.partition("slowest lines")[2]
    with_robot, _, without = table.partition("without a robot")
    assert "back.mod" not in with_robot
    assert [line.split()[0] for line in without.splitlines() if "WaitTime" in line] == [
        "back.mod:4",
        "back.mod:3",
    ]


def test_one_task_of_several_can_run_alone(cell: Path) -> None:
    report = json.loads(run(cell, "--task", "t_left", "--format", "json").out)
    assert [move["task"] for move in report["moves"]] == ["T_LEFT"]
    assert "robots" not in report
    ended = run(cell, "--task", "T_LEFTT")
    assert (ended.code, "did you mean `T_LEFT`?" in ended.err) == (2, True)


def test_check_looks_at_all_tasks(cell: Path) -> None:
    (cell / "right.mod").write_text(module("right", "x:=1;"))
    ended = rapidsim("check", ".", "--output-format", "concise", cwd=cell)
    assert "right.mod:3" in ended.out
    assert ended.code == 1


def test_the_tasks_of_a_backup_are_tasks_and_those_with_moves_have_a_robot(tmp_path: Path) -> None:
    for number, body in enumerate(((turn(20),), ("WaitTime 1;",), (turn(10),)), start=1):
        folder = tmp_path / "RAPID" / f"TASK{number}" / "PROGMOD"
        folder.mkdir(parents=True)
        (folder / f"m{number}.mod").write_text(module(f"m{number}", *body))
    it = simulate([tmp_path], robot="irb1600")
    assert [(one.task, len(one.moves)) for one in it.robots] == [("T_ROB1", 1), ("T_ROB3", 1)]
    report = json.loads(run(tmp_path, "--format", "json").out)
    assert [move["task"] for move in report["moves"]] == ["T_ROB1", "T_ROB3"]


def test_a_backup_without_moves_runs(tmp_path: Path) -> None:
    for number in (1, 2):
        folder = tmp_path / "RAPID" / f"TASK{number}"
        folder.mkdir(parents=True)
        (folder / "m.mod").write_text(module(f"m{number}", "WaitTime 1;", 'TPWrite "done";'))
    ended = run(tmp_path, "--format", "json")
    assert ended.code == 0, ended.err
    assert [event["task"] for event in json.loads(ended.out)["events"]] == ["T_ROB1", "T_ROB2"]


def test_tasks_take_the_robots_they_name_and_then_those_that_are_left(tmp_path: Path) -> None:
    file = tmp_path / "rapidsim.toml"
    file.write_text(
        '[[robot]]\nname = "a"\n[[robot]]\nname = "b"\n[[task]]\nname = "T1"\n'
        '[[task]]\nname = "T2"\nrobot = "A"\n[[task]]\nname = "T3"\ntype = "static"\n'
    )
    tasks = read_station(file).tasks
    assert [task.robot_number for task in tasks] == [1, 0, None]
    assert tasks[2].kind is TaskKind.STATIC


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[[task]]\n[[task]]", "there are two tasks T_ROB1"),
        ('[[task]]\nrobot = "x"', "there is no [[robot]] `x`"),
        ('[[task]]\nname = "A"\n[[task]]\nname = "B"\nmotion = true', "no robot is left"),
        ('[[robot]]\nname = "a"\n[[robot]]\nname = "A"', "two robots have one name"),
        ('[[task]]\ntype = "dynamic"', "`dynamic` is not a type"),
        ('[[robot]]\nname = "a"\n[[task]]\nrobot = "a"\nmotion = false', "has no robot"),
    ],
)
def test_what_a_station_says_wrong_of_tasks_is_refused(
    text: str, message: str, tmp_path: Path
) -> None:
    file = tmp_path / "rapidsim.toml"
    file.write_text(text)
    with pytest.raises(InputError) as caught:
        read_station(file)
    assert message in caught.value.message


@pytest.mark.parametrize("task", ["", '[[task]]\nname = "T_BACK"\nmodules = ["cell/back.mod"]\n'])
def test_modules_may_lie_where_only_the_station_file_says(tmp_path: Path, task: str) -> None:
    below = tmp_path / "cell"
    below.mkdir()
    (below / "left.mod").write_text(module("left", 'TPWrite "here";'))
    (below / "back.mod").write_text(module("back", 'TPWrite "there";'))
    listing = '[[task]]\nmodules = ["cell/left.mod"]\n' + task
    (tmp_path / "rapidsim.toml").write_text(listing)
    ended = run(tmp_path)
    assert (ended.code, "here" in ended.out) == (0, True)
    # What the station file does not list is in no task.
    (tmp_path / "rapidsim.toml").write_text("")
    ended = run(tmp_path)
    assert (ended.code, "there are some in cell" in ended.err) == (2, True)


def test_a_task_without_modules_is_refused(cell: Path) -> None:
    text = STATION.replace('modules = ["back.mod"]\n', "")
    (cell / "rapidsim.toml").write_text(text)
    ended = run(cell)
    assert (ended.code, "T_BACK has no module" in ended.err) == (2, True)


def test_a_backup_says_what_its_tasks_are(tmp_path: Path) -> None:
    bodies = {1: ("WaitTime 1;",), 2: (turn(20),), 3: ('TPWrite "alive";', "WaitTime 9;")}
    for number, body in bodies.items():
        folder = tmp_path / "RAPID" / f"TASK{number}" / "PROGMOD"
        folder.mkdir(parents=True)
        (folder / f"m{number}.mod").write_text(module(f"m{number}", *body))
    shared = tmp_path / "RAPID" / "TASK0" / "SYSMOD"
    shared.mkdir(parents=True)
    (shared / "base.sys").write_text("no RAPID at all")
    (tmp_path / "BACKINFO").mkdir()
    (tmp_path / "BACKINFO" / "backinfo.txt").write_text(
        ">>SYSTEM_ID:\nCell\n\n>>TASK0: (,,)\n>>TASK1: (T_MAIN,,)\n>>TASK2: (T_ROB1,Prog,)\n"
        ">>TASK3: (T_WATCH,,)\nPROGMOD/m3.mod @\n\n>>EOF:\n"
    )
    (tmp_path / "SYSPAR").mkdir()
    (tmp_path / "SYSPAR" / "SYS.cfg").write_text(
        'SYS:CFG_1.0:6:0::\n#\nCAB_TASKS:\n\n      -Name "T_ROB1" -Type "NORMAL" \\\n'
        '      -MotionTask\n\n      -Name "T_MAIN" -Type "NORMAL"\n\n      -Name "T_WATCH"\n#\n'
    )
    report = json.loads(run(tmp_path, "--format", "json").out)
    assert [move["task"] for move in report["moves"]] == ["T_ROB1"]
    assert [event["task"] for event in report["events"]] == ["T_WATCH"]
    assert report["time_s"] == pytest.approx(report["moves"][0]["end_s"], abs=0.01)
    assert [one.task for one in simulate([tmp_path], robot="irb1600").robots] == ["T_ROB1"]


def test_tasks_call_each_other_as_deep_from_any_caller(cell: Path) -> None:
    # Each clause takes some calls, so a stack that is deeper by fifty ends some ticks earlier.
    (cell / "left.mod").write_text(
        "MODULE left\n  PROC main()\n    again;\n  ENDPROC\n"
        "  PROC again()\n    RAISE 1;\n  ERROR\n    again;\n  ENDPROC\nENDMODULE\n"
    )

    def time_of_overflow(calls: int) -> object:
        if calls:
            return time_of_overflow(calls - 1)
        ended = rapidsim("run", ".", "--no-record", "--format", "json", cwd=cell)
        found = json.loads(ended.out)
        assert "the stack overflowed in again" in str(found["diagnostics"])
        return found["time_s"]

    def from_c(calls: int) -> object:
        # Python counts a call by C, such as that of `eval`, which is no frame.
        names = {"from_c": from_c, "calls": calls}
        return eval("from_c(calls - 1)", names) if calls else time_of_overflow(0)

    assert time_of_overflow(0) == time_of_overflow(50) == from_c(20)
