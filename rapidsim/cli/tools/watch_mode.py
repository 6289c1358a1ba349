"""`--watch`: a command again and again, whenever one of its files changes."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable, Mapping, Sequence
from contextvars import ContextVar
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import current_terminal, echo
from rapidsim.files import InputError
from rapidsim.module_files import MODULE_SUFFIXES
from rapidsim.station.station import find_station

if TYPE_CHECKING:
    from rapidsim.jobs.checking.watched_tasks import WatchedTasks

_LOOKS_S = 0.4
_PROGRAM = ".pgf"
_READ = {*MODULE_SUFFIXES, _PROGRAM, ".toml", ".cfg"}
"""Files of a folder that can change the output of a command."""

_WATCHED: ContextVar[WatchedTasks | None] = ContextVar("watched", default=None)

Stamps = Mapping[str, tuple[int, int]]
"""Time of change [ns] and size of each file."""


def watch_option(command: Callable[..., int]) -> Callable[..., int]:
    """Add `--watch` to a command; the decorator goes above those of options that name files."""

    @functools.wraps(command)
    def watching(*, watch: bool, **options: object) -> int:
        if not watch:
            return command(**options)
        paths = options["paths"]
        assert isinstance(paths, tuple)
        if "-" in paths:
            raise InputError("--watch: standard input does not change")
        if options.get("output_format") == "json":
            raise InputError("--watch prints again and again, and --format json one object")
        if options.get("write_pers"):
            raise InputError("--watch and --write-pers exclude each other")
        beside = [options.get(name) for name in ("station", "io", "answers")]
        named = [str(file) for file in beside if file is not None]
        # A command that runs once does not pay for importing it.
        from rapidsim.jobs.checking.watched_tasks import WatchedTasks

        _WATCHED.set(WatchedTasks())
        while True:
            before = _stamps(paths, named)
            try:
                if command(**options) == ExitCode.INTERRUPTED:
                    return ExitCode.INTERRUPTED
            except InputError as error:
                # An editor may be just writing the file: the next change completes it.
                echo(f"error: {error.message}", err=True)
                if error.help:
                    echo(f" help: {error.help}", err=True)
            if not current_terminal().quiet:
                files = "1 file" if len(before) == 1 else f"{len(before)} files"
                echo(f"\nWatching {files}; Ctrl-C ends it.", err=True)
            while (now := _stamps(paths, named)) == before:
                wait_for_change()
            changed = sorted(
                name for name in now.keys() | before.keys() if now.get(name) != before.get(name)
            )
            if not current_terminal().quiet:
                more = f" and {len(changed) - 1} more" if len(changed) > 1 else ""
                echo(f"Changed: {changed[0]}{more}\n", err=True)

    option = click.option("--watch", is_flag=True, help="Repeat when one of the files changes.")
    return option(watching)


def watched_tasks() -> WatchedTasks | None:
    """The tasks as they were when the command ran last; None for one that runs once."""
    return _WATCHED.get()


def wait_for_change() -> None:
    """Wait until it is worth looking again."""
    time.sleep(_LOOKS_S)


def _stamps(paths: Sequence[str], named: Sequence[str]) -> Stamps:
    """The files as they are now; what is not there has none."""
    station = find_station(paths)
    files = [Path(name) for name in named] + ([station] if station else [])
    for path in map(Path, paths):
        if path.is_dir():
            files += [one for one in path.rglob("*") if _counts(one.relative_to(path))]
        elif path.suffix.lower() == _PROGRAM:
            files += [one for one in path.parent.iterdir() if _counts(Path(one.name))]
        else:
            files.append(path)
    found = {}
    for file in files:
        try:
            status = file.stat()
        except OSError:
            continue
        found[str(file)] = (status.st_mtime_ns, status.st_size)
    return found


def _counts(file: Path) -> bool:
    """Whether a file of a folder is read; what programs wrote to their home folders is not."""
    at_home = any(folder.suffix == ".home" for folder in file.parents)
    return file.suffix.lower() in _READ and not at_home
