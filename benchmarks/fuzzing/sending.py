"""Send a program through the commands, in this process, and tell what must never happen.

Never: an exit code that no page promises, a traceback, the line that reports a defect, an exception
that passes the command line, more of the processor's time than a run was given.
"""

from __future__ import annotations

import io
import re
import signal
import sys
import time
import traceback
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from unittest import mock

from rapidsim.cli.boundary import run_commands
from rapidsim.reach.trial_run import LONGEST_WORK_S

SOUND = (0, 1, 2, 3, 4)
"""Exit codes of commands that nobody interrupted; 70 is a defect."""
INTERRUPTED = (130, 143)
MAX_WALL = 2.0
GRACE = 2.0
"""Seconds of the processor that a command may take beyond its `--max-wall`."""
CHECK_LIMIT = LONGEST_WORK_S + GRACE
"""Processor time [s]: of an endless loop `check` runs 120 s of virtual time, or so long."""
_FRAME = re.compile(r'File "[^"]*/(rapidsim/[^"]+|<[^"]+>)", line \d+, in (\S+)')
_FRAMES = 2
HANGS = "Hang"


class Hang(BaseException):
    """A command took too long."""


@dataclass(frozen=True)
class Ended:
    """How a command ended."""

    arguments: tuple[str, ...]
    code: int
    out: str
    err: str
    seconds: float
    """Of the processor."""


@dataclass(frozen=True)
class Failure:
    """What must never happen; failures with one signature have one cause."""

    signature: str
    arguments: tuple[str, ...]
    text: str

    @property
    def hangs(self) -> bool:
        """Whether it is a matter of time; the place then is where the alarm found the command."""
        return self.signature.startswith(HANGS)


def send(*arguments: object, limit: float | None = None) -> tuple[Ended, Failure | None]:
    """Carry out one command and judge how it ended.

    What takes too long is tried again: the first command that needs a formula may compile it.
    """
    given = tuple(map(str, arguments))
    limit = limit or (CHECK_LIMIT if given[0] == "check" else MAX_WALL + GRACE)
    ended, failure = _sent(given, limit)
    return _sent(given, limit) if failure is not None and failure.hangs else (ended, failure)


def _sent(given: tuple[str, ...], limit: float) -> tuple[Ended, Failure | None]:
    begin = time.process_time()
    with _streams() as (out, err):
        code, passed = _guarded(given, limit)
    seconds = time.process_time() - begin
    if code in INTERRUPTED:
        # The command took what was meant for the fuzzer.
        sys.exit(code)
    ended = Ended(given, code, _text(out), _text(err), seconds)
    text = ended.err + passed
    if passed or "Traceback (most recent call last)" in text or code not in SOUND:
        return ended, Failure(_signature(text, code), given, text)
    if seconds > limit:
        return ended, Failure(f"{HANGS} {given[0]}", given, f"{seconds:.1f} s of the processor")
    return ended, None


def _guarded(arguments: Sequence[str], limit: float) -> tuple[int, str]:
    """Exit code, and the traceback of what passed the command line."""
    before = signal.signal(signal.SIGPROF, _too_long)
    # Again and again: whoever catches everything would catch one alarm.
    signal.setitimer(signal.ITIMER_PROF, limit, 1.0)
    try:
        return run_commands(arguments), ""
    except KeyboardInterrupt:
        raise
    except BaseException:
        signal.setitimer(signal.ITIMER_PROF, 0)
        return -1, traceback.format_exc()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def _too_long(number: int, frame: FrameType | None) -> None:
    raise Hang


@contextmanager
def _streams() -> Iterator[tuple[io.TextIOWrapper, io.TextIOWrapper]]:
    out, err, nothing = (_stream() for _ in range(3))
    with (
        mock.patch.object(sys, "stdout", out),
        mock.patch.object(sys, "stderr", err),
        mock.patch.object(sys, "stdin", nothing),
    ):
        yield out, err


def _stream() -> io.TextIOWrapper:
    return io.TextIOWrapper(io.BytesIO(), "utf-8", errors="replace", newline="\n")


def _text(stream: io.TextIOWrapper) -> str:
    stream.flush()
    stream.seek(0)
    return stream.read()


def _signature(text: str, code: int) -> str:
    """The exception and the innermost functions of ours that it came from."""
    last = text.rstrip().split("Traceback (most recent call last)")[-1]
    frames = [(file, f"{Path(file).name}:{name}") for file, name in _FRAME.findall(last)]
    places = [place for _, place in frames]
    if f"{Hang.__name__}\n" in f"{last}\n":
        # What it was busy with; the innermost place is where the alarm found it.
        busy = [place for file, place in frames if not file.startswith("rapidsim/cli/")]
        return " ".join([HANGS, *busy[:_FRAMES]])
    kinds = re.findall(r"^(?:\w+\.)*(\w+)(?::|$)", last, re.MULTILINE)
    kind = next((k for k in reversed(kinds) if k[0].isupper()), f"exit {code}")
    return " ".join([kind, *places[-_FRAMES:]])
