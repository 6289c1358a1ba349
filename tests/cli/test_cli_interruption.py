"""Ctrl-C at any instant: one line, exit code 130 or the normal one, never a traceback."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from cli_helper import HEARS
from exports import ROBOT, export

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


@pytest.mark.parametrize("instant", [1, 3, 8, 21, 55, 89, 144, 200])
def test_while_the_command_line_loads_and_checks(instant: int, tmp_path: Path) -> None:
    done = interrupted(instant, tmp_path, "check", "job.mod")
    assert (done.returncode, done.stderr, done.stdout) == (130, "interrupted\n", "")


@pytest.mark.parametrize("instant", [250, 350, 450, 600, 900, 1200])
def test_while_a_program_runs_and_is_recorded(instant: int, tmp_path: Path) -> None:
    done = interrupted(instant, tmp_path, "run", "job.mod")
    said = re.fullmatch(r"interrupted(| at .*| after the run .*)\n|", done.stderr)
    assert said
    assert done.returncode == (130 if done.stderr else 0)
    assert not [one for one in tmp_path.iterdir() if one.name.endswith(".part")]


SENDS_ITSELF_A_SIGNAL_AT = """
import os, signal, sys, time
from rapidsim.cli import main
from rapidsim.controller.cell.watchdog import Watchdog
from rapidsim.controller.journal.journal import Journal
from rapidsim.jobs.checking import load_tasks
load_tasks.MOST_STATEMENTS = 20
what, left = sys.argv.pop(1), int(sys.argv.pop(1))
def heard():
    global left
    left -= 1
    if left == 0:
        os.kill(os.getpid(), signal.SIGINT)
        # A thread ends the run, which goes on until then.
        while what == "line" and not Watchdog.runs_ended:
            time.sleep(0.01)
noted = Journal.line
def line(journal, moment, place):
    if what == "line":
        heard()
    noted(journal, moment, place)
Journal.line = line
def audited(event, arguments):
    if what == "file" and event == "open" and str(arguments[0]).endswith(".part"):
        heard()
sys.addaudithook(audited)
main()
"""
_MOVES = 45


def _large_run(instant: tuple[str, int], folder: Path) -> subprocess.CompletedProcess[str]:
    folder.mkdir()
    (folder / "export.mod").write_text(
        export("inline", "spiral", _MOVES).replace(
            "PROC main()", "PERS num k:=0; PROC main() k:=1;"
        )
    )
    return subprocess.run(
        [
            *(sys.executable, "-c", HEARS + SENDS_ITSELF_A_SIGNAL_AT, *map(str, instant)),
            *("run", "export.mod", "--robot", ROBOT, "--dt", "0.5", "--record", "r.rrd"),
            *(("--write-pers",) if instant[0] == "line" else ()),
            *("--trace", "t.csv", "--report", "r.html", "--events", "e.jsonl"),
        ],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.process
@pytest.mark.parametrize("line", [1, 3])
def test_while_the_moves_of_a_large_program_are_made(line: int, tmp_path: Path) -> None:
    done = _large_run(("line", line), tmp_path / "here")
    assert done.returncode == 130
    told = re.fullmatch(
        r"interrupted at [0-9.]+ s: ([0-9,]+) moves made(?:, [0-9,]+ more on the way)?, "
        r"the program at export.mod:([0-9]+); Ctrl-C again ends the writing of outputs\n",
        done.stderr,
    )
    assert told, done.stderr
    assert line <= int(told[2]) - 3 < _MOVES
    assert "note[R109] time-limit: the run was interrupted" in done.stdout
    assert "export.mod on ABB IRB 4600-45/2.05 cut off after" in done.stdout
    there = {one.name for one in (tmp_path / "here").iterdir()}
    assert {"r.rrd", "t.csv", "r.html", "e.jsonl"} < there
    assert not [one for one in there if one.endswith(".part")]
    # The program is not changed by a run that was broken off.
    assert "PERS num k:=0;" in (tmp_path / "here" / "export.mod").read_text()


@pytest.mark.process
def test_while_the_outputs_of_a_large_program_are_written(tmp_path: Path) -> None:
    whole = _large_run(("file", 0), tmp_path / "whole")
    assert whole.returncode == 0, whole.stderr
    complete = {one.name: one.read_bytes() for one in (tmp_path / "whole").iterdir()}
    assert {"r.rrd", "t.csv", "r.html", "e.jsonl"} <= set(complete)
    done = _large_run(("file", 2), tmp_path / "file 2")
    assert done.returncode == 130, done.stderr
    assert re.fullmatch(
        rf"interrupted after the run \([0-9.]+ s, {_MOVES} moves\): not all outputs were written\n",
        done.stderr,
    ), done.stderr
    there = {one.name: one.read_bytes() for one in (tmp_path / "file 2").iterdir()}
    assert len(there) > 1
    assert there.keys() < complete.keys()
    # Recordings carry an identity of their own.
    assert all(there[name] == complete[name] for name in there if name != "r.rrd")


INTERRUPTS_A_REPLAY = """
import signal
from types import SimpleNamespace
from rapidsim.cli import main
from rapidsim.server import replay
from rapidsim.simulation.progress import Progress
def replayed(*arguments):
    # It begins as a replay does.
    arguments[-1](SimpleNamespace(progress=lambda: Progress(0, 0, 0), cell=None))
    signal.raise_signal(signal.SIGINT)
replay.replay_journal, replay.replayed = lambda path: None, replayed
main()
"""


@pytest.mark.process
def test_a_replay_is_interrupted_at_once(tmp_path: Path) -> None:
    """Half of it would differ from its journal, so that there is nothing to write."""
    (tmp_path / "job.mod").write_text(PROGRAM)
    done = subprocess.run(
        [
            *(sys.executable, "-c", HEARS + INTERRUPTS_A_REPLAY),
            *("run", "job.mod", "--replay", "a.jsonl"),
        ],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    told = "interrupted at 0.000 s: 0 moves made; no output was written\n"
    assert (done.returncode, done.stdout, done.stderr) == (130, "", told)
    assert [one.name for one in tmp_path.iterdir()] == ["job.mod"]


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
