"""Tracks and positioners of a backup: mechanical units in `SYSPAR/MOC.cfg` other than the robots.

MECHANICAL_UNIT refers to its SINGLE, which refers to its SINGLE_TYPE (track or rotating) and JOINT
(`axis_drives`); `gantries` are chains of joints. Units of ABB's own positioners have no such
instances in a backup: only their names are known. The same applies to a unit that a program must
activate: its axes have no values until then, and a run has no such units.

Source: Technical reference manual System parameters, topic Motion.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field

from rapidsim.frames.transform import Transform
from rapidsim.motion.robot.external_axes import Carried, ExternalAxis
from rapidsim.station.backup.axis_drives import Named, axis_drive, by_name, instance_of
from rapidsim.station.backup.cfg_file import SWITCHED_ON, Configuration
from rapidsim.station.backup.gantries import gantries
from rapidsim.station.backup.robots import arm_instances, base_frame
from rapidsim.values import value_class

UNIT_GROUP = "MECHANICAL_UNIT_GROUP"
_SINGLES = 6
_LINEAR = ("TRACK", "EXT_LIN", "FREE_LIN")
_ROTATING = ("FREE_ROT", "EXT_ROT")


@value_class(frozen=True, slots=True)
class ExternalUnits:
    """Mechanical units other than the robots."""

    axes: tuple[tuple[ExternalAxis, ...], ...] = ()
    """Simulated axes of each robot."""
    world_from_end: Mapping[str, Transform] = field(default_factory=dict)
    """Frame that carries a robot, of each gantry with simulated axes, with all of these at zero."""
    unsupported: tuple[str, ...] = ()
    """Names of the units that the backup does not describe fully."""


def external_units(motion: Configuration, system: Configuration) -> ExternalUnits:
    """Return the units of each robot, according to MOC.cfg and the unit groups in SYS.cfg.

    A unit in no group belongs to the first robot.
    """
    robots = arm_instances(motion)
    owners = _owners(system, [one.get("name") for one in robots])
    named = by_name(motion)
    chains = gantries(motion, named)
    tracks = {one.get("base_frame_coordinated") for one in robots}
    active = {
        unit.get("name")
        for unit in motion.get("MECHANICAL_UNIT", ())
        if unit.get("activate_at_start_up", "").lower() == SWITCHED_ON
    }
    axes: list[list[ExternalAxis]] = [[] for _ in robots or ({},)]
    others: list[str] = []
    described: dict[str, Sequence[ExternalAxis] | None] = {
        unit: _axes(unit, singles, named, carries_robot=unit in tracks)
        for unit, singles in _units(motion).items()
    }
    for unit, gantry in chains.items():
        described[unit] = None if gantry is None else gantry.axes
    for unit, whole in described.items():
        owner = owners.get(unit, 0)
        if owner is None or unit not in active or whole is None:
            others.append(unit)
            continue
        mine = axes[owner]
        if len({axis.letter for axis in (*mine, *whole)}) < len(mine) + len(whole):
            others.append(unit)
        else:
            mine += whole
    ends = {
        unit: gantry.world_from_end
        for unit, gantry in chains.items()
        if gantry is not None and unit not in others
    }
    by_letter = (tuple(sorted(mine, key=lambda axis: axis.letter)) for mine in axes)
    return ExternalUnits(tuple(by_letter), ends, tuple(others))


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


def _axes(
    unit: str, singles: Sequence[str], named: Named, *, carries_robot: bool
) -> Sequence[ExternalAxis] | None:
    """Return the axes of a unit; None if the configuration does not describe them fully."""
    found = [_axis(unit, one, named, carries_robot=carries_robot) for one in singles]
    whole = [axis for axis in found if axis is not None]
    return whole if len(whole) == len(found) else None


def _axis(unit: str, name: str, named: Named, *, carries_robot: bool) -> ExternalAxis | None:
    """Return one axis of a unit; None if the configuration does not describe it fully."""
    single = instance_of(named, "SINGLE", name)
    kind = instance_of(named, "SINGLE_TYPE", single.get("use_single_type"))
    mechanics = kind.get("mechanics", "").upper()
    drive = axis_drive(named, instance_of(named, "JOINT", single.get("use_joint")))
    if drive is None or mechanics not in (*_LINEAR, *_ROTATING):
        return None
    linear = mechanics in _LINEAR
    frame = base_frame(single)
    carries: Carried | None = ("robot" if carries_robot else None) if linear else "wobj"
    return drive.axis(unit, carries, frame.rotation[:, 0 if linear else 2], frame, linear=linear)
