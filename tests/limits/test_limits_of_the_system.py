"""What the system refuses, and numbers beyond all measure: a sentence and an exit code of use."""

import json
import os
import sys
from pathlib import Path

import pytest
from command_line import call

from rapidsim.applications.kin import command as kin_command
from rapidsim.cli.boundary import run_commands
from rapidsim.jobs.cache.result_store import ResultStore

PROGRAM = "MODULE job\n  PROC main()\n  ENDPROC\nENDMODULE\n"


@pytest.mark.parametrize("length", [246, 252, 253, 255, 256, 300, 5000])
@pytest.mark.parametrize(
    "command",
    [
        ("check", "{}"),
        ("run", "job.mod", "--no-record", "--trace", "{}.csv"),
        ("run", "job.mod", "--record", "{}.rrd"),
        ("run", "job.mod", "--no-record", "--home", "{}"),
        ("check", "job.mod", "--station", "{}.toml"),
        ("diff", "{}", "job.mod"),
        ("fmt", "{}.mod"),
        ("follow", "{}.csv"),
    ],
    ids=" ".join,
)
def test_a_name_that_is_too_long(command: tuple[str, ...], length: int, tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    ended = call(*(part.format("a" * length) for part in command), cwd=tmp_path)
    assert ended.code == 2
    assert ended.err.startswith("error: ")


@pytest.mark.process
@pytest.mark.skipif(sys.platform == "win32", reason="Windows keeps a folder that is used")
@pytest.mark.parametrize("command", [("check", "."), ("run", "a.mod"), ("diff", "a", "b")])
def test_a_folder_that_is_gone(
    command: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = Path.cwd()
    folder = tmp_path / "gone"
    folder.mkdir()
    os.chdir(folder)
    folder.rmdir()
    try:
        assert run_commands(command) == 2
    finally:
        os.chdir(before)
    assert capsys.readouterr().err.startswith("error: the working folder does not exist any more")


@pytest.mark.parametrize(
    "command",
    [
        "follow --line 500,0,600,600,0,600 --tool 1e300,0,0 --format json",
        "follow --line 1e300,0,600,600,0,1e308",
        "follow far.csv --format json",
        "points --shell 1e300,1e301",
        "points --postures --robot irb120 --tool 1e308,1e308,0 --base 1e308,1e308,0",
        "kin fk --joints 0,0,0,0,1e300,0 --format json",
        "calibrate /",
    ],
)
def test_numbers_beyond_all_measure(command: str, tmp_path: Path) -> None:
    (tmp_path / "far.csv").write_text("x,y,z\n500,0,1e300\n500,0,600\n")
    ended = call(*command.split(), cwd=tmp_path)
    assert ended.code == 2
    assert "error" in ended.err + ended.out


@pytest.mark.parametrize("command", ["follow --line L --tool T --format json", "points --shell S"])
def test_the_largest_numbers(command: str, tmp_path: Path) -> None:
    for name, text in (("L", "1e12,0,0,-1e12,1e12,0"), ("T", "1e12,0,0"), ("S", "1e11,1e12")):
        command = command.replace(f" {name}", f" {text}")
    ended = call(*command.split(), cwd=tmp_path)
    assert ended.code in (0, 1)
    if "json" in command:
        assert "error" not in json.loads(ended.out)


def test_an_object_that_json_cannot_hold_is_a_defect(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kin_command, "json_of", lambda record: {"far": float("inf")})
    ended = call("kin", "fk", "--joints", "0,0,0,0,30,0", "--format", "json", cwd=tmp_path)
    assert ended.code == 70
    assert "has a defect" in json.loads(ended.out)["error"]["message"]


@pytest.mark.parametrize("text", ["[" * 100_000, "\xff", "null", '{"a"', "1" * 5000])
def test_an_entry_of_the_store_that_is_none(text: str, tmp_path: Path) -> None:
    store = ResultStore(tmp_path)
    (tmp_path / "key.json").write_bytes(text.encode("latin-1"))
    assert store.value("key") is None


@pytest.mark.parametrize("name", ["job.mod", "cell.rspag", "EIO.cfg", "table.stl"])
def test_a_file_that_git_lfs_has_not_fetched(name: str, tmp_path: Path) -> None:
    pointer = f"version https://git-lfs.github.com/spec/v1\noid sha256:{64 * '0'}\nsize 4711\n"
    (tmp_path / name).write_text(pointer)
    station = (
        '[robot]\nmodel = "irb120"\n[[object]]\nname = "table"\nmesh = "table.stl"\nunit = "mm"\n'
    )
    if name == "table.stl":
        (tmp_path / "rapidsim.toml").write_text(station)
    (tmp_path / "plain.mod").write_text(PROGRAM)
    of_cell = "plain.mod" if name == "table.stl" else name
    ended = call("init" if name.endswith("cfg") else "check", of_cell, cwd=tmp_path)
    assert ended.code == 2
    assert f"{name} is a Git LFS pointer, without content\n" in ended.err
    assert ended.err.endswith("help: run `git lfs pull`\n")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no such pipes")
def test_nobody_waits_for_a_pipe(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "key.json")
    assert ResultStore(tmp_path).text("key") is None
    (tmp_path / "job.mod").write_text(PROGRAM)
    ended = call("run", "job.mod", "--replay", "key.json", cwd=tmp_path)
    assert (ended.code, ended.err) == (2, "error: key.json is no file but a pipe\n")
