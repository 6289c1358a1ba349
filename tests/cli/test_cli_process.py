"""What the tests call here says what a process says: the promise of `command_line`."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

import pytest
from cli_helper import PROGRAMS, rapidsim
from command_line import SWITCH, Ended


@pytest.mark.process
@pytest.mark.parametrize(
    "arguments",
    [
        ("run", "cell.mod", "--no-record", "--assert", "time_s < 0.1"),
        ("check", "-"),
        ("check", "weld.mod"),
        ("robots", "irb120"),
    ],
    ids=lambda arguments: " ".join(arguments[:2]),
)
def test_a_call_and_a_process_say_the_same(
    arguments: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (PROGRAMS / "wrong.mod").read_bytes()
    process = rapidsim(*arguments, stdin=text, columns=60)
    monkeypatch.delenv(SWITCH)
    assert timeless(rapidsim(*arguments, stdin=text, columns=60)) == timeless(process)


@pytest.mark.process
def test_a_process_ends_at_once_but_does_what_others_asked_for(tmp_path: Path) -> None:
    """Coverage, profilers and recordings write when the process ends."""
    code = (
        "import atexit, sys, threading\n"
        "from rapidsim.cli import main\n"
        "class Late:\n    def __del__(self): print('taken down')\n"
        "late = Late()\n"
        "atexit.register(print, 'asked for')\n"
        "def work():\n    threading.main_thread().join()\n    print('worked')\n"
        "if sys.argv.pop() == 'thread': threading.Thread(target=work).start()\n"
        "main()\n"
    )
    said = [
        subprocess.run(
            [sys.executable, "-c", code, "--version", other],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=True,
        ).stdout.splitlines()[1:]
        for other in ("nothing", "thread")
    ]
    assert said == [["asked for"], ["worked", "asked for", "taken down"]]


def test_a_call_leaves_no_trace(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NO_COLOR", "kept")
    before = kept_by_the_process()
    assert rapidsim("run", "cell.mod", "--no-record", environment={"TEST": "1"}).code == 0
    assert kept_by_the_process() == before


def kept_by_the_process() -> tuple[object, ...]:
    streams = sys.stdin, sys.stdout, sys.stderr
    filters = tuple(warnings.filters)
    return Path.cwd(), dict(os.environ), streams, filters, sys.getrecursionlimit(), sys.gettrace()


def timeless(ended: Ended) -> Ended:
    return Ended(ended.code, re.sub(r"\d+\.\d\d s\)", "s)", ended.out), ended.err)
