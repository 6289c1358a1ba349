"""Tracks and positioners of a backup: mechanical units in `SYSPAR/MOC.cfg` other than the robots.

The data of an axis are in several types: MECHANICAL_UNIT refers to its SINGLE, which refers to its
SINGLE_TYPE (track or rotating) and JOINT. JOINT has its position in `extjoint` and refers to the
rest: bounds in ARM, acceleration in ACC_DATA, transmission, motor speed. Units of ABB's own
positioners have no such instances in a backup: only their names are known. The same applies to a
unit that a program must activate: its axes have no values until then, and a run has no such units.

Source: Technical reference manual System parameters, topic Motion.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from rapidsim.motion.robot.external_axes import LETTERS, ExternalAxis
from rapidsim.station.backup.cfg_file import SWITCHED_ON, Configuration, Instance
from rapidsim.station.backup.robots import base_frame, bounds, number
from rapidsim.values import value_class

UNIT_GROUP = "MECHANICAL_UNIT_GROUP"
_SINGLES = 6
_FIRST_AXIS = 7
_LINEAR = ("TRACK", "EXT_LIN", "FREE_LIN")
_ROTATING = ("FREE_ROT", "EXT_ROT")


@value_class(frozen=True, slots=True)
class ExternalUnits:
    """Mechanical units other than the robots."""

    axes: tuple[tuple[ExternalAxis, ...], ...] = ()
    """Simulated axes of each robot."""
    unsupported: tuple[str, ...] = ()
    """Names of the units that the backup does not describe fully."""


def external_units(motion: Configuration, system: Configuration) -> ExternalUnits:
    """Return the units of each robot, according to MOC.cfg and the unit groups in SYS.cfg.

    A unit in no group belongs to the first robot.
    """
    robots = [one for one in motion.get("ROBOT", ()) if one.get("use_robot_type")]
    owners = _owners(system, [one.get("name") for one in robots])
    named = {kind: _by_name(instances) for kind, instances in motion.items()}
    tracks = {one.get("base_frame_coordinated") for one in robots}
    active = {
        unit.get("name")
        for unit in motion.get("MECHANICAL_UNIT", ())
        if unit.get("activate_at_start_up", "").lower() == SWITCHED_ON
    }
    axes: list[list[ExternalAxis]] = [[] for _ in robots or ({},)]
    others: list[str] = []
    for unit, singles in _units(motion).items():
        owner = owners.get(unit, 0)
        found = [_axis(unit, one, named, carries_robot=unit in tracks) for one in singles]
        whole = [axis for axis in found if axis is not None]
        if owner is None or unit not in active or len(whole) < len(found):
            others.append(unit)
            continue
        mine = axes[owner]
        if len({axis.letter for axis in (*mine, *whole)}) < len(mine) + len(whole):
            others.append(unit)
        else:
            mine += whole
    return ExternalUnits(
        tuple(tuple(sorted(mine, key=lambda axis: axis.letter)) for mine in axes), tuple(others)
    )


def _owners(system: Configuration, labels: Sequence[str | None]) -> Mapping[str, int | None]:
    """Return the number of the robot of each unit in a group; None if no robot has it.

    If several robots share a unit it is the first of them.
    """
    groups = system.get(UNIT_GROUP, ())
    # A group whose robot MOC.cfg lacks is that of the first robot, if no other group is.
    unknown = None if any(group.get("robot") in labels for group in groups) else 0
    owners: dict[str, int | None] = {}
    for group in groups:
        robot = group.get("robot")
        owner = labels.index(robot) if robot in labels else unknown if robot else None
        for key, unit in group.items():
            if key.lower().startswith("mechanicalunit_"):
                known = [one for one in (owners.get(unit), owner) if one is not None]
                owners[unit] = min(known, default=None)
    return owners


def _units(motion: Configuration) -> Mapping[str, Sequence[str]]:
    """Return the names of the singles of each unit; a single in no unit is a separate unit."""
    units: dict[str, list[str]] = {}
    for unit in motion.get("MECHANICAL_UNIT", ()):
        singles = [one for n in range(_SINGLES) if (one := unit.get(f"use_single_{n}"))]
        if singles and unit.get("name"):
            units[unit["name"]] = singles
    used = {name for singles in units.values() for name in singles}
    for single in motion.get("SINGLE", ()):
        if (name := single.get("name")) and name not in used:
            units.setdefault(name, [name])
    return units


def _axis(
    unit: str,
    name: str,
    named: Mapping[str, Mapping[str, Instance]],
    *,
    carries_robot: bool,
) -> ExternalAxis | None:
    """Return one axis of a unit; None if the configuration does not describe it fully."""

    def instance(kind: str, of: str | None) -> Instance:
        return named.get(kind, {}).get(of or "", {})

    single = instance("SINGLE", name)
    mechanics = instance("SINGLE_TYPE", single.get("use_single_type")).get("mechanics", "").upper()
    joint = instance("JOINT", single.get("use_joint"))
    arm = instance("ARM", joint.get("use_arm"))
    place = number(joint, "logical_axis")
    limits = bounds(arm)
    gear = number(instance("TRANSMISSION", joint.get("use_transmission")), "transm_joint")
    duty = instance("STRESS_DUTY_CYCLE", joint.get("use_stress_duty_cycle") or joint.get("name"))
    motor_speed = number(duty, "speed_absolute_max")
    acceleration = instance("ACC_DATA", arm.get("use_acc_data"))
    most = number(acceleration, "wc_acc") or number(acceleration, "nom_acc")
    known = mechanics in (*_LINEAR, *_ROTATING)
    if not (known and place and limits and gear and motor_speed and most):
        return None
    letter = int(place) - _FIRST_AXIS
    if not 0 <= letter < len(LETTERS):
        return None
    linear = mechanics in _LINEAR
    frame = base_frame(single)
    return ExternalAxis(
        unit=unit,
        letter=LETTERS[letter],
        linear=linear,
        lower=limits[0],
        upper=limits[1],
        max_speed=motor_speed / math.fabs(gear),
        max_acceleration=most,
        carries=("robot" if carries_robot else None) if linear else "wobj",
        direction=tuple(frame.rotation[:, 0 if linear else 2].tolist()),
        world_from_user=frame,
    )


def _by_name(instances: Sequence[Instance]) -> Mapping[str, Instance]:
    return {one.get("name", ""): one for one in instances}
