"""`rapidsim run`: run a program on the virtual controller and report the result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from typing import TypeAlias

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.interrupted import report_if_interrupted
from rapidsim.cli.options.job_options import input_options, job_of, program_options
from rapidsim.cli.options.outputs import (
    OutputFileOptions,
    Outputs,
    new_outputs,
    output_options,
    write,
    write_values,
)
from rapidsim.cli.terminal import current_terminal, echo, terminal_options
from rapidsim.cli.tools.assertions import (
    Assertion,
    judge_assertions,
    judge_budget,
    read_assertions,
)
from rapidsim.cli.tools.instrumentation import choose_instrumentation, run_instrumented
from rapidsim.cli.tools.opened_viewer import open_viewer
from rapidsim.cli.tools.progress_meter import Meter
from rapidsim.cli.tools.run_interruption import RunInterruption
from rapidsim.cli.tools.run_output import FORMATS, RunDone, print_rejected, print_run, stage
from rapidsim.cli.tools.run_timer import RunTimer
from rapidsim.cli.tools.watch_mode import watch_option
from rapidsim.extras import pip_install
from rapidsim.files import InputError, SourceFile
from rapidsim.jobs.inputs.job import Job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.inputs.task_files import program_name
from rapidsim.jobs.running.run_files import (
    LoadedJob,
    PreparedRun,
    ProgramRejectedError,
    as_named,
    executed,
    loaded,
    prepared,
)
from rapidsim.report.run.assertion_figures import asked_figures
from rapidsim.report.run.figures import Figures, figures
from rapidsim.report.run.summary import OutputFile
from rapidsim.report.run.verdicts import Verdicts
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.verdict import Failure

Execute: TypeAlias = Callable[[Callable[[RunInProgress], None]], FinishedRun]
"""Runs a program, and first calls a function with the run."""

_EXIT_CODES = {
    None: ExitCode.CLEAN,
    Failure.PROGRAM: ExitCode.FINDINGS,
    Failure.LIMIT: ExitCode.LIMIT,
    Failure.ASSERTION: ExitCode.FAILED,
}


@click.command()
@watch_option
@program_options
@output_options
@input_options
@click.option(
    "--assert",
    "asserted",
    metavar="EXPR",
    multiple=True,
    help="A RAPID expression that must be TRUE when the run has ended, such as 'time_s < 12.5'.",
)
@click.option(
    "--format",
    "output_format",
    type=click.Choice(FORMATS),
    default="table",
    show_default=True,
    help="Output format.",
)
@click.option(
    "--write-pers",
    is_flag=True,
    help="Write the final values of persistents into the program's files.",
)
@click.option(
    "--break",
    "breaks",
    metavar="FILE:LINE",
    multiple=True,
    help="Stop there and read commands from the terminal; `FILE:LINE, CONDITION` is possible.",
)
@click.option(
    "--profile",
    metavar="FILE.prof",
    help="Write a profile of the interpreter's computing time.",
)
@click.option(
    "--timings",
    is_flag=True,
    help="Show the processor time of reading, solving, planning, program and recording.",
)
@click.option(
    "--replay",
    metavar="JOURNAL",
    help="Replay a journal of `rapidsim serve` instead of running main.",
)
@terminal_options
def run(
    request: RunRequest,
    files: OutputFileOptions,
    asserted: tuple[str, ...],
    output_format: str,
    write_pers: bool,
    breaks: tuple[str, ...],
    profile: str | None,
    timings: bool,
    replay: str | None,
) -> int:
    """Run a RAPID program on a virtual controller with a simulated robot.

    PATH is a module (.mod .modx .sys .sysx .prg), a .pgf program file, a folder, a controller
    backup, a RobotStudio Pack&Go station (.rspag), or - for standard input. All PATHs together
    form one task, unless a backup or the station file assigns modules to tasks.

    Exit codes: 0 the program ended, 1 it has errors or stopped with one, 2 wrong usage, 3 a time
    limit ended the run, 4 an --assert or the cycle budget of the station file failed.
    """
    terminal, timer = current_terminal(), RunTimer(is_reported=timings)
    interruption = RunInterruption(ends_run=not breaks)
    watch = choose_instrumentation(breaks, profile)
    if write_pers and "-" in request.paths:
        raise InputError("--write-pers: standard input cannot be written to")
    outputs = new_outputs(files, program_name(request.paths))
    if outputs.lacks_recorder and not terminal.quiet:
        echo(f"note: no recording, which needs rerun: {pip_install('rerun')}", err=True)
    job = job_of(replace(request, may_be_empty=replay is not None))
    # Assertions may name any data.
    ready = loaded(job, in_runs=not (breaks or profile or replay), keeps_data=bool(asserted))
    job = ready.job
    try:
        made = prepared(ready)
        _echo_home_folder(request, made.options.home)
        meter = Meter(sum(task.moves for task in ready.tasks))
        execute = _with_watchers(partial(executed, made), interruption.watch)
        if replay is not None:
            # Half a replay differs from its journal: Ctrl-C interrupts it.
            execute = _replaying(ready, made, Path(replay))
        execute = _with_watchers(execute, meter.watch, timer.watch)
        assertions = read_assertions(asserted, ready.programs, job.station.io, terminal)
        with report_if_interrupted(meter.so_far), interruption.awaited():
            finished, measured = run_instrumented(execute, ready, made, watch, terminal, meter)
    except ProgramRejectedError as rejected:
        print_rejected(ready, rejected.diagnostics, output_format, terminal)
        return ExitCode.FINDINGS
    timer.end_run()
    if interruption.has_come:
        echo(f"interrupted{meter.reached()}; Ctrl-C again ends the writing of outputs", err=True)
        # Such a run does not change programs, and opens no window.
        write_pers, outputs = False, replace(outputs, view=False)
    simulation = finished.simulation
    shown = cache(partial(figures, simulation))
    done = RunDone(simulation, shown, _judge(job, assertions, finished, shown), measured)
    written, refused = _write_all(simulation, outputs, job.files if write_pers else ())
    if watch.profile and measured:
        from rapidsim.cli.tools.profiler import write_profile

        write_profile(measured, watch.profile)
        written = (*written, OutputFile(watch.profile, "profile"))
    done = replace(done, timings=timer.timings())
    print_run(done, job.robot, written, output_format, terminal)
    recording = outputs.recording
    if outputs.view and recording and any(one.path == recording for one in written):
        open_viewer(recording)
    if refused is not None:
        # What the run found is not lost over a file that could not be written.
        raise refused
    return ExitCode.INTERRUPTED if interruption.has_come else _EXIT_CODES[done.verdict.failure]


def _write_all(
    run: Simulation, outputs: Outputs, programs: Sequence[SourceFile]
) -> tuple[tuple[OutputFile, ...], InputError | None]:
    """Write the outputs, and values of persistents to programs; return the error of one of them."""
    with stage("writing", current_terminal()), report_if_interrupted(partial(_ended, run)):
        written, refused = write(run, outputs)
    if programs:
        try:
            written = (*written, *write_values(run, programs))
        except InputError as error:
            refused = refused or error
    return written, refused


def _ended(run: Simulation) -> str:
    """The exit code of a run with an output file that could not be written."""
    moves = sum(len(robot.moves) for robot in run.robots)
    return f" after the run ({run.time_s:.3f} s, {moves:,} moves): not all outputs were written"


def _with_watchers(execute: Execute, *watchers: Callable[[RunInProgress], None]) -> Execute:
    """The run, which others follow."""

    def run_all(watch: Callable[[RunInProgress], None]) -> FinishedRun:
        def watch_all(run: RunInProgress) -> None:
            for one in (*watchers, watch):
                one(run)

        return execute(watch_all)

    return run_all


def _replaying(ready: LoadedJob, made: PreparedRun, journal: Path) -> Execute:
    """The run that replays a journal.

    Raises:
        InputError: If the file is not a journal.
    """
    from rapidsim.server.loading import with_cell
    from rapidsim.server.replay import replay_journal, replayed

    life = replay_journal(journal)
    tell = partial(echo, err=True)
    return lambda watch: as_named(made, replayed(with_cell(ready, made), life, tell, watch))


def _echo_home_folder(request: RunRequest, home: Path | None) -> None:
    """Say that HOME: is not the folder that is there."""
    default = Path(f"{program_name(request.paths)}.home")
    if request.home is None and home not in (None, default) and not current_terminal().quiet:
        echo(
            f"note: HOME: is {home}, a fresh one; `--home {default}` takes the existing one",
            err=True,
        )


def _judge(
    job: Job,
    assertions: Sequence[Assertion],
    finished: FinishedRun,
    make_figures: Callable[[], Figures],
) -> Verdicts:
    """Verdicts on the assertions and the cycle budget."""
    run, asked, budget_s = finished.simulation, job.request, job.station.check.cycle_budget_s
    known = asked_figures(run, make_figures(), run.diagnostics) if assertions else {}
    return Verdicts(
        judge_assertions(assertions, finished, known),
        judge_budget(budget_s, finished, asked.max_cycles, asked.entry),
    )
