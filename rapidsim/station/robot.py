"""The table [robot], or several [[robot]]: the arm, its mounting position, its start position."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field, replace
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from rapidsim.frames.transform import Transform
from rapidsim.json_records.declarations import Excludes, Key, Needs, Valid
from rapidsim.motion.robot.catalogue import entry_name
from rapidsim.station.declared_tables import values_of
from rapidsim.station.frames import Frame
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.station.units import UnitKey
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.motion.robot.external_axes import ExternalAxis
    from rapidsim.motion.robot.robot import Robot

_USUAL_AXES = 6
_SHAPES_MISSING = Needs("shapes", "describes `shapes`, which are missing")


@value_class(frozen=True, slots=True)
class RobotTable:
    """A table [robot] or [[robot]]: an arm of the catalogue, or of a URDF file, and its place."""

    name: str | None = None
    """Name of one of several robots, in [[task]] tables."""
    model: str | None = None
    """Name in the catalogue."""
    urdf: str | None = None
    """Path of a URDF file."""
    scale: Annotated[
        float | None,
        Needs("urdf", "only lengths of a `urdf` are scaled"),
        Valid(lambda scale: scale > 0.0, "must be greater than 0, not {:g}"),
    ] = None
    """Factor on the lengths of the URDF file that converts them to m."""
    base: Frame | None = None
    """Base frame of the arm in the world."""
    start: tuple[float, ...] | None = None
    """Its joints at the start [degrees, or mm of a linear axis]."""
    shapes: Annotated[
        Path | None,
        Excludes("urdf", "a `urdf` names its own shapes"),
        Valid(Path.is_dir, "{} is not a folder"),
    ] = None
    """Folder of the user's own meshes of its links."""
    shapes_unit: Annotated[UnitKey, Key("shapes-unit"), _SHAPES_MISSING] = None
    """Length unit of the meshes."""
    shapes_frame: Annotated[Literal["link", "base"], Key("shapes-frame"), _SHAPES_MISSING] = "link"
    """Frame of each mesh: that of its link, or for all the base, with all axes at zero."""


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
    """Read [robot] or each [[robot]]. Errors are collected in the reader.

    Args:
        reader: Reads the file.
        station: The top-level table.
        defaults: The robots of a backup. A table describes the robot with its `name`, else the
            first that no other table describes; a key that it lacks has that robot's value.
    """
    without: tuple[str, ...] = ()
    if isinstance(station.get("robot"), list):
        tables = list(reader.tables(station, "robot"))
    else:
        # A name distinguishes several.
        tables, without = [("robot", reader.table(station, "robot"))], ("name",)
    robots = list(defaults)
    for (path, robot), place in zip(tables, _places(tables, defaults), strict=True):
        if place < len(defaults):
            robots[place] = _read_robot(reader, path, robot, without, defaults[place])
        else:
            robots.append(_read_robot(reader, path, robot, without, StationRobot()))
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
    reader: Reader, path: str, table: Table, without: Sequence[str], default: StationRobot
) -> StationRobot:
    robot = RobotTable(**values_of(reader, RobotTable, table, path, without=without))
    if "model" in table and "urdf" in table:
        reader.wrong(path, "give `model` or `urdf`, not both")
    name = robot.model if robot.urdf is None else str(reader.file.parent / robot.urdf)
    found = replace(
        default,
        name=name or default.name,
        scale=robot.scale,
        start_joints_deg=robot.start,
        world_from_base=default.world_from_base if robot.base is None else robot.base,
        label=robot.name or default.label,
        unknown=None if name else default.unknown,
        bounds=default.bounds if name is None or default.has_bounds_of(name) else (),
    )
    if robot.shapes is None:
        return found
    return replace(
        found,
        shapes=robot.shapes,
        shapes_unit_m=None if robot.shapes_unit is None else robot.shapes_unit.in_m,
        shapes_in_base=robot.shapes_frame == "base",
    )
