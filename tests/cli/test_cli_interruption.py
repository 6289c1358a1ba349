"""Ctrl-C at any instant: one line, exit code 130 or the normal one, never a traceback."""

import subprocess
import sys
from pathlib import Path

import pytest

# Tests that run in the background are deaf to Ctrl-C, and so are their children.
HEARS = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
SENDS_ITSELF_A_SIGNAL = """
import os, signal, sys
from rapidsim.cli import main
left = int(sys.argv.pop(1))
def heard(event, arguments):
    # Modules are imported all along, which makes them a clock that does not depend on the machine.
    global left
    if event == "import":
        left -= 1
        if left == 0:
            os.kill(os.getpid(), signal.SIGINT)
sys.addaudithook(heard)
main()
"""
PROGRAM = """MODULE job
  PROC main()
    MoveAbsJ [[10,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
  ENDPROC
ENDMODULE
"""


def interrupted(instant: int, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    (folder / "job.mod").write_text(PROGRAM)
    return subprocess.run(
        [sys.executable, "-c", HEARS + SENDS_ITSELF_A_SIGNAL, str(instant), *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize("instant", [1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144, 200])
def test_while_the_command_line_loads_and_checks(instant: int, tmp_path: Path) -> None:
    done = interrupted(instant, tmp_path, "check", "job.mod")
    assert (done.returncode, done.stderr, done.stdout) == (130, "interrupted\n", "")


@pytest.mark.parametrize("instant", [250, 300, 350, 400, 450, 500, 600, 700, 900, 1200])
def test_while_a_program_runs_and_is_recorded(instant: int, tmp_path: Path) -> None:
    done = interrupted(instant, tmp_path, "run", "job.mod")
    assert (done.returncode, done.stderr) in ((130, "interrupted\n"), (0, ""))
    assert not [one for one in tmp_path.iterdir() if one.name.endswith(".part")]


def test_a_command_in_the_background_stays_deaf(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    deaf = "import signal; signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
    done = subprocess.run(
        [sys.executable, "-c", deaf + SENDS_ITSELF_A_SIGNAL, "20", "check", "job.mod"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
