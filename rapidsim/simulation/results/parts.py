"""Events of the parts of a cell: taken by grippers, put down, dropped."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

from rapidsim.diagnostics import Violation
from rapidsim.values import value_class


class PartChange(StrEnum):
    """Kind of an event of a part."""

    GRIPPED = "gripped"
    PLACED = "placed"
    DROPPED = "dropped"
    MISSED = "missed"
    APPEARED = "appeared"
    BLOCKED = "blocked"
    """It could not appear, as its place is occupied."""
    DELIVERED = "delivered"


@value_class(frozen=True, slots=True)
class PartEvent:
    """A change of the carrier of a part, or a gripper that closes on nothing."""

    time_s: float
    change: PartChange
    part: str
    """Name of the part; empty if a gripper closes on nothing."""
    carrier: str
    """Name of the gripper, or of the body on which the part rests; empty in the air."""
    robot: int
    """Index of the robot whose gripper acts."""
    signals: tuple[str, ...] = ()
    """Signals that operate the gripper."""
    violation: Violation | None = None
    """The fault of the program, if it is one."""
    meets: str = ""
    """Name of the part that is where this one is put; empty if the place is free."""
    held_s: float = 0.0
    """Time [s] for which the gripper has held a part that it releases."""


@value_class(frozen=True, slots=True)
class PartCounts:
    """Numbers of parts of a run."""

    total: int
    """All parts."""
    moved: int
    """Parts that were put down somewhere."""
    delivered: int
    """Parts that disappeared at a sink."""
    lost: int
    """Parts that were dropped and not taken again."""


def part_counts(total: int, events: Sequence[PartEvent]) -> PartCounts:
    """Count the parts of a run, of which there is a total, by their events in order of time."""
    last = {one.part: one.change for one in events}
    placed = {one.part for one in events if one.change is PartChange.PLACED}
    ends = [*last.values()]
    delivered, lost = ends.count(PartChange.DELIVERED), ends.count(PartChange.DROPPED)
    return PartCounts(total, len(placed), delivered, lost)
