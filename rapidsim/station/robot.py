"""The table [robot], or several [[robot]]: the arm, its mounting position, its start position."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field, replace
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.frames.transform import Transform
from rapidsim.motion.robot.catalogue import entry_name
from rapidsim.station.external_axes import read_frame
from rapidsim.station.toml_reader import UNITS_M, Reader, Table
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.motion.robot.external_axes import ExternalAxis
    from rapidsim.motion.robot.robot import Robot

_KEYS = ("model", "urdf", "scale", "base", "start", "shapes", "shapes-unit", "shapes-frame")
_USUAL_AXES = 6
_KEYS_OF_SEVERAL = ("name", *_KEYS)


@value_class(frozen=True, slots=True)
class StationRobot:
    """A robot of a station."""

    name: str | None = None
    """Name in the catalogue or path of a URDF file; None if the file names no robot."""
    scale: float | None = None
    """Factor on the lengths of that URDF file that converts them to m."""
    start_joints_deg: tuple[float, ...] | None = None
    world_from_base: Transform = field(default_factory=Transform.identity)
    label: str | None = None
    """Name in [[task]] tables; None if not specified."""
    unknown: str | None = None
    """Type in a backup of an arm that the catalogue lacks."""
    axis_count: int | None = None
    """Number of axes that a backup lists; None if it lists no axes."""
    bounds: tuple[tuple[float, float] | None, ...] = ()
    """Range of each axis in a backup [rad, or m of a prismatic axis]; None if not specified."""
    carried_by: str | None = None
    """Mechanical unit that moves its base, if the motion of its axes is unknown."""
    shapes: Path | None = None
    """Folder of the user's own meshes of its links."""
    shapes_unit_m: float | None = None
    """Length unit of the meshes [m]; None if not specified."""
    shapes_in_base: bool = False
    """Whether all meshes are drawn in the base frame, with all axes at zero."""
    external: tuple[ExternalAxis, ...] = ()
    """Its external axes, if it is not the first robot: those of the first are the station's."""

    def has_bounds_of(self, name: str) -> bool:
        """Whether the axis bounds apply to an arm: to this one, or to a substitute for it."""
        return self.name is None or entry_name(self.name) == entry_name(name)

    @property
    def can_be_guessed(self) -> bool:
        """Whether another arm may be a substitute: targets of six axes are equivalent."""
        return self.axis_count in (None, _USUAL_AXES)

    @property
    def is_special(self) -> bool:
        """Whether shapes or bounds of axes are specified, which apply to one arm only."""
        return self.shapes is not None or any(one is not None for one in self.bounds)

    def fitted(self, arm: Robot) -> Robot:
        """Return the arm with the configured shapes and axis bounds.

        Raises:
            InputError: If the shapes do not fit the arm, or cannot be read.
        """
        arm = self._bounded(arm)
        if self.shapes is None:
            return arm
        # Most stations have no shapes, and reading shapes takes a while to import.
        from rapidsim.station.link_meshes import with_meshes  # noqa: PLC0415

        return with_meshes(arm, self.shapes, self.shapes_unit_m, in_base=self.shapes_in_base)

    def _bounded(self, arm: Robot) -> Robot:
        if len(self.bounds) != len(arm.joints):
            return arm
        joints = tuple(
            joint if bound is None else joint.within(*bound)
            for joint, bound in zip(arm.joints, self.bounds, strict=True)
        )
        return replace(arm, joints=joints)


def read_robots(
    reader: Reader, station: Table, defaults: Sequence[StationRobot] = ()
) -> tuple[StationRobot, ...]:
    """Read [robot] or each [[robot]]; empty if missing. Errors are collected in the reader.

    Args:
        reader: Reads the file.
        station: The top-level table.
        defaults: The robots of a backup. A table describes the robot with its `name`, else the
            first that no other table describes; a key that it lacks has that robot's value.
    """
    if "robot" not in station:
        return tuple(defaults)
    keys: tuple[str, ...] = _KEYS_OF_SEVERAL
    if isinstance(station.get("robot"), list):
        tables = list(reader.tables(station, "robot"))
    else:
        tables, keys = [("robot", reader.table(station, "robot"))], _KEYS
    robots = list(defaults)
    for (path, robot), place in zip(tables, _places(tables, defaults), strict=True):
        if place < len(defaults):
            robots[place] = _read_robot(reader, path, robot, keys, defaults[place])
        else:
            robots.append(_read_robot(reader, path, robot, keys, StationRobot()))
    labels = [robot.label.lower() for robot in robots if robot.label]
    if len(set(labels)) != len(labels):
        reader.wrong("robot", "two robots have one name")
    return tuple(robots) or (StationRobot(),)


def _places(tables: Sequence[tuple[str, Table]], defaults: Sequence[StationRobot]) -> list[int]:
    """Return the index of the robot that each table describes."""
    labels = [robot.label.lower() for robot in defaults if robot.label]
    named: dict[int, int] = {}
    for number, (_, table) in enumerate(tables):
        name = str(table.get("name")).lower()
        if name in labels and labels.index(name) not in named.values():
            named[number] = labels.index(name)
    free = (place for place in count() if place not in named.values())
    return [named[number] if number in named else next(free) for number in range(len(tables))]


def dropped_bounds(
    robots: Sequence[StationRobot], defaults: Sequence[StationRobot]
) -> Iterator[str]:
    """Yield remarks on axis bounds of a backup that belong to another arm."""
    for robot, backup in zip(robots, defaults, strict=False):
        if any(backup.bounds) and not robot.bounds:
            yield f"joint limits of the backup are those of {backup.name}, not of {robot.name}"


def _read_robot(
    reader: Reader, path: str, robot: Table, keys: Sequence[str], default: StationRobot
) -> StationRobot:
    reader.note_unknown_keys(path, robot, keys)
    if "model" in robot and "urdf" in robot:
        reader.wrong(path, "give `model` or `urdf`, not both")
    base = default.world_from_base
    if "base" in robot:
        base = read_frame(reader, reader.table(robot, "base", f"{path}.base"), f"{path}.base")
    name = reader.text(robot, path, "model")
    urdf = reader.text(robot, path, "urdf")
    if urdf is not None:
        name = str(reader.file.parent / urdf)
    scale = reader.number(robot, path, "scale")
    if scale is not None and urdf is None:
        reader.wrong(f"{path}.scale", "only lengths of a `urdf` are scaled")
    elif scale is not None and scale <= 0.0:
        reader.wrong(f"{path}.scale", f"must be greater than 0, not {scale:g}")
    found = replace(
        default,
        name=name or default.name,
        scale=scale,
        start_joints_deg=reader.numbers(robot, path, "start", None),
        world_from_base=base,
        label=reader.text(robot, path, "name") or default.label,
        unknown=None if name else default.unknown,
        bounds=default.bounds if name is None or default.has_bounds_of(name) else (),
    )
    return _with_shapes(reader, path, robot, found)


def _with_shapes(reader: Reader, path: str, robot: Table, found: StationRobot) -> StationRobot:
    name = reader.text(robot, path, "shapes")
    unit = reader.text(robot, path, "shapes-unit")
    frame = reader.text(robot, path, "shapes-frame") or "link"
    if name is None:
        for key in ("shapes-unit", "shapes-frame"):
            if key in robot:
                reader.wrong(f"{path}.{key}", "describes `shapes`, which are missing")
        return found
    if "urdf" in robot:
        reader.wrong(f"{path}.shapes", "a `urdf` names its own shapes")
    folder = reader.inside(name, f"{path}.shapes")
    if folder is not None and not folder.is_dir():
        reader.wrong(f"{path}.shapes", f"{folder} is not a folder")
    if unit is not None and unit not in UNITS_M:
        known = ", ".join(UNITS_M)
        reader.wrong(f"{path}.shapes-unit", f"`{unit}` is not a unit of length", f"known: {known}")
    if frame not in ("link", "base"):
        reader.wrong(f"{path}.shapes-frame", f"`{frame}` is neither `link` nor `base`")
    return replace(
        found,
        shapes=folder,
        shapes_unit_m=None if unit is None else UNITS_M.get(unit),
        shapes_in_base=frame == "base",
    )
