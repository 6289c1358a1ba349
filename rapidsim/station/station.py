"""The content of a station file `rapidsim.toml`, and where it is looked for.

Most programs that are checked have none, so nothing here needs NumPy; `read.py` does.
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
    """The content of a station file; without one, all defaults."""

    file: Path | None = None
    robots: tuple[StationRobot, ...] = ()
    """In the order of the file; none without one."""
    external_axes: tuple[ExternalAxis, ...] = ()
    """Those of the first robot."""
    model: MotionModel = field(default_factory=MotionModel)
    nearest_configuration: bool = False
    """Whether moves go on to the nearest configuration where the stored one cannot be had."""
    exact_configuration: bool = False
    """Whether a stored configuration is not met where an axis is one quarter turn off."""
    tasks: tuple[StationTask, ...] = ()
    """In the order of the file; without any there is one, with the first robot."""
    io: CellIo = field(default_factory=CellIo)
    robotware: RobotWare | None = None
    """What the controller has; None where nobody says, and all that any version has is known."""
    stubs: tuple[Path, ...] = ()
    """Modules that stand for libraries which the program lacks; all tasks have them."""
    configured: Configured = field(default_factory=dict)
    """The system parameters of a backup."""
    starts_at: datetime | None = None
    """Date and time of day at which a run begins; None where the file does not say."""
    check: CheckSettings = field(default_factory=CheckSettings)
    """What `check` looks for."""
    geometry: CellGeometry | None = None
    """What stands in the cell; None where nothing says, and no contact is looked for."""
    robot_source: str | None = None
    """What names the robots, in words; None where that is the file."""
    other_units: tuple[str, ...] = ()
    """Mechanical units beside the robots of which only the names are known."""
    remarks: tuple[str, ...] = ()
    """What is said of the cell and left out."""

    @property
    def robot(self) -> str | None:
        """The first robot, by name or URDF file; None if the file names none."""
        return self.robots[0].name if self.robots else None

    @property
    def start_joints_deg(self) -> tuple[float, ...] | None:
        """The start position of the first robot; None if the file gives none."""
        return self.robots[0].start_joints_deg if self.robots else None

    @property
    def world_from_base(self) -> Transform | None:
        """The base frame of the first robot; None if it is the world frame."""
        return self.robots[0].world_from_base if self.robots else None

    @property
    def task(self) -> str:
        """The name of the first task."""
        return self.tasks[0].name if self.tasks else DEFAULT_TASK

    def robot_number(self, task: str) -> int:
        """Which of the robots a task moves; the first if the file does not say."""
        numbers = {one.name.lower(): one.robot_number for one in self.tasks}
        return numbers.get(task.lower()) or 0

    def entry(self, task: str) -> str | None:
        """The procedure that a task begins with; None if not specified."""
        return {one.name.lower(): one.entry for one in self.tasks}.get(task.lower())

    @property
    def modules(self) -> tuple[Path, ...]:
        """Modules of the first task, in addition to those named on the command line."""
        return self.tasks[0].modules if self.tasks else ()

    @property
    def units(self) -> tuple[str, ...]:
        """Names of the mechanical units besides the robot."""
        further = (axis for robot in self.robots for axis in robot.external)
        simulated = (axis.unit for axis in (*self.external_axes, *further))
        return tuple(dict.fromkeys((*simulated, *self.other_units)))


def find_station(paths: Iterable[str]) -> Path | None:
    """The station file next to the first path that is a file or folder, or in a folder above.

    One in the folder of its modules (RAPID, PROGMOD, SYSMOD) is next to a folder, too.

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
