"""`rapidsim.simulate`: run the files of a program."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from os import PathLike, fspath

from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.files import InputError, read_tasks
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.motion.robot import Robot, load_robot
from rapidsim.simulation.load import load
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.result import Simulation
from rapidsim.simulation.simulate import simulate as simulate_program


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
    max_time: float | None = None,
    options: RunOptions | None = None,
) -> Simulation:
    """Run the modules, program files or folders named, as `rapidsim run` does.

    Args:
        paths: What is run, as one task.
        robot: An arm, or its name in the catalogue.
        max_time: Virtual time [s] at which the run ends; replaces that of the options.
        options: Inputs and limits of the run.

    Returns:
        The run; its diagnostics begin with what checking found. A program that stops with an error
        while it runs is a result.

    Raises:
        InputError: If something is missing, unreadable, or no RAPID.
        ProgramRejectedError: If checking finds an error.
    """
    tasks = read_tasks([fspath(path) for path in paths])
    if len(tasks) > 1:
        raise InputError("several tasks are not simulated together yet")
    loaded = load(tasks[0].files)
    if loaded.program is None:
        raise ProgramRejectedError(loaded.diagnostics)
    arm = load_robot(robot) if isinstance(robot, str) else robot
    options = options or RunOptions()
    options = replace(options, program_files=tuple(file.name for file in tasks[0].files))
    if max_time is not None:
        options = replace(options, max_time_s=max_time)
    try:
        run = simulate_program(loaded.program, arm, options=options)
    except NotExecutableError as error:
        raise ProgramRejectedError((*loaded.diagnostics, error.diagnostic)) from None
    return replace(run, diagnostics=(*loaded.diagnostics, *run.diagnostics))
