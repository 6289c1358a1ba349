"""`rapidsim.simulate`: run the files of a program."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from os import PathLike, fspath
from pathlib import Path

from rapidsim.controller.cell.description import without_declared
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.files import backup_folders, named_tasks, read_tasks
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.jobs.load_tasks import load_tasks
from rapidsim.jobs.task_setups import task_setups
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate as simulate_program
from rapidsim.simulation.simulate import simulate_tasks
from rapidsim.station.backup.backup import backup_station
from rapidsim.station.read import read_io
from rapidsim.station.station import Station


class ProgramRejectedError(Exception):
    """The program has errors and cannot run."""

    def __init__(self, diagnostics: tuple[Diagnostic, ...]) -> None:
        """Carry what was found; the message is the first error."""
        super().__init__(
            next(d.violation.message for d in diagnostics if d.severity is Severity.ERROR)
        )
        self.diagnostics = diagnostics


def simulate(
    paths: Iterable[str | PathLike[str]],
    *,
    robot: Robot | str,
    io: str | PathLike[str] | None = None,
    max_time: float | None = None,
    options: RunOptions | None = None,
) -> Simulation:
    """Run the modules, program files or folders named, as `rapidsim run` does.

    Args:
        paths: What is run, as one task, but for the tasks of a backup: each of them that has moves
            gets an arm of its own, and its signals are those of the backup.
        robot: An arm, or its name in the catalogue.
        io: A file of signals and what happens to inputs; adds to that of the options.
        max_time: Virtual time [s] at which the run ends; replaces that of the options.
        options: Inputs and limits of the run.

    Returns:
        The run; its diagnostics begin with what checking found. A program that stops with an error
        while it runs is a result.

    Raises:
        InputError: If something is missing, unreadable, or no RAPID.
        ProgramRejectedError: If checking finds an error.
    """
    options = options or RunOptions()
    names = [fspath(path) for path in paths]
    folders = backup_folders(names)
    # The arms are the caller's.
    station = replace(backup_station(folders), robots=()) if folders else Station()
    tasks = named_tasks(read_tasks(names), options.task)
    if len(tasks) == len(station.tasks):
        pairs = zip(tasks, station.tasks, strict=True)
        tasks = tuple(replace(task, name=said.name) for task, said in pairs)
    loaded = load_tasks(tasks)
    if not loaded.tasks:
        raise ProgramRejectedError(loaded.diagnostics)
    arm = load_robot(robot) if isinstance(robot, str) else robot
    files = tuple(file.name for task in tasks for file in task.files)
    options = replace(options, program_files=files, io=station.io.and_also(options.io))
    if io is not None:
        options = replace(options, io=options.io.and_also(read_io(Path(io))))
    if max_time is not None:
        options = replace(options, max_time_s=max_time)
    try:
        if len(loaded.tasks) == 1:
            run = simulate_program(loaded.tasks[0].program, arm, options=options)
        else:
            setups = task_setups(loaded.tasks, station, arm, load_robot)
            run = simulate_tasks(setups, options)
    except NotExecutableError as error:
        raise ProgramRejectedError((*loaded.diagnostics, error.diagnostic)) from None
    units = [axis.unit for axis in options.external_axes]
    found = without_declared(loaded.diagnostics, options.io, units)
    return replace(run, diagnostics=(*found, *run.diagnostics))
