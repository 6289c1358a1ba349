"""One error of the system at each call of a command that reads or writes.

Whatever file, folder or memory the system refuses, and whenever: the command ends with an exit code
of use and a sentence, a file that was there is the old or the new one, whole, and no piece stays.
"""

from __future__ import annotations

import builtins
import csv
import errno
import functools
import gc
import io
import json
import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType
from typing import Any
from unittest import mock

from fuzzing.sending import Ended, send

MODULE = """MODULE job
  PERS num count:=1;
  VAR iodev file;
  VAR string line;
  PROC main()
    Incr count;
    Open "HOME:"\\File:="log.txt",file\\Write;
    Write file,"count"\\Num:=count;
    Close file;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v1000,fine,tool0;
    MoveJ [[800,0,900],[0.5,0,0.866025,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,z10,tool0;
    SetDO doDone,1;
  ENDPROC
ENDMODULE
"""
_STATION = """[robot]
model = "irb1600-6-1.2"

[[object]]
name = "table"
box = [100, 100, 100]
pose = { position = [3000, 0, 0] }
"""
_POINTS = "x,y,z\n700,0,700\n750,0,700\n800,50,700\n"
OLDER = "older\n"
COMMANDS: dict[str, tuple[str, ...]] = {
    "check": ("check", "job.mod"),
    "check as sarif": ("check", ".", "--output-format", "sarif"),
    "check --fix": ("check", "loose.mod", "--fix"),
    "check with a baseline": ("check", "job.mod", "--baseline", "known.json", "--update-baseline"),
    "run": ("run", "job.mod", "--no-record", "--trace", "t.csv", "--events", "e.jsonl"),
    "run as json": ("run", "job.mod", "--no-record", "--trace", "t.json", "--format", "json"),
    "run with pictures": ("run", "job.mod", "--record", "r.rrd", "--report", "r.html"),
    "run --write-pers": ("run", "job.mod", "--no-record", "--write-pers"),
    "fmt": ("fmt", "loose.mod"),
    "diff": ("diff", "job.mod", "loose.mod"),
    "init": ("init", "new", "--ci", "github"),
    "frames": ("frames", "job.mod"),
    "robots": ("robots", "irb1600-6-1.2"),
    "follow": ("follow", "points.csv", "--trace", "f.csv"),
    "points": ("points", "--shell", "300,500"),
    "kin": ("kin", "fk", "--joints", "0,0,0,0,30,0"),
    "explain": ("explain", "N201"),
}
FILES = {
    "job.mod": MODULE,
    "loose.mod": "MODULE loose\nVAR num n;\nPROC main()\nIF n=1 n:=2;\nENDPROC\nENDMODULE\n",
    "new/job.mod": MODULE,
    "rapidsim.toml": _STATION,
    "points.csv": _POINTS,
    "t.csv": OLDER,
    "t.json": OLDER,
    "e.jsonl": OLDER,
    "r.rrd": OLDER,
    "r.html": OLDER,
    "f.csv": OLDER,
}
_OPAQUE = (".rrd",)
"""Suffixes of files whose bytes differ from run to run."""
_REMOVES = ("unlink", "replace", "rename", "rmtree", "lstat", "stat", "open")
"""Calls whose failure may leave a piece behind, as it cannot be removed."""
_CALLS = {
    os: ("open", "stat", "lstat", "listdir", "scandir", "replace", "rename", "unlink", "mkdir"),
    shutil: ("disk_usage", "rmtree"),
    tempfile: ("mkdtemp",),
}
_Kept = functools._lru_cache_wrapper
_STREAM = ("read", "write", "flush", "readline")


@dataclass
class Injector:
    """Counts the calls that a command makes of the system, and lets one fail."""

    at: int | None = None
    """Number of the call that fails; None to count only."""
    error: Callable[[str, object], BaseException] = lambda name, path: _os_error(name, path)
    calls: list[str] = field(default_factory=list)
    firsts: dict[tuple[object, ...], int] = field(default_factory=dict)
    """Numbers of the calls that came from a place in the code for the first time."""

    def call(self, name: str, path: object = None) -> None:
        """Count a call, and raise if it is the one."""
        if self.at is None:
            self.firsts.setdefault(_callers(), len(self.calls))
        self.calls.append(name)
        if len(self.calls) - 1 == self.at:
            raise self.error(name, path)

    @contextmanager
    def active(self) -> Iterator[None]:
        """Let calls in here be counted."""
        with ExitStack() as stack:
            for module, names in _CALLS.items():
                for name in names:
                    original = getattr(module, name)
                    stack.enter_context(mock.patch.object(module, name, self._made(name, original)))
            opened = self._opened(io.open)
            for owner in (io, builtins):
                stack.enter_context(mock.patch.object(owner, "open", opened))
            yield

    def _made(self, name: str, original: Callable[..., Any]) -> Callable[..., Any]:
        def made(*arguments: Any, **named: Any) -> Any:
            is_path = bool(arguments) and name not in _STREAM and not isinstance(arguments[0], int)
            self.call(name, arguments[0] if is_path else None)
            return original(*arguments, **named)

        return made

    def _opened(self, original: Callable[..., Any]) -> Callable[..., Any]:
        def opened(file: Any, *arguments: Any, **named: Any) -> Any:
            self.call("open", None if isinstance(file, int) else file)
            return _Stream(original(file, *arguments, **named), self)

        return opened


class _Stream:
    """A stream whose calls are counted."""

    def __init__(self, stream: Any, injector: Injector) -> None:
        self.__dict__.update(stream=stream, injector=injector)

    def __getattr__(self, name: str) -> Any:
        value = getattr(self.stream, name)
        if name not in _STREAM:
            return value
        return self.injector._made(name, value)

    def __enter__(self) -> _Stream:
        self.stream.__enter__()
        return self

    def __exit__(self, *error: Any) -> Any:
        return self.stream.__exit__(*error)

    def __iter__(self) -> Iterator[Any]:
        return iter(self.stream)


def _callers() -> tuple[object, ...]:
    """The lines of code that are being executed."""
    lines: list[object] = []
    frame: FrameType | None = sys._getframe(2)
    while frame is not None:
        lines += (frame.f_code, frame.f_lineno)
        frame = frame.f_back
    return tuple(lines)


def _os_error(name: str, path: object) -> OSError:
    number = errno.ENOSPC if name in ("write", "flush", "mkdir", "mkdtemp") else errno.EIO
    return OSError(number, os.strerror(number), *(() if path is None else (path,)))


def _memory_error(_name: str, _path: object) -> MemoryError:
    return MemoryError()


ERRORS = {"OSError": _os_error, "MemoryError": _memory_error}


@dataclass(frozen=True)
class Broken:
    """A command that did not keep the law."""

    command: str
    call: str
    """Number and name of the call that failed."""
    reason: str


@dataclass
class Injections:
    """All injections into one command."""

    name: str
    every: int = 1
    """Only each so many-th place that calls fails."""
    only: tuple[str, ...] = ()
    """Only calls of these names fail; empty for all."""
    tried: int = 0
    broken: list[Broken] = field(default_factory=list)

    def run(self) -> Injections:
        """Let the calls of the command fail, one after the other."""
        self._ended(Injector())
        injector = Injector()
        _, fresh, _ = self._ended(injector)
        for kind, error in ERRORS.items():
            wanted = [
                at
                for at in injector.firsts.values()
                if not self.only or injector.calls[at] in self.only
            ]
            for at in wanted[:: self.every]:
                failing = Injector(at, error)
                ended, files, failure = self._ended(failing)
                self.tried += 1
                call = f"{kind} at call {at}, {injector.calls[at]}"
                reason = failure or _judged(ended, files, fresh, injector.calls[at])
                if reason is not None:
                    self.broken.append(Broken(self.name, call, reason))
        return self

    def _ended(self, injector: Injector) -> tuple[Ended, dict[str, bytes], str | None]:
        before = Path.cwd()
        _forget()
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for file, text in FILES.items():
                (folder / file).parent.mkdir(exist_ok=True)
                (folder / file).write_text(text, encoding="utf-8")
            os.chdir(folder)
            try:
                with injector.active():
                    ended, failure = send(*COMMANDS[self.name])
            finally:
                os.chdir(before)
            files = {
                path.relative_to(folder).as_posix(): path.read_bytes()
                for path in folder.rglob("*")
                if path.is_file()
            }
        return (
            ended,
            files,
            None if failure is None else f"{failure.signature}\n{failure.text[-700:]}",
        )


def _judged(
    ended: Ended, files: dict[str, bytes], fresh: dict[str, bytes], call: str
) -> str | None:
    """Why a command did not keep the law; None if it did."""
    if ended.code >= 2 and not ended.err.strip():
        return f"exit {ended.code} without a sentence"
    for file, data in files.items():
        if ".home/" in file:
            continue
        if file.endswith(".part"):
            if call not in _REMOVES:
                return f"{file} stays"
            continue
        older = FILES.get(file, "").encode()
        if file.endswith(_OPAQUE):
            if data != older and len(data) < len(fresh.get(file, b"")) / 2:
                return f"{file} is no whole file"
        elif data != older and not _is_whole(file, data):
            return f"{file} is not whole"
    missing = next((file for file in FILES if file not in files), None)
    return None if missing is None else f"{missing} is gone"


def _is_whole(file: str, data: bytes) -> bool:
    text = data.decode()
    match file.rpartition(".")[2]:
        case "json" | "jsonl":
            try:
                for part in text.splitlines() if file.endswith("l") else [text]:
                    json.loads(part)
            except ValueError:
                return False
        case "csv":
            if len({len(row) for row in csv.reader(io.StringIO(text))}) != 1:
                return False
        case _:
            pass
    return text.endswith("\n")


def _forget() -> None:
    """Forget what functions have kept of files."""
    for kept in gc.get_objects():
        # Not `isinstance`, which asks a weak proxy for the class of an object that may be gone.
        if type(kept) is _Kept and kept.__module__.startswith("rapidsim."):
            kept.cache_clear()


def fuzz_system(names: Sequence[str] = tuple(COMMANDS)) -> bool:
    """Try all injections and print; whether none broke the law."""
    tried, broken = 0, 0
    for name in names:
        done = Injections(name).run()
        print(f"{name:24} {done.tried:6} injections, {len(done.broken)} broken", flush=True)
        for one in done.broken:
            print(f"  {one.call}: {one.reason}", flush=True)
        tried, broken = tried + done.tried, broken + len(done.broken)
    print(f"{tried} injections, {broken} broken")
    return not broken
