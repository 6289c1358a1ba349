"""What a run is given beside program and robot."""

from __future__ import annotations

from dataclasses import field
from datetime import datetime
from pathlib import Path
from types import MappingProxyType

from rapidsim.collisions.geometry import CellGeometry
from rapidsim.controller.cell.description import CellIo
from rapidsim.controller.cell.inputs import START_OF_TIME, Answers, CellInputs
from rapidsim.controller.cell.message_queues import QueueSettings
from rapidsim.controller.cell.network import Network
from rapidsim.frames.transform import Transform
from rapidsim.language.equipment import Configured
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class RunOptions:
    """Inputs and limits of a run."""

    program_files: tuple[str, ...] = ()
    """The files as the user named them, for reports."""
    model: MotionModel = field(default_factory=MotionModel)
    nearest_configuration: bool = False
    """Whether a move to a target whose stored configuration cannot be had goes to the nearest one
    and the run on; else it ends there, as on a controller with ConfJ or ConfL on."""
    functions_fail: bool = False
    """Whether CalcJointT still fails for such a target, as on a controller, while moves go on."""
    exact_configuration: bool = False
    """Whether a stored configuration is not met where cf1, cf4 or cf6 is one quarter turn off."""
    start_joints_deg: tuple[float, ...] | None = None
    """Joints at the start [deg]. None takes the start of the arm's entry, as a rule all zero with
    axis 5 at 30 degrees; if the first move is a line or arc, the arm begins above it."""
    world_from_base: Transform = field(default_factory=Transform.identity)
    """Where the robot stands, with all external axes at zero."""
    external_axes: tuple[ExternalAxis, ...] = ()
    """Tracks, positioners and other axes beside the arm, in the order of their letters."""
    answers: Answers | None = None
    """None answers every question with its default and a warning."""
    answers_are_typed: bool = False
    """Whether a person answers, who is asked again after an answer that is none."""
    io: CellIo = field(default_factory=CellIo)
    """Signals, how they are wired, and what happens to inputs."""
    home: Path | None = None
    """The folder HOME: stands for; None makes file instructions fail with a clear error."""
    ramdisk: Path | None = None
    """The folder RAMDISK: stands for; None is one in the home folder."""
    geometry: CellGeometry | None = None
    """What stands in the cell; None looks for no contacts."""
    network: Network | None = None
    """What sockets may use of the network; None lets them reach the station's scripts only."""
    configured: Configured = field(default_factory=lambda: MappingProxyType({}))
    """The system parameters that ReadCfgData reads."""
    starts_at: datetime = START_OF_TIME
    """Date and time of day that the controller's clock shows when the run begins."""
    max_time_s: float = 3600.0
    """Virtual time at which the run ends."""
    max_wall_s: float | None = None
    """How long the run may take on our clock; the only thing in a run that depends on it."""
    max_cycles: int = 1
    """How often main runs."""
    entry: str = "main"
    """The procedure to run."""
    task: str = "T_ROB1"
    """Name of the task."""
    queue: QueueSettings | None = None
    """Message queue of the task; None where nobody describes it."""
    cell_tasks: tuple[str, ...] = ()
    """Names of all tasks of the cell, also of those that are not in the run."""
    guesses_frames: bool = True
    """Whether a work object that nothing in the run moves, but something should, stands where its
    `uframe` says; else the run stops there."""

    @property
    def cell(self) -> CellInputs:
        """What of it the cell is given."""
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
        )
