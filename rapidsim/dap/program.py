"""The program of a session: loaded from the arguments of `launch`, and its run."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import field
from pathlib import Path

from rapidsim.dap.wire import Message
from rapidsim.diagnostics import Severity
from rapidsim.files import InputError
from rapidsim.interpreter.tools.executable_lines import places_to_stop
from rapidsim.jobs.inputs.answers import answers_of_file
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import DEFAULT_ENTRY, RunRequest
from rapidsim.jobs.running.run_files import (
    LoadedJob,
    PreparedRun,
    ProgramRejectedError,
    as_named,
    executed,
    loaded,
    prepared,
)
from rapidsim.report.findings.merging import merged
from rapidsim.report.findings.text import concise
from rapidsim.report.palette import PLAIN
from rapidsim.server.loading import with_cell
from rapidsim.server.replay import replay_journal, replayed
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.syntax import tree
from rapidsim.values import value_class

_RUN_S, _REPLAY_S = 3600.0, 1e9
"""Virtual time [s] at which a run and a replay end."""


class LaunchError(Exception):
    """A program that cannot be run; the message has the reasons, one a line."""


@value_class(frozen=True, slots=True, eq=False)
class DebuggedProgram:
    """A program that is ready to run."""

    loaded: LoadedJob
    prepared: PreparedRun
    replay: str | None
    """A journal of `serve` to repeat; None to run main."""
    lines: dict[str, frozenset[int]] = field(default_factory=dict)
    """Lines at which a program can stop, by file as the user named it."""
    paths: dict[str, str] = field(default_factory=dict)
    """Absolute path of each file."""
    modules: list[tree.Module] = field(default_factory=list)
    """Modules of the program, and those that it has loaded."""

    @classmethod
    def launched(cls, arguments: Message) -> DebuggedProgram:
        """Load the program of the arguments of `launch`.

        Raises:
            LaunchError: If it has errors, or something is missing.
        """
        program = arguments.get("program")
        paths = [program] if isinstance(program, str) else program
        if not isinstance(paths, list) or not paths or not all(isinstance(p, str) for p in paths):
            raise LaunchError("`program` names a module, a folder, a .pgf file, or a list of them")
        # A served controller may have been on for days.
        limit_s = _REPLAY_S if arguments.get("replay") else _RUN_S
        try:
            request = RunRequest(
                paths=tuple(_shortened(one) for one in paths),
                robot=arguments.get("robot"),
                station=arguments.get("station"),
                io=arguments.get("io"),
                home=arguments.get("home"),
                entry=arguments.get("proc") or DEFAULT_ENTRY,
                answers=answers_of_file(file) if (file := arguments.get("answers")) else None,
                max_time_s=float(arguments.get("maxTime") or limit_s),
            )
            # One statement after the other: no move may be a row of a loop.
            ready = loaded(job(request))
            made = prepared(ready)
        except InputError as error:
            raise LaunchError("\n".join(filter(None, (error.message, error.help)))) from None
        except ProgramRejectedError as error:
            errors = [one for one in error.diagnostics if one.severity is Severity.ERROR]
            raise LaunchError(concise(merged(errors), PLAIN).strip()) from None
        return cls.of(ready, made, arguments.get("replay"))

    @classmethod
    def of(
        cls, loaded: LoadedJob, prepared: PreparedRun, replay: str | None = None
    ) -> DebuggedProgram:
        """A program that has been loaded."""
        found = cls(loaded, prepared, replay)
        for program in loaded.programs.values():
            for module in program.modules:
                found.take(module)
        return found

    def take(self, module: tree.Module) -> bool:
        """Take a module, which the program may have loaded; return whether it is new."""
        if module in self.modules:
            return False
        self.modules.append(module)
        file = module.source.file
        self.lines[file] = self.lines.get(file, frozenset()) | places_to_stop(module).keys()
        self.paths[file] = str(Path(file).absolute())
        return True

    def run(self, watch: Callable[[RunInProgress], None]) -> FinishedRun:
        """Run to the end.

        Args:
            watch: Receives the run before it begins.

        Raises:
            LaunchError: If it cannot begin.
        """
        try:
            if self.replay is None:
                return executed(self.prepared, watch)
            ready = with_cell(self.loaded, self.prepared)
            journal = replay_journal(Path(self.replay))
            return as_named(self.prepared, replayed(ready, journal, lambda line: None, watch))
        except ProgramRejectedError as error:
            raise LaunchError(concise(merged(error.diagnostics), PLAIN).strip()) from None
        except InputError as error:
            raise LaunchError(error.message) from None

    def file_of(self, path: str) -> str | None:
        """The file of a path of the client; None if the program has none there."""
        wanted = os.path.normcase(os.path.realpath(path))
        for file, place in self.paths.items():
            if os.path.normcase(os.path.realpath(place)) == wanted:
                return file
        return None

    def statement_line(self, file: str, line: int) -> int | None:
        """The first line with a statement, from a line on; None without one."""
        return min((one for one in self.lines[file] if one >= line), default=None)


def _shortened(path: str) -> str:
    """A path below the working directory as a user would type it."""
    try:
        relative = os.path.relpath(path)
    except ValueError:
        return path
    return path if relative.startswith(os.pardir) else relative
