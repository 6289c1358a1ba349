"""`rapidsim calibrate`: fit the motion model to logs of a real controller."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.job_options import echo_remarks
from rapidsim.cli.options.numbers import NumberOption
from rapidsim.cli.terminal import current_terminal, print_json, table_or_json, terminal_options
from rapidsim.files import InputError
from rapidsim.jobs.inputs.input_resolution import choose_robot, choose_station
from rapidsim.module_files import MODULE_SUFFIXES, read_tasks


@click.command(short_help="Fit the motion model to logs of a real controller.")
@click.argument("logs", nargs=-1, required=True, metavar="LOG...", type=Path)
@click.option(
    "--program", metavar="PATH", help="The program that was logged; default: LOG's name with .mod."
)
@click.option("--robot", metavar="NAME|FILE.urdf", help="The arm.")
@click.option("--station", metavar="FILE.toml", help="The station file from which the fit starts.")
@click.option(
    "--clock",
    metavar="RATIO",
    type=NumberOption(0.5, 2.0),
    default=1.0,
    show_default=True,
    help="Real seconds per second of the logs.",
)
@table_or_json
@terminal_options
def calibrate(
    logs: tuple[Path, ...],
    program: str | None,
    robot: str | None,
    station: str | None,
    clock: float,
    output_format: str,
) -> int:
    """Fit acceleration, smoothing and dwell to moves that a controller logged.

    LOG is a CSV file of times and joint angles in degrees (`time,j1,...,j6`), taken every 4 to 12
    ms from rest before the program starts until the arm is at rest again. The program that
    ran is the module of the same name next to it. A good set: one long straight move at moderate
    speed, five or more short moves to stop points, and ten or more corners with small zones at full
    speed.
    """
    from rapidsim.applications.calibrate.fit import LoggedRun
    from rapidsim.applications.calibrate.fit import calibrate as fit
    from rapidsim.applications.calibrate.joint_log import read_joint_log
    from rapidsim.applications.calibrate.report import as_json, as_text
    from rapidsim.cli.options.robot_choice import open_robot
    from rapidsim.jobs.checking.checked_program import load

    programs = [program or _program_of_log(log) for log in logs]
    settings = choose_station(programs, station)
    echo_remarks(settings)
    chosen = choose_robot(robot, settings)
    arm = open_robot(chosen.name, chosen.scale)
    runs = []
    for log, path in zip(logs, programs, strict=True):
        read = read_joint_log(log, len(arm.joints))
        tasks = read_tasks([path])
        loaded = load(tasks[0].files)
        if loaded.program is None:
            raise InputError(f"{path} has mistakes", f"see them with `rapidsim check {path}`")
        runs.append(LoggedRun(loaded.program, replace(read, times=read.times * clock)))
    calibration = fit(runs, arm, settings.model)
    if output_format == "json":
        print_json(as_json(calibration))
    else:
        current_terminal().show(as_text(calibration), soft_wrap=True)
    return ExitCode.CLEAN


def _program_of_log(log: Path) -> str:
    """The module that has the name of a log."""
    if not log.exists():
        raise InputError(f"{log} does not exist")
    if log.is_dir():
        raise InputError(f"{log} is no log but a folder")
    for suffix in MODULE_SUFFIXES:
        module = log.with_suffix(suffix)
        if module.is_file():
            return str(module)
    raise InputError(
        f"no program belongs to {log}",
        f"name it with --program, or call it {log.with_suffix('.mod').name}",
    )
