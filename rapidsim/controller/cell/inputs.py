"""Inputs of a cell: signals, answers, folders, network, date and limits."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.controller.cell.description import CellIo
from rapidsim.language.equipment import Configured
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.controller.cell.network import Network

Answers = Callable[[str], str | None]
"""Answers an operator's question by its prompt; None if there is no answer."""


START_OF_TIME = datetime(2000, 1, 1)
"""A fixed day, so that runs are reproducible."""


@value_class(frozen=True, slots=True)
class CellInputs:
    """Inputs that all tasks of a cell share from the start; defaults are those of `RunOptions`."""

    answers: Answers | None
    """None answers every question with its default and a warning."""
    answers_are_typed: bool
    """Whether a person types the answers; an invalid one is then prompted again."""
    io: CellIo
    """Signals, their cross connections, and the stimuli of inputs."""
    home: Path | None
    """Folder of HOME:; None makes file instructions fail with a clear error."""
    ramdisk: Path | None
    """Folder of RAMDISK:; None places it in the home folder."""
    network: Network | None
    """Permitted use of the network by sockets; None limits them to the station's scripts."""
    tasks: tuple[str, ...]
    """Names of all tasks of the cell; a run may have only some of them."""
    configured: Configured
    """The system parameters."""
    starts_at: datetime
    """Date and time of day on the controller's clock at the start of the run."""
    max_time_s: float
    """Virtual time at which the run ends."""
    max_wall_s: float | None
    """Maximum duration of the run on the wall clock; nothing else in a run depends on it."""
    max_work_s: float | None
    """Maximum processor time of the run; nothing else depends on that either."""
