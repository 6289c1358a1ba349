"""Robots that ship with rapidsim: one folder each, described by its `robot.toml`.

Input is a name, output a `CatalogueEntry` in SI units. Shapes are generated from the entry by
`scripts/build_robots.py` and stored in its folder. The short names of all robots are in one file,
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
from rapidsim.motion.robot.known_constants import (
    MeasuredConstants,
    PublishedAccelerations,
    PublishedTorques,
    ReferenceCycle,
    ReferenceVolume,
    inertia_shape,
    measured_constants,
    published_accelerations,
    published_torques,
    reference_cycle,
    reference_volume,
)
from rapidsim.motion.robot.scaled_torques import InertiaShape
from rapidsim.motion.robot.structures import Geometry, geometry_from_table
from rapidsim.shipped import shipped
from rapidsim.values import value_class

_PARTS = re.compile(r"(\d+)")
NEAR_NAMES = 5
"""Number of similar names suggested for an unknown one."""


class RobotError(InputError):
    """A robot that cannot be loaded; the message contains the robot, the reason and the remedy."""

    def __init__(self, message: str, similar: Sequence[str] = ()) -> None:
        """Create the error; `similar` are known names near an unknown one."""
        super().__init__(message, similar=similar)


@value_class(frozen=True, slots=True)
class CatalogueEntry:
    """Data of one arm."""

    name: str
    title: str
    maker: str
    geometry: Geometry
    joint_names: tuple[str, ...]
    limits: tuple[tuple[float, float], ...]
    """Lower and upper limit of each joint [rad]."""
    max_speeds: tuple[float | None, ...]
    """[rad/s]; None where no source has it."""
    max_accelerations: tuple[float | None, ...]
    """[rad/s2], for version 1 of the motion model; None unless measured."""
    measured: MeasuredConstants | None
    """None unless measured."""
    shape: InertiaShape | None
    """Shape of the inertia; None unless a drawing of the arm shows it."""
    torques: PublishedTorques | None
    """None unless published."""
    accelerations: PublishedAccelerations | None
    """None unless published."""
    picking: ReferenceCycle | None
    wrist_centre_volume: ReferenceVolume | None
    unconfirmed_speeds: tuple[float, ...]
    """Axis speeds in RAPID's units that no source confirms, for the user to check; or empty."""
    payload_kg: float | None
    reach_m: float | None
    sources: tuple[str, ...]
    """Sources of the numbers."""
    checks: tuple[str, ...]
    """Sources with which the figures were compared."""
    notes: tuple[str, ...]
    notices: tuple[str, ...]
    """Notices for the user of the arm; commands print them."""
    not_modelled: tuple[str, ...]
    """Properties of the arm that a run does not model; every run on it reports them."""
    link_excess_m: tuple[float, ...]
    """See `Robot.link_excess_m`."""
    folder: Path

    @property
    def urdf(self) -> Path | None:
        """Description with link shapes; None if there is no such file."""
        file = self.folder / f"{self.name}.urdf"
        return file if file.is_file() else None


def robots_folder() -> Path:
    """Return the folder of the catalogue, in a checkout or an installation."""
    return shipped("robots")


@cache
def robot_names() -> tuple[str, ...]:
    """Return the names of all robots, sorted, with numbers compared by value."""
    names = (file.parent.name for file in robots_folder().glob("*/robot.toml"))
    return tuple(sorted(names, key=_by_number))


@cache
def aliases() -> Mapping[str, str]:
    """Return the short names of robots, and the robots they refer to."""
    text = (robots_folder() / "aliases.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def aliases_of(name: str) -> tuple[str, ...]:
    """Return the short names of a robot."""
    return tuple(alias for alias, robot in aliases().items() if robot == name)


def entry_name(name: str) -> str:
    """Return the name of a robot in lower case, for an alias the name it refers to."""
    wanted = name.lower()
    return aliases().get(wanted, wanted)


@cache
def find_entry(name: str) -> CatalogueEntry:
    """Return the robot of a name or alias, in any case.

    Raises:
        RobotError: If no robot has the name; the message lists the closest names.
    """
    wanted = entry_name(name)
    if wanted not in robot_names():
        raise _unknown(name)
    return read_entry(robots_folder() / wanted)


def speed_lender(entry: CatalogueEntry) -> CatalogueEntry | None:
    """Return the arm whose axis speeds replace unknown ones; None if no arm of its kind has any.

    Arms of one kind have equal maker and structure. Arms of the same family are preferred, then
    arms with the same number in their type, then those of the nearest payload and reach. The
    inertia of a payload grows with the square of the reach, which therefore counts twice.
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
    """Return the arms with axis speeds from a source."""
    entries = map(find_entry, robot_names())
    return tuple(entry for entry in entries if None not in entry.max_speeds)


def _family(name: str) -> str:
    """Return the part of a name before payload and reach."""
    return name.partition("-")[0]


def _type_number(name: str) -> str:
    """Return the number of a type, such as 1300 of `crb1300-7-1.4`."""
    number = _PARTS.search(name)
    return "" if number is None else number[0]


def _distance(one: float | None, other: float | None) -> float:
    """Distance of two figures as the logarithm of their ratio; 0 if either is unknown."""
    return abs(log(one / other)) if one and other else 0.0


def read_entry(folder: Path) -> CatalogueEntry:
    """Read the `robot.toml` of a folder.

    Raises:
        RobotError: If the file contains an invalid value or lacks one.
    """
    file = folder / "robot.toml"
    try:
        return _entry(tomllib.loads(file.read_text(encoding="utf-8")), folder)
    except KeyError as missing:
        raise RobotError(f"{file}: {missing} is missing") from None
    except (tomllib.TOMLDecodeError, TypeError, ValueError) as mistake:
        raise RobotError(f"{file}: {mistake}") from None


def kinematics_of(entry: CatalogueEntry) -> Kinematics:
    """Return the solver for an arm: its closed form, or a search if it has none."""
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


def arm_from_geometry(geometry: OpwGeometry) -> OrthoParallel:
    """Return the arm with link frames that are parallel to the base with all joints at 0.

    The origin of link 1 is at the foot, 2 and 3 on their axes, 4 next to the elbow on axis 4, 5 in
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
        measured=measured_constants(table["dynamics"]) if "dynamics" in table else None,
        shape=inertia_shape(table["shape"]) if "shape" in table else None,
        torques=published_torques(table["torques"]) if "torques" in table else None,
        accelerations=(
            published_accelerations(table["accelerations"]) if "accelerations" in table else None
        ),
        picking=reference_cycle(table["picking_cycle"]) if "picking_cycle" in table else None,
        wrist_centre_volume=(
            reference_volume(table["wrist_centre_volume"])
            if "wrist_centre_volume" in table
            else None
        ),
        unconfirmed_speeds=tuple(table.get("unconfirmed_speeds", ())),
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


def _limits(joint: Mapping[str, Any]) -> tuple[float, float]:
    """Return lower and upper limit of a joint [deg], or [mm] for a sliding joint."""
    lower, upper = joint["limits_mm"] if "limits_mm" in joint else joint["limits_deg"]
    return lower, upper


def _radians(
    joints: Sequence[Mapping[str, Any]], key: str, key_mm: str
) -> tuple[float | None, ...]:
    """Return an optional value of each joint in radians, or None.

    Values of a sliding joint are in mm, each of which counts as one degree; see `Kinematics`.
    """
    given = (joint.get(key_mm if "limits_mm" in joint else key) for joint in joints)
    return tuple(None if value is None else radians(value) for value in given)


def _by_number(name: str) -> list[tuple[int, str]]:
    """Return a sort key that puts `kr16-2` before `kr120-r2500-pro`."""
    return [(int(part or 0), "") if part.isdigit() else (0, part) for part in _PARTS.split(name)]


def _unknown(name: str) -> RobotError:
    known = (*robot_names(), *aliases())
    near = difflib.get_close_matches(name.lower(), known, n=NEAR_NAMES, cutoff=0.4)
    nearest = f"; similar names: {', '.join(near)}" if near else ""
    return RobotError(f"robot `{name}` is not in the catalogue{nearest}", near)
