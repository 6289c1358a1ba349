"""The statement of a program behind each event of a part."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from itertools import islice

from rapidsim.controller.journal.events import EventKind
from rapidsim.language.moves import Place
from rapidsim.simulation.results.parts import PartEvent
from rapidsim.simulation.results.simulation import Simulation

_SAME_TIME_S = 1e-9


def place_of(simulation: Simulation, event: PartEvent) -> Place | None:
    """Return the statement that operated the gripper; None if no statement was executed by then.

    If the cell itself changed the signal, as after the delay of a cross connection, it is the last
    statement that the task of the robot had come to.
    """
    names = {name.lower() for name in event.signals}
    first = bisect_left(simulation.events, event.time_s - _SAME_TIME_S, key=lambda one: one.time_s)
    for one in islice(simulation.events, first, None):
        if one.time_s > event.time_s + _SAME_TIME_S:
            break
        if (
            one.kind is EventKind.SIGNAL
            and str(one.details.get("signal", "")).lower() in names
            and one.place is not None
        ):
            return one.place
    lines = simulation.robots[event.robot].lines
    last = bisect_right(lines, event.time_s + _SAME_TIME_S, key=lambda one: one.time_s)
    return lines[last - 1].place if last else None
