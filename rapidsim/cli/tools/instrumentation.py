"""Instrumentation of a run: none, breakpoints, or Python's profiler."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from rapidsim.cli.options.new_files import new_profile
from rapidsim.cli.terminal import Terminal
from rapidsim.cli.tools.run_output import stage
from rapidsim.files import InputError
from rapidsim.jobs.running.run_files import LoadedJob
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
    run: Callable[[], T],
    loaded: LoadedJob,
    watch: Instrumentation,
    terminal: Terminal,
    meter: RenderableType | None = None,
) -> tuple[T, RunProfile | None]:
    """Run what was loaded, and measure it if that is wanted.

    Args:
        run: Runs it.
        loaded: What it is.
        watch: How it is watched.
        terminal: Receives the progress.
        meter: How far it is.

    Raises:
        InputError: If several tasks run where one is to be followed.
    """
    if (watch.breaks or watch.profile) and len(loaded.tasks) > 1:
        raise InputError("--break and --profile follow one task", "name it with --task")
    program = loaded.tasks[0].program
    if watch.breaks:
        from rapidsim.cli.tools.debugger import debugged

        return debugged(run, program, watch.breaks), None
    with stage("simulating", terminal, meter):
        if watch.profile is None:
            return run(), None
        from rapidsim.cli.tools.profiler import profiled

        return profiled(run, program)
