"""The models behind the numbers of a run, as a record of JSON."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from rapidsim.json_records.declarations import OrAbsent, Rounded
from rapidsim.motion.model import Controller, MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import constants_of, model_of, torques_of
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class

_LIGHT_LOAD = 0.01
"""Share of the rated payload that is not worth a word."""
PROGRAM_POINTER = (
    "runs ahead of the robot: it continues after a fly-by move when the robot starts that move"
)


@value_class(frozen=True, slots=True)
class RunModels:
    """Models and their parameters, and what they leave out of the arm; empty without a run."""

    motion: OrAbsent[str] = None
    """Version of the motion model."""
    controller: OrAbsent[Controller] = None
    """Kind of controller, on which the duration of a stop point depends."""
    acceleration: OrAbsent[str] = None
    """Source of the accelerations or torques of the axes."""
    payload: OrAbsent[str] = None
    """Assumption about loads; absent if none counts."""
    axis_speed: OrAbsent[str] = None
    """Source of axis speeds that are not the arm's own."""
    corner: OrAbsent[str] = None
    """Shape of corner paths."""
    program_pointer: OrAbsent[str] = None
    filter_time_s: OrAbsent[float] = None
    """Width of the smoothing of the command."""
    smoothing: OrAbsent[str] = None
    """`axes` if each axis is smoothed separately, `path` if the command is."""
    fine_dwell_s: OrAbsent[float] = None
    """Duration of a stop point."""
    ramp: OrAbsent[str] = None
    """Effect of AccSet ramps; absent if no move has one."""
    robot_not_modelled: OrAbsent[tuple[str, ...]] = None
    time_s_with_acceleration_times: OrAbsent[Mapping[str, Rounded]] = None
    """Duration of the run [s] by a factor on all accelerations."""


def models(simulation: Simulation, times: Mapping[str, float] | None = None) -> RunModels:
    """Return the models of a run.

    Args:
        simulation: The run.
        times: Durations of the run [s] by a factor on all accelerations.
    """
    model = simulation.model
    resolved = [model_of(one.robot, model) for one in simulation.robots]
    return RunModels(
        motion=model.version,
        controller=model.controller,
        acceleration="; ".join(of_robots(simulation, lambda robot: [_acceleration(model, robot)])),
        payload=_load(simulation),
        axis_speed=_axis_speeds(simulation),
        corner=model.corner,
        program_pointer=PROGRAM_POINTER,
        filter_time_s=max(one.window for one in resolved),
        smoothing=model.smoothing,
        fine_dwell_s=max(one.dwell for one in resolved),
        ramp=_ramps(simulation),
        robot_not_modelled=tuple(of_robots(simulation, lambda robot: robot.not_modelled)),
        time_s_with_acceleration_times=times,
    )


def of_robots(simulation: Simulation, texts: Callable[[Robot], Sequence[str]]) -> list[str]:
    """Notes on the robots of a run, deduplicated; with names unless all share the note."""
    robots = {one.robot.name: one.robot for one in simulation.robots}
    said: dict[str, list[str]] = {}
    for name, robot in robots.items():
        for text in texts(robot):
            said.setdefault(text, []).append(name)
    return [
        text if len(names) == len(robots) else f"{', '.join(names)}: {text}"
        for text, names in said.items()
    ]


def _axis_speeds(simulation: Simulation) -> str | None:
    """The source of axis speeds other than the arm's own."""
    given = simulation.model.max_speed
    if given is not None:
        units = simulation.robots[0].robot.units("/s")
        return f"axis speeds {_degrees(given)} {units}, from the station file"
    return "; ".join(of_robots(simulation, _speed_lender)) or None


def _speed_lender(robot: Robot) -> list[str]:
    """The arm whose axis speeds a robot uses; empty if they are its own."""
    if robot.axis_speeds_from is None:
        return []
    return [f"axis speeds of {robot.axis_speeds_from}, no source gives those of {robot.name}"]


def _acceleration(model: MotionModel, robot: Robot) -> str:
    """Note on the assumed accelerations of an arm."""
    own = constants_of(robot, model)
    if torques_of(robot, model):
        factors = (*model.torque, model.wrist)
        fitted = ""
        if factors != (1.0,) * len(factors):
            numbers = ", ".join(f"{factor:g}" for factor in factors)
            fitted = f", times {numbers} from the station file"
        return f"{own.limits_text}{fitted}"
    measured = [a for joint in robot.joints if (a := joint.max_acceleration) is not None]
    if model.acceleration is not None:
        return f"axis accelerations {_degrees(model.acceleration)} {robot.units('/s2')}"
    if model.version == "1" and model.own_accelerations and any(measured):
        return f"axis accelerations {_degrees(measured)} {robot.units('/s2')}, measured on this arm"
    if model.version == "3" and model.own_accelerations:
        return own.limits_text
    return f"axis acceleration = axis speed / {model.acceleration_time:g} s"


def _load(simulation: Simulation) -> str | None:
    """Note on the modelled effect of loads; None if none adds to the inertia of an arm."""
    for one in simulation.robots:
        if torques_of(one.robot, simulation.model) and any(
            (piece.path.programmed.load > _LIGHT_LOAD).any() for piece in one.trajectory.pieces
        ):
            return "the load is assumed to be a point mass at the wrist"
    return None


def _ramps(simulation: Simulation) -> str | None:
    """Note on the modelled effect of AccSet ramps; None if no move has one."""
    if not any(robot.trajectory.has_ramps for robot in simulation.robots):
        return None
    return "AccSet's ramp of p % averages the speed over 100 / p of that time (assumed)"


def _degrees(values: Sequence[float]) -> str:
    return ", ".join(f"{math.degrees(value):g}" for value in values)
