"""What happens at the edge of the process: defects, interruption, closed pipes, colours."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from cli_helper import rapidsim

BROKEN = """
import rapidsim.report.rules as rules
def fail():
    raise {what}
rules.rules = fail
from rapidsim.cli import main
main()
"""


def broken(what: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run `explain` of an installation in which it fails."""
    return subprocess.run(
        [sys.executable, "-c", BROKEN.format(what=what), "explain", "N201", *arguments],
        capture_output=True,
        text=True,
        check=False,
    )


def test_a_defect_is_one_line_that_says_how_to_report_it() -> None:
    done = broken("KeyError('lost')")
    assert (done.returncode, done.stdout) == (70, "")
    assert len(done.stderr.splitlines()) == 1
    for part in ("has a defect", "KeyError: 'lost'", "please report"):
        assert part in done.stderr


def test_a_defect_shows_its_traceback_when_asked() -> None:
    done = broken("KeyError('lost')", "-v")
    assert done.returncode == 70
    assert "Traceback (most recent call last)" in done.stderr
    assert "please report" in done.stderr.splitlines()[-1]


def test_an_interruption_is_one_line() -> None:
    done = broken("KeyboardInterrupt")
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


def test_a_closed_pipe_is_quiet() -> None:
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [sys.executable, "-m", "rapidsim", "explain", "--all"],
        stdout=writing,
        stderr=subprocess.PIPE,
        check=False,
    )
    os.close(writing)
    assert (done.returncode, done.stderr) == (141, b"")


def on_a_terminal(*arguments: str, **environment: str) -> bytes:
    """Standard output of a command that believes to write to a terminal."""
    pty = pytest.importorskip("pty", reason="this system has no pseudo terminals")
    reading, writing = pty.openpty()
    subprocess.run(
        [sys.executable, "-m", "rapidsim", *arguments],
        stdout=writing,
        stdin=subprocess.DEVNULL,
        env={"PATH": os.environ["PATH"], "TERM": "xterm", "COLUMNS": "80", **environment},
        check=False,
    )
    os.close(writing)
    output = b""
    while True:
        try:
            output += os.read(reading, 65536)
        except OSError:
            os.close(reading)
            return output


@pytest.mark.parametrize("arguments", [("explain", "N201"), ("robots",), ("check", "wrong.mod")])
def test_colours_are_for_terminals_that_want_them(
    arguments: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wrong.mod").write_text("MODULE a\n  PROC main()\n    x:=;\n  ENDPROC\nENDMODULE\n")
    assert b"\x1b[" in on_a_terminal(*arguments)
    assert b"\x1b" not in on_a_terminal(*arguments, NO_COLOR="1")
    assert b"\x1b" not in on_a_terminal(*arguments, TERM="dumb")
    assert b"\x1b" not in on_a_terminal(*arguments, "--no-color")
    assert "\x1b" not in rapidsim(*arguments, cwd=tmp_path).out
