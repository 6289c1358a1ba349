"""What a cell is given: signals, answers, folders, network, date and limits."""

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
"""Answers an operator's question by its prompt; None if nobody answers."""


START_OF_TIME = datetime(2000, 1, 1)
"""A fixed day, so that two runs are the same."""


@value_class(frozen=True, slots=True)
class CellInputs:
    """What all tasks of a cell share from the start; `RunOptions` says what it is by default."""

    answers: Answers | None
    """None answers every question with its default and a warning."""
    answers_are_typed: bool
    """Whether a person answers, who is asked again after an invalid answer."""
    io: CellIo
    """Signals, how they are wired, and what happens to inputs."""
    home: Path | None
    """The folder HOME: stands for; None makes file instructions fail with a clear error."""
    ramdisk: Path | None
    """The folder RAMDISK: stands for; None is one in the home folder."""
    network: Network | None
    """What sockets may use of the network; None limits them to the station's scripts."""
    tasks: tuple[str, ...]
    """Names of all tasks of the cell; a run may be of some of them."""
    configured: Configured
    """The system parameters."""
    starts_at: datetime
    """Date and time of day that the controller's clock shows when the run begins."""
    max_time_s: float
    """Virtual time at which the run ends."""
    max_wall_s: float | None
    """How long the run may take on the wall clock; nothing else in a run depends on it."""
