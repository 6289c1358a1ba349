"""The results of a search along a motion: contacts and clearances."""

from __future__ import annotations

from rapidsim.frames.transform import Array
from rapidsim.values import value_class

FARTHEST_M = 0.5
"""Bodies farther apart have no clearance worth a number."""


@value_class(frozen=True, slots=True)
class BodyName:
    """The name of a body in messages."""

    name: str
    robot: int | None = None
    """Which of the robots it is a link or the tool of; None for an object."""


@value_class(frozen=True, slots=True, eq=False)
class Contact:
    """Two bodies touch."""

    time_s: float
    """The first instant."""
    robot: int
    """Whose move it is."""
    move: int
    """The index of the move of that robot."""
    first: BodyName
    second: BodyName
    point: Array
    """Where (3,) [m] in the world."""
    depth_m: float | None
    """How far the bodies overlap at most while that move lasts; None after many contacts."""
    continued: bool = False
    """Whether they touched at the end of the move before already."""


@value_class(frozen=True, slots=True, eq=False)
class Clearance:
    """The closest that two bodies came during one move."""

    distance_m: float
    time_s: float
    robot: int
    move: int
    first: BodyName
    second: BodyName
    point: Array
    """Where (3,) [m] in the world: on the second body."""


@value_class(frozen=True, slots=True, eq=False)
class CollisionReport:
    """All results along a motion."""

    contacts: tuple[Contact, ...]
    """In order of time."""
    clearances: tuple[Clearance, ...]
    """One a move in whose course bodies came nearer than `FARTHEST_M`, in order of moves."""
    decided: bool = True
    """Whether everything was checked to the end; a motion that slides along a body for long may
    not be."""
