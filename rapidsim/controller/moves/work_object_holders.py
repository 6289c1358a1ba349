"""Carriers of the work object of a move: another robot ("ROB_2") or a conveyor.

Source: Application manual MultiMove (3HAC021272-001), "Coordinated work objects", "Semi coordinated
movements": robots that are not synchronised work on a work object only while it does not move.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from rapidsim.frames.transform import Transform
from rapidsim.language.data import WobjData
from rapidsim.values import value_class as value


@value(frozen=True, slots=True, eq=False)
class Holder:
    """Another robot, or a conveyor, at its pose at a time."""

    unit: str
    """Name of the mechanical unit."""
    moves: bool
    """Whether it is a robot that is moving."""
    world_from_user: Transform
    """The flange of a robot; the connected object of a conveyor."""


def no_holder(wobj: WobjData, time_s: float | None) -> Holder | None:
    """Return None: for cells in which nothing holds work objects."""
    del wobj, time_s
    return None


@dataclass(slots=True, eq=False)
class Holders:
    """Finds them by the names of their mechanical units once all tasks exist."""

    find: Callable[[WobjData, float | None], Holder | None] = no_holder
    """Returns the holder of a work object, of a conveyor that at a time [s]; None is now."""
