"""A station packed by RobotStudio is the backup of the controller that it holds."""

import io
import json
import random
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from cli_helper import rapidsim
from laws import cases

from rapidsim.export.edited_files import edited_bytes
from rapidsim.files import InputError, SourceFile

MAIN = (
    "MODULE main_module\n  PROC main()\n"
    '    SetDO doLamp,1;\n    TPWrite "on";\n  ENDPROC\nENDMODULE\n'
)
EIO = 'EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n      -Name "doLamp" -SignalType "DO"\n'
ROOTS = ("Backups", "Controller Data")
METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA)


@pytest.fixture(autouse=True)
def _temporary_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))


def archive(
    *systems: str,
    root: str = "Backups",
    evil: str = "",
    eio: str = EIO,
    method: int = zipfile.ZIP_STORED,
) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", method) as packed:
        packed.writestr("Stations/cell.rsstn", "no business of ours")
        for system in systems:
            text = MAIN.replace('"on"', f'"{system}"')
            packed.writestr(f"{root}/{system}/RAPID/TASK1/PROGMOD/main_module.mod", text)
            packed.writestr(f"{root}/{system}/SYSPAR/EIO.cfg", eio)
            packed.writestr(f"{root}/{system}/BACKINFO/backinfo.txt", "")
            packed.writestr(f"Virtual Controllers/{system}/HOME/x.mod", "MODULE x\nENDMODULE\n")
        if evil:
            packed.writestr(evil, "out")
    return data.getvalue()


def packed(
    folder: Path, *systems: str, root: str = "Backups", evil: str = "", eio: str = EIO
) -> None:
    (folder / "cell.rspag").write_bytes(archive(*systems, root=root, evil=evil, eio=eio))


def texts(out: str) -> list[str]:
    return [event["message"] for event in json.loads(out)["events"]]


@pytest.mark.parametrize("root", ROOTS)
def test_a_packed_station_is_checked_and_run_as_its_backup(root: str, tmp_path: Path) -> None:
    packed(tmp_path, "System1", root=root)
    checked = rapidsim("check", "cell.rspag", "--output-format", "json", cwd=tmp_path)
    assert (checked.code, json.loads(checked.out)["diagnostics"]) == (0, [])
    ran = rapidsim("run", "cell.rspag", "--no-record", "--format", "json", cwd=tmp_path)
    assert texts(ran.out) == ["doLamp = 1", "System1"]
    again = rapidsim("run", "cell.rspag", "--no-record", "--format", "json", cwd=tmp_path)
    assert again.out == ran.out


def test_findings_stand_at_places_in_the_archive(tmp_path: Path) -> None:
    name = "cell.rspag!System1/RAPID/TASK1/PROGMOD/main_module.mod"
    packed(tmp_path, "System1", eio="")
    checked = rapidsim("check", "cell.rspag", "--output-format", "json", cwd=tmp_path)
    (found,) = json.loads(checked.out)["diagnostics"]
    assert (found["code"], found["file"]) == ("I801", name)
    with pytest.raises(InputError, match="cannot be written into a packed station"):
        edited_bytes(SourceFile(name, MAIN, "utf-8"), [], subject="fixes")


@pytest.mark.parametrize("root", ROOTS)
def test_one_of_several_controllers_is_named(root: str, tmp_path: Path) -> None:
    packed(tmp_path, "One", "Two_0.58m", root=root)
    for path in ("cell.rspag!two_0.58M", "cell.rspag!One"):
        ran = rapidsim("run", path, "--no-record", "--format", "json", cwd=tmp_path)
        name = path.partition("!")[2].replace("two_0.58M", "Two_0.58m")
        assert texts(ran.out) == ["doLamp = 1", name]
    assert rapidsim("check", "cell.rspag!One", cwd=tmp_path).code == 0
    ended = rapidsim("check", "cell.rspag!Three", cwd=tmp_path)
    said = ended.err.replace("\n", " ")
    assert "holds no controller Three; there are: cell.rspag!One, cell.rspag!Two_0.58m" in said
    assert rapidsim("run", "cell.rspag!Two_0.58m", cwd=tmp_path).code == 0
    assert (tmp_path / "cell-Two_0.58m.rrd").is_file()
    each = rapidsim("check", "cell.rspag", "--each", "--output-format", "json", cwd=tmp_path)
    assert (each.code, json.loads(each.out)["files"]) == (0, 2)


SYS = 'SYS:CFG_1.0:6:1::\n#\nCAB_TASKS:\n\n      -Name "{task}" -Type "NORMAL" -MotionTask\n'
MOC = (
    'MOC:CFG_1.0:6:1::\n#\nROBOT:\n\n      -name "ROB_1" -use_robot_type "{arm}" \\\n'
    "      -base_frame_pos_x {x}\n"
)
MOVES = """MODULE main_module
  {data}
  PROC main()
    MoveAbsJ [[{axis},0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
    {statement}
    TPWrite GetTaskName();
  ENDPROC
ENDMODULE
"""


def two_controllers(
    folder: Path, tasks: tuple[str, str], *, data: str = "", statement: str = ""
) -> None:
    """A packed station of the controllers `Left` and `Right`, each with a task and an arm."""
    arms = (("Left", "ROB1_1600_1.2_6", 10, 0.0), ("Right", "ROB1_120_0.58_3", -40, 1.5))
    with zipfile.ZipFile(folder / "cell.rspag", "w") as packed:
        for task, (name, arm, axis, x) in zip(tasks, arms, strict=True):
            root = f"Backups/{name}"
            text = MOVES.format(axis=axis, data=data, statement=statement)
            packed.writestr(f"{root}/RAPID/TASK1/PROGMOD/main_module.mod", text)
            packed.writestr(f"{root}/SYSPAR/SYS.cfg", SYS.format(task=task))
            packed.writestr(f"{root}/SYSPAR/MOC.cfg", MOC.format(arm=arm, x=x))
            packed.writestr(f"{root}/SYSPAR/EIO.cfg", EIO)
            information = f">>TASK1: ({task},,)\nPROGMOD/main_module.mod @ \n"
            packed.writestr(f"{root}/BACKINFO/backinfo.txt", information)


def test_controllers_whose_tasks_differ_are_one_cell(tmp_path: Path) -> None:
    two_controllers(tmp_path, ("T_LEFT", "T_RIGHT"))
    ended = rapidsim("run", "cell.rspag", "--no-record", "--format", "json", cwd=tmp_path)
    ran = json.loads(ended.out)
    assert (ended.code, ran["end"]) == (0, "ended")
    assert {robot["task"]: robot["robot"] for robot in ran["robots"]} == {
        "T_LEFT": "irb1600-6-1.2",
        "T_RIGHT": "irb120-3-0.58",
    }
    assert {move["task"]: move["joints_deg"][0] for move in ran["moves"]} == {
        "T_LEFT": 10.0,
        "T_RIGHT": -40.0,
    }
    assert sorted(texts(ended.out)) == ["T_LEFT", "T_RIGHT"]
    text = rapidsim("run", "cell.rspag", "--no-record", cwd=tmp_path)
    assert text.out.startswith("cell.rspag on ABB IRB 1600-6/1.2 and ABB IRB 120-3/0.58")
    assert "Left, Right form one cell" in text.err.replace("\n", " ")
    checked = rapidsim("check", "cell.rspag", "--output-format", "json", cwd=tmp_path)
    assert (checked.code, json.loads(checked.out)["coverage"]["checked"]) == (0, 2)
    # One of them is the same alone.
    alone = rapidsim("run", "cell.rspag!Right", "--no-record", "--format", "json", cwd=tmp_path)
    (move,) = json.loads(alone.out)["moves"]
    (same,) = (one for one in ran["moves"] if one["task"] == "T_RIGHT")
    assert (move["joints_deg"], move["end_s"]) == (same["joints_deg"], same["end_s"])


@pytest.mark.parametrize(
    ("tasks", "options", "why"),
    [
        (("T_ROB1", "T_ROB1"), {}, "Left and Right both have a task T_ROB1"),
        (
            ("T_A", "T_B"),
            {"data": "PERS num nParts{3}:=[1,2,3];\n  TASK PERS num nOwn:=1;"},
            "Left and Right both declare the persistent nparts, which tasks of one cell share",
        ),
        (
            ("T_A", "T_B"),
            {"statement": "SetDO doLamp,1;"},
            "the programs of one use the signal dolamp, which Left and Right both have",
        ),
        (
            ("T_A", "T_B"),
            {"statement": 'TPWrite "ROB_1";'},
            "the programs of one use the unit rob_1, which Left and Right both have",
        ),
    ],
    ids=["task", "persistent", "signal", "unit"],
)
def test_controllers_that_share_a_name_are_no_cell(
    tasks: tuple[str, str], options: dict[str, str], why: str, tmp_path: Path
) -> None:
    two_controllers(tmp_path, tasks, **options)
    ended = rapidsim("check", "cell.rspag", cwd=tmp_path)
    said = ended.err.replace("\n", " ")
    assert ended.code == 2
    assert "name one: cell.rspag!Left, cell.rspag!Right; check --each checks all" in said
    assert why in " ".join(said.split())
    assert rapidsim("check", "cell.rspag!Left", cwd=tmp_path).code == 0


@pytest.mark.parametrize(
    ("systems", "said"),
    [
        ((), "holds no backup"),
        (
            ("One", "Two"),
            "holds 2 controllers; name one: cell.rspag!One, cell.rspag!Two; check --each",
        ),
    ],
)
def test_a_station_without_one_controller_is_refused(
    systems: tuple[str, ...], said: str, tmp_path: Path
) -> None:
    packed(tmp_path, *systems)
    ended = rapidsim("check", "cell.rspag", cwd=tmp_path)
    assert (ended.code, said in ended.err.replace("\n", " ")) == (2, True)


def test_what_is_no_archive_is_refused(tmp_path: Path) -> None:
    (tmp_path / "cell.rspag").write_text("a text, not an archive\n")
    ended = rapidsim("check", "cell.rspag", cwd=tmp_path)
    assert (ended.code, "is no archive" in ended.err) == (2, True)


def _damaged(data: bytes, random_: random.Random) -> bytes:
    """An archive with some bytes changed, removed, or added."""
    bytes_ = bytearray(data)
    for _ in range(random_.randint(1, 4)):
        at = random_.randrange(len(bytes_))
        match random_.randrange(4):
            case 0:
                bytes_[at] = random_.randrange(256)
            case 1:
                bytes_[at] ^= 1 << random_.randrange(8)
            case 2:
                del bytes_[at : at + random_.randint(1, 40)]
            case _:
                bytes_[at:at] = random_.randbytes(random_.randint(1, 20))
    return bytes(bytes_)


@pytest.mark.parametrize("method", METHODS)
def test_a_damaged_archive_is_refused_and_leaves_nothing(method: int, tmp_path: Path) -> None:
    random_ = random.Random(method)
    data = archive("System1", root="Controller Data", method=method)
    for number in range(cases(400)):
        (tmp_path / "cell.rspag").write_bytes(_damaged(data, random_))
        before = set((tmp_path / "temporary").iterdir())
        ended = rapidsim("check", "cell.rspag", "--no-run", cwd=tmp_path)
        assert ended.code in (0, 1, 2), (number, ended.err)
        assert "Traceback" not in ended.err
        if ended.code == 2 and "cannot be read" in ended.err:
            assert set((tmp_path / "temporary").iterdir()) == before, number


@pytest.mark.process
def test_nothing_stays_unpacked(tmp_path: Path) -> None:
    packed(tmp_path, "System1")
    command = [sys.executable, "-m", "rapidsim", "run", "cell.rspag", "--no-record"]
    environment = {"TMPDIR": str(tmp_path / "temporary"), "PATH": ""}
    ended = subprocess.run(command, cwd=tmp_path, env=environment, check=False, capture_output=True)
    assert ended.returncode == 0, ended.stderr
    assert not list((tmp_path / "temporary").iterdir())


@pytest.mark.parametrize(
    "evil", ["Backups/System1/HOME/../../../../../out.txt", "/Backups/System1/HOME/out.txt"]
)
def test_nothing_of_an_archive_comes_to_lie_elsewhere(evil: str, tmp_path: Path) -> None:
    packed(tmp_path, "System1", evil=evil)
    assert rapidsim("check", "cell.rspag", cwd=tmp_path).code == 0
    room = tmp_path / "temporary"
    assert all(one.is_relative_to(room) for one in tmp_path.rglob("*.mod"))
    assert not list(tmp_path.rglob("out.txt"))


def test_a_first_station_file_lies_beside_the_archive(tmp_path: Path) -> None:
    packed(tmp_path, "System1")
    assert rapidsim("init", "cell.rspag", "--robot", "irb1600", cwd=tmp_path).code == 0
    assert (tmp_path / "rapidsim.toml").is_file()
    ran = rapidsim("run", "cell.rspag", "--no-record", "--format", "json", cwd=tmp_path)
    assert texts(ran.out) == ["doLamp = 1", "System1"]
    assert json.loads(ran.out)["robot"] == "irb1600-6-1.2"
