"""`rapidsim.simulate`: load the programs of a job, prepare its run, run it."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from itertools import chain, count
from os import PathLike, fspath
from pathlib import Path

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.files import InputError, relative_to_cwd
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.jobs.checking.best_arm import with_best_arm
from rapidsim.jobs.checking.load_tasks import LoadedTask, load_tasks
from rapidsim.jobs.checking.misspelt_signals import misspelt_in
from rapidsim.jobs.checking.move_checks import of_unnamed_arm
from rapidsim.jobs.checking.target_attribution import attribute_to_targets
from rapidsim.jobs.checking.task_setups import task_setups
from rapidsim.jobs.inputs.api_options import api_request
from rapidsim.jobs.inputs.entry import require_entry
from rapidsim.jobs.inputs.job import Job, job
from rapidsim.jobs.inputs.run_options import run_options
from rapidsim.jobs.inputs.task_files import program_name, program_title
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.written_moves import RunNotFollowedError
from rapidsim.reach.valueless_persistents import doubt_valueless
from rapidsim.simulation.live.unattended import has_live_inputs, run_unattended
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import run_tasks
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.values import value_class

_UNATTENDED = {"CI", "PYTEST_CURRENT_TEST"}
"""Environment variables of unattended runs, in which no person checks the home folder."""


class ProgramRejectedError(Exception):
    """The program has errors and cannot run."""

    def __init__(self, diagnostics: tuple[Diagnostic, ...]) -> None:
        """Store the findings; the message is the first error, or the last warning."""
        errors = (one for one in diagnostics if one.severity is Severity.ERROR)
        # A missing module is a warning in a check, although a run needs it.
        super().__init__(next(errors, diagnostics[-1]).violation.message)
        self.diagnostics = diagnostics

    def __reduce__(self) -> tuple[type[ProgramRejectedError], tuple[tuple[Diagnostic, ...]]]:
        """Reconstruct the error from its findings, not from its message."""
        return ProgramRejectedError, (self.diagnostics,)


def simulate(
    paths: Iterable[str | PathLike[str]],
    *,
    robot: Robot | str | None = None,
    io: str | PathLike[str] | None = None,
    max_time: float | None = None,
    options: RunOptions | None = None,
) -> Simulation:
    """Run modules, program files or folders, as `rapidsim run` does.

    Args:
        paths: Paths to run; together they form one task, unless a backup or the station file
            assigns the modules to tasks. The nearest station file is used.
        robot: An arm, or its name in the catalogue; None takes that of the station or
            backup; if neither names one, the default arm, or the arm that suits the targets best.
        io: A file of signals and stimuli; adds to the station and the options.
        max_time: Virtual time [s] at which the run ends; overrides that of the options.
        options: Inputs and limits of the run; non-default settings of the cell override the station
            file.

    Returns:
        The run; its diagnostics begin with the findings of the check. A program that stops with a
        runtime error is a result, too.

    Raises:
        InputError: If an input is missing, unreadable, or not RAPID.
        ProgramRejectedError: If checking finds an error.
        RobotError: If the catalogue has no such robot.
    """
    asked = api_request(paths, robot, options)
    limit_s = asked.max_time_s if max_time is None else max_time
    asked = replace(asked, io=None if io is None else fspath(io), max_time_s=limit_s)
    return run_job(job(asked)).simulation


@value_class(frozen=True, slots=True, eq=False)
class LoadedJob:
    """A job with its files checked and its robot loaded."""

    job: Job
    robot: Robot
    tasks: tuple[LoadedTask, ...]
    """Empty if there is an error among the findings."""
    diagnostics: tuple[Diagnostic, ...]

    @property
    def programs(self) -> Mapping[str, Program]:
        """Programs of the tasks, by name."""
        return {task.name: task.program for task in self.tasks}


@value_class(frozen=True, slots=True, eq=False)
class PreparedRun:
    """A run with all of its inputs."""

    setups: tuple[TaskSetup, ...]
    options: RunOptions
    diagnostics: tuple[Diagnostic, ...]
    """Findings of the check."""
    title: str
    """Title of the run."""
    strict: bool = False
    """Whether any qualification of the verdict fails the run."""
    is_arm_guessed: bool = False
    """Whether an arm is a guess; then targets out of its reach are warnings."""


def run_job(job: Job, *, keeps_data: bool = False) -> FinishedRun:
    """Load, prepare and run.

    Args:
        job: The job.
        keeps_data: See `loaded`.

    Raises:
        ProgramRejectedError: If checking finds an error.
        InputError: If an input of the run is missing.
    """
    return executed(prepared(loaded(job, in_runs=True, keeps_data=keeps_data)))


def _is_followed() -> bool:
    """Whether a debugger or a coverage tool traces the lines that Python executes."""
    if sys.gettrace() is not None:
        return True
    # Python 3.12 also has `sys.monitoring`, with six slots for tools.
    monitoring = getattr(sys, "monitoring", None)
    return monitoring is not None and any(map(monitoring.get_tool, range(6)))


def loaded(job: Job, *, in_runs: bool = False, keeps_data: bool = True) -> LoadedJob:
    """Load the robot, parse and check the files; errors in them are findings, never raised.

    Args:
        job: The job.
        in_runs: Execute long sequences of moves of one shape as one loop, unless a tracer observes
            Python: it would not see each move on its own line.
        keeps_data: Keep all data of the program, also the targets that such moves name.
    """
    job.require_arms()
    if job.is_arm_named:
        # An unknown name is reported before any error of the program.
        job.arm()
    in_runs = in_runs and not _is_followed()
    found = load_tasks(job.tasks, job.cell, in_runs=in_runs, keeps_data=keeps_data)
    try:
        job = with_best_arm(job, [task.program for task in found.tasks])
    except RunNotFollowedError:
        whole = load_tasks(job.tasks, job.cell, in_runs=False)
        job = with_best_arm(job, [task.program for task in whole.tasks])
    robot = job.arm()
    asked_for = tuple(one for one in found.diagnostics if one.violation.rule.on_by_default)
    diagnostics = (*asked_for, *misspelt_in(job, found.diagnostics))
    return LoadedJob(job, robot, found.tasks, diagnostics)


def prepared(loaded: LoadedJob) -> PreparedRun:
    """Assign each task its robot and its start, and the run its inputs.

    Raises:
        ProgramRejectedError: If there is an error among the findings.
        InputError: If an input of the run is missing.
    """
    if not loaded.tasks:
        raise ProgramRejectedError(loaded.diagnostics)
    job = loaded.job
    if not job.request.may_be_empty:
        for name, program in loaded.programs.items():
            require_entry(program, job.entry(name), name if len(loaded.programs) > 1 else "")
    bare = task_setups(loaded.tasks, job.station, loaded.robot, job.open_robot)
    setups = tuple(replace(setup, entry=job.entry(setup.name)) for setup in bare)
    home, ramdisk = _home(job.request.home, job.request.paths), job.request.ramdisk
    if ramdisk is not None and not Path(ramdisk).is_dir():
        raise InputError(f"--ramdisk: {ramdisk} is not a folder")
    options = replace(
        run_options(job), home=home, ramdisk=None if ramdisk is None else Path(ramdisk)
    )
    title = program_title(job.request.paths)
    diagnostics = loaded.diagnostics
    return PreparedRun(setups, options, diagnostics, title, job.is_strict, job.is_arm_guessed)


def executed(
    prepared: PreparedRun, watch: Callable[[RunInProgress], None] | None = None
) -> FinishedRun:
    """Run a prepared run; the written files have names relative to the working directory.

    Args:
        prepared: The run.
        watch: Receives the run before it begins; see `run_tasks`.

    Raises:
        ProgramRejectedError: If a program cannot be translated to executable code.
        InputError: If an arm cannot be timed, or no task moves one.
    """
    run = run_unattended if has_live_inputs(prepared.options) else run_tasks
    try:
        finished = run(prepared.setups, prepared.options, watch)
    except NotExecutableError as error:
        raise ProgramRejectedError((*prepared.diagnostics, error.diagnostic)) from None
    return as_named(prepared, finished)


def as_named(prepared: PreparedRun, finished: FinishedRun) -> FinishedRun:
    """Return a run with the findings of its check, and with names that the user knows."""
    run = finished.simulation
    written = (replace(one, path=str(relative_to_cwd(Path(one.path)))) for one in run.home_files)
    programs = [setup.program for setup in prepared.setups]
    sure = tuple(doubt_valueless(one, programs) for one in run.diagnostics)
    found = attribute_to_targets(sure, programs)
    if prepared.is_arm_guessed:
        found = of_unnamed_arm(found)
    diagnostics = (*prepared.diagnostics, *found)
    run = replace(
        run,
        home_files=tuple(written),
        diagnostics=diagnostics,
        named=prepared.title,
        strict=prepared.strict,
    )
    return replace(finished, simulation=run)


def _fresh(folder: Path) -> Path:
    """Return the folder itself, or the first of `x-2.home`, `x-3.home` ... that does not exist.

    Files of an earlier run must not decide a test.
    """
    names = (folder.with_stem(f"{folder.stem}-{number}") for number in count(2))
    return next(one for one in chain((folder,), names) if not one.exists())


def _home(home: str | None, paths: tuple[str, ...]) -> Path:
    """Return the folder for HOME:; the default one is created when the program writes to it."""
    if home is None:
        folder = Path(f"{program_name(paths)}.home")
        if folder.is_symlink():
            # A repository may contain the link; then the untrusted program would choose its target.
            raise InputError(
                f"{folder} is a link, which a default home folder must not be",
                "`--home DIR` names any folder",
            )
        return _fresh(folder) if _UNATTENDED & os.environ.keys() else folder
    if not Path(home).is_dir():
        raise InputError(f"--home: {home} is not a folder")
    return Path(home)
