"""What a controller backup says of its robots and signals, and what the station file changes."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.controller.cell.description import SignalDeclaration, SignalKind, Status
from rapidsim.jobs.running.run_files import simulate
from rapidsim.language.robotware import RobotWare
from rapidsim.module_files import Backup, backup_among
from rapidsim.simulation.results.signal_history import signal_changes
from rapidsim.station.backup.backup import backup_station
from rapidsim.station.backup.cfg_file import read_configuration
from rapidsim.station.backup.signals import backup_io
from rapidsim.station.read import read_station
from rapidsim.station.station import Station

EIO = r"""EIO:CFG_1.0:6:1::

#
EIO_SIGNAL:

      -Name "diPart" -SignalType "DI" -Device "d652" -DeviceMap "0"

      -Name "doGrip" -SignalType "DO"\
      -Label "closes -Name of no signal" -DeviceMap "3" -Default 1

      -Name "diClosed" -SignalType "DI"

      -Name "goJob" -SignalType "GO" -UnitMap "0-3,8"

      -Name "giFree" -SignalType "GI"

      -Name "giSized" -SignalType "GI" -Size 4

      -Name "aoFlow" -SignalType "AO" -MinLog -2.5 -MaxLog 10

      -Name "aiOpen" -SignalType "AI" -MinLog 0 -MaxLog 0

      -Name "odd" -SignalType "XX"
#
EIO_CROSS:

      -Name "c1" -Res "diClosed" -Act1 "doGrip" -Act1_invert -Oper1 "AND"\
      -Act2 "diPart" -Act2_invert "false"

      -Name "c2" -Res "doMixed" -Act1 "a" -Oper1 "AND" -Act2 "b" -Oper2 "OR" -Act3 "c"

      -Name "c3" -Res "doRing" -Act1 "doRing"
"""
MOC = """MOC:CFG_1.0:6:1::
#
ROBOT:

      -name "ROB_1" -use_robot_type "{type}"\\
      -base_frame_pos_x 0.5 -base_frame_pos_z -0.25\\
      -base_frame_orient_u0 0 -base_frame_orient_u3 1
"""
MODULE = """MODULE m
  PROC main()
    WaitDI diClosed,1;
    TPWrite "closed";
  ENDPROC
ENDMODULE
"""


def station(folder: Path, configuration: Mapping[str, str]) -> Station:
    """What a backup with one task says."""
    for name, text in {"RAPID/TASK1/m.mod": MODULE, **configuration}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, newline="\r\n")
    backup = backup_among([str(folder)])
    assert backup is not None
    return backup_station(backup)


@pytest.mark.parametrize("size", ["5000", "-5000", "0", "1e400", "nan"])
def test_a_size_that_no_group_has_is_that_of_a_group_without_size(
    size: str, tmp_path: Path
) -> None:
    eio = EIO.replace("-Size 4", f"-Size {size}")
    signals = {one.name: one for one in station(tmp_path, {"SYSPAR/EIO.cfg": eio}).io.signals}
    assert (signals["giSized"].width, signals["giFree"].width) == (32, 32)


def test_signals_are_those_of_the_configuration(tmp_path: Path) -> None:
    io = station(tmp_path, {"SYSPAR/EIO.cfg": EIO}).io
    assert io.signals == (
        SignalDeclaration("diPart", SignalKind.DI, 0.0, 0.0, 1.0),
        SignalDeclaration("doGrip", SignalKind.DO, 1.0, 0.0, 1.0),
        SignalDeclaration("diClosed", SignalKind.DI, 0.0, 0.0, 1.0),
        SignalDeclaration("goJob", SignalKind.GO, 0.0, 0.0, 31.0),
        SignalDeclaration("giFree", SignalKind.GI, 0.0, 0.0, 2.0**32 - 1.0),
        SignalDeclaration("giSized", SignalKind.GI, 0.0, 0.0, 15.0),
        SignalDeclaration("aoFlow", SignalKind.AO, 0.0, -2.5, 10.0),
        SignalDeclaration("aiOpen", SignalKind.AI, 0.0, None, None),
    )


def test_cross_connections_follow_and_what_is_left_out_is_said(tmp_path: Path) -> None:
    said = station(tmp_path, {"syspar/eio.CFG": EIO})
    cross, mixed = said.io.crosses
    assert (cross.result, cross.condition.text) == ("diClosed", "not doGrip and diPart")
    assert [
        cross.condition.holds({"doGrip": grip, "diPart": part}.__getitem__)
        for grip, part in ((0.0, 1.0), (1.0, 1.0), (0.0, 0.0))
    ] == [True, False, False]
    assert (mixed.result, mixed.condition.text) == ("doMixed", "a and b or c")
    (remark,) = said.remarks
    assert "`doRing`" in remark


@given(
    signals=st.lists(st.booleans(), min_size=2, max_size=5), words=st.tuples(*[st.booleans()] * 4)
)
@examples(30)
def test_a_cross_connection_is_evaluated_from_left_to_right(
    signals: list[bool], words: tuple[bool, ...]
) -> None:
    actors = "".join(f' -Act{n} "s{n}"' for n in range(1, len(signals) + 1))
    operators = "".join(
        f' -Oper{n} "{"OR" if word else "AND"}"'
        for n, word in enumerate(words[: len(signals) - 1], start=1)
    )
    text = f'EIO_CROSS:\n\n      -Name "c" -Res "r"{actors}{operators}\n'
    io, remarks = backup_io(read_configuration(text))
    expected = signals[0]
    for word, one in zip(words, signals[1:], strict=False):
        expected = (expected or one) if word else (expected and one)
    values = {f"s{n}": float(one) for n, one in enumerate(signals, start=1)}
    assert io.crosses[0].condition.holds(values.__getitem__) is expected
    assert not remarks


@pytest.mark.parametrize(
    ("type_name", "arm"),
    [
        ("ROB1_1200_0.9_5_TypeB", "irb1200-5-0.9"),
        ("ROB1_6700_2.60_200", "irb6700-200-2.6"),
        ("ROB1_4600_2.55_40", "irb4600-40-2.55"),
        ("ROB1_120_0.58_3", "irb120-3-0.58"),
        ("ROB1_1300_0.9_11", "irb1300-11-0.9"),
        ("ROB1_CRB_1300_0.9_11", "crb1300-11-0.9"),
        ("ROB1_15000_0.95_5", "crb15000-5-0.95"),
        ("ROB1_660_180", "irb660-180-3.15"),
        ("ROB1_1600_6", None),
        ("ROB1_6700_LeanID_2.65_220", None),
        ("ROB1_120_0.58_4", None),
        ("anything", None),
    ],
)
def test_an_arm_is_known_by_type_reach_and_payload(
    type_name: str, arm: str | None, tmp_path: Path
) -> None:
    said = station(tmp_path, {"SYSPAR/MOC.cfg": MOC.format(type=type_name)})
    assert said.robot == arm
    assert said.robots[0].unknown == (None if arm else type_name)
    place = said.world_from_base
    assert place is not None
    assert place.translation.tolist() == [0.5, 0.0, -0.25]
    assert np.allclose(place.rotation, np.diag([-1.0, -1.0, 1.0]))


def test_the_station_file_counts_in_place_of_the_backup(tmp_path: Path) -> None:
    backup = station(
        tmp_path,
        {"SYSPAR/MOC.cfg": MOC.format(type="ROB1_1200_0.9_5"), "SYSPAR/EIO.cfg": EIO},
    )
    file = tmp_path / "rapidsim.toml"
    file.write_text('[signals]\ndoGrip = { type = "do", value = 0 }\n')
    whole = read_station(file, backup)
    assert whole.robot == "irb1200-5-0.9"
    assert {one.name: one.value for one in whole.io.signals}["doGrip"] == 0.0
    assert len(whole.io.signals) == len(backup.io.signals)
    file.write_text("[robot]\nstart = [0, 0, 0, 0, 30, 0]\n")
    whole = read_station(file, backup)
    assert whole.robot == "irb1200-5-0.9"
    assert whole.start_joints_deg == (0, 0, 0, 0, 30, 0)
    file.write_text('[robot]\nmodel = "irb140"\n')
    assert read_station(file, backup).robot == "irb140"


def test_a_run_of_a_backup_has_its_wiring(tmp_path: Path) -> None:
    wired = EIO.replace("-Default 1", "").replace('"diPart" -S', '"diPart" -Default 1 -S')
    station(tmp_path, {"SYSPAR/EIO.cfg": wired})
    run = simulate([tmp_path], robot="irb120")
    assert [event.message for event in run.events if event.kind == "text"] == ["closed"]
    assert not [found for found in run.diagnostics if found.violation.code == "I801"]


@given(st.text(alphabet='-ABac:"\\\n #_1', max_size=60))
def test_any_text_is_a_configuration(text: str) -> None:
    for name, instances in read_configuration(text).items():
        assert name == name.upper()
        assert all(key == key.lower() for instance in instances for key in instance)


@pytest.mark.parametrize(("spare", "shown"), [(3, 5), (400, 2)])
def test_a_long_configuration_shows_what_the_run_sets(
    spare: int, shown: int, tmp_path: Path
) -> None:
    signals = [f'-Name "diSpare{number}" -SignalType "DI"' for number in range(spare)]
    signals += ['-Name "diClosed" -SignalType "DI"', '-Name "doGo" -SignalType "DO"']
    eio = "EIO_SIGNAL:\n" + "\n".join(signals) + '\nEIO_CROSS:\n-Res "diClosed" -Act1 "doGo"\n'
    set_first = MODULE.replace("    WaitDI", "    SetDO doGo,1;\n    WaitDI")
    station(tmp_path, {"SYSPAR/EIO.cfg": eio, "RAPID/TASK1/m.mod": set_first})
    changes = signal_changes(simulate([tmp_path], robot="irb120"))
    assert len(changes) == shown
    assert changes["diClosed"][-1][1] == 1.0


def test_system_outputs_of_a_backup_show_the_state_of_the_controller(tmp_path: Path) -> None:
    shown = """#
SYSSIG_OUT:

      -Status "TaskExecuting" -Signal "doGrip" -Arg2 "T_ROB1"

      -Status "EmStop" -Signal "goJob"

      -Status "MechUnitNotMoving" -Signal "doStands" -Arg1 "ROB_1"

      -Status "MechUnitActive" -Signal "doTable" -Arg1 "STN1"

      -Status "SimMode" -Signal "aoFlow"
#
EIO_SIGNAL:

      -Name "doStands" -SignalType "DO"

      -Name "doTable" -SignalType "DO"
"""
    said = station(tmp_path, {"SYSPAR/EIO.cfg": f"{EIO}\n{shown}"})
    signals = {one.name: one for one in said.io.signals}
    grip, job = signals["doGrip"], signals["goJob"]
    assert (grip.status, grip.task, grip.value) == (Status.TASK_EXECUTING, "T_ROB1", 1.0)
    assert (job.status, job.value) == (Status.EMERGENCY_STOP, 0.0)
    # RobotWare 7 names the output by the instance.
    renamed = f"{EIO}\n{shown}".replace('" -Signal "doStands"', '" -Name "doStands"')
    seven = {one.name: one for one in station(tmp_path, {"SYSPAR/EIO.cfg": renamed}).io.signals}
    stands = signals["doStands"]
    assert seven["doStands"] == stands
    assert (stands.status, stands.unit, stands.value) == (Status.UNIT_NOT_MOVING, "ROB_1", 1.0)
    # Tables are switched on and off, which is not shown.
    assert "MechUnitActive is not simulated: `doTable`" in said.remarks[-2]
    assert "SimMode is not simulated: `aoFlow`" in said.remarks[-1]


def test_an_input_that_slows_the_robot_down_is_told(tmp_path: Path) -> None:
    inputs = """#
SYSSIG_IN:

      -Signal "diStart" -Action "StartMain" -Arg1 "CONT"

      -Signal "diSlow" -Action "LimitSpeed"
"""
    said = station(tmp_path, {"SYSPAR/EIO.cfg": f"{EIO}\n{inputs}"})
    assert said.remarks[-1] == ("EIO.cfg: LimitSpeed is not simulated: `diSlow` slows nothing down")


@pytest.mark.parametrize(
    ("line", "version"),
    [
        ("RobotWare Version: 6.08.01.00", RobotWare(6, 8)),
        ("RobotWare_7.13.0", RobotWare(7, 13)),
        ("5.15", None),
    ],
)
def test_a_backup_says_which_robotware_it_is_of(
    tmp_path: Path, line: str, version: RobotWare | None
) -> None:
    module = tmp_path / "RAPID" / "TASK1" / "PROGMOD" / "main.mod"
    module.parent.mkdir(parents=True)
    module.write_text("MODULE main_module\n  PROC main()\n  ENDPROC\nENDMODULE\n")
    (tmp_path / "BACKINFO").mkdir()
    (tmp_path / "BACKINFO" / "backinfo.txt").write_text(
        f">>PRODUCTS_ID:\n{line}\n>>TASK1: (T_ROB1,MAIN,)\n"
    )
    station = backup_station(Backup(tmp_path, (tmp_path / "RAPID" / "TASK1",)))
    assert station.robotware == version
