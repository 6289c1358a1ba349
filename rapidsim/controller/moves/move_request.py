"""A move instruction on its way to become a segment, and the error of one that cannot."""

from __future__ import annotations

from rapidsim.controller.moves.target_words import named_target
from rapidsim.diagnostics import Violation
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import MotionSettings, Move, Place
from rapidsim.motion.configurations.targets import Placement
from rapidsim.values import dataclass


class MoveRefusedError(RapidError):
    """A move whose end cannot be reached, with the finding that says why."""

    def __init__(self, errno: float, violation: Violation) -> None:
        """Carry the finding along."""
        super().__init__(errno, violation.message, cf=violation.cf)
        self.violation = violation


@dataclass(frozen=True, slots=True, eq=False)
class MoveRequest:
    """A move and all that its segment depends on, but the robot and where it starts."""

    move: Move
    settings: MotionSettings
    placed: Placement
    """Where its tool and its work object are."""


@dataclass(frozen=True, slots=True, eq=False)
class AskedMove:
    """A request and where it stands in the program, for what is to be said of it."""

    request: MoveRequest
    place: Place
    is_first: bool = False
    """Nobody knows where the first move of a run starts."""

    @property
    def name(self) -> str:
        """What it goes to, as findings name it."""
        return target_name(self.place, self.request.move)

    @property
    def written(self) -> str:
        """What it goes to, as the program writes it: what is said of a target is said once."""
        return _target_text(self.place, self.request.move)


def target_name(place: Place, move: Move) -> str:
    """What a move goes to, as findings name it; else the name of the instruction."""
    return named_target(_target_text(place, move))


def _target_text(place: Place, move: Move) -> str:
    arguments = place.arguments
    return arguments.get("topoint", arguments.get("tojointpos", move.instruction))
