"""System parameters of a controller without configuration files, derived from its cell.

Clients that begin by reading the axes get an answer for every station: the parameters of a backup
take precedence, and the types that it lacks follow from robots, tasks and signals. They are the
types that public clients read; names and units are those of a controller's files.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final, TypeAlias

from rapidsim.controller.cell.description import SignalDeclaration, Status
from rapidsim.language.equipment import Attributes, Configured
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.station.task_kind import TaskKind

_EGM: Final = "egmident"
"""Data type that every program guided by a sensor uses."""
_EGM_OPTION: Final = "689-1 Externally Guided Motion"
_Instances: TypeAlias = list[Mapping[str, str]]
_Types: TypeAlias = dict[str, _Instances]


def with_derived(setups: Sequence[TaskSetup], options: RunOptions) -> Configured:
    """Return the parameters of the station, completed by the types that it lacks."""
    derived = {
        "MOC": _motion(setups),
        "SYS": _system(setups),
        "EIO": _io(options.io.signals),
    }
    domains = dict.fromkeys((*options.configured, *derived))
    return {
        domain: {**derived.get(domain, {}), **options.configured.get(domain, {})}
        for domain in domains
    }


def is_guided(setups: Iterable[TaskSetup]) -> bool:
    """Whether a program is written for sensors that guide its robot."""
    modules = (module for setup in setups for module in setup.program.modules)
    return any(_EGM in module.source.text.lower() for module in modules)


def robots(setups: Sequence[TaskSetup]) -> Iterator[tuple[str, TaskSetup]]:
    """Iterate over the tasks that move a robot, with the names of their mechanical units."""
    movers = (one for one in setups if one.robot is not None)
    return ((f"ROB_{number}", one) for number, one in enumerate(movers, start=1))


def _motion(setups: Sequence[TaskSetup]) -> _Types:
    types: _Types = {
        name: [] for name in ("ARM", "JOINT", "MECHANICAL_UNIT", "ROBOT", "SINGLE", "TRANSMISSION")
    }
    for number, (unit, setup) in enumerate(robots(setups), start=1):
        assert setup.robot is not None
        names = [f"rob{number}_{axis}" for axis in range(1, len(setup.robot.joints) + 1)]
        for index, (name, joint) in enumerate(zip(names, setup.robot.joints, strict=True)):
            limits = joint.unit * joint.lower, joint.unit * joint.upper
            _add_axis(types, name, index, index, limits, rotates=not joint.slides)
        types["ROBOT"].append(
            Attributes(
                {
                    "name": unit,
                    "use_robot_type": setup.robot.name,
                    **{f"use_joint_{index}": name for index, name in enumerate(names)},
                    **_base_frame(setup),
                }
            )
        )
        types["MECHANICAL_UNIT"].append(
            Attributes({"name": unit, "use_robot": unit, "activate_at_start_up": "true"})
        )
        for external, axes in _units(setup.robot.external).items():
            singles = [f"{external}_{axis.letter}" for axis in axes]
            for name, one in zip(singles, axes, strict=True):
                logical = 6 + ord(one.letter) - ord("a")
                _add_axis(types, name, logical, 0, (one.lower, one.upper), rotates=not one.linear)
                types["SINGLE"].append(
                    Attributes({"name": name, "use_single_type": name, "use_joint": name})
                )
            used = {f"use_single_{place}": name for place, name in enumerate(singles)}
            types["MECHANICAL_UNIT"].append(Attributes({"name": external, **used}))
    return types


def _add_axis(
    types: _Types,
    name: str,
    logical: int,
    kinematic: int,
    limits: tuple[float, float],
    *,
    rotates: bool,
) -> None:
    """Add an axis: its arm with limits [rad or m], its transmission, its numbers."""
    lower, upper = limits
    bounds = {"lower_joint_bound": f"{lower:.10g}", "upper_joint_bound": f"{upper:.10g}"}
    types["ARM"].append(Attributes({"name": name, **bounds}))
    turning = {"rotating_move": "true"} if rotates else {}
    types["TRANSMISSION"].append(Attributes({"name": name, **turning}))
    numbers = {"logical_axis": str(logical + 1), "kinematic_axis_number": str(kinematic + 1)}
    parts = {"use_arm": name, "use_transmission": name}
    types["JOINT"].append(Attributes({"name": name, **numbers, **parts}))


def _base_frame(setup: TaskSetup) -> dict[str, str]:
    """Return the base frame of a robot in the world [m]."""
    place = setup.place
    positions = zip("xyz", place.translation, strict=True)
    return {
        **{f"base_frame_pos_{axis}": f"{float(one):.10g}" for axis, one in positions},
        **{f"base_frame_orient_u{n}": f"{float(q):.10g}" for n, q in enumerate(place.quaternion)},
    }


def _units(axes: Iterable[ExternalAxis]) -> dict[str, list[ExternalAxis]]:
    units: dict[str, list[ExternalAxis]] = {}
    for axis in axes:
        units.setdefault(axis.unit, []).append(axis)
    return units


def _system(setups: Sequence[TaskSetup]) -> _Types:
    moving = {one.name: unit for unit, one in robots(setups)}
    tasks: _Instances = []
    groups: _Instances = []
    for one in setups:
        task = {"Name": one.name, "Entry": one.entry or "main"}
        if one.kind is not TaskKind.SEMISTATIC:
            task["Type"] = one.kind.value.upper()
        if one.name in moving:
            group = f"rob{len(groups) + 1}"
            task |= {"MotionTask": "true", "UseMechanicalUnitGroup": group}
            assert one.robot is not None
            used = enumerate(_units(one.robot.external), start=1)
            units = {f"MechanicalUnit_{number}": unit for number, unit in used}
            groups.append(Attributes({"Name": group, "Robot": moving[one.name], **units}))
        tasks.append(Attributes(task))
    options = [Attributes({"name": "616-1 PC Interface", "desc": "616-1 PC Interface"})]
    if is_guided(setups):
        options.append(Attributes({"name": _EGM_OPTION, "desc": _EGM_OPTION}))
    if len(moving) > 1:
        options.append(Attributes({"name": "604-1 MultiMove Coordinated", "desc": "MultiMove"}))
    return {"CAB_TASKS": tasks, "MECHANICAL_UNIT_GROUP": groups, "PRESENT_OPTIONS": [*options]}


def _io(signals: Iterable[SignalDeclaration]) -> _Types:
    declared: _Instances = []
    shown: _Instances = []
    for one in signals:
        level = "ReadOnly" if one.status is not None else "All"
        declared.append(
            Attributes({"Name": one.name, "SignalType": one.kind.value.upper(), "Access": level})
        )
        if one.status is not None:
            of = {"Arg2": one.task} if one.task else {}
            if one.status in (Status.UNIT_ACTIVE, Status.UNIT_NOT_MOVING):
                of["Arg1"] = one.unit
            shown.append(Attributes({"Status": one.status.value, "Signal": one.name, **of}))
    return {"EIO_SIGNAL": declared, "SYSSIG_OUT": shown}
