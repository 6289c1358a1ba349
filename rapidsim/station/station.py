"""Content of a station file `rapidsim.toml`, and the search for the file.

Most programs that are checked have no such file, so this module needs no NumPy; `read.py` does.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import field
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.controller.cell.description import CellIo
from rapidsim.files import require_inside
from rapidsim.language.equipment import Configured
from rapidsim.language.robotware import RobotWare
from rapidsim.module_files import named_file
from rapidsim.motion.model import MotionModel
from rapidsim.station.check import CheckSettings
from rapidsim.station.tasks import DEFAULT_TASK, StationTask
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.collisions.geometry import CellGeometry
    from rapidsim.frames.transform import Transform
    from rapidsim.motion.robot.external_axes import ExternalAxis
    from rapidsim.station.robot import StationRobot

FILE_NAME = "rapidsim.toml"
_MODULE_FOLDERS = ("RAPID", "PROGMOD", "SYSMOD")


@value_class(frozen=True, slots=True)
class Station:
    """Content of a station file; without one, all defaults."""

    file: Path | None = None
    robots: tuple[StationRobot, ...] = ()
    """Robots in the order of the file; empty without a file."""
    external_axes: tuple[ExternalAxis, ...] = ()
    """External axes of the first robot."""
    model: MotionModel = field(default_factory=MotionModel)
    nearest_configuration: bool = False
    """Whether moves continue to the nearest configuration if the stored one is unreachable."""
    exact_configuration: bool = False
    """Whether a stored configuration is not met if an axis is one quarter turn off."""
    tasks: tuple[StationTask, ...] = ()
    """Tasks in the order of the file; if empty there is one, with the first robot."""
    io: CellIo = field(default_factory=CellIo)
    robotware: RobotWare | None = None
    """RobotWare version; None if unspecified, so that the features of all versions are known."""
    stubs: tuple[Path, ...] = ()
    """Modules in place of libraries that the program lacks; all tasks have them."""
    configured: Configured = field(default_factory=dict)
    """System parameters of a backup."""
    starts_at: datetime | None = None
    """Date and time of day at the start of a run; None if not specified."""
    check: CheckSettings = field(default_factory=CheckSettings)
    """Settings of `check`."""
    geometry: CellGeometry | None = None
    """Bodies of the cell; None if unspecified, and no contacts are checked."""
    robot_source: str | None = None
    """Description of the source of the robots; None if it is the file."""
    other_units: tuple[str, ...] = ()
    """Further mechanical units, of which only the names are known."""
    remarks: tuple[str, ...] = ()
    """Notes on unsupported station entries."""

    @property
    def robot(self) -> str | None:
        """First robot, by name or URDF file; None if the file names none."""
        return self.robots[0].name if self.robots else None

    @property
    def start_joints_deg(self) -> tuple[float, ...] | None:
        """Start position of the first robot; None if the file does not specify it."""
        return self.robots[0].start_joints_deg if self.robots else None

    @property
    def world_from_base(self) -> Transform | None:
        """Base frame of the first robot; None if it is the world frame."""
        return self.robots[0].world_from_base if self.robots else None

    @property
    def task(self) -> str:
        """Name of the first task."""
        return self.tasks[0].name if self.tasks else DEFAULT_TASK

    def robot_number(self, task: str) -> int:
        """Return the number of the robot that a task moves; the first if not specified."""
        numbers = {one.name.lower(): one.robot_number for one in self.tasks}
        return numbers.get(task.lower()) or 0

    def entry(self, task: str) -> str | None:
        """Return the entry procedure of a task; None if not specified."""
        return {one.name.lower(): one.entry for one in self.tasks}.get(task.lower())

    @property
    def modules(self) -> tuple[Path, ...]:
        """Modules of the first task, in addition to those named on the command line."""
        return self.tasks[0].modules if self.tasks else ()

    @property
    def units(self) -> tuple[str, ...]:
        """Names of the mechanical units other than the robots."""
        further = (axis for robot in self.robots for axis in robot.external)
        simulated = (axis.unit for axis in (*self.external_axes, *further))
        return tuple(dict.fromkeys((*simulated, *self.other_units)))


def find_station(paths: Iterable[str]) -> Path | None:
    """Return the station file next to the first path that exists, or in a folder above it.

    A file in the module folder (RAPID, PROGMOD, SYSMOD) of a folder counts as next to it, too.

    Raises:
        InputError: If it is a link to another folder.
    """
    for path in paths:
        if path != "-" and (place := named_file(path)).exists():
            folder = place.resolve() if place.is_dir() else place.resolve().parent
            modules = _module_folders(folder) if place.is_dir() else ()
            found = next(
                (f for f in (folder, *modules, *folder.parents) if _has_station_file(f)), None
            )
            room = folder if found in modules else found
            return found and room and require_inside([found / FILE_NAME], [room])[0]
    return None


def _module_folders(folder: Path) -> Sequence[Path]:
    try:
        return sorted(one for one in folder.iterdir() if one.name.upper() in _MODULE_FOLDERS)
    except OSError:
        return ()


def _has_station_file(folder: Path) -> bool:
    try:
        return (folder / FILE_NAME).is_file()
    except OSError:
        return False
