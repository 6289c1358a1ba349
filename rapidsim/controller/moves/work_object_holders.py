"""Other robots that hold the work object of a move: a work object with `ufmec` "ROB_2".

Source: Application manual MultiMove (3HAC021272-001), "Coordinated work objects", "Semi coordinated
movements": robots that are not synchronised work on a work object only while it does not move.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from rapidsim.frames.transform import Transform
from rapidsim.values import value_class as value


@value(frozen=True, slots=True, eq=False)
class Holder:
    """Another robot at its current pose."""

    unit: str
    """Name of the mechanical unit."""
    moves: bool
    """Whether it is moving."""
    world_from_flange: Transform


def no_holder(unit: str) -> Holder | None:
    """Return None: for cells in which no other robot has this name."""
    del unit
    return None


@dataclass(slots=True, eq=False)
class Holders:
    """Finds robots by the names of their mechanical units once all tasks exist."""

    find: Callable[[str], Holder | None] = no_holder
