"""The table [robot], or several [[robot]]: which arm, where it stands, where its axes start."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field, replace
from typing import TYPE_CHECKING

from rapidsim.frames.transform import Transform
from rapidsim.station.external_axes import read_frame
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import dataclass

if TYPE_CHECKING:
    from rapidsim.motion.robot.external_axes import ExternalAxis
    from rapidsim.motion.robot.robot import Robot

_KEYS = ("model", "urdf", "scale", "base", "start")
_KEYS_OF_SEVERAL = ("name", *_KEYS)


@dataclass(frozen=True, slots=True)
class StationRobot:
    """What a station says of its robot."""

    name: str | None = None
    """A name of the catalogue or the path of a URDF file; None where the file names no robot."""
    scale: float | None = None
    """What the lengths of that URDF file are multiplied by, so that they are m."""
    start_joints_deg: tuple[float, ...] | None = None
    world_from_base: Transform = field(default_factory=Transform.identity)
    label: str | None = None
    """What [[task]] tables call it; None where the file does not say."""
    unknown: str | None = None
    """What a backup calls an arm that the catalogue does not have."""
    bounds: tuple[tuple[float, float] | None, ...] = ()
    """Of each axis what a backup lets it do [rad, m of one that slides], None where it does not
    say."""
    carried_by: str | None = None
    """The mechanical unit that moves its base, where what its axes do is not known."""
    external: tuple[ExternalAxis, ...] = ()
    """Axes beside it, where it is not the first: those of the first are the station's."""

    def armed(self, other: StationRobot) -> StationRobot:
        """This robot with the arm of another and what is said of its axes."""
        return replace(
            self,
            name=other.name,
            scale=other.scale,
            unknown=other.unknown,
            bounds=other.bounds,
            carried_by=other.carried_by,
        )

    def bounded(self, arm: Robot) -> Robot:
        """The arm with the bounds of its axes, where they were said of such an arm."""
        if len(self.bounds) != len(arm.joints):
            return arm
        joints = tuple(
            joint if bound is None else joint.within(*bound)
            for joint, bound in zip(arm.joints, self.bounds, strict=True)
        )
        return replace(arm, joints=joints)


def read_robots(reader: Reader, station: Table) -> tuple[StationRobot, ...]:
    """Read [robot], or each [[robot]]; none if there is neither. What is wrong is noted."""
    if "robot" not in station:
        return ()
    if not isinstance(station.get("robot"), list):
        return (_read_robot(reader, "robot", reader.table(station, "robot"), _KEYS),)
    robots = [
        _read_robot(reader, path, robot, _KEYS_OF_SEVERAL)
        for path, robot in reader.tables(station, "robot")
    ]
    labels = [robot.label.lower() for robot in robots if robot.label]
    if len(set(labels)) != len(labels):
        reader.wrong("robot", "two robots have one name")
    return tuple(robots) or (StationRobot(),)


def _read_robot(reader: Reader, path: str, robot: Table, keys: Sequence[str]) -> StationRobot:
    reader.known(path, robot, keys)
    if "model" in robot and "urdf" in robot:
        reader.wrong(path, "give `model` or `urdf`, not both")
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
    return StationRobot(
        name,
        scale,
        reader.numbers(robot, path, "start", None),
        base,
        reader.text(robot, path, "name"),
    )
