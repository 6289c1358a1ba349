"""`rapidsim init`: the first station file, and that checking and running go on with it as it is."""

import json
import tomllib
from pathlib import Path

import pytest
from command_line import call

MOVES = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;"
MOTION = f"""MODULE Motion
  PROC main()
    WHILE NOT stopAll DO
      {MOVES}
      WaitTime 1;
      IF part_ready=1 Set grip_close;
      count:=count+1;
      IF count=3 stopAll:=TRUE;
    ENDWHILE
    SetGO part_kind,2;
  ENDPROC
ENDMODULE
"""
SERVER = """MODULE Server
  PROC main()
    WHILE NOT stopAll DO
      WaitTime 0.5;
      TPWrite "count "\\Num:=count;
      IF part_ready=1 TPWrite "ready";
      Reset grip_close;
    ENDWHILE
    WaitDI part_ready,0;
  ENDPROC
ENDMODULE
"""
SHARED = """MODULE Shared(SYSMODULE)
  PERS bool stopAll:=FALSE;
  PERS num count:=0;
ENDMODULE
"""
UNUSED = "MODULE Unused\n  PROC helper()\n  ENDPROC\nENDMODULE\n"


def written(folder: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return folder


def station(folder: Path) -> dict[str, object]:
    return tomllib.loads((folder / "rapidsim.toml").read_text())


def checked(path: Path, folder: Path) -> list[str]:
    """Codes of errors and warnings, but for what a program asks for on purpose."""
    it = call("check", str(path), "--output-format", "json", cwd=folder)
    found = json.loads(it.out)["diagnostics"]
    return [one["code"] for one in found if one["severity"] != "note"]


def test_several_mains_become_tasks(tmp_path: Path) -> None:
    cell = written(
        tmp_path / "cell",
        {"Motion.mod": MOTION, "Server.mod": SERVER, "Shared.sys": SHARED, "Unused.mod": UNUSED},
    )
    it = call("init", "cell", cwd=tmp_path)
    assert it.code == 0, it.err
    assert it.out == "Written: cell/rapidsim.toml (2 tasks, 3 signals)\n"
    said = station(cell)
    assert said["task"] == [
        {"name": "T_ROB1", "modules": ["Motion.mod", "Shared.sys", "Unused.mod"]},
        {
            "name": "Server",
            "modules": ["Server.mod", "Shared.sys"],
            "type": "semistatic",
            "motion": False,
        },
    ]
    assert said["signals"] == {
        "part_ready": {"type": "di"},
        "grip_close": {"type": "do"},
        "part_kind": {"type": "go"},
    }
    assert said["robot"] == {}
    assert checked(cell, tmp_path) == ["I803"] or checked(cell, tmp_path) == []
    run = call("run", "cell", "--no-record", "--format", "json", cwd=tmp_path)
    assert run.code == 0, run.err
    assert json.loads(run.out)["end"] == "ended"


def test_what_is_there_is_kept(tmp_path: Path) -> None:
    cell = written(tmp_path / "cell", {"Motion.mod": UNUSED, "rapidsim.toml": "# mine\n"})
    it = call("init", "cell", cwd=tmp_path)
    assert it.code == 2
    assert "rapidsim.toml is there already" in it.err
    assert (cell / "rapidsim.toml").read_text() == "# mine\n"


def test_a_program_has_its_file_beside_it_and_the_arm_that_is_named(tmp_path: Path) -> None:
    written(tmp_path, {"pick.mod": f"MODULE pick\n PROC main()\n {MOVES}\n ENDPROC\nENDMODULE\n"})
    it = call("init", "pick.mod", "--robot", "irb120", cwd=tmp_path)
    assert it.code == 0, it.err
    assert station(tmp_path) == {"robot": {"model": "irb120-3-0.58"}}
    assert checked(Path("pick.mod"), tmp_path) == []


CONFIGURATION = {
    "cfg/SYS.cfg": """CAB_TASKS:
      -Name "T_LEFT" -Type "NORMAL" -Entry "go" -MotionTask
      -Name "T_RIGHT" -Type "NORMAL" -BindRef 0 -Entry "go" -MotionTask
      -Name "watch" -Entry "look"
#
CAB_TASK_MODULES:
      -File "HOME:/common.sys" -Shared
      -File "HOME:/mover.mod" -ModName "mover" -AllMotionTask
      -File "HOME:/watch.mod" -ModName "watch" -Task "watch"
""",
    "cfg/EIO.cfg": """EIO_SIGNAL:
      -Name "running" -SignalType "DO" -Default 1
      -Name "level" -SignalType "AI" -MinLog -2.5 -MaxLog 10
      -Name "kind" -SignalType "GI" -Size 4
""",
    "cfg/MOC.cfg": """ROBOT:
      -name "ROB_1" -use_robot_type "ROB1_120_0.58_3"
      -name "ROB_2" -use_robot_type "ROB1_9999_1_1"
""",
    "HOME/mover.mod": f"MODULE mover\n PROC go()\n {MOVES}\n ENDPROC\nENDMODULE\n",
    "HOME/watch.mod": "MODULE watch\n PROC look()\n IF running=1 AND level<kind seen:=TRUE;\n"
    " WaitTime 1;\n ENDPROC\nENDMODULE\n",
    "HOME/common.sys": "MODULE common(SYSMODULE)\n PERS bool seen:=FALSE;\nENDMODULE\n",
}


def test_configuration_files_say_what_a_controller_would_be_told(tmp_path: Path) -> None:
    written(tmp_path, CONFIGURATION)
    it = call("init", "HOME", "cfg", cwd=tmp_path)
    assert it.code == 0, it.err
    said = station(tmp_path / "HOME")
    assert said["robot"] == [{"name": "ROB_1", "model": "irb120-3-0.58"}, {"name": "ROB_2"}]
    assert said["task"] == [
        {
            "name": "T_LEFT",
            "modules": ["common.sys", "mover.mod"],
            "entry": "go",
            "robot": "ROB_1",
        },
        {
            "name": "T_RIGHT",
            "modules": ["common.sys", "mover.mod"],
            "entry": "go",
            "check_references": False,
            "robot": "ROB_2",
        },
        {
            "name": "watch",
            "modules": ["common.sys", "watch.mod"],
            "type": "semistatic",
            "entry": "look",
            "motion": False,
        },
    ]
    assert said["signals"] == {
        "running": {"type": "do", "value": 1},
        "level": {"type": "ai", "min": -2.5, "max": 10},
        "kind": {"type": "gi", "width": 4},
    }
    assert checked(Path("HOME"), tmp_path) == []
    run = call("run", "HOME", "--no-record", "--format", "json", cwd=tmp_path)
    assert run.code == 0, run.err
    assert (json.loads(run.out)["end"], len(json.loads(run.out)["moves"])) == ("ended", 2)


@pytest.mark.parametrize("arm", ["ROB1_120_0.58_3", "ROB1_9999_1_1"])
def test_a_backup_says_most_of_it_by_itself(tmp_path: Path, arm: str) -> None:
    backup = written(
        tmp_path / "backup",
        {
            "BACKINFO/backinfo.txt": ">>TASK1: (T_ROB1,,)\nPROGMOD/m.mod @ \n",
            "RAPID/TASK1/PROGMOD/m.mod": "MODULE m\n PROC main()\n Set missing_one;\n"
            " IF known_one=1 Reset missing_one;\n ENDPROC\nENDMODULE\n",
            "SYSPAR/EIO.cfg": 'EIO_SIGNAL:\n      -Name "known_one" -SignalType "DI"\n',
            "SYSPAR/MOC.cfg": f'ROBOT:\n      -name "ROB_1" -use_robot_type "{arm}"\n',
        },
    )
    it = call("init", "backup", cwd=tmp_path)
    assert it.code == 0, it.err
    assert station(backup) == {}
    text = (backup / "rapidsim.toml").read_text()
    assert '# [signals]\n# missing_one = { type = "do" }\n' in text
    assert ("# [robot]\n" in text) == (arm == "ROB1_9999_1_1")
    # What EIO.cfg does not declare is an error before and after, until it is no comment.
    assert checked(backup, tmp_path) == ["I801"]
    (backup / "rapidsim.toml").write_text('[signals]\nmissing_one = { type = "do" }\n')
    run = call("run", "backup", "--no-record", "--format", "json", cwd=tmp_path)
    assert run.code == 0, run.err
    named = json.loads(run.out)["robot"] == "irb120-3-0.58"
    assert named == (arm == "ROB1_120_0.58_3")


def test_what_a_run_lacks_of_a_backup_is_said(tmp_path: Path) -> None:
    """A positioner whose axes MOC.cfg does not describe, and an arm without axis speeds."""
    written(
        tmp_path / "backup",
        {
            "BACKINFO/backinfo.txt": ">>TASK1: (T_ROB1,,)\nPROGMOD/m.mod @ \n",
            "RAPID/TASK1/PROGMOD/m.mod": "MODULE m\n PROC main()\n ENDPROC\nENDMODULE\n",
            "SYSPAR/MOC.cfg": "MECHANICAL_UNIT:\n\n"
            '      -name "STN_1" -use_single_0 "S1" -use_single_1 "S2"\n#\n'
            'ROBOT:\n\n      -name "ROB_1" -use_robot_type "ROB1_1300_0.9_11"\n',
        },
    )
    it = call("init", "backup", cwd=tmp_path)
    assert it.code == 0, it.err
    assert "note: the unit STN_1 of the backup is known only by name" in it.err
    assert "note: no source gives the axis speeds of irb1300-11-0.9" in it.err


PICK = f"""MODULE Pick
  PROC main()
    WaitDI diPart,1;
    {MOVES}
    SetDO doGrip,1;
    WaitDI diGripped,1;
    IF diLamp=1 Reset doGrip;
    WaitDI diGripped,0;
  ENDPROC
ENDMODULE
"""


def test_what_sets_inputs_is_suggested_and_runs(tmp_path: Path) -> None:
    cell = written(tmp_path / "cell", {"Pick.mod": PICK})
    assert call("init", "cell", "--robot", "irb120", cwd=tmp_path).code == 0
    text = (cell / "rapidsim.toml").read_text()
    assert "stimulus" not in tomllib.loads(text)
    assert "# Other inputs that nothing sets: diLamp\n" in text
    comments = [line.removeprefix("# ") for line in text.splitlines()]
    begin = comments.index("[[stimulus]]")
    end = next(n for n, line in enumerate(comments) if line.startswith("Other inputs"))
    said = tomllib.loads("\n".join(comments[begin:end]))
    assert said["stimulus"] == [
        {"at": 2.0, "set": {"diPart": 1}},
        {"when": "doGrip = 1", "after": 0.4, "set": {"diGripped": 1}},
        {"when": "doGrip = 0", "after": 0.4, "set": {"diGripped": 0}},
    ]
    bodies = tomllib.loads("\n".join(comments[comments.index("[[object]]") :]))
    assert bodies["object"][0]["name"] == "table"
    plain = "\n".join(line for line in text.splitlines() if not line.startswith("#"))
    (cell / "rapidsim.toml").write_text("\n".join([plain, *comments[begin:end]]))
    run = call("run", "cell", "--no-record", "--format", "json", "--max-time", "20", cwd=tmp_path)
    # Nothing opens the gripper, for the lamp is off.
    assert [one["for"] for one in json.loads(run.out)["waits"]][:2] == [
        "diPart = 1",
        "diGripped = 1",
    ]


@pytest.mark.parametrize(
    ("service", "place", "kind"),
    [("github", ".github/workflows/rapid.yml", "sarif"), ("gitlab", ".gitlab-ci.yml", "junit")],
)
def test_a_file_for_a_service_is_written_on_request(
    service: str, place: str, kind: str, tmp_path: Path
) -> None:
    (tmp_path / ".git").mkdir()
    (tmp_path / ".gitignore").write_text("*.rrd\n")
    written(tmp_path / "my cell", {"Pick.mod": PICK})
    it = call("init", "my cell", "--ci", service, cwd=tmp_path)
    assert it.code == 0, it.err
    assert f"Written: {place}\nFor .gitignore: *.home/\n" in it.out
    text = (tmp_path / place).read_text()
    assert f"\"rapidsim check 'my cell' --format {kind}" in text
    (tmp_path / "my cell" / "rapidsim.toml").unlink()
    again = call("init", "my cell", "--ci", service, cwd=tmp_path)
    assert (again.code, "is there already" in again.err.replace("\n", " ")) == (2, True)
    assert not (tmp_path / "my cell" / "rapidsim.toml").exists()


def test_a_cell_with_a_station_file_gets_the_file_of_a_service(tmp_path: Path) -> None:
    (tmp_path / ".git").mkdir()
    written(tmp_path / "cell", {"Pick.mod": PICK})
    station_file = tmp_path / "cell" / "rapidsim.toml"
    station_file.write_text('[robot]\nmodel = "irb120"\n')
    it = call("init", "cell", "--ci", "github", cwd=tmp_path)
    assert (it.code, it.err) == (0, "")
    assert it.out.startswith("Kept: cell/rapidsim.toml\nWritten: .github/workflows/rapid.yml\n")
    assert station_file.read_text() == '[robot]\nmodel = "irb120"\n'
    assert "rapidsim check cell" in (tmp_path / ".github/workflows/rapid.yml").read_text()


def test_a_file_for_a_service_does_not_lead_out(tmp_path: Path) -> None:
    top = tmp_path / "top"
    written(top / "cell", {"Pick.mod": PICK})
    (top / ".git").mkdir()
    (tmp_path / "other").mkdir()
    (top / ".github").symlink_to(tmp_path / "other")
    it = call("init", "cell", "--ci", "github", cwd=top)
    assert (it.code, "leads out of" in it.err.replace("\n", " ")) == (2, True)
    assert not list((tmp_path / "other").iterdir())


def test_an_input_that_a_loop_looks_at_gets_an_example(tmp_path: Path) -> None:
    loop = (
        "MODULE Loop\n  PROC main()\n    WHILE TRUE DO\n      IF di_start=1 THEN\n"
        f"        {MOVES}\n        EXIT;\n      ENDIF\n    ENDWHILE\n  ENDPROC\nENDMODULE\n"
    )
    written(tmp_path, {"Loop.mod": loop})
    assert call("run", "Loop.mod", "--no-record", cwd=tmp_path).code == 1
    assert call("init", "Loop.mod", cwd=tmp_path).code == 0
    file = tmp_path / "rapidsim.toml"
    text = file.read_text()
    example = text[text.index("# [[stimulus]]") :].split("\n\n")[0]
    file.write_text(text + "\n" + example.replace("# ", ""))
    assert station(tmp_path)["stimulus"] == [{"at": 1.0, "pulse": 0.5, "set": {"di_start": 1}}]
    ran = call("run", "Loop.mod", "--no-record", cwd=tmp_path)
    assert ran.code == 0, ran.out
