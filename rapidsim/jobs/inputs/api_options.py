"""Requests from Python: paths, an arm, and `RunOptions`, which describe both the run and the cell.

Checking a program without moves goes through here too, so imports that need NumPy are deferred.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from os import PathLike, fspath
from typing import TYPE_CHECKING

from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.motion.model import MotionModel
from rapidsim.station.station import Station
from rapidsim.station.tasks import DEFAULT_TASK, StationTask

if TYPE_CHECKING:
    from rapidsim.frames.transform import Transform
    from rapidsim.motion.robot.robot import Robot
    from rapidsim.simulation.options import RunOptions
    from rapidsim.station.robot import StationRobot


def api_request(
    paths: Iterable[str | PathLike[str]],
    robot: Robot | str | None,
    options: RunOptions | None,
) -> RunRequest:
    """Return the request of a call of `rapidsim.check` or `rapidsim.simulate`."""
    asked = RunRequest(paths=tuple(fspath(path) for path in paths), robot=robot, cell=options)
    if options is None:
        return asked
    from rapidsim.controller.cell.inputs import START_OF_TIME

    return replace(
        asked,
        entry=options.entry,
        answers=options.answers,
        answers_are_typed=options.answers_are_typed,
        home=None if options.home is None else str(options.home),
        network=options.network,
        starts_at=None if options.starts_at == START_OF_TIME else options.starts_at,
        max_time_s=options.max_time_s,
        max_wall_s=options.max_wall_s,
        max_cycles=options.max_cycles,
    )


def with_api_options(station: Station, options: RunOptions) -> Station:
    """Return a station with the non-default settings of the options in place of its own."""
    is_named = options.task != DEFAULT_TASK and not station.tasks
    return replace(
        station,
        robots=_robots(station.robots, options),
        external_axes=options.external_axes or station.external_axes,
        model=station.model if options.model == MotionModel() else options.model,
        nearest_configuration=station.nearest_configuration or options.nearest_configuration,
        exact_configuration=station.exact_configuration or options.exact_configuration,
        io=station.io.and_also(options.io),
        tasks=(StationTask(options.task),) if is_named else station.tasks,
    )


def _robots(robots: tuple[StationRobot, ...], options: RunOptions) -> tuple[StationRobot, ...]:
    """Return the robots, with start and base of the first one replaced by those of the options."""
    from rapidsim.station.robot import StationRobot

    start, place = options.start_joints_deg, options.world_from_base
    if start is None and _is_identity(place):
        return robots
    first, *others = robots or (StationRobot(),)
    first = replace(
        first,
        start_joints_deg=first.start_joints_deg if start is None else start,
        world_from_base=first.world_from_base if _is_identity(place) else place,
    )
    return (first, *others)


def _is_identity(transform: Transform) -> bool:
    import numpy as np

    return not transform.translation.any() and np.array_equal(transform.rotation, np.eye(3))
