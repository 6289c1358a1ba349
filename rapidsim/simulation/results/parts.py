"""Events of the parts of a cell: taken by grippers, put down, dropped."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum

from rapidsim.controller.journal.events import EventKind
from rapidsim.diagnostics import Violation
from rapidsim.language.moves import Place
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class

_SAME_TIME_S = 1e-9


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


def place_of(simulation: Simulation, event: PartEvent) -> Place | None:
    """Return the statement that operated the gripper; None if no statement was executed by then.

    If the cell itself changed the signal, as after the delay of a cross connection, it is the last
    statement that the task of the robot had come to.
    """
    names = {name.lower() for name in event.signals}
    for one in simulation.events:
        if (
            one.kind is EventKind.SIGNAL
            and abs(one.time_s - event.time_s) <= _SAME_TIME_S
            and str(one.details.get("signal", "")).lower() in names
            and one.place is not None
        ):
            return one.place
    executed = [
        line.place
        for line in simulation.robots[event.robot].lines
        if line.time_s <= event.time_s + _SAME_TIME_S
    ]
    return executed[-1] if executed else None
