"""Instrumentation of a run: none, breakpoints, or Python's profiler."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from rapidsim.cli.options.new_files import new_profile
from rapidsim.cli.terminal import Terminal
from rapidsim.cli.tools.run_output import stage
from rapidsim.files import InputError
from rapidsim.jobs.running.run_files import LoadedJob, PreparedRun
from rapidsim.simulation.progress import RunInProgress
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rich.console import RenderableType

    from rapidsim.cli.tools.profiler import RunProfile

T = TypeVar("T")


@value_class(frozen=True, slots=True)
class Instrumentation:
    """The requested instrumentation; one at most."""

    breaks: tuple[str, ...]
    profile: Path | None
    """File for the profile."""


def choose_instrumentation(breaks: Sequence[str], profile: str | None) -> Instrumentation:
    """The instrumentation of the options.

    Raises:
        InputError: If they want both, or the profile cannot be written there.
    """
    if breaks and profile:
        raise InputError("--break and --profile exclude each other")
    return Instrumentation(tuple(breaks), new_profile(profile) if profile else None)


def run_instrumented(
    run: Callable[[Callable[[RunInProgress], None]], T],
    loaded: LoadedJob,
    prepared: PreparedRun,
    watch: Instrumentation,
    terminal: Terminal,
    meter: RenderableType | None = None,
) -> tuple[T, RunProfile | None]:
    """Run what was loaded, and measure it if that is wanted.

    Args:
        run: Runs it, and first calls a function with the run.
        loaded: The program.
        prepared: Its inputs.
        watch: How it is watched.
        terminal: Receives the progress.
        meter: How far it is.

    Raises:
        InputError: If several tasks run where one is to be measured.
    """
    if watch.profile and len(loaded.tasks) > 1:
        raise InputError("--profile follows one task", "name it with --task")
    if watch.breaks:
        from rapidsim.cli.tools.debugger import debugged
        from rapidsim.dap.program_files import ProgramFiles

        files = ProgramFiles(tuple(loaded.programs))
        for program in loaded.programs.values():
            files.take_all(program.modules)
        uses_network = prepared.options.network is not None
        return debugged(run, files, watch.breaks, uses_network=uses_network), None
    with stage("simulating", terminal, meter):
        if watch.profile is None:
            return run(lambda run: None), None
        from rapidsim.cli.tools.profiler import profiled

        return profiled(lambda: run(lambda run: None), loaded.tasks[0].program)
