"""The program of a session: loaded from the arguments of `launch`, and its run."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from rapidsim.dap.program_files import ProgramFiles
from rapidsim.dap.wire import Message
from rapidsim.diagnostics import Severity
from rapidsim.files import InputError
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

    @property
    def files(self) -> ProgramFiles:
        """Its files, without those of modules that a run loads."""
        files = ProgramFiles(tuple(setup.name for setup in self.prepared.setups))
        for program in self.loaded.programs.values():
            files.take_all(program.modules)
        return files

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
        return cls(ready, made, arguments.get("replay"))

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


def _shortened(path: str) -> str:
    """A path below the working directory as a user would type it."""
    try:
        relative = os.path.relpath(path)
    except ValueError:
        return path
    return path if relative.startswith(os.pardir) else relative
