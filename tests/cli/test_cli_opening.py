"""The command that a summary names works in the shell where it is typed."""

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from rapidsim.cli.open_command import Shell, command_line, open_command, shell_of

WINDOWS = {"PSModulePath": r"C:\Modules"}


@pytest.mark.parametrize(
    ("system", "variables", "shell"),
    [
        ("posix", {}, Shell.POSIX),
        ("nt", WINDOWS, Shell.POWERSHELL),
        ("nt", {**WINDOWS, "PROMPT": "$P$G"}, Shell.CMD),
        ("nt", {**WINDOWS, "MSYSTEM": "MINGW64"}, Shell.POSIX),
    ],
)
def test_the_shell_is_known_by_what_it_sets(
    system: str, variables: Mapping[str, str], shell: Shell
) -> None:
    assert shell_of(system, variables) is shell


@pytest.mark.parametrize(
    ("shell", "program", "file", "typed"),
    [
        (Shell.POSIX, "rerun", "cell.rrd", "rerun cell.rrd"),
        (Shell.POSIX, ".venv/bin/rerun", "a b.rrd", ".venv/bin/rerun 'a b.rrd'"),
        (Shell.CMD, r"C:\my env\rerun.exe", "a & b.rrd", r'"C:\my env\rerun.exe" "a & b.rrd"'),
        (Shell.POWERSHELL, r".venv\Scripts\rerun.exe", "a.rrd", r".venv\Scripts\rerun.exe a.rrd"),
        (
            Shell.POWERSHELL,
            r"C:\my env\rerun.exe",
            "o'b.rrd",
            r"& 'C:\my env\rerun.exe' 'o''b.rrd'",
        ),
    ],
)
def test_words_are_quoted_as_a_shell_wants_it(
    shell: Shell, program: str, file: str, typed: str
) -> None:
    assert command_line(program, Path(file), shell) == typed


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
@pytest.mark.parametrize("name", ["cell.rrd", "pick & $HOME `x`.rrd", "it's.rrd", "-q.rrd"])
def test_bash_opens_the_recording(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The viewer is beside the program, and no path leads there."""
    scripts = tmp_path / "my env"
    scripts.mkdir()
    viewer = scripts / "rerun"
    viewer.write_text('#!/bin/sh\n[ -f "$1" ] && echo "shows $1"\n')
    viewer.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", "/usr/bin:/bin")
    if shutil.which("rerun"):
        pytest.skip("a viewer is installed for everybody")
    monkeypatch.setattr(sys, "argv", [os.path.relpath(scripts / "rapidsim")])
    Path(name).touch()
    ended = subprocess.run(
        ["bash", "-c", open_command(Path(name))], capture_output=True, check=False
    )
    assert ended.stdout.decode().strip().removeprefix("shows ").removeprefix("./") == name
