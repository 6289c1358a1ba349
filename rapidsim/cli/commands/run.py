"""`rapidsim run`: run a program on the virtual controller and say what happened."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from datetime import datetime
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rapidsim.analysis.program import Program
from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.answers import answers_from
from rapidsim.cli.options.check_settings import choose_settings
from rapidsim.cli.options.dates import Date
from rapidsim.cli.options.inputs import (
    RobotChoice,
    choose_robot,
    choose_station,
    chosen_tasks,
    missing_neighbours,
    program_name,
    seen_from_here,
)
from rapidsim.cli.options.numbers import POSITIVE
from rapidsim.cli.options.outputs import (
    VALUES,
    Asked,
    new_outputs,
    new_profile,
    output_options,
    write,
    write_values,
)
from rapidsim.cli.options.robot_choice import open_robot
from rapidsim.cli.terminal import Terminal, current_terminal, say, terminal_options
from rapidsim.cli.tools.assertions import judge_assertions, judge_budget, read_assertions
from rapidsim.cli.viewer import leave_open
from rapidsim.controller.cell.description import without_declared
from rapidsim.controller.cell.inputs import START_OF_TIME
from rapidsim.controller.cell.network import Network
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.files import InputError, did_you_mean
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.jobs.load_tasks import load_tasks
from rapidsim.jobs.task_setups import task_setups
from rapidsim.motion.robot.robot import Robot
from rapidsim.report.findings.merging import merged
from rapidsim.report.findings.source_frame import printable
from rapidsim.report.findings.text import full, summary_line
from rapidsim.report.run.assertion_figures import asked_figures
from rapidsim.report.run.figures import Figures, figures
from rapidsim.report.run.json_report import rejected_json, run_json
from rapidsim.report.run.summary import ASCII_BARS, BLOCK_BARS, Written, summary
from rapidsim.report.run.verdicts import Judgement
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.simulation.simulate import FinishedRun, run_tasks
from rapidsim.station.read import read_io
from rapidsim.syntax import tree

if TYPE_CHECKING:
    from rapidsim.cli.tools.profiler import Profile

_EXIT_CODES = {
    End.ENDED: ExitCode.CLEAN,
    End.STOPPED: ExitCode.CLEAN,
    End.CYCLE_LIMIT: ExitCode.CLEAN,
    End.TIME_LIMIT: ExitCode.LIMIT,
    End.ERROR: ExitCode.FINDINGS,
}
_NAMED_PROCEDURES = 8


@click.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option("--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them.")
@click.option("--station", metavar="FILE.toml", help="The station file, instead of a near one.")
@click.option("--task", metavar="NAME", help="Only this one of several tasks.")
@click.option("--proc", metavar="NAME", default="main", help="The procedure to run.")
@output_options
@click.option(
    "--io", metavar="FILE.toml", help="Signals and what happens to inputs; adds to the station."
)
@click.option("--answers", metavar="FILE", help="Answers to the program's questions, one a line.")
@click.option(
    "--home", metavar="DIR", help="The folder HOME: stands for; else <program>.home here."
)
@click.option("--allow-network", is_flag=True, help="Sockets may use real ports of this computer.")
@click.option(
    "--network-host",
    "network_hosts",
    metavar="ADDRESS",
    multiple=True,
    help="Another address that sockets may use.",
)
@click.option(
    "--start-time",
    metavar="DATE",
    type=Date(),
    help="What the controller's clock shows at the start; else 2000-01-01.",
)
@click.option(
    "--max-time",
    metavar="SECONDS",
    type=POSITIVE,
    default=3600.0,
    show_default=True,
    help="Simulated time after which the run is cut off.",
)
@click.option(
    "--max-wall",
    metavar="SECONDS",
    type=POSITIVE,
    help="Time on the computer's clock after which the run is cut off; else none.",
)
@click.option(
    "--cycles",
    metavar="N",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    help="How often the procedure runs.",
)
@click.option(
    "--assert",
    "asserted",
    metavar="EXPR",
    multiple=True,
    help="A RAPID expression that must hold when the run has ended, such as 'time_s < 12.5'.",
)
@click.option(
    "--format",
    "output_format",
    type=click.Choice(["table", "json", "none"]),
    default="table",
    show_default=True,
    help="What is printed.",
)
@click.option(
    "--write-pers",
    is_flag=True,
    help="Write what the run left in persistents into the program's files.",
)
@click.option(
    "--break",
    "breaks",
    metavar="FILE:LINE",
    multiple=True,
    help="Stop there and take commands; on a terminal only.",
)
@click.option(
    "--profile", metavar="FILE.prof", help="Where the interpreter spends the computer's time."
)
@terminal_options
def run(
    paths: tuple[str, ...],
    robot: str | None,
    station: str | None,
    task: str | None,
    proc: str,
    asked: Asked,
    io: str | None,
    answers: str | None,
    home: str | None,
    allow_network: bool,
    network_hosts: tuple[str, ...],
    start_time: datetime | None,
    max_time: float,
    max_wall: float | None,
    cycles: int,
    asserted: tuple[str, ...],
    output_format: str,
    write_pers: bool,
    breaks: tuple[str, ...],
    profile: str | None,
) -> int:
    """Run a RAPID program on a virtual controller with a simulated robot.

    PATH is a module (.mod .modx .sys .sysx .prg), a .pgf program file, a folder, a controller
    backup, or - for standard input. What is named together is one task, unless a backup or the
    station file says which modules belong to which.

    Exit codes: 0 the program ended, 1 it has errors or stopped with one, 2 wrong usage, 3 the time
    limit came first, 4 it ended and an --assert or the cycle budget of the station file failed.
    """
    terminal = current_terminal()
    if network_hosts and not allow_network:
        raise InputError("--network-host: it needs --allow-network")
    if breaks and profile:
        raise InputError("--break and --profile exclude each other")
    profile_file = new_profile(profile) if profile else None
    if write_pers and "-" in paths:
        raise InputError("--write-pers: standard input cannot be written to")
    outputs = new_outputs(asked, program_name(paths))
    cell = choose_station(paths, station)
    budget_s = choose_settings(paths, cell.check).cycle_budget_s
    around = cell.io.and_also(read_io(Path(io))) if io else cell.io
    tasks = chosen_tasks(paths, cell, task)
    files = tuple(file for one in tasks for file in one.files)
    names = tuple(file.name for file in files)
    choice = choose_robot(robot, cell)
    arm = open_robot(choice.name)
    loaded = load_tasks(tasks)
    loaded = replace(loaded, diagnostics=without_declared(loaded.diagnostics, around, cell.units))
    if not loaded.tasks:
        hint = missing_neighbours(paths, loaded.diagnostics)
        return _reject(loaded.diagnostics, names, arm, output_format, terminal, hint)
    program = loaded.tasks[0].program
    if len(tasks) > 1 and (breaks or profile):
        raise InputError("--break and --profile follow one task", "name it with --task")
    programs = {one.name: one.program for one in loaded.tasks}
    assertions = read_assertions(asserted, programs, around, terminal)
    setups = task_setups(loaded.tasks, cell, arm, open_robot)
    options = RunOptions(
        program_files=names,
        model=cell.model,
        io=around,
        answers=answers_from(answers),
        answers_are_typed=answers is None,
        home=_home(home, paths),
        network=Network(frozenset(network_hosts)) if allow_network else None,
        starts_at=start_time or cell.starts_at or START_OF_TIME,
        max_time_s=max_time,
        max_wall_s=max_wall,
        max_cycles=cycles,
        entry=_entry(list(programs.values()), proc),
    )
    measured: Profile | None = None

    def execute() -> FinishedRun:
        return run_tasks(setups, options)

    try:
        if breaks:
            from rapidsim.cli.tools.debugger import debugged

            finished = debugged(execute, program, breaks)
        elif profile_file:
            from rapidsim.cli.tools.profiler import profiled

            with _stage("simulating", terminal):
                finished, measured = profiled(execute, program)
        else:
            with _stage("simulating", terminal):
                finished = execute()
    except NotExecutableError as error:
        findings = (*loaded.diagnostics, error.diagnostic)
        return _reject(findings, names, arm, output_format, terminal)
    simulation = _seen_from_here(finished.simulation)
    findings = (*loaded.diagnostics, *simulation.diagnostics)
    shown = cache(partial(figures, simulation))
    asked_for = asked_figures(simulation, shown(), findings) if assertions else {}
    judgement = Judgement(
        judge_assertions(assertions, finished, asked_for),
        judge_budget(budget_s, finished, cycles, proc),
    )
    with _stage("writing", terminal):
        written, refused = write(simulation, findings, outputs)
    if profile_file and measured:
        from rapidsim.cli.tools.profiler import write_profile

        write_profile(measured, profile_file)
        written = (*written, Written(profile_file, "profile"))
    if write_pers:
        try:
            written = (*written, *write_values(simulation, files))
        except InputError as error:
            refused = refused or error
    if output_format == "json":
        report = run_json(simulation, shown(), findings, _json_files(written), judgement)
        say(_as_text(report))
    elif output_format == "table":
        _print_findings(findings, terminal)
        if not terminal.quiet:
            _print_summary(simulation, shown(), choice, written, terminal)
            if measured:
                from rapidsim.cli.tools.profiler import costs_table

                terminal.show(costs_table(measured.routines))
    _print_judgement(judgement, output_format, terminal)
    recording = outputs.recording
    if outputs.view and recording and any(one.path == recording for one in written):
        leave_open(recording)
    if refused is not None:
        # What the run found is not lost over a file that could not be written.
        raise refused
    code = _EXIT_CODES[simulation.end]
    return ExitCode.FAILED if judgement.failed and code is ExitCode.CLEAN else code


def _seen_from_here(simulation: Simulation) -> Simulation:
    """The run with the files it wrote named as the user would name them here."""
    files = simulation.home_files
    seen = (replace(file, path=str(seen_from_here(Path(file.path)))) for file in files)
    return replace(simulation, home_files=tuple(seen))


def _reject(
    findings: Sequence[Diagnostic],
    names: Sequence[str],
    arm: Robot,
    output_format: str,
    terminal: Terminal,
    hint: str | None = None,
) -> int:
    """Say why the program does not run."""
    if output_format == "json":
        say(_as_text(rejected_json(names, arm.name, findings)))
    elif output_format == "table":
        _print_findings(findings, terminal)
        if not terminal.quiet:
            say(summary_line(merged(findings), files=len(names), seconds=None))
            if hint:
                say(hint)
    return ExitCode.FINDINGS


def _home(home: str | None, paths: Sequence[str]) -> Path:
    """The folder HOME: stands for; the default one comes to be when the program writes to it."""
    if home is None:
        folder = Path(f"{program_name(paths)}.home")
        if folder.is_symlink():
            # A checkout may hold it; then the program, which is not trusted, would choose its room.
            raise InputError(
                f"{folder} is a link, and a home folder that is there by default must not be one",
                "`--home DIR` names any folder",
            )
        return folder
    if not Path(home).is_dir():
        raise InputError(f"--home: {home} is no folder")
    return Path(home)


def _entry(programs: Sequence[Program], name: str) -> str:
    """The procedure that each task runs, refused if it cannot be started on its own."""
    for program in programs:
        _require_entry(program, name)
    return name


def _require_entry(program: Program, name: str) -> None:
    startable = [
        routine.name
        for routine in program.routines.values()
        if isinstance(routine.node, tree.Proc) and all(p.optional for p in routine.parameters)
    ]
    if name.lower() in (one.lower() for one in startable):
        return
    if name.lower() in program.routines:
        raise InputError(f"`{name}` is no procedure that runs without arguments")
    named = ", ".join(f"`{one}`" for one in startable[:_NAMED_PROCEDURES])
    named += ", ..." if len(startable) > _NAMED_PROCEDURES else ""
    raise InputError(
        f"the program has no procedure `{name}`",
        did_you_mean(name, startable) or (f"--proc names one: {named}" if startable else None),
    )


def _json_files(written: Sequence[Written]) -> dict[str, object]:
    files: dict[str, object] = {one.what: str(one.path) for one in written if one.what != VALUES}
    program = [str(one.path) for one in written if one.what == VALUES]
    return {**files, "program": program} if program else files


def _as_text(report: dict[str, object]) -> str:
    return json.dumps(report, indent=2, allow_nan=False)


def _print_findings(findings: Sequence[Diagnostic], terminal: Terminal) -> None:
    if terminal.quiet:
        findings = [finding for finding in findings if finding.severity is Severity.ERROR]
    text = full(merged(findings), terminal.palette, width=terminal.width)
    say(text, palette=terminal.palette, nl=False)


def _print_judgement(judgement: Judgement, output_format: str, terminal: Terminal) -> None:
    """Say what became of the assertions and the budget; beside JSON only what is amiss."""
    is_table = output_format == "table"
    palette = terminal.palette
    for verdict in judgement.verdicts:
        if (is_table and not terminal.quiet) or not verdict.holds:
            colour = {True: palette.help, None: palette.warning, False: palette.error}
            text = palette.paint(printable(verdict.text), colour[verdict.holds])
            say(text, palette=palette, err=not is_table)


def _print_summary(
    simulation: Simulation,
    shown: Figures,
    choice: RobotChoice,
    written: Sequence[Written],
    terminal: Terminal,
) -> None:
    plain = not terminal.console().encoding.startswith("utf")
    terminal.show(
        summary(
            simulation,
            shown,
            robot_reason=choice.reason,
            written=written,
            bars=ASCII_BARS if plain else BLOCK_BARS,
        )
    )


@contextmanager
def _stage(what: str, terminal: Terminal) -> Iterator[None]:
    """Say on a terminal what is under way; anywhere else say nothing."""
    if terminal.quiet or not sys.stderr.isatty():
        yield
        return
    from rich.console import Console
    from rich.status import Status

    with Status(f"{what} ...", console=Console(stderr=True)):
        yield
