"""A station packed by RobotStudio is the backup of the controller that it holds."""

import json
import zipfile
from pathlib import Path

import pytest
from cli_helper import rapidsim

MAIN = (
    "MODULE main_module\n  PROC main()\n"
    '    SetDO doLamp,1;\n    TPWrite "on";\n  ENDPROC\nENDMODULE\n'
)
EIO = 'EIO:CFG_1.0:6:1::\n#\nEIO_SIGNAL:\n\n      -Name "doLamp" -SignalType "DO"\n'


@pytest.fixture(autouse=True)
def _temporary_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "temporary").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "temporary"))


def packed(folder: Path, *systems: str, evil: str = "") -> Path:
    file = folder / "cell.rspag"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("Stations/cell.rsstn", "no business of ours")
        for system in systems:
            archive.writestr(f"Backups/{system}/RAPID/TASK1/PROGMOD/main_module.mod", MAIN)
            archive.writestr(f"Backups/{system}/SYSPAR/EIO.cfg", EIO)
            archive.writestr(f"Backups/{system}/BACKINFO/backinfo.txt", "")
        if evil:
            archive.writestr(evil, "out")
    return file


def test_a_packed_station_is_checked_and_run_as_its_backup(tmp_path: Path) -> None:
    packed(tmp_path, "System1")
    checked = rapidsim("check", "cell.rspag", "--output-format", "json", cwd=tmp_path)
    assert (checked.code, json.loads(checked.out)["diagnostics"]) == (0, [])
    ran = rapidsim("run", "cell.rspag", "--no-record", "--format", "json", cwd=tmp_path)
    events = json.loads(ran.out)["events"]
    assert [event["message"] for event in events] == ["doLamp = 1", "on"]
    again = rapidsim("run", "cell.rspag", "--no-record", "--format", "json", cwd=tmp_path)
    assert again.out == ran.out


@pytest.mark.parametrize(
    ("systems", "said"),
    [((), "holds no backup"), (("One", "Two"), "holds 2 backups (One, Two); unpack it")],
)
def test_a_station_without_one_controller_is_refused(
    systems: tuple[str, ...], said: str, tmp_path: Path
) -> None:
    packed(tmp_path, *systems)
    ended = rapidsim("check", "cell.rspag", cwd=tmp_path)
    assert (ended.code, said in ended.err.replace("\n", " ")) == (2, True)


def test_what_is_no_archive_is_refused(tmp_path: Path) -> None:
    (tmp_path / "cell.rspag").write_text("version https://git-lfs.github.com/spec/v1\n")
    ended = rapidsim("check", "cell.rspag", cwd=tmp_path)
    assert (ended.code, "is no archive" in ended.err) == (2, True)


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
    assert [event["message"] for event in json.loads(ran.out)["events"]] == ["doLamp = 1", "on"]
