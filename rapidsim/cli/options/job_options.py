"""The options of a run as one `RunRequest`, and the job of a request."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from datetime import datetime
from typing import TYPE_CHECKING, Any

import click

from rapidsim.cli.options.answers import answers_from
from rapidsim.cli.options.dates import Date
from rapidsim.cli.options.declared import Command, argument, attach, collect, option, shared
from rapidsim.cli.options.numbers import POSITIVE
from rapidsim.cli.options.poses import scale_option
from rapidsim.cli.terminal import echo
from rapidsim.files import InputError
from rapidsim.jobs.cache.number_store import NumberStore
from rapidsim.jobs.cache.result_store import store_of_user
from rapidsim.jobs.inputs.job import Job, OpenRobot, job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.station.station import Station
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.collisions.outer_hull import HullStore
    from rapidsim.controller.cell.network import Network
    from rapidsim.motion.robot.robot import Robot

assume_missing_option = click.option(
    "--assume-missing",
    is_flag=True,
    help="Assume that undeclared names exist: skip calls, use tool0 for tools.",
)
strict_option = click.option(
    "--strict", is_flag=True, help="Also fail on anything unknown, not simulated or not checked."
)

no_cache_option = click.option(
    "--no-cache",
    is_flag=True,
    envvar="RAPIDSIM_NO_CACHE",
    help="Neither use nor store cached results.",
)


@value_class(frozen=True, slots=True)
class ProgramOptions:
    """Options of the program of a run."""

    paths: tuple[str, ...] = argument("PATH...", nargs=-1, required=True)
    robot: str | None = option(
        "--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them."
    )
    scale: float | None = shared(scale_option)
    station: str | None = option(
        "--station", metavar="FILE.toml", help="The station file, instead of the nearest."
    )
    task: str | None = option("--task", metavar="NAME", help="Only this task, of several.")
    proc: str = option("--proc", metavar="NAME", default="main", help="The procedure to run.")


@value_class(frozen=True, slots=True)
class InputOptions:
    """Options of the inputs, limits and clock of a run."""

    io: str | None = option(
        "--io", metavar="FILE.toml", help="Signals and stimuli of inputs; adds to the station."
    )
    answers: str | None = option(
        "--answers", metavar="FILE", help="Answers to the program's questions, one per line."
    )
    home: str | None = option(
        "--home", metavar="DIR", help="The folder for HOME:; default <program>.home."
    )
    allow_network: bool = option(
        "--allow-network", is_flag=True, help="Sockets may use real ports of this computer."
    )
    network_hosts: tuple[str, ...] = option(
        "--network-host",
        metavar="ADDRESS",
        multiple=True,
        help="Another host that sockets may reach.",
    )
    assume_missing: bool = shared(assume_missing_option)
    strict: bool = shared(strict_option)
    start_time: datetime | None = option(
        "--start-time",
        metavar="DATE",
        type=Date(),
        help="The controller's clock at the start; default 2000-01-01.",
    )
    max_time: float = option(
        "--max-time",
        metavar="SECONDS",
        type=POSITIVE,
        default=3600.0,
        show_default=True,
        help="End the run after this much simulated time.",
    )
    max_wall: float | None = option(
        "--max-wall",
        metavar="SECONDS",
        type=POSITIVE,
        help="End the run after this much real time; default: no limit.",
    )
    cycles: int = option(
        "--cycles",
        metavar="N",
        type=click.IntRange(min=1),
        default=1,
        show_default=True,
        help="How many times the procedure runs.",
    )
    no_cache: bool = shared(no_cache_option)


def program_options(command: Command) -> Command:
    """Add the options of a program to a command; with `input_options` they form a `request`."""

    @functools.wraps(command)
    def with_request(**values: Any) -> int:
        program, inputs = collect(ProgramOptions, values), collect(InputOptions, values)
        return command(request=_request(program, inputs), **values)

    return attach(ProgramOptions)(with_request)


input_options = attach(InputOptions)
"""Adds the input options to a command with `program_options`."""


def _request(program: ProgramOptions, inputs: InputOptions) -> RunRequest:
    if inputs.network_hosts and not inputs.allow_network:
        raise InputError("--network-host: it needs --allow-network")
    return RunRequest(
        paths=program.paths,
        robot=program.robot,
        scale=program.scale,
        station=program.station,
        task=program.task,
        io=inputs.io,
        entry=program.proc,
        answers=answers_from(inputs.answers),
        answers_are_typed=inputs.answers is None,
        home=inputs.home,
        hulls=hulls_of_earlier_runs(uses_cache=not inputs.no_cache),
        network=_network(inputs.network_hosts) if inputs.allow_network else None,
        assume_missing=inputs.assume_missing,
        strict=inputs.strict,
        starts_at=inputs.start_time,
        max_time_s=inputs.max_time,
        max_wall_s=inputs.max_wall,
        max_cycles=inputs.cycles,
    )


def hulls_of_earlier_runs(*, uses_cache: bool) -> HullStore | None:
    """Return the user's store of bodies around meshes; None if it is not used, or not there."""
    store = store_of_user() if uses_cache else None
    return None if store is None else NumberStore(store)


def job_of(request: RunRequest, *, open_robot: OpenRobot | None = None) -> Job:
    """Return the job of a request; print notes on skipped parts of a backup on stderr.

    Args:
        request: The request.
        open_robot: Loads an arm; None also prints notes on it on stderr.
    """
    found = job(request, open_robot=open_robot or functools.cache(_open_robot))
    echo_remarks(found.station)
    return found


def echo_remarks(station: Station) -> None:
    """Print notes on skipped parts of a backup on stderr."""
    for remark in station.remarks:
        echo(f"note: {remark}", err=True)


def _open_robot(name: str, scale: float | None) -> Robot:
    from rapidsim.cli.options.robot_choice import open_robot

    return open_robot(name, scale)


def open_quietly(name: str, scale: float | None) -> Robot:
    """Load an arm without printing notes on it; the caller prints them."""
    from rapidsim.cli.options.robot_choice import robot_of

    return robot_of(name, scale)


def _network(hosts: Sequence[str]) -> Network:
    """The network, for the few runs that may use it."""
    from rapidsim.controller.cell.network import Network
    from rapidsim.egm.devices import SensorDevices
    from rapidsim.egm.udp import PacedSensors

    allowed = frozenset(hosts)
    return Network(allowed, PacedSensors(SensorDevices(hosts=allowed)))
