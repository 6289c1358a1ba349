"""A user's request, with one form for all commands and Python calls."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from rapidsim.diagnostics import Severity
from rapidsim.values import value_class

if TYPE_CHECKING:
    from datetime import datetime

    from rapidsim.collisions.outer_hull import HullStore
    from rapidsim.controller.cell.inputs import Answers
    from rapidsim.controller.cell.network import Network
    from rapidsim.motion.robot.robot import Robot
    from rapidsim.simulation.options import RunOptions

DEFAULT_ENTRY = "main"


@value_class(frozen=True, slots=True, kw_only=True)
class RunRequest:
    """Files, cell, and options of a check or run; None if not specified."""

    paths: tuple[str, ...]
    texts: tuple[tuple[str, str], ...] = ()
    """Texts by path that are used in place of those on the disk."""
    station: str | None = None
    """Station file; None for the nearest one."""
    robot: Robot | str | None = None
    """An arm, its name in the catalogue, or a URDF file."""
    scale: float | None = None
    """Factor on the lengths of a URDF file; None for that of the station."""
    task: str | None = None
    """Name of the only task to use; None for all tasks."""
    cell: RunOptions | None = None
    """Robot, motion model, signals and task from Python, which override the station file."""
    io: str | Mapping[str, object] | None = None
    """Signals and changes of inputs in addition to those of the station: a file, or its tables."""
    entry: str = DEFAULT_ENTRY
    may_be_empty: bool = False
    """Whether folders may have no modules, and programs no entry: clients load them later."""
    assume_missing: bool = False
    """Whether undeclared names are assumed to exist; the station may also enable it."""
    strict: bool = False
    """Whether unknown, unsimulated and unchecked parts fail; the station may also enable it."""
    answers: Answers | None = None
    answers_are_typed: bool = False
    home: str | None = None
    """The folder for HOME:; None for `<program>.home` in the working directory."""
    ramdisk: str | None = None
    """The folder for RAMDISK:; None for one in the home folder."""
    network: Network | None = None
    hulls: HullStore | None = None
    """Bodies around meshes that earlier runs computed; None to compute them anew."""
    starts_at: datetime | None = None
    max_time_s: float = 3600.0
    max_wall_s: float | None = None
    max_cycles: int = 1
    select: tuple[str, ...] = ()
    """Rules that a check is limited to; empty for the default rules."""
    extend_select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    fail_on: Severity | None = None
    """Lowest severity that fails a check; None for that of the settings."""
    reach: bool = True
    """Whether a check examines if the robot can make the moves."""
    trial_run: bool = True
    """Whether main is run for the moves that only a run can check."""
