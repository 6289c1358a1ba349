"""A move instruction to be resolved to a segment, and the error for an unreachable pose."""

from __future__ import annotations

from rapidsim.controller.moves.target_labels import named_target
from rapidsim.diagnostics import Violation
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import MotionSettings, Move, Place
from rapidsim.motion.configurations.targets import Placement
from rapidsim.values import value_class


class NotReachableError(RapidError):
    """A pose that the arm cannot take, with the finding for its cause.

    Functions such as CalcJointT raise it to the program. A move to such a pose ends the run.
    """

    def __init__(self, errno: float, violation: Violation) -> None:
        """Store the finding."""
        super().__init__(errno, violation.message, cf=violation.cf)
        self.violation = violation


@value_class(frozen=True, slots=True, eq=False)
class MoveRequest:
    """A move with all data of its segment, except the robot and its start."""

    move: Move
    settings: MotionSettings
    placed: Placement
    """Placement of its tool and its work object."""


@value_class(frozen=True, slots=True, eq=False)
class LocatedMoveRequest:
    """A request and its place in the program, for findings about it."""

    request: MoveRequest
    place: Place
    is_first: bool = False
    """Whether it is the first move of a run."""
    starts_free: bool = False
    """Whether neither station nor program define the position of the arm before it."""

    @property
    def name(self) -> str:
        """Its target, as findings name it."""
        return target_name(self.place, self.request.move)

    @property
    def written(self) -> str:
        """Its target as the program's text has it, so that each target is reported once."""
        return _target_text(self.place, self.request.move)


def target_name(place: Place, move: Move) -> str:
    """Target of a move, as findings name it; else the name of the instruction."""
    return named_target(_target_text(place, move))


def _target_text(place: Place, move: Move) -> str:
    arguments = place.arguments
    return arguments.get("topoint", arguments.get("tojointpos", move.instruction))
