"""What a run is given beside program and robot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from rapidsim.motion.model import MotionModel

Answers = Callable[[str], str | None]
"""Answers an operator's question by its prompt; None where nobody answers."""


@dataclass(frozen=True, slots=True)
class RunOptions:
    """Inputs and limits of a run."""

    program_files: tuple[str, ...] = ()
    """The files as the user named them, for reports."""
    model: MotionModel = field(default_factory=MotionModel)
    start_joints_deg: tuple[float, ...] | None = None
    """Where the arm stands at the start; None takes all zero with axis 5 at 30 degrees."""
    answers: Answers | None = None
    """None answers every question with its default and a warning."""
    home: Path | None = None
    """The folder HOME: stands for; None makes file instructions fail with a clear error."""
    max_time_s: float = 3600.0
    """Virtual time at which the run ends."""
    max_cycles: int = 1
    """How often main runs."""
    entry: str = "main"
    """The procedure to run."""
    task: str = "T_ROB1"
    """Name of the task."""
