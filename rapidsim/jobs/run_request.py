"""A user's request: built alike by every command and by Python calls."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rapidsim.diagnostics import Severity
from rapidsim.values import value_class

if TYPE_CHECKING:
    from datetime import datetime

    from rapidsim.controller.cell.inputs import Answers
    from rapidsim.controller.cell.network import Network
    from rapidsim.motion.robot.robot import Robot
    from rapidsim.simulation.options import RunOptions

DEFAULT_ENTRY = "main"


@value_class(frozen=True, slots=True, kw_only=True)
class RunRequest:
    """Files, cell, and how to check or run them; None where not specified."""

    paths: tuple[str, ...]
    station: str | None = None
    """The station file; None takes the one near the paths."""
    robot: Robot | str | None = None
    """An arm, its name in the catalogue, or a URDF file."""
    scale: float | None = None
    """What the lengths of a URDF file are multiplied by; None takes what the station says."""
    task: str | None = None
    """The only one of several tasks that is wanted."""
    cell: RunOptions | None = None
    """What Python says of robot, motion model, signals and task; more than the station file."""
    io: str | None = None
    """A file of signals and what happens to inputs; adds to the station."""
    entry: str = DEFAULT_ENTRY
    assume_missing: bool = False
    """Whether what nothing declares is assumed to exist, besides what the station says."""
    strict: bool = False
    """Whether what is unknown, not simulated or not checked fails too, besides what the station
    says."""
    answers: Answers | None = None
    answers_are_typed: bool = False
    home: str | None = None
    """The folder for HOME:; None is `<program>.home` here."""
    ramdisk: str | None = None
    """The folder for RAMDISK:; None is one in the home folder."""
    network: Network | None = None
    starts_at: datetime | None = None
    max_time_s: float = 3600.0
    max_wall_s: float | None = None
    max_cycles: int = 1
    select: tuple[str, ...] = ()
    """Rules that a check looks for, and no others."""
    extend_select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    fail_on: Severity | None = None
    """The lowest severity that fails a check; None takes that of the settings."""
    reach: bool = True
    """Whether a check asks if the robot can make the moves."""
    trial_run: bool = True
    """Whether main is run for the moves that only a run can check."""
