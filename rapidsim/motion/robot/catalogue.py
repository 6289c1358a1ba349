"""The robots that ship with rapidsim: one folder each, described by its `robot.toml`.

Input is a name, output a `CatalogueEntry` in SI units. Shapes are generated from the same entry by
`scripts/build_robots.py` and stored beside it. The short names of all robots are in one file,
`aliases.toml`, so that finding a robot reads only its own entry.
"""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Mapping, Sequence
from functools import cache
from math import log, radians
from pathlib import Path
from typing import Any

import numpy as np

from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.motion.kinematics.closed_form.five_axis import FiveAxis, FiveAxisGeometry
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_geometry import JOINT_COUNT, OpwGeometry
from rapidsim.motion.kinematics.closed_form.palletizer import Palletizer, PalletizerGeometry
from rapidsim.motion.kinematics.closed_form.scara import Scara, ScaraGeometry
from rapidsim.motion.kinematics.numerical.revolute_chain import AxisRowGeometry, searched_arm
from rapidsim.motion.robot.dynamics import Dynamics, Torques, prior
from rapidsim.motion.robot.structures import Geometry, geometry_from_table
from rapidsim.shipped import shipped
from rapidsim.values import value_class

_PARTS = re.compile(r"(\d+)")
NEAR_NAMES = 5
"""How many similar names an unknown one is answered with."""


class RobotError(InputError):
    """A robot that cannot be loaded; the message says which, why, and what to do."""

    def __init__(self, message: str, similar: Sequence[str] = ()) -> None:
        """Say so; `similar` are known names near one that is not."""
        super().__init__(message, similar=similar)


@value_class(frozen=True, slots=True)
class CatalogueEntry:
    """What is known about one arm."""

    name: str
    title: str
    maker: str
    geometry: Geometry
    joint_names: tuple[str, ...]
    limits: tuple[tuple[float, float], ...]
    """Lower and upper limit of each joint [rad]."""
    max_speeds: tuple[float | None, ...]
    """[rad/s]; None where no source gives it."""
    max_accelerations: tuple[float | None, ...]
    """[rad/s2], as version 1 of the motion model has them; None unless they were measured."""
    torques: Torques | None
    """None unless they were measured."""
    payload_kg: float | None
    reach_m: float | None
    sources: tuple[str, ...]
    """Where the numbers come from."""
    checks: tuple[str, ...]
    """What the figures were compared with."""
    notes: tuple[str, ...]
    notices: tuple[str, ...]
    """What the user of the arm should know; commands print them."""
    not_modelled: tuple[str, ...]
    """What the arm has and a run leaves out; every run on it says so."""
    link_excess_m: tuple[float, ...]
    """See `Robot.link_excess_m`."""
    folder: Path

    @property
    def urdf(self) -> Path | None:
        """The description with link shapes, if there is one."""
        file = self.folder / f"{self.name}.urdf"
        return file if file.is_file() else None


def robots_folder() -> Path:
    """The folder of the catalogue, in a checkout and in an installation alike."""
    return shipped("robots")


@cache
def robot_names() -> tuple[str, ...]:
    """The names of all robots in the catalogue, sorted, with numbers compared by value."""
    names = (file.parent.name for file in robots_folder().glob("*/robot.toml"))
    return tuple(sorted(names, key=_by_number))


@cache
def aliases() -> Mapping[str, str]:
    """The short names of robots, and the robots they refer to."""
    text = (robots_folder() / "aliases.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def aliases_of(name: str) -> tuple[str, ...]:
    """The short names of a robot."""
    return tuple(alias for alias, robot in aliases().items() if robot == name)


def entry_name(name: str) -> str:
    """The name of a robot in lower case, of an alias the name it refers to."""
    wanted = name.lower()
    return aliases().get(wanted, wanted)


def find_entry(name: str) -> CatalogueEntry:
    """The robot of a name or alias, in any case.

    Raises:
        RobotError: If there is none; the message lists the closest names.
    """
    wanted = entry_name(name)
    if wanted not in robot_names():
        raise _unknown(name)
    return read_entry(robots_folder() / wanted)


def speed_lender(entry: CatalogueEntry) -> CatalogueEntry | None:
    """The arm whose axis speeds stand in for unknown ones; None if no arm of the same kind has any.

    Arms of one kind have the same maker and structure. Those of the same family are preferred, then
    those whose type has the same number, then those of the nearest payload and reach. The inertia
    of a payload grows with the square of the reach, which therefore counts twice.
    """

    def is_of_kind(other: CatalogueEntry) -> bool:
        kind = entry.maker, type(entry.geometry), len(entry.limits)
        return kind == (other.maker, type(other.geometry), len(other.limits))

    def difference(other: CatalogueEntry) -> tuple[bool, bool, float]:
        return (
            _family(other.name) != _family(entry.name),
            _type_number(other.name) != _type_number(entry.name),
            2.0 * _distance(other.reach_m, entry.reach_m)
            + _distance(other.payload_kg, entry.payload_kg),
        )

    return min(filter(is_of_kind, _entries_with_speeds()), key=difference, default=None)


@cache
def _entries_with_speeds() -> tuple[CatalogueEntry, ...]:
    """The arms whose axis speeds a source gives."""
    entries = map(find_entry, robot_names())
    return tuple(entry for entry in entries if None not in entry.max_speeds)


def _family(name: str) -> str:
    """The part of a name before payload and reach."""
    return name.partition("-")[0]


def _type_number(name: str) -> str:
    """The number of a type, such as 1300 of `crb1300-7-1.4`."""
    number = _PARTS.search(name)
    return "" if number is None else number[0]


def _distance(one: float | None, other: float | None) -> float:
    """Distance of two figures as the logarithm of their ratio; 0 if either is unknown."""
    return abs(log(one / other)) if one and other else 0.0


def read_entry(folder: Path) -> CatalogueEntry:
    """Read the `robot.toml` of a folder.

    Raises:
        RobotError: If the file says something that is not understood.
    """
    file = folder / "robot.toml"
    try:
        return _entry(tomllib.loads(file.read_text(encoding="utf-8")), folder)
    except KeyError as missing:
        raise RobotError(f"{file}: {missing} is missing") from None
    except (tomllib.TOMLDecodeError, TypeError, ValueError) as mistake:
        raise RobotError(f"{file}: {mistake}") from None


def kinematics_of(entry: CatalogueEntry) -> Kinematics:
    """The solver for an arm: its closed form, or a search if it has none."""
    match entry.geometry:
        case OpwGeometry() as geometry:
            return arm_from_geometry(geometry)
        case FiveAxisGeometry() as geometry:
            return FiveAxis(geometry)
        case PalletizerGeometry() as geometry:
            return Palletizer(geometry)
        case ScaraGeometry() as geometry:
            return Scara(geometry)
        case AxisRowGeometry() as geometry:
            return searched_arm(geometry, entry.limits)


def dynamics_of(entry: CatalogueEntry) -> Dynamics | None:
    """Torque limits of the main axes of an arm: measured, else scaled from measured ABB arms.

    None if neither is known: arms of other makers and kinds, and those without axis speeds.
    """
    if not isinstance(entry.geometry, OpwGeometry):
        return None
    if entry.torques is not None:
        return Dynamics(entry.torques, entry.geometry)
    speeds = tuple(speed for speed in entry.max_speeds if speed is not None)
    if entry.maker != "ABB" or entry.reach_m is None or len(speeds) != JOINT_COUNT:
        return None
    return Dynamics(prior(entry.geometry, speeds, entry.reach_m), entry.geometry)


def arm_from_geometry(geometry: OpwGeometry) -> OrthoParallel:
    """The arm with link frames that are parallel to the base with all joints at 0.

    The origin of link 1 is at the foot, 2 and 3 on their axes, 4 beside the elbow on axis 4, 5 in
    the wrist centre, 6 in the flange. The flange frame is that of the formulas, which for ABB's
    zero position is `tool0`.
    """
    to_flange = np.array([0.0, 0.0, geometry.c4])
    unnamed = Transform(np.broadcast_to(np.eye(3), (JOINT_COUNT, 3, 3)), np.zeros((JOINT_COUNT, 3)))
    opw6_from_flange = Transform(np.eye(3), to_flange)
    formulas = OrthoParallel(geometry, Transform.identity(), unnamed, opw6_from_flange)
    home = formulas.link_frames(np.zeros(JOINT_COUNT)).rotation
    origins: Array = np.zeros((JOINT_COUNT, 3))
    origins[-1] = to_flange
    named = Transform(np.swapaxes(home, -1, -2), origins)
    return OrthoParallel(geometry, Transform.identity(), named, opw6_from_flange)


def _entry(table: Mapping[str, Any], folder: Path) -> CatalogueEntry:
    if table["name"] != folder.name:
        raise ValueError(f"name `{table['name']}` is not that of the folder")
    joints = table["joint"]
    geometry = geometry_from_table(table)
    return CatalogueEntry(
        name=table["name"],
        title=table["title"],
        maker=table["maker"],
        geometry=geometry,
        joint_names=tuple(f"joint_{number}" for number in range(1, len(joints) + 1)),
        limits=tuple((radians(lower), radians(upper)) for lower, upper in map(_limits, joints)),
        max_speeds=_radians(joints, "max_speed_deg_s", "max_speed_mm_s"),
        max_accelerations=_radians(joints, "max_acceleration_deg_s2", "max_acceleration_mm_s2"),
        torques=_torques(table["dynamics"]) if "dynamics" in table else None,
        payload_kg=table.get("payload_kg"),
        reach_m=table.get("reach_m"),
        sources=tuple(table["sources"]),
        checks=tuple(table["checks"]),
        notes=tuple(table["notes"]),
        notices=tuple(table.get("notices", ())),
        not_modelled=tuple(table.get("not_modelled", ())),
        link_excess_m=tuple(1e-3 * excess for excess in table.get("link_excess_mm", ())),
        folder=folder,
    )


def _torques(table: Mapping[str, Any]) -> Torques:
    """The table [dynamics]: what was measured of an arm."""
    w4, w5, w6 = (radians(one) for one in table["wrist_deg_s2"])
    return Torques(
        **{name: table[name] for name in ("i1", "rod", "point", "x", "z", "c", "d", "e", "kappa")},
        delta=radians(table["delta_deg"]),
        n33=table["n33"],
        wrist=(w4, w5, w6),
        filter_time=table["filter_time_s"],
        fine_dwell=table["fine_dwell_s"],
        measured=True,
        wrist_in_zones=(
            (table["wrist_zone_share"], table["wrist_zone_cycles"])
            if "wrist_zone_share" in table
            else None
        ),
    )


def _limits(joint: Mapping[str, Any]) -> tuple[float, float]:
    """Lower and upper limit of a joint [deg], or [mm] where it slides."""
    lower, upper = joint["limits_mm"] if "limits_mm" in joint else joint["limits_deg"]
    return lower, upper


def _radians(
    joints: Sequence[Mapping[str, Any]], key: str, key_mm: str
) -> tuple[float | None, ...]:
    """A value of each joint that may not be given at all.

    A joint that slides is given in mm, each of which counts as one degree; see `Kinematics`.
    """
    given = (joint.get(key_mm if "limits_mm" in joint else key) for joint in joints)
    return tuple(None if value is None else radians(value) for value in given)


def _by_number(name: str) -> list[tuple[int, str]]:
    """A sort key that puts `kr16-2` before `kr120-r2500-pro`."""
    return [(int(part or 0), "") if part.isdigit() else (0, part) for part in _PARTS.split(name)]


def _unknown(name: str) -> RobotError:
    known = (*robot_names(), *aliases())
    near = difflib.get_close_matches(name.lower(), known, n=NEAR_NAMES, cutoff=0.4)
    nearest = f"; similar names: {', '.join(near)}" if near else ""
    return RobotError(f"robot `{name}` is not in the catalogue{nearest}", near)
