"""Whatever a file that the user names turns out to be: a message, an exit code, no waiting."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from rapidsim.cli.boundary import run_commands

PROGRAM = 'MODULE job\n  PROC main()\n    TPWrite "done";\n  ENDPROC\nENDMODULE\n'
MANY = 2_000_000
DEEP = 5_000


def nothing(file: Path) -> None:
    del file


def binary(file: Path) -> None:
    file.write_bytes(bytes(range(256)) * 40)


def utf_16(file: Path) -> None:
    file.write_text('<?xml version="1.0"?><!DOCTYPE r [<!ENTITY a "b">]><robot/>', "utf-16")


def nested_json(file: Path) -> None:
    file.write_text('{"a":' * DEEP)


def nested_toml(file: Path) -> None:
    file.write_text("a = " + "[" * DEEP)


def nested_xml(file: Path) -> None:
    file.write_text("<a>" * DEEP)


def device(file: Path) -> None:
    file.symlink_to("/dev/zero")


def one_character(file: Path) -> None:
    file.write_text("a" * MANY)


def locked(file: Path) -> None:
    file.write_text("")
    file.chmod(0)


def pipe(file: Path) -> None:
    os.mkfifo(file)


KINDS: dict[str, Callable[[Path], None]] = {
    "missing": nothing,
    "folder": Path.mkdir,
    "empty": Path.touch,
    "binary": binary,
    "utf-16": utf_16,
    "nested json": nested_json,
    "nested toml": nested_toml,
    "nested xml": nested_xml,
    "pipe": pipe,
    "device": device,
    "locked": locked,
    "link to itself": lambda file: file.symlink_to(file),
    "one character": one_character,
}
OPTIONS: dict[str, tuple[str, ...]] = {
    "module": ("check", "bad.mod"),
    "run module": ("run", "bad.mod", "--no-record"),
    "program file": ("check", "bad.pgf"),
    "unknown suffix": ("check", "bad.txt"),
    "station": ("run", "job.mod", "--no-record", "--station", "bad.toml"),
    "io": ("run", "job.mod", "--no-record", "--io", "bad.toml"),
    "answers": ("run", "job.mod", "--no-record", "--answers", "bad.txt"),
    "robot": ("kin", "fk", "--joints", "0,0,0,0,0,0", "--robot", "bad.urdf"),
    "baseline": ("check", "job.mod", "--baseline", "bad.json"),
    "points": ("follow", "bad.csv"),
    "log": ("calibrate", "bad.csv", "--program", "job.mod"),
    "recording": ("view", "bad.rrd"),
}
# What is fine: any text is an answer, an empty table of signals has none, a baseline that is not
# there is made, a module full of mistakes has findings.
FINE = {
    ("station", "empty"): (0,),
    ("io", "empty"): (0,),
    ("baseline", "missing"): (0,),
    ("baseline", "link to itself"): (0,),
    **{("answers", kind): (0,) for kind in KINDS if kind not in ("missing", "folder", "pipe")},
    **{(module, kind): (1, 2) for module in ("module", "run module") for kind in KINDS},
    **{("answers", kind): (2,) for kind in ("device", "link to itself", "locked")},
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("option", OPTIONS)
def test_a_broken_file_is_told(
    option: str,
    kind: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    if kind == "locked" and (os.name != "posix" or os.geteuid() == 0):
        pytest.skip("root and Windows read every file")
    if kind in ("pipe", "device") and os.name != "posix":
        pytest.skip("this system has no such files")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "job.mod").write_text(PROGRAM)
    arguments = OPTIONS[option]
    name = next(one for one in arguments if one.startswith("bad."))
    KINDS[kind](tmp_path / name)
    code = run_commands(arguments)
    out, err = capsys.readouterr()
    assert code in FINE.get((option, kind), (2,))
    assert len(out) + len(err) < 3000
    if code == 2:
        assert err.startswith("error: ")
        assert len(err.splitlines()) <= 2
