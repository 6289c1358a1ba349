"""A move instruction on its way to become a segment, and the error of one that cannot."""

from __future__ import annotations

from dataclasses import dataclass

from rapidsim.diagnostics import Violation
from rapidsim.language.controller import MotionSettings, Move, Place
from rapidsim.language.errors import RapidError
from rapidsim.motion.targets import Placement


class MoveRefusedError(RapidError):
    """A move whose end cannot be reached, with the finding that says why."""

    def __init__(self, errno: float, violation: Violation) -> None:
        """Carry the finding along."""
        super().__init__(errno, violation.message, cf=violation.cf)
        self.violation = violation


@dataclass(frozen=True, slots=True, eq=False)
class AskedMove:
    """A move and all that it depends on but the robot."""

    move: Move
    settings: MotionSettings
    place: Place
    placed: Placement
    """Where its tool and its work object are."""

    @property
    def name(self) -> str:
        """What it goes to, as the program writes it."""
        return target_name(self.place, self.move)


def target_name(place: Place, move: Move) -> str:
    """What a move goes to, as the program writes it; else the name of the instruction."""
    arguments = place.arguments
    return arguments.get("topoint", arguments.get("tojointpos", move.instruction))
