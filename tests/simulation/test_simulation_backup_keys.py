"""A station file says some keys, and all others have the values of the backup."""

import json
from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest
from command_line import call

from rapidsim.controller.cell.description import SignalKind, Status, SystemAction
from rapidsim.controller.cell.message_queues import QueueMode, QueueSettings, QueueType
from rapidsim.frames.transform import Transform
from rapidsim.json_records.declarations import record_fields
from rapidsim.language.robotware import RobotWare
from rapidsim.module_files import backup_among
from rapidsim.station.backup.backup import backup_station
from rapidsim.station.controller import ControllerTable
from rapidsim.station.external_axes import AxisTable
from rapidsim.station.read import read_station
from rapidsim.station.robot import RobotTable
from rapidsim.station.signals import SignalEntry
from rapidsim.station.station import Station
from rapidsim.station.task_kind import TaskEvent, TaskKind
from rapidsim.station.tasks import TaskTable

MOVE = "MoveJ [[500,0,600],[0,0,1,0],[0,0,0,0],[9E9,0,9E9,9E9,9E9,9E9]],v100,fine,tool0;"
BACKUP = {
    "BACKINFO/backinfo.txt": ">>PRODUCTS_ID:\nRobotWare Version: 6.08.01\n"
    ">>TASK1: (T_ROB1,,)\nPROGMOD/left.mod @ \n"
    ">>TASK2: (T_ROB2,,)\nPROGMOD/right.mod @ \n"
    ">>TASK3: (T_BACK,,)\nPROGMOD/back.mod @ \n",
    "RAPID/TASK1/PROGMOD/left.mod": f"MODULE left\n PROC main()\n  Set doGrip;\n  {MOVE}\n"
    "  Set doUnknown;\n  WaitDI diPart,1;\n ENDPROC\nENDMODULE\n",
    "RAPID/TASK2/PROGMOD/right.mod": "MODULE right\n PROC go()\n ENDPROC\nENDMODULE\n",
    "RAPID/TASK3/PROGMOD/back.mod": "MODULE back\n PROC watch()\n ENDPROC\nENDMODULE\n",
    "SYSPAR/SYS.cfg": """CAB_TASKS:
      -Name "T_ROB1" -Type "NORMAL" -MotionTask -UseMechanicalUnitGroup "first"
      -Name "T_ROB2" -Type "NORMAL" -Entry "go" -MotionTask -UseMechanicalUnitGroup "second"
      -Name "T_BACK" -Type "STATIC" -Entry "watch" -BindRef 0 -RMQType "Remote"\\
      -RMQMode "Synchronous" -RMQMaxMsgSize 500 -RMQMaxNoOfMsg 7
#
CAB_EXEC_HOOKS:
      -Routine "second" -Shelf "STOP" -Task "T_BACK" -SeqNo 2
      -Routine "first" -Shelf "QSTOP" -AllTask -SeqNo 1
      -Routine "never" -Shelf "POWER_ON" -Task "T_BACK"
      -Routine "other" -Shelf "STOP" -Task "T_ROB1"
#
MECHANICAL_UNIT_GROUP:
      -Name "first" -Robot "ROB_1" -MechanicalUnit_1 "TRACK_1"
      -Name "second" -Robot "ROB_2"
""",
    "SYSPAR/EIO.cfg": """EIO_SIGNAL:
      -Name "doGrip" -SignalType "DO" -Default 1
      -Name "goJob" -SignalType "GO" -Size 5
      -Name "aoFlow" -SignalType "AO" -MinLog -2.5 -MaxLog 10
      -Name "doMoves" -SignalType "DO"
      -Name "diPart" -SignalType "DI"
      -Name "diStart" -SignalType "DI"
#
EIO_CROSS:
      -Name "c" -Res "diPart" -Act1 "doGrip" -Act1_invert
#
SYSSIG_OUT:
      -Status "MechUnitNotMoving" -Signal "doMoves" -Arg3 "ROB_2" -Arg2 "T_ROB2"
#
SYSSIG_IN:
      -Signal "diStart" -Action "Start" -Arg1 "CYCLE"
""",
    "SYSPAR/MOC.cfg": """ROBOT:
      -name "ROB_1" -use_robot_type "ROB1_1200_0.9_5" -use_joint_0 "r1_1" -use_joint_1 "r1_2"\\
      -use_joint_2 "r1_3" -use_joint_3 "r1_4" -use_joint_4 "r1_5" -use_joint_5 "r1_6"\\
      -base_frame_pos_x 0.5 -base_frame_orient_u0 0 -base_frame_orient_u3 1
      -name "ROB_2" -use_robot_type "ROB1_120_0.58_3" -base_frame_pos_y 1
#
ARM:
      -name "r1_1" -lower_joint_bound -1 -upper_joint_bound 1
      -name "r1_2" -lower_joint_bound -1 -upper_joint_bound 1
      -name "r1_3" -lower_joint_bound -1 -upper_joint_bound 1
      -name "r1_4" -lower_joint_bound -1 -upper_joint_bound 1
      -name "r1_5" -lower_joint_bound -1 -upper_joint_bound 1
      -name "r1_6" -lower_joint_bound -1 -upper_joint_bound 1
      -name "track" -use_acc_data "track" -lower_joint_bound 0 -upper_joint_bound 4
#
MECHANICAL_UNIT:
      -name "TRACK_1" -use_single_0 "track" -activate_at_start_up
#
SINGLE:
      -name "track" -use_single_type "t" -use_joint "track" -base_frame_pos_z 0.25
#
SINGLE_TYPE:
      -name "t" -mechanics "FREE_ROT"
#
JOINT:
      -name "track" -logical_axis 8 -use_arm "track" -use_transmission "track"
#
TRANSMISSION:
      -name "track" -transm_joint 100
#
STRESS_DUTY_CYCLE:
      -name "track" -speed_absolute_max 300
#
ACC_DATA:
      -name "track" -nom_acc 2.5 -wc_acc 2.5
""",
}


def backup(folder: Path, files: Mapping[str, str] = BACKUP) -> Station:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    found = backup_among([str(folder)])
    assert found is not None
    return backup_station(found)


SAID: dict[str, dict[str, tuple[str, dict[str, object]]]] = {
    "robot": {
        "model": ('model = "irb1200-5-0.9"', {"name": "irb1200-5-0.9"}),
        "urdf": ('urdf = "my.urdf"', {"bounds": ()}),
        "scale": ('urdf = "my.urdf"\nscale = 0.5', {"bounds": (), "scale": 0.5}),
        "base": (
            "base = { position = [1000, 0, 0] }",
            {"world_from_base": Transform(np.eye(3), np.array([1.0, 0.0, 0.0]))},
        ),
        "start": (
            "start = [0, 0, 0, 0, 30, 0]",
            {"start_joints_deg": (0.0, 0.0, 0.0, 0.0, 30.0, 0.0)},
        ),
        "shapes": ('shapes = "meshes"', {}),
        "shapes-unit": ('shapes = "meshes"\nshapes-unit = "inch"', {"shapes_unit_m": 0.0254}),
        "shapes-frame": ('shapes = "meshes"\nshapes-frame = "base"', {"shapes_in_base": True}),
    },
    "external_axis": {
        "name": ('name = "track_1"', {"unit": "track_1"}),
        "axis": ('name = "TRACK_1"\naxis = "b"', {}),
        "kind": ('name = "TRACK_1"\nkind = "rotational"', {}),
        "limits": (
            'name = "TRACK_1"\nlimits = [-180, 90]',
            {"lower": -np.pi, "upper": np.pi / 2},
        ),
        "speed": ('name = "TRACK_1"\nspeed = 90', {"max_speed": np.pi / 2}),
        "acceleration": ('name = "TRACK_1"\nacceleration = 180', {"max_acceleration": np.pi}),
        "start": ('name = "TRACK_1"\nstart = 45', {"start": np.pi / 4}),
        "carries": ('name = "TRACK_1"\ncarries = "robot"', {"carries": "robot"}),
        "direction": ('name = "TRACK_1"\ndirection = [0, 1, 0]', {"direction": (0.0, 1.0, 0.0)}),
        "frame": (
            'name = "TRACK_1"\nframe = { position = [0, 2000, 0] }',
            {"world_from_user": Transform(np.eye(3), np.array([0.0, 2.0, 0.0]))},
        ),
    },
    "task": {
        "name": ('name = "t_back"', {"name": "t_back"}),
        "modules": ('name = "T_BACK"\nmodules = ["more.mod"]', {}),
        "type": ('name = "T_BACK"\ntype = "semistatic"', {"kind": TaskKind.SEMISTATIC}),
        "motion": ('name = "T_BACK"\nmotion = false', {}),
        "robot": (
            'name = "T_BACK"\nrobot = "ROB_2"',
            {"robot": "ROB_2", "robot_number": 1, "motion": True},
        ),
        "entry": ('name = "T_BACK"\nentry = "look"', {"entry": "look"}),
        "events": (
            'name = "T_BACK"\nevents = { START = "look" }',
            {"events": ((TaskEvent.START, "look"),)},
        ),
        "check_references": (
            'name = "T_BACK"\ncheck_references = true',
            {"refers_late": False},
        ),
    },
    "rmq": {
        "type": ('type = "internal"', {"type": QueueType.INTERNAL}),
        "mode": ('mode = "interrupt"', {"mode": QueueMode.INTERRUPT}),
        "size": ("size = 420", {"max_bytes": 420}),
        "messages": ("messages = 3", {"max_messages": 3}),
    },
}
SIGNALS: dict[str, tuple[str, str, dict[str, object]]] = {
    "type": ("doGrip", 'type = "di"', {"kind": SignalKind.DI, "value": 0.0}),
    "value": ("doGrip", "value = 0", {"value": 0.0}),
    "width": ("goJob", "width = 3", {"highest": 7.0}),
    "min": ("aoFlow", "min = -1", {"lowest": -1.0}),
    "max": ("aoFlow", "max = 5", {"highest": 5.0}),
    "system": ("doMoves", 'system = "MechUnitActive"', {"status": Status.UNIT_ACTIVE}),
    "task": ("doMoves", 'task = "T_ROB1"', {"task": "T_ROB1"}),
    "unit": ("doMoves", 'unit = "ROB_1"', {"unit": "ROB_1"}),
    "action": ("diStart", 'action = "Stop"', {"action": SystemAction.STOP, "cycle": ""}),
}


def assert_differs(old: object, new: object, said: Mapping[str, object], besides: str = "") -> None:
    """The fields that a key says have its value, all others that of the backup."""
    assert type(old) is type(new)
    for one in fields(old):  # type: ignore[arg-type]
        value = getattr(new, one.name)
        expected = said.get(one.name, getattr(old, one.name))
        if one.name in besides.split():
            continue
        assert _is_close(value, expected), one.name


def _is_close(value: object, expected: object) -> bool:
    if isinstance(expected, Transform):
        assert isinstance(value, Transform)
        return np.allclose(value.matrix, expected.matrix)
    if isinstance(expected, float | tuple) and not isinstance(value, bool):
        return value == expected or np.allclose(value, expected)  # type: ignore[arg-type]
    return value == expected


def with_file(folder: Path, text: str) -> tuple[Station, Station]:
    """A backup, and its station file completed from it."""
    old = backup(folder)
    (folder / "meshes").mkdir()
    (folder / "rapidsim.toml").write_text(text)
    return old, read_station(folder / "rapidsim.toml", old)


def test_the_backup_says_something_of_every_part(tmp_path: Path) -> None:
    said = backup(tmp_path)
    assert [one.name for one in said.robots] == ["irb1200-5-0.9", "irb120-3-0.58"]
    assert [one.name for one in said.tasks] == ["T_ROB1", "T_ROB2", "T_BACK"]
    assert [one.robot_number for one in said.tasks] == [0, 1, None]
    assert [axis.unit for axis in said.external_axes] == ["TRACK_1"]
    assert said.robotware == RobotWare(6, 8)
    assert said.tasks[2].queue is not None
    assert said.tasks[2].refers_late
    assert said.tasks[2].events == ((TaskEvent.QUICK_STOP, "first"), (TaskEvent.STOP, "second"))
    start = said.io.signals[-1]
    assert (start.action, start.cycle) == (SystemAction.START, "CYCLE")


def test_every_key_is_tried() -> None:
    def keys(kind: type) -> set[str]:
        return {one.key for one in record_fields(kind)}

    assert {*SAID["robot"], "name"} == keys(RobotTable)
    assert set(SAID["external_axis"]) == keys(AxisTable)
    assert {*SAID["task"], "rmq"} == keys(TaskTable)
    assert set(SAID["rmq"]) == keys(QueueSettings)
    assert set(SIGNALS) == keys(SignalEntry)
    assert {"robotware", "stubs"} <= keys(ControllerTable)


@pytest.mark.parametrize("key", SAID["robot"])
def test_a_key_of_the_robot_leaves_the_others(key: str, tmp_path: Path) -> None:
    text, said = SAID["robot"][key]
    old, new = with_file(tmp_path, f"[robot]\n{text}\n")
    besides = {"urdf": "name", "scale": "name", "shapes": "shapes"}.get(key.partition("-")[0], "")
    assert_differs(old.robots[0], new.robots[0], said, besides)
    assert new.robots[1:] == old.robots[1:]
    assert_differs(old, new, {}, "file check robots robot_source remarks")
    assert (new.robot_source == old.robot_source) == (key not in ("urdf", "scale"))
    about = [one for one in new.remarks if one not in old.remarks]
    assert [one.partition(", not of ")[0] for one in about] == (
        ["joint limits of the backup are those of irb1200-5-0.9"]
        if key in ("urdf", "scale")
        else []
    )


def test_robots_are_found_by_name_and_then_by_place(tmp_path: Path) -> None:
    start = "start = [0, 0, 0, 0, 45, 0]"
    text = f'[[robot]]\nname = "rob_2"\n{start}\n[[robot]]\nmodel = "irb1600"\n'
    old, new = with_file(tmp_path, text)
    assert [one.name for one in new.robots] == ["irb1600", "irb120-3-0.58"]
    assert new.robots[1].start_joints_deg == (0.0, 0.0, 0.0, 0.0, 45.0, 0.0)
    assert (new.robots[0].bounds, len(old.robots[0].bounds)) == ((), 6)
    assert new.robots[0].world_from_base == old.robots[0].world_from_base


@pytest.mark.parametrize("key", SAID["external_axis"])
def test_a_key_of_an_external_axis_leaves_the_others(key: str, tmp_path: Path) -> None:
    text, said = SAID["external_axis"][key]
    old, new = with_file(tmp_path, f"[[external_axis]]\n{text}\n")
    (before,), (after,) = old.external_axes, new.external_axes
    assert_differs(before, after, said)
    assert_differs(old, new, {}, "file check external_axes")


def test_an_external_axis_more_leaves_those_of_the_backup(tmp_path: Path) -> None:
    text = 'name = "STN"\naxis = "a"\nkind = "linear"\nlimits = [0, 1]\nspeed = 1\n'
    _, new = with_file(tmp_path, f"[[external_axis]]\n{text}")
    assert [axis.unit for axis in new.external_axes] == ["STN", "TRACK_1"]


@pytest.mark.parametrize("key", SAID["task"])
def test_a_key_of_a_task_leaves_the_others(key: str, tmp_path: Path) -> None:
    text, said = SAID["task"][key]
    old, new = with_file(tmp_path, f"[[task]]\n{text}\n")
    besides = {"modules": "modules", "motion": "motion"}.get(key, "")
    assert_differs(old.tasks[2], new.tasks[2], said, besides)
    assert new.tasks[:2] == old.tasks[:2]
    assert_differs(old, new, {}, "file check tasks")
    if key == "modules":
        assert new.tasks[2].modules == (tmp_path / "more.mod",)


@pytest.mark.parametrize("key", SAID["rmq"])
def test_a_key_of_a_queue_leaves_the_others(key: str, tmp_path: Path) -> None:
    text, said = SAID["rmq"][key]
    old, new = with_file(tmp_path, f'[[task]]\nname = "T_BACK"\nrmq = {{ {text} }}\n')
    assert_differs(old.tasks[2].queue, new.tasks[2].queue, said)
    assert_differs(old.tasks[2], new.tasks[2], {}, "queue")


@pytest.mark.parametrize("key", SIGNALS)
def test_a_key_of_a_signal_leaves_the_others(key: str, tmp_path: Path) -> None:
    name, text, said = SIGNALS[key]
    old, new = with_file(tmp_path, f"[signals]\n{name} = {{ {text} }}\n")
    (before,) = [one for one in old.io.signals if one.name == name]
    assert_differs(before, new.io.signals[-1], said)
    assert new.io.signals[:-1] == tuple(one for one in old.io.signals if one.name != name)
    assert_differs(old, new, {}, "file check io")
    assert_differs(old.io, new.io, {}, "signals")


def test_a_connection_counts_in_place_of_that_of_the_backup(tmp_path: Path) -> None:
    old, new = with_file(tmp_path, '[[cross]]\nset = "doMoves"\nfrom = "doGrip"\n')
    assert [one.result for one in new.io.crosses] == ["diPart", "doMoves"]
    (tmp_path / "rapidsim.toml").write_text('[[cross]]\nset = "dipart"\nfrom = "doMoves"\n')
    (cross,) = read_station(tmp_path / "rapidsim.toml", old).io.crosses
    assert cross.condition.text == "doMoves"


def test_what_a_backup_says_of_the_controller_is_a_key_too(tmp_path: Path) -> None:
    (tmp_path / "stub.mod").touch()
    _, new = with_file(tmp_path, '[controller]\nstubs = ["stub.mod"]\n')
    assert (new.robotware, new.stubs) == (RobotWare(6, 8), (tmp_path / "stub.mod",))
    _, new = with_file(tmp_path / "other", '[controller]\nrobotware = "7.1"\n')
    assert new.robotware == RobotWare(7, 1)


def test_what_is_out_of_reach_stays_so_with_a_start(tmp_path: Path) -> None:
    """The base frame and axis bounds of MOC.cfg hold for an arm that the file names or starts."""
    files = {name: text.replace("  Set doUnknown;\n", "") for name, text in BACKUP.items()}
    backup(tmp_path / "b", files)
    checked = call("check", "b", "--output-format", "json", cwd=tmp_path).out
    assert "K60" in checked
    for text in ("start = [0, 0, 0, 0, 30, 0]", 'model = "irb1200-5-0.9"'):
        (tmp_path / "b" / "rapidsim.toml").write_text(f"[robot]\n{text}\n")
        again = call("check", "b", "--output-format", "json", cwd=tmp_path).out
        found, before = (json.loads(out)["diagnostics"] for out in (again, checked))
        assert [one for one in found if one["code"].startswith("K60")] == [
            one for one in before if one["code"].startswith("K60")
        ]


def _without(name: str) -> dict[str, str]:
    return {key: text for key, text in BACKUP.items() if not key.endswith(name)}


BACKUPS = {
    "whole": BACKUP,
    "without MOC": _without("MOC.cfg"),
    "without EIO": _without("EIO.cfg"),
    "without SYS": _without("SYS.cfg"),
    "unlisted": _without("backinfo.txt"),
    "unknown arm": {**BACKUP, "SYSPAR/MOC.cfg": BACKUP["SYSPAR/MOC.cfg"].replace("1200", "9")},
    "unknown second arm": {
        **BACKUP,
        "SYSPAR/MOC.cfg": BACKUP["SYSPAR/MOC.cfg"].replace("ROB1_120_", "ROB1_9_"),
    },
    "alone": {
        name: text.replace("ROB_2", "ROB_9").replace("ROB1_120_0.58_3", "")
        for name, text in BACKUP.items()
        if "TASK2" not in name and "TASK3" not in name and name != "BACKINFO/backinfo.txt"
    },
}


@pytest.mark.parametrize("files", BACKUPS.values(), ids=BACKUPS)
def test_init_changes_no_result(files: Mapping[str, str], tmp_path: Path) -> None:
    backup(tmp_path / "b", files)
    commands = (("check", "b", "--output-format", "json"), ("run", "b", "--no-record", "--format"))
    asked = [(*one, "json") if one[0] == "run" else one for one in commands]
    before = [call(*one, cwd=tmp_path) for one in asked]
    written = call("init", "b", cwd=tmp_path)
    assert written.code == 0, written.err
    for one, old in zip(asked, before, strict=True):
        new = call(*one, cwd=tmp_path)
        assert (new.code, new.out) == (old.code, old.out)


def test_an_empty_station_file_changes_nothing(tmp_path: Path) -> None:
    old, new = with_file(tmp_path, "")
    assert replace(new, file=None, check=old.check) == old
