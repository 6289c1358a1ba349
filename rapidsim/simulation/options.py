"""Inputs and limits of a run, apart from program and robot."""

from __future__ import annotations

from dataclasses import field, replace
from datetime import datetime
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from rapidsim.collisions.geometry import CellGeometry
from rapidsim.controller.cell.description import CellIo
from rapidsim.controller.cell.inputs import START_OF_TIME, Answers, CellInputs
from rapidsim.controller.cell.message_queues import QueueSettings
from rapidsim.controller.cell.network import Network
from rapidsim.frames.transform import Transform
from rapidsim.language.equipment import Configured
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.collisions.outer_hull import HullStore


@value_class(frozen=True, slots=True)
class RunOptions:
    """Inputs and limits of a run."""

    program_files: tuple[str, ...] = ()
    """Files as the user named them, for reports."""
    model: MotionModel = field(default_factory=MotionModel)
    nearest_configuration: bool = False
    """Whether a move to a target with an unreachable stored configuration uses the nearest one and
    the run continues; else it ends there, as on a controller with ConfJ or ConfL on."""
    functions_fail: bool = False
    """Whether CalcJointT fails for such a target, as on a controller, although moves continue."""
    exact_configuration: bool = False
    """Whether a stored configuration is not met if cf1, cf4 or cf6 is one quarter turn off."""
    start_joints_deg: tuple[float, ...] | None = None
    """Joints at the start [deg]. None for the start of the arm's entry, usually all zero with
    axis 5 at 30 degrees; if the first move is a line or arc, the arm begins above it."""
    world_from_base: Transform = field(default_factory=Transform.identity)
    """Pose of the robot's base, with all external axes at zero."""
    external_axes: tuple[ExternalAxis, ...] = ()
    """Tracks, positioners and other additional axes, in the order of their letters."""
    answers: Answers | None = None
    """None answers every question with its default and a warning."""
    answers_are_typed: bool = False
    """Whether a person answers, who is asked again after an invalid answer."""
    io: CellIo = field(default_factory=CellIo)
    """Signals, their connections, and changes of inputs."""
    home: Path | None = None
    """The folder for HOME:; None makes file instructions fail with a clear error."""
    ramdisk: Path | None = None
    """The folder for RAMDISK:; None for one in the home folder."""
    geometry: CellGeometry | None = None
    """Bodies of the cell; None for no collision check."""
    hulls: HullStore | None = None
    """Bodies around large meshes that earlier runs computed; None to compute them anew."""
    network: Network | None = None
    """Network access of sockets; None limits them to the station's scripts."""
    configured: Configured = field(default_factory=lambda: MappingProxyType({}))
    """System parameters that ReadCfgData reads."""
    starts_at: datetime = START_OF_TIME
    """Date and time of day of the controller's clock at the start of the run."""
    max_time_s: float = 3600.0
    """Virtual time at which the run ends."""
    max_wall_s: float | None = None
    """Limit of the run in wall-clock time; nothing else in a run depends on that time."""
    max_work_s: float | None = None
    """Limit of the processor time of the run: other work of the computer does not shorten it."""
    max_cycles: int = 1
    """Number of cycles of main."""
    entry: str = "main"
    """Procedure to run."""
    task: str = "T_ROB1"
    """Name of the task."""
    queue: QueueSettings | None = None
    """Message queue of the task; None if it is not described."""
    cell_tasks: tuple[str, ...] = ()
    """Names of all tasks of the cell, also of those that are not in the run."""
    guesses_frames: bool = True
    """Whether to place a work object at its `uframe` if the unit that should move it is not in the
    run; else the run stops there."""

    def with_axes(self, robot: Robot) -> Robot:
        """Return an arm with the external axes of the run."""
        return replace(robot, external=self.external_axes) if self.external_axes else robot

    @property
    def cell(self) -> CellInputs:
        """Options that the cell uses."""
        return CellInputs(
            answers=self.answers,
            answers_are_typed=self.answers_are_typed,
            io=self.io,
            home=self.home,
            ramdisk=self.ramdisk,
            network=self.network,
            tasks=self.cell_tasks,
            configured=self.configured,
            starts_at=self.starts_at,
            max_time_s=self.max_time_s,
            max_wall_s=self.max_wall_s,
            max_work_s=self.max_work_s,
        )
