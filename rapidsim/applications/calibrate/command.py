"""`rapidsim calibrate`: fit the motion model to logs of a real controller."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.declared import argument, option, options_of, shared
from rapidsim.cli.options.job_options import echo_remarks
from rapidsim.cli.options.numbers import NumberOption
from rapidsim.cli.terminal import (
    current_terminal,
    echo,
    print_json,
    table_or_json,
    terminal_options,
)
from rapidsim.files import InputError
from rapidsim.jobs.inputs.input_resolution import choose_robot, choose_station
from rapidsim.language.robotware import RobotWare, read_robotware
from rapidsim.module_files import MODULE_SUFFIXES, read_tasks
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.applications.calibrate.donation import Donation
    from rapidsim.applications.calibrate.fit import LoggedRun
    from rapidsim.motion.robot.robot import Robot

DONATED = ".json"
"""Suffix of logs that `--donate` wrote."""


def _version(context: click.Context, option: click.Parameter, text: str | None) -> RobotWare | None:
    del context
    version = None if text is None else read_robotware(text)
    if text is not None and version is None:
        raise click.BadParameter(f"`{text}` is no version such as 6.15", param=option)
    return version


@value_class(frozen=True, slots=True)
class CalibrateOptions:
    """Logs, what they are logs of, and what to write."""

    logs: tuple[Path, ...] = argument("[LOG...]", nargs=-1, type=Path)
    program: str | None = option(
        "--program",
        metavar="PATH",
        help="The program that was logged; default: LOG's name with .mod.",
    )
    robot: str | None = option("--robot", metavar="NAME|FILE.urdf", help="The arm.")
    station: str | None = option(
        "--station", metavar="FILE.toml", help="The station file from which the fit starts."
    )
    clock: float = option(
        "--clock",
        metavar="RATIO",
        type=NumberOption(0.5, 2.0),
        default=1.0,
        show_default=True,
        help="Real seconds per second of the logs.",
    )
    donate: Path | None = option(
        "--donate",
        metavar="FILE.json",
        type=Path,
        help="Also pack joints, times, moves, arm and RobotWare into one file, without any names.",
    )
    robotware: RobotWare | None = option(
        "--robotware",
        metavar="VERSION",
        callback=_version,
        help="The controller's version in that file, such as 6.15; default: the station's.",
    )
    programs: str | None = option(
        "--programs",
        metavar="ARM",
        help="Write three programs to log for an arm, without LOG: swings, corners, picks.",
    )
    output_format: str = shared(table_or_json)


@click.command(short_help="Fit the motion model to logs of a real controller.")
@options_of(CalibrateOptions)
@terminal_options
def calibrate(options: CalibrateOptions) -> int:
    """Fit acceleration, smoothing and dwell to moves that a controller logged.

    LOG is a CSV file of times and joint angles in degrees (`time,j1,...,j6`), taken every 4 to 12
    ms from rest before the program starts until the arm is at rest again. The program that
    ran is the module of the same name next to it. A good set: one long straight move at moderate
    speed, five or more short moves to stop points, and ten or more corners with small zones at full
    speed. --programs writes such a set. A LOG may also be a file that --donate wrote: it contains
    its program and its arm.
    """
    from rapidsim.applications.calibrate.donation import write_donation
    from rapidsim.applications.calibrate.fit import calibrate as fit
    from rapidsim.applications.calibrate.report import as_json, as_text
    from rapidsim.cli.options.new_files import new_file
    from rapidsim.cli.options.robot_choice import open_robot

    if options.programs is not None:
        return _write_programs(options.programs, options.logs)
    if not options.logs:
        raise InputError("no log is named", "--programs ARM writes programs to log")
    if options.donate is not None:
        _require_absent(new_file(str(options.donate), (DONATED,)))
    donated = [log for log in options.logs if log.suffix.lower() == DONATED]
    logs = {
        log: options.program or _program_of_log(log) for log in options.logs if log not in donated
    }
    donations = _donations(donated)
    settings = choose_station(list(logs.values()), options.station)
    echo_remarks(settings)
    arms = {one.arm for one in donations.values()}
    chosen = choose_robot(options.robot or min(arms, default=None), settings)
    arm = open_robot(chosen.name, chosen.scale)
    if arms - {arm.name}:
        raise InputError(f"the logs are of {', '.join(sorted(arms | {arm.name}))}, not of one arm")
    runs = _runs(logs, donations, arm, options.clock)
    calibration = fit(runs, arm, settings.model)
    if options.donate is not None:
        version = options.robotware or settings.robotware
        write_donation(options.donate, runs, arm, version, settings.model)
    if options.output_format == "json":
        print_json(as_json(calibration))
        return ExitCode.CLEAN
    current_terminal().show(as_text(calibration), soft_wrap=True)
    if options.donate is not None:
        echo(f"\nWritten: {options.donate}. What it contains: docs/help-us.md.")
    return ExitCode.CLEAN


def _write_programs(name: str, logs: Sequence[Path]) -> int:
    """Write the standard programs for an arm into this folder."""
    from rapidsim.applications.calibrate.standard_programs import standard_programs
    from rapidsim.cli.options.robot_choice import open_robot

    if logs:
        raise InputError("--programs takes no LOG", "it writes programs to log")
    texts = standard_programs(open_robot(name))
    for file in texts:
        _require_absent(Path(file))
    for file, text in texts.items():
        Path(file).write_text(text, encoding="ascii", newline="\r\n")
    echo(f"Written: {', '.join(texts)}. Log each, then `rapidsim calibrate LOG...`.")
    return ExitCode.CLEAN


def _require_absent(file: Path) -> None:
    if file.exists():
        raise InputError(f"{file} is here already", "it is never overwritten")


def _donations(files: Sequence[Path]) -> dict[Path, Donation]:
    if not files:
        return {}
    from rapidsim.applications.calibrate.donation import read_donation

    return {file: read_donation(file) for file in files}


def _runs(
    logs: Mapping[Path, str], donations: Mapping[Path, Donation], arm: Robot, clock: float
) -> list[LoggedRun]:
    """Return the logs with their programs; the times of donated ones are real already."""
    from rapidsim.applications.calibrate.fit import LoggedRun
    from rapidsim.applications.calibrate.joint_log import read_joint_log
    from rapidsim.jobs.checking.checked_program import load

    runs = []
    for log, path in logs.items():
        read = read_joint_log(log, len(arm.joints))
        tasks = read_tasks([path])
        loaded = load(tasks[0].files)
        if loaded.program is None:
            raise InputError(f"{path} has mistakes", f"see them with `rapidsim check {path}`")
        runs.append(LoggedRun(loaded.program, replace(read, times=read.times * clock)))
    if donations:
        from rapidsim.applications.calibrate.donation import donated_runs

        for file, donation in donations.items():
            runs += donated_runs(donation, arm, file.name)
    return runs


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
