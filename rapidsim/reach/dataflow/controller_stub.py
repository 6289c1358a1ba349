"""A controller without a robot, on which single instructions are executed.

It has settings, accepts moves, ignores what does not affect them, and refuses whatever only a run
could answer.
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
    """An instruction asked something of the controller that only a run can answer."""


class ControllerStub:
    """Stands in for the controller: keeps settings, accepts moves, knows nothing of a robot."""

    def __init__(self, settings: MotionSettings, places_parts: bool = False) -> None:
        """Begin with the settings where the instruction stands.

        Args:
            settings: These settings.
            places_parts: Whether the station says where parts are that a torch searches.
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
        """Ignore corrections by a sensor, which are not known; the programmed move is checked."""
        del identity, move
        put()

    def part_pose(self, search: str) -> Pose | None:
        """None, for a part that is where it was taught; a run knows where others are."""
        del search
        if self._places_parts:
            raise NeedsRunError("part_pose")
        return None

    def not_simulated(self, routine: str, treated_as: str, *, is_unknown: bool = False) -> None:
        """Nothing; the run that executes it reports it."""

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        """Nothing; time does not affect the moves."""

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Nothing; outputs do not affect the moves."""

    def require_within(self, name: str, value: float) -> None:
        """Nothing; whether an output can have the value is told when it runs."""

    def __getattr__(self, name: str) -> NoReturn:
        """Refuse all else."""
        raise NeedsRunError(name)
