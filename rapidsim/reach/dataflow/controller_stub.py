"""Controller without a robot, on which single instructions are executed.

It has settings, records moves, ignores calls that do not affect them, and rejects all calls whose
result requires a run.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

from rapidsim.diagnostics import Source, Span
from rapidsim.language.data import Pose
from rapidsim.language.error_numbers import IN_NO_HANDLER
from rapidsim.language.moves import MotionSettings, Move, Place
from rapidsim.language.path_events import Trigger

_NOWHERE = Place(Span(Source("", ""), 0, 0), "")


class NeedsRunError(Exception):
    """An instruction needs a result of the controller that requires a run."""


class ControllerStub:
    """Stub of the controller: stores settings and records moves, but has no robot."""

    def __init__(self, settings: MotionSettings, places_parts: bool = False) -> None:
        """Create a stub with the settings at an instruction.

        Args:
            settings: These settings.
            places_parts: Whether the station places the parts that a torch searches.
        """
        self.settings = settings
        self._places_parts = places_parts
        self.moves: list[Move] = []
        self.ticks_left = 0
        self.place = _NOWHERE
        self.errno = 0.0
        self.handler = IN_NO_HANDLER
        self.intno = 0.0

    def move(self, move: Move, triggers: tuple[Trigger, ...] = ()) -> None:
        """Record a move; events along its path do not affect it."""
        self.moves.append(move)

    def correct(self, identity: Callable[[], int], move: Move, put: Callable[[], None]) -> None:
        """Ignore corrections by a sensor, which are unknown; the programmed move is checked."""
        del identity, move
        put()

    def search(self, move: Move, *details: object) -> NoReturn:
        """Record the move of a search; only a run tells where it finds its signal."""
        del details
        self.moves.append(move)
        raise NeedsRunError("search")

    search_joints = search

    def part_pose(self, search: str) -> Pose | None:
        """Return None, for a part at its taught position; other positions require a run."""
        del search
        if self._places_parts:
            raise NeedsRunError("part_pose")
        return None

    def not_simulated(self, routine: str, treated_as: str, *, is_unknown: bool = False) -> None:
        """Do nothing: the run that executes the routine reports it."""

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        """Do nothing: time does not affect the moves."""

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Do nothing: outputs do not affect the moves."""

    def require_within(self, name: str, value: float) -> None:
        """Do nothing: an invalid value of an output is reported by a run."""

    def __getattr__(self, name: str) -> NoReturn:
        """Reject all other requests."""
        raise NeedsRunError(name)
