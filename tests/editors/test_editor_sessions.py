"""Recipes of `editors/` in the editors themselves, with `rapidsim lsp` as a user has it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from code_server_script import SCRIPT, or_skip

pytestmark = pytest.mark.screen

HERE = Path(__file__).parent
RECIPES = HERE.parents[1] / "editors"
PROGRAM = """MODULE cell
    CONST robtarget pHome := [[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    PROC main()
        VAR num count;
        count := cuont + 1;
        MoveJ pHome, v500, fine, tool0;
    ENDPROC
ENDMODULE
"""
FINDING = "`cuont` is not declared\ndid you mean `count`?"
DOWNLOADS = "RAPIDSIM_CODE_SERVER"
"""Names the folder for code-server, 800 MB that take a minute to come; without it no VS Code."""


def need(program: str) -> str:
    found = shutil.which(program)
    if found is None:
        pytest.skip(f"{program} is not installed")
    return found


def session(command: list[str], folder: Path, **variables: Path) -> dict[str, Any]:
    """Run an editor without a screen in a folder; return what its script has written."""
    folder.mkdir(exist_ok=True)
    (folder / "cell.mod").write_text(PROGRAM)
    result = folder / "result.json"
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    environment = {**os.environ, "PATH": path, "HOME": str(folder), "RESULT": str(result)}
    environment.update({name: str(value) for name, value in variables.items()})
    ended = subprocess.run(
        command,
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=180,
        check=False,
    )
    assert result.is_file(), ended.stdout + ended.stderr
    seen: dict[str, Any] = json.loads(result.read_text(encoding="utf-8"))
    assert "problem" not in seen, seen["problem"]
    return seen


def test_neovim(tmp_path: Path) -> None:
    nvim = need("nvim")
    plugins = tmp_path / "config" / "nvim" / "plugin"
    plugins.mkdir(parents=True)
    shutil.copy(RECIPES / "neovim.lua", plugins / "rapid.lua")
    places = {
        f"XDG_{name}_HOME": tmp_path / name.lower() for name in ("CONFIG", "DATA", "STATE", "CACHE")
    }
    script = f"luafile {HERE / 'neovim_session.lua'}"
    command = [nvim, "--headless", "-n", "cell.mod", "-c", script]
    seen = session(command, tmp_path / "cell", **places)
    assert seen["filetype"] == "rapid"
    assert seen["findings"] == [["N201", 6, FINDING]]
    assert "Position 600, 0, 800 mm" in seen["hover"]
    assert seen["definition"] == 2
    assert seen["mapped"] is True
    assert seen["text"].rstrip() == PROGRAM.replace("pHome", "pRest").rstrip()


def test_emacs(tmp_path: Path) -> None:
    emacs = need("emacs")
    probe = [emacs, "--batch", "--eval", "(require 'eglot)"]
    if subprocess.run(probe, capture_output=True, timeout=60, check=False).returncode:
        pytest.skip("Emacs has no eglot")
    shutil.copy(RECIPES / "emacs.el", tmp_path / "rapid.el")
    script = str(HERE / "emacs_session.el")
    command = [emacs, "--batch", "-L", str(tmp_path), "-l", script, "cell.mod"]
    seen = session(command, tmp_path / "cell")
    assert seen["mode"] == "rapid-mode"
    assert seen["comment"] == "! "
    assert seen["findings"] == [[6, f"rapidsim [N201]: {FINDING}"]]
    assert "Position 600, 0, 800 mm" in seen["hover"]
    assert seen["definition"] == 2
    assert seen["text"] == PROGRAM.replace("pHome", "pRest")


@pytest.mark.skipif(
    DOWNLOADS not in os.environ, reason=f"{DOWNLOADS} names no folder for downloads"
)
def test_vscode(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    programs = or_skip(SCRIPT.install, Path(os.environ[DOWNLOADS]))
    extension = or_skip(SCRIPT.package_extension, tmp_path)
    folder = tmp_path / "cell"
    folder.mkdir()
    runs = PROGRAM.replace("cuont", "count").replace("fine", "z50")
    (folder / "cell.mod").write_text(
        runs.replace("    ENDPROC", "        WaitTime 1;\n    ENDPROC")
    )
    monkeypatch.setenv("FAILURE", str(tmp_path / "failure.png"))
    with SCRIPT.serve(programs, extension, tmp_path / "server") as url:
        printed = programs.drive(HERE / "vscode_session.mjs", url, folder, "cell.mod", 7)
    seen = json.loads(printed)
    message = "MoveJ with zone `z50`, then WaitTime: the corner becomes a stop"
    assert message in "".join(seen["problems"])
    assert seen["squiggles"] == 1
    assert seen["lenses"] == ["Run | Record"]
    assert {"Run", "Record", "Debug"} <= {label.partition(" (")[0] for label in seen["buttons"]}
    assert seen["language"] == "RAPID"
    assert seen["stack"][0].startswith("main")
    assert [name.strip() for name in seen["scopes"]][:2] == ["Routine", "Module"]
