"""What the command line asks of a run, as one `Asked`; and a job of it, with its notes said."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from datetime import datetime
from typing import TYPE_CHECKING

import click

from rapidsim.cli.options.answers import answers_from
from rapidsim.cli.options.dates import Date
from rapidsim.cli.options.numbers import POSITIVE
from rapidsim.cli.options.poses import scale_option
from rapidsim.cli.terminal import echo
from rapidsim.files import InputError
from rapidsim.jobs.job import Job, OpenRobot, job
from rapidsim.jobs.run_request import RunRequest
from rapidsim.station.station import Station

if TYPE_CHECKING:
    from rapidsim.controller.cell.network import Network
    from rapidsim.motion.robot.robot import Robot

assume_missing_option = click.option(
    "--assume-missing",
    is_flag=True,
    help="Assume that what no module declares exists: skip calls, use tool0 for tools.",
)
strict_option = click.option(
    "--strict", is_flag=True, help="Fail on what is unknown, not simulated or not checked, too."
)
_PROGRAM = (
    click.argument("paths", metavar="PATH...", nargs=-1, required=True),
    click.option(
        "--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them."
    ),
    scale_option,
    click.option(
        "--station", metavar="FILE.toml", help="The station file, instead of the nearest."
    ),
    click.option("--task", metavar="NAME", help="Only this task, of several."),
    click.option("--proc", metavar="NAME", default="main", help="The procedure to run."),
)
_INPUTS = (
    click.option(
        "--io", metavar="FILE.toml", help="Signals and what happens to inputs; adds to the station."
    ),
    click.option(
        "--answers", metavar="FILE", help="Answers to the program's questions, one per line."
    ),
    click.option("--home", metavar="DIR", help="The folder for HOME:; default <program>.home."),
    click.option(
        "--allow-network", is_flag=True, help="Sockets may use real ports of this computer."
    ),
    click.option(
        "--network-host",
        "network_hosts",
        metavar="ADDRESS",
        multiple=True,
        help="Another host that sockets may reach.",
    ),
    assume_missing_option,
    strict_option,
    click.option(
        "--start-time",
        metavar="DATE",
        type=Date(),
        help="The controller's clock at the start; default 2000-01-01.",
    ),
    click.option(
        "--max-time",
        metavar="SECONDS",
        type=POSITIVE,
        default=3600.0,
        show_default=True,
        help="End the run after this much simulated time.",
    ),
    click.option(
        "--max-wall",
        metavar="SECONDS",
        type=POSITIVE,
        help="End the run after this much real time; default: no limit.",
    ),
    click.option(
        "--cycles",
        metavar="N",
        type=click.IntRange(min=1),
        default=1,
        show_default=True,
        help="How many times the procedure runs.",
    ),
)


def program_options(command: Callable[..., int]) -> Callable[..., int]:
    """Give a command options of the program; these and `input_options` come as one `asked`."""

    @functools.wraps(command)
    def asking(
        *,
        paths: tuple[str, ...],
        robot: str | None,
        scale: float | None,
        station: str | None,
        task: str | None,
        proc: str,
        io: str | None,
        answers: str | None,
        home: str | None,
        allow_network: bool,
        network_hosts: tuple[str, ...],
        assume_missing: bool,
        strict: bool,
        start_time: datetime | None,
        max_time: float,
        max_wall: float | None,
        cycles: int,
        **others: object,
    ) -> int:
        if network_hosts and not allow_network:
            raise InputError("--network-host: it needs --allow-network")
        asked = RunRequest(
            paths=paths,
            robot=robot,
            scale=scale,
            station=station,
            task=task,
            io=io,
            entry=proc,
            answers=answers_from(answers),
            answers_are_typed=answers is None,
            home=home,
            network=_network(network_hosts) if allow_network else None,
            assume_missing=assume_missing,
            strict=strict,
            starts_at=start_time,
            max_time_s=max_time,
            max_wall_s=max_wall,
            max_cycles=cycles,
        )
        return command(request=asked, **others)

    return _with_all(_PROGRAM, asking)


def input_options(command: Callable[..., int]) -> Callable[..., int]:
    """Give a command the options of what a run is given beside its program."""
    return _with_all(_INPUTS, command)


def _with_all(
    options: Sequence[Callable[[Callable[..., int]], Callable[..., int]]],
    command: Callable[..., int],
) -> Callable[..., int]:
    # Decorators stand on the help page from the last applied to the first.
    for option in reversed(options):
        command = option(command)
    return command


def job_of(request: RunRequest, *, open_robot: OpenRobot | None = None) -> Job:
    """The job that is asked for; what a backup says and is left out is said on stderr.

    Args:
        request: The request.
        open_robot: Loads an arm; None says on stderr what is special about it.
    """
    found = job(request, open_robot=open_robot or functools.cache(_open_robot))
    echo_remarks(found.station)
    return found


def echo_remarks(station: Station) -> None:
    """Say on stderr what a backup says of the cell and is left out."""
    for remark in station.remarks:
        echo(f"note: {remark}", err=True)


def _open_robot(name: str, scale: float | None) -> Robot:
    from rapidsim.cli.options.robot_choice import open_robot

    return open_robot(name, scale)


def open_quietly(name: str, scale: float | None) -> Robot:
    """Load an arm; who does so says what is special about it, or another process does."""
    from rapidsim.cli.options.robot_choice import robot_of

    return robot_of(name, scale)


def _network(hosts: Sequence[str]) -> Network:
    """The network, for the few runs that may use it."""
    from rapidsim.controller.cell.network import Network
    from rapidsim.egm.devices import SensorDevices
    from rapidsim.egm.udp import PacedSensors

    allowed = frozenset(hosts)
    return Network(allowed, PacedSensors(SensorDevices(hosts=allowed)))
