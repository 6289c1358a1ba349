"""RAPID under pytest: the example of the repository, what a failure shows, covered lines."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[2] / "programs" / "tested"
PLUGIN = "rapidsim.pytest_plugin"

FAILING = """MODULE test_wrong
  PROC half(num n)
    halve n;
  ENDPROC
  PROC halve(num n)
    n:=n/0;
  ENDPROC
  PROC test_division()
    half 4;
  ENDPROC
  PROC test_that_stops()
    EXIT;
  ENDPROC
  PROC test_of_the_home_folder()
    VAR iodev log;
    Open "HOME:"\\File:="log.txt", log\\Append;
    Write log, "once";
    Close log;
    IF FileSize("HOME:/log.txt")>6 RAISE ERR_ARGVALERR;
  ENDPROC
  PROC helper()
  ENDPROC
ENDMODULE
"""
BROKEN = "MODULE test_broken\n  PROC test_nothing()\n    x:=1;\n  ENDPROC\nENDMODULE\n"


def run_pytest(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """In a process of its own, as the plugin's user has it; only this plugin is there."""
    environment = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "COLUMNS": "100"}
    environment.pop("PYTEST_ADDOPTS", None)
    return subprocess.run(
        [sys.executable, *arguments, "-p", PLUGIN, "--rootdir", ".", "-c", os.devnull],
        cwd=folder,
        capture_output=True,
        text=True,
        env=environment,
        check=False,
    )


@pytest.mark.process
def test_the_example_passes_and_its_lines_are_counted(tmp_path: Path) -> None:
    shutil.copytree(EXAMPLE, tmp_path / "tested")
    (tmp_path / "tested" / ".coveragerc").write_text(
        "[run]\nplugins = rapidsim.interpreter.tools.coverage_plugin\nsource = .\n"
    )
    covered = ("-m", "coverage", "run", "-m", "pytest", "-q", "-p", "no:cacheprovider")
    ended = run_pytest(tmp_path / "tested", *covered)
    assert "11 passed" in ended.stdout, ended.stdout + ended.stderr
    report = subprocess.run(
        [sys.executable, "-m", "coverage", "report", "-m"],
        cwd=tmp_path / "tested",
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert [line.split()[3] for line in report.splitlines() if line.startswith("stack.mod")] == [
        "100%"
    ]
    written = {one.name for one in (tmp_path / "tested").iterdir()} - {"__pycache__"}
    assert written == {".coverage", ".coveragerc", *(one.name for one in EXAMPLE.glob("*.*"))}


@pytest.mark.process
def test_a_failure_shows_the_rapid_stack(tmp_path: Path) -> None:
    (tmp_path / "test_wrong.mod").write_text(FAILING)
    (tmp_path / "test_broken.mod").write_text(BROKEN)
    ended = run_pytest(tmp_path, "-m", "pytest", "-q", "-p", "no:cacheprovider")
    shown = ended.stdout
    assert "3 failed, 1 passed" in shown
    assert "division by zero" in shown
    for line in ("    n:=n/0;", "    halve n;", "    half 4;"):
        assert line in shown
    assert "test_wrong.mod::test_that_stops" in shown
    assert "`x` is not declared" in shown
    assert "Traceback" not in shown
