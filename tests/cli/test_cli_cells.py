"""Modules with SYS.cfg, EIO.cfg or MOC.cfg beside them are a cell, and a station file is found."""

import json
from pathlib import Path

import pytest
from command_line import call

MOVE = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;"
MAIN = f"""MODULE Job
  PROC main()
    {MOVE}
    Set doGrip;
    WaitDI diClosed,1\\MaxTime:=5;
  ENDPROC
ENDMODULE
"""
EIO = """EIO_SIGNAL:
      -Name "doGrip" -SignalType "DO"
      -Name "diClosed" -SignalType "DI"
#
EIO_CROSS:
      -Name "c" -Res "diClosed" -Act1 "doGrip"
"""
MOC = """ROBOT:
      -name "ROB_1" -use_robot_type "ROB1_120_0.58_3" -base_frame_pos_x 0.5
"""
SYS = """CAB_TASKS:
      -Name "T_BACK" -Type "SEMISTATIC" -Entry "watch"
      -Name "T_ROB1" -Type "NORMAL" -MotionTask
      -Name "T_GONE" -Type "STATIC"
#
CAB_TASK_MODULES:
      -File "HOME:/back.sys" -ModName "back" -Task "T_BACK"
      -File "HOME:/gone.sys" -ModName "gone" -Task "T_GONE"
"""
BACK = "MODULE back(SYSMODULE)\n PROC watch()\n  WaitTime 1;\n ENDPROC\nENDMODULE\n"


def written(folder: Path, **files: str) -> Path:
    for name, text in files.items():
        file = folder / ".".join(name.replace("__", "/").rsplit("_", 1))
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return folder


def asked(place: Path, path: str) -> tuple[str, dict[str, object]]:
    checked = call("check", path, "--output-format", "json", cwd=place)
    ran = call("run", path, "--no-record", "--format", "json", cwd=place)
    assert checked.code in (0, 1), checked.err
    return checked.out, json.loads(ran.out)


@pytest.mark.parametrize("where", ["", "SYSPAR__", "config__Grippers_"])
@pytest.mark.parametrize("modules", ["", "PROGMOD__", "RAPID__"])
def test_configuration_beside_modules_makes_a_cell(
    where: str, modules: str, tmp_path: Path
) -> None:
    files = {f"{where}EIO_cfg": EIO, f"{where}MOC_cfg": MOC, f"{modules}Main_mod": MAIN}
    written(tmp_path / "cell", **files)
    found, run = asked(tmp_path, "cell")
    assert json.loads(found)["diagnostics"] == []
    assert (run["end"], run["robot"]) == ("ended", "irb120-3-0.58")
    made = call("init", "cell", cwd=tmp_path)
    assert (made.code, "cell/rapidsim.toml" in made.out) == (0, True), made.err
    assert asked(tmp_path, "cell") == (found, run)


def test_tasks_are_those_of_the_configuration(tmp_path: Path) -> None:
    written(tmp_path / "cell", SYS_cfg=SYS, EIO_cfg=EIO, Main_mod=MAIN, back_sys=BACK)
    found, run = asked(tmp_path, "cell")
    assert json.loads(found)["diagnostics"] == []
    assert {event["task"] for event in run["events"]} >= {"T_ROB1"}  # type: ignore[attr-defined]
    assert run["end"] == "ended"
    said = call("check", "cell", cwd=tmp_path)
    assert "SYS.cfg: no module of the task T_GONE is in the folder" in said.out + said.err
    assert call("init", "cell", cwd=tmp_path).code == 0
    assert asked(tmp_path, "cell") == (found, run)


def test_configuration_alone_is_no_program(tmp_path: Path) -> None:
    written(tmp_path / "cell", EIO_cfg=EIO)
    for command in ("check", "run", "init"):
        assert call(command, "cell", cwd=tmp_path).code == 2


def test_configuration_that_leads_out_is_refused(tmp_path: Path) -> None:
    written(tmp_path / "cell", Main_mod=MAIN)
    written(tmp_path / "other", EIO_cfg=EIO)
    (tmp_path / "cell" / "SYSPAR").symlink_to(tmp_path / "other")
    ended = call("check", "cell", cwd=tmp_path)
    assert (ended.code, "leads out of" in ended.err.replace("\n", " ")) == (2, True)


@pytest.mark.parametrize("folder", ["PROGMOD", "RAPID", "SYSMOD"])
def test_a_station_beside_deeper_modules_is_found(folder: str, tmp_path: Path) -> None:
    written(tmp_path / "cell" / folder, Main_mod=MAIN, rapidsim_toml='[robot]\nmodel = "irb140"\n')
    _, run = asked(tmp_path, "cell")
    assert str(run["robot"]).startswith("irb140")
    (tmp_path / "cell" / "rapidsim.toml").write_text('[robot]\nmodel = "irb120"\n')
    _, run = asked(tmp_path, "cell")
    assert run["robot"] == "irb120-3-0.58"


def test_a_station_that_leads_out_is_refused(tmp_path: Path) -> None:
    written(tmp_path / "cell", Main_mod=MAIN)
    written(tmp_path / "other", rapidsim_toml='[robot]\nmodel = "irb140"\n')
    (tmp_path / "cell" / "PROGMOD").symlink_to(tmp_path / "other")
    ended = call("check", "cell", cwd=tmp_path)
    assert (ended.code, "leads out of" in ended.err.replace("\n", " ")) == (2, True)


def test_what_init_writes_for_deeper_modules_is_found_again(tmp_path: Path) -> None:
    written(tmp_path / "cell" / "PROGMOD", Main_mod=MAIN)
    made = call("init", "cell", "--robot", "irb140", cwd=tmp_path)
    assert "Written: cell/rapidsim.toml" in made.out
    _, run = asked(tmp_path, "cell")
    assert str(run["robot"]).startswith("irb140")
