"""A move instruction that is to become a segment, and the error for a pose out of reach."""

from __future__ import annotations

from rapidsim.controller.moves.target_labels import named_target
from rapidsim.diagnostics import Violation
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import MotionSettings, Move, Place
from rapidsim.motion.configurations.targets import Placement
from rapidsim.values import value_class


class NotReachableError(RapidError):
    """A pose that the arm cannot take, with the finding that says why.

    Functions such as CalcJointT raise it to the program. A move to such a pose ends the run.
    """

    def __init__(self, errno: float, violation: Violation) -> None:
        """Carry the finding along."""
        super().__init__(errno, violation.message, cf=violation.cf)
        self.violation = violation


@value_class(frozen=True, slots=True, eq=False)
class MoveRequest:
    """A move with all that its segment depends on, except the robot and its start."""

    move: Move
    settings: MotionSettings
    placed: Placement
    """Where its tool and its work object are."""


@value_class(frozen=True, slots=True, eq=False)
class LocatedMoveRequest:
    """A request and its place in the program, for findings about it."""

    request: MoveRequest
    place: Place
    is_first: bool = False
    """Whether it is the first move of a run."""
    starts_free: bool = False
    """Whether neither station nor program say where the arm begins."""

    @property
    def name(self) -> str:
        """What it goes to, as findings name it."""
        return target_name(self.place, self.request.move)

    @property
    def written(self) -> str:
        """What it goes to, as the program writes it, so that each target is reported once."""
        return _target_text(self.place, self.request.move)


def target_name(place: Place, move: Move) -> str:
    """What a move goes to, as findings name it; else the name of the instruction."""
    return named_target(_target_text(place, move))


def _target_text(place: Place, move: Move) -> str:
    arguments = place.arguments
    return arguments.get("topoint", arguments.get("tojointpos", move.instruction))
