"""Call the command line as its user does: arguments in, exit code and text out.

A process for each call would cost most of the suite's time for starting Python. So the calls go to
the very function that a process calls, with streams, folder, environment and warnings as a process
has them. Tests of what only a process has carry the mark `process`, which starts a real one;
`COMMAND_LINE=process` does so for all.
"""

import contextlib
import io
import os
import subprocess
import sys
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

from rapidsim.cli.boundary import run_commands
from rapidsim.cli.exit_codes import ExitCode

SWITCH = "COMMAND_LINE"
PASSED_ON = ("PATH", "HOME", "OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE")
"""Variables that a process takes from this one; the last choose how NumPy's library computes, and
so the last digit of what it computes."""
PROCESS = "process"


@dataclass(frozen=True)
class Ended:
    code: int
    out: str
    err: str


def call(
    *arguments: object,
    cwd: Path,
    stdin: bytes = b"",
    columns: int = 80,
    environment: Mapping[str, str] | None = None,
    terminal: bool = False,
) -> Ended:
    """Run `rapidsim` with its arguments.

    Args:
        arguments: Of the command line.
        cwd: Where it is called.
        stdin: What it is given to read.
        columns: How wide its output may be.
        environment: Variables beyond those that every process has.
        terminal: Whether its streams say that they are a terminal.
    """
    words = [str(argument) for argument in arguments]
    variables = {
        **{name: os.environ[name] for name in PASSED_ON if name in os.environ},
        "COLUMNS": str(columns),
        "PYTHONIOENCODING": "utf-8",
        "RAPIDSIM_NO_CACHE": "1",
        **(environment or {}),
    }
    if os.environ.get(SWITCH) == PROCESS and not terminal:
        code, out, err = _in_a_process(words, cwd, stdin, variables)
    else:
        code, out, err = _here(words, cwd, stdin, variables, _Terminal if terminal else _Stream)
    ended = Ended(code, out.decode(), err.decode())
    assert "Traceback" not in ended.err
    return ended


_Stream = io.TextIOWrapper


class _Terminal(io.TextIOWrapper):
    """A stream that believes to be one."""

    def isatty(self) -> bool:
        return True


def _in_a_process(
    arguments: list[str], cwd: Path, stdin: bytes, environment: Mapping[str, str]
) -> tuple[int, bytes, bytes]:
    done = subprocess.run(
        [sys.executable, "-W", "error", "-m", "rapidsim", *arguments],
        cwd=cwd,
        input=stdin,
        capture_output=True,
        env=environment,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


def _here(
    arguments: list[str],
    cwd: Path,
    stdin: bytes,
    environment: Mapping[str, str],
    stream: type[io.TextIOWrapper],
) -> tuple[int, bytes, bytes]:
    given, out, err = io.BytesIO(stdin), io.BytesIO(), io.BytesIO()
    with (
        contextlib.chdir(cwd),
        patch.dict(os.environ, environment, clear=True),
        warnings.catch_warnings(),
        patch("sys.stdin", stream(given, encoding="utf-8")),
        patch("sys.stdout", stream(out, encoding="utf-8")) as stdout,
        patch("sys.stderr", stream(err, encoding="utf-8")) as stderr,
    ):
        warnings.simplefilter("error")
        code = run_commands(arguments)
        stdout.flush()
        stderr.flush()
        if code == ExitCode.INTERRUPTED:
            raise KeyboardInterrupt  # Meant for the tests.
        return code, out.getvalue(), err.getvalue()
