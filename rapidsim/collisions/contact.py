"""Results of a collision search along a motion: contacts and clearances."""

from __future__ import annotations

import math

from rapidsim.frames.transform import Array
from rapidsim.values import value_class

FARTHEST_M = 0.5
"""Distance [m] above which no clearance is reported."""


@value_class(frozen=True, slots=True)
class BodyName:
    """Name of a body in messages."""

    name: str
    robot: int | None = None
    """Index of the robot whose link or tool it is; None for an object."""


@value_class(frozen=True, slots=True, eq=False)
class Contact:
    """A contact of two bodies."""

    time_s: float
    """First instant [s]."""
    robot: int
    """Index of the robot whose move it is."""
    move: int
    """Index of the move of that robot."""
    first: BodyName
    second: BodyName
    point: Array
    """Position (3,) [m] in the world."""
    depth_m: float | None
    """Largest overlap [m] of the bodies during that move; None after many contacts."""
    continued: bool = False
    """Whether they already touched at the end of the previous move."""


@value_class(frozen=True, slots=True, eq=False)
class Clearance:
    """Smallest distance of two bodies during one move."""

    distance_m: float
    time_s: float
    robot: int
    move: int
    first: BodyName
    second: BodyName
    point: Array
    """Position (3,) [m] in the world, on the second body."""


@value_class(frozen=True, slots=True, eq=False)
class CollisionReport:
    """All results along a motion."""

    contacts: tuple[Contact, ...]
    """Contacts in order of time."""
    clearances: tuple[Clearance, ...]
    """Clearances in order of moves, one per move with bodies nearer than `FARTHEST_M`."""
    decided: bool = True
    """Whether the search was completed; it may not be if a motion slides along a body for long."""
    until_s: float = math.inf
    """Time [s] up to which the motion was searched, if a limit ended the search."""
