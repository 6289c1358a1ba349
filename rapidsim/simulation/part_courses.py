"""Carriers of the parts of a cell during a run.

A part is a body that grippers take, or that appears and disappears. A gripper that closes takes the
nearest of its parts within reach; a part that it releases rests on the body below it and moves with
that, be it a positioner, a belt, a part or another robot's gripper. The parts on a part move with
it. All follows from the signals of the run and the motion of its arms, in order of time; at one
time grippers close before others open, as a part that changes hands is never loose.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from functools import partial
from heapq import heappop, heappush
from itertools import count

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.scene import WORLD, AttachedBody, SceneFrame
from rapidsim.collisions.support import DEEPEST_M
from rapidsim.diagnostics import Violation
from rapidsim.findings.collisions import LeftInTheAir, NothingGripped, PlaceOccupied
from rapidsim.frames.transform import Transform
from rapidsim.motion.configurations.targets import MM
from rapidsim.simulation.cell_bodies import CellBodies
from rapidsim.simulation.part_places import FARTHEST_M, PartPlaces, PartState
from rapidsim.simulation.part_supply import PartHolder, PartSink
from rapidsim.simulation.results.parts import PartChange, PartEvent
from rapidsim.values import value_class

_MM = 1e3
_MOVED_M = 5e-3
"""Travel [m] of a body on which a part lies loosely."""
_PUT = "open the gripper where something is within 5 mm below the part"
_CLOSE = "close the other gripper on the part before this one opens"
_FETCH = "take the part before the end, stop the belt, or let a [[sink]] take what arrives there"
_APPEARS, _CLOSES, _OPENS, _LEAVES = range(4)
"""Order of what happens at one time."""


@value_class(frozen=True, slots=True, eq=False)
class PartCourse:
    """Carriers of one part."""

    carried: tuple[AttachedBody, ...]
    """In order of time."""
    from_s: float
    until_s: float
    """Interval [s] in which it exists."""


@value_class(frozen=True, slots=True, eq=False)
class PartCourses:
    """Carriers and events of the parts of a run."""

    parts: Mapping[int, PartCourse]
    """By the index of the body."""
    events: tuple[PartEvent, ...]
    """Events in order of time."""


def part_courses(
    cell: CellBodies,
    distances: Bodies,
    holders: Sequence[PartHolder],
    sinks: Sequence[PartSink],
) -> PartCourses:
    """Follow the parts of a run.

    Args:
        cell: Its bodies.
        distances: The same bodies; behind them a point.
        holders: Grippers and clamps.
        sinks: Bodies from which parts disappear.
    """
    return _Tracker(cell, distances, holders, sinks).courses()


_Act = Callable[[float], None]


@value_class(slots=True, eq=False)
class _Queue:
    """Acts by time and order."""

    heap: list[tuple[float, int, int, _Act]] = field(default_factory=list)
    numbers: count[int] = field(default_factory=count)

    def add(self, time_s: float, order: int, act: _Act) -> None:
        """Let something happen at a time [s]."""
        heappush(self.heap, (time_s, order, next(self.numbers), act))


class _Tracker:
    def __init__(
        self,
        cell: CellBodies,
        distances: Bodies,
        holders: Sequence[PartHolder],
        sinks: Sequence[PartSink],
    ) -> None:
        self._cell, self._holders, self._sinks = cell, holders, sinks
        self._queue = _Queue()
        self._at = PartPlaces(cell, distances, holders)
        self._events: list[PartEvent] = []

    def courses(self) -> PartCourses:
        """Return carriers and events of the parts."""
        if not self._at.parts:
            return PartCourses({}, ())
        self._begin()
        while self._queue.heap and self._queue.heap[0][0] <= self._cell.end_s:
            time_s, _, _, act = heappop(self._queue.heap)
            act(time_s)
        for number in self._at.parts:
            self._settle(number, self._cell.end_s)
        courses = {}
        for number, part in self._at.parts.items():
            carried = self._cell.bodies[number].carried
            if part.carried != [carried[0]] or number in self._cell.arrivals:
                if len(carried) > 1:
                    name = self._at.name(number)
                    self._cell.remarks.append(f"{name}: its work object changes as it is carried")
                carried = tuple(part.carried)
            courses[number] = PartCourse(carried, part.from_s, part.until_s)
        return PartCourses(courses, tuple(self._events))

    def _begin(self) -> None:
        """Queue what the signals and the clock do to the parts."""
        for number, arrival in self._cell.arrivals.items():
            self._at.parts[number].from_s = self._at.parts[number].until_s = np.inf
            self._queue.add(arrival.time_s, _APPEARS, partial(self._appear, number))
        for holder in self._holders:
            for time_s, closes in holder.changes:
                act = self._close if closes else self._open
                order = _CLOSES if closes else _OPENS
                self._queue.add(time_s, order, partial(act, holder))
        for sink in self._sinks:
            for time_s in sink.empties:
                self._queue.add(time_s, _LEAVES, partial(self._empty, sink))
        self._at.frames.prefetch([time_s for time_s, *_ in self._queue.heap] + [0.0])
        for number, part in self._at.parts.items():
            if part.until_s == np.inf and part.from_s == -np.inf:
                self._rest(number, part)

    def _rest(self, number: int, part: PartState) -> None:
        """Let a part that stands in the world rest on the positioner, belt or part below it."""
        below = self._at.support(number, 0.0, self._at.bodies(0.0))
        if below is None:
            return
        part.below, first = below.body, part.carried[0]
        frame = self._at.frame_on(below.body, 0.0)
        if first.frame == WORLD and (frame.axes or frame.belt is not None):
            part.carried.clear()
            self._attach(number, 0.0, below.body, frame, first)

    def _appear(self, number: int, time_s: float) -> None:
        part, arrival = self._at.parts[number], self._cell.arrivals[number]
        meets = self._at.occupant(number, time_s)
        if meets:
            fault = PlaceOccupied(self._at.name(number), f"{meets} is there already", time_s)
            self._log(
                time_s,
                PartChange.BLOCKED,
                number,
                "",
                violation=fault,
                meets=meets,
                signals=arrival.signals,
            )
            return
        part.from_s, part.until_s = time_s, np.inf
        first = part.carried[0]
        part.carried[0] = replace(first, from_s=time_s)
        found = self._at.support(number, time_s, self._at.bodies(time_s))
        carrier = ""
        if arrival.belt is not None:
            part.carried.clear()
            self._attach(number, time_s, None, SceneFrame(belt=arrival.belt), first)
            carrier = f"`{self._cell.conveyors[arrival.belt].unit}`"
        elif found is not None:
            carrier = self._at.name(found.body)
            frame = self._at.frame_on(found.body, time_s)
            if frame != first.frame:
                part.carried.clear()
                self._attach(number, time_s, found.body, frame, first)
            part.below = found.body
        self._log(time_s, PartChange.APPEARED, number, carrier)

    def _close(self, holder: PartHolder, time_s: float) -> None:
        near: list[tuple[float, int]] = []
        taken: list[int] = []
        present = self._at.present(time_s)
        for reach in holder.reaches:
            parts = [
                part
                for part in reach.parts
                if part in present
                and part != holder.body
                and self._at.parts[part].holder is not holder
            ]
            distances = self._at.distances_from(holder, parts, time_s)
            near += zip(distances.tolist(), parts, strict=True)
            if parts and distances.min() <= reach.distance_m:
                taken.append(parts[int(distances.argmin())])
        if not taken:
            self._miss(holder, near, time_s)
        others = [
            self._at.name(other)
            for other, one in self._at.parts.items()
            if holder.body is not None and one.holder and one.holder.body == holder.body
        ]
        for number in dict.fromkeys(taken):
            fault: Violation | None = None
            if others:
                where = f"{holder.name} holds {others[0]} already"
                fault = PlaceOccupied(self._at.name(number), where, time_s)
            self._settle(number, time_s)
            part, frame = self._at.parts[number], holder.frame
            if holder.body in self._at.parts:
                frame = self._at.parts[holder.body].carried[-1].frame
            part.holder, part.since_s = holder, time_s
            self._attach(number, time_s, holder.body, frame)
            self._log(time_s, PartChange.GRIPPED, number, holder.name, holder, fault)

    def _miss(self, holder: PartHolder, near: Sequence[tuple[float, int]], time_s: float) -> None:
        said = "there is no part for it"
        if near:
            distance_m, number = min(near)
            where = f"is {distance_m * _MM:.1f} mm away"
            if not np.isfinite(distance_m):
                where = f"is more than {FARTHEST_M * _MM:g} mm away"
            said = f"the nearest part, {self._at.name(number)}, {where}"
        fault = NothingGripped(holder.name, time_s, said)
        self._log(time_s, PartChange.MISSED, None, holder.name, holder, fault)

    def _open(self, holder: PartHolder, time_s: float) -> None:
        for number, part in self._at.parts.items():
            if part.holder is not holder:
                continue
            part.holder = None
            below = self._at.bodies(time_s, holder)
            found = self._at.support(number, time_s, below)
            fault: Violation | None = None
            if meets := self._at.occupant(number, time_s):
                where = f"{meets} is there already"
                fault = PlaceOccupied(self._at.name(number), where, time_s)
            if found is None:
                deep = self._at.support(number, time_s, below, DEEPEST_M)
                said = "nothing is below it"
                if deep is not None:
                    said = f"{self._at.name(deep.body)} is {deep.drop_m * _MM:.0f} mm below it"
                fault = fault or LeftInTheAir(self._at.name(number), time_s, said, _PUT)
                self._attach(number, time_s, None, WORLD)
                self._log(time_s, PartChange.DROPPED, number, "", holder, fault, meets)
                continue
            frame = self._at.frame_on(found.body, time_s)
            self._attach(number, time_s, found.body, frame)
            if self._at.could_hold(frame, number):
                part.loose = len(self._events), time_s
            fault = fault or self._put_on_sink(number, found.body, time_s)
            carrier = self._at.name(found.body)
            self._log(time_s, PartChange.PLACED, number, carrier, holder, fault, meets)

    def _put_on_sink(self, number: int, body: int, time_s: float) -> Violation | None:
        """Let a part disappear from a sink; return the fault if it has no place there."""
        fault: Violation | None = None
        for sink in self._sinks:
            if sink.body != body:
                continue
            resting = [one for one in self._at.resting_on(body) if one in self._at.present(time_s)]
            if sink.capacity is not None and len(resting) > sink.capacity:
                where = f"{self._at.name(body)} holds {sink.capacity} already"
                fault = PlaceOccupied(self._at.name(number), where, time_s)
            if not sink.is_emptied and self._cell.belt_of(body) is None:
                self._leave_later(number, time_s + sink.after_s, self._deliver)
        return fault

    def _leave_later(self, number: int, time_s: float, act: Callable[[int, float], None]) -> None:
        """Let something happen to a part unless its carrier changes before."""
        changes = len(self._at.parts[number].carried)

        def leave(now_s: float) -> None:
            if len(self._at.parts[number].carried) == changes:
                act(number, now_s)

        self._queue.add(time_s, _LEAVES, leave)

    def _empty(self, sink: PartSink, time_s: float) -> None:
        present = self._at.present(time_s)
        for number in self._at.resting_on(sink.body):
            if number in present:
                self._deliver(number, time_s)

    def _deliver(self, number: int, time_s: float) -> None:
        """Let a part disappear with all parts on it."""
        for other in (number, *self._at.riders(number)):
            self._at.parts[other].until_s = time_s
            self._log(time_s, PartChange.DELIVERED, other, "")

    def _end_of_belt(self, number: int, time_s: float) -> None:
        """Let a part leave the end of a belt: into a sink, or it is lost."""
        belt = self._at.parts[number].carried[-1].frame.belt
        if any(self._cell.belt_of(sink.body) == belt for sink in self._sinks):
            self._deliver(number, time_s)
            return
        assert belt is not None
        said = f"it leaves the end of `{self._cell.conveyors[belt].unit}`"
        fault = LeftInTheAir(self._at.name(number), time_s, said, _FETCH)
        self._at.parts[number].until_s = time_s
        self._log(time_s, PartChange.DROPPED, number, "", violation=fault)

    def _attach(
        self,
        number: int,
        time_s: float,
        below: int | None,
        frame: SceneFrame,
        first: AttachedBody | None = None,
    ) -> None:
        """Let a frame carry a part, and all parts that rest on it, from an instant on.

        Args:
            number: The part.
            time_s: The instant.
            below: Body that it rests on, or that holds it.
            frame: The frame.
            first: Pose of a part that appears.
        """
        frames = self._at.frames.at(time_s)
        self._at.parts[number].below = below
        for other in (number, *self._at.riders(number)):
            now = (
                first if other == number and first is not None else self._at.carrier(other, time_s)
            )
            pose = frames[now.frame] @ now.frame_from_body
            seen = frames[frame].inverse() @ pose
            self._at.parts[other].carried.append(AttachedBody(time_s, frame, seen))
            if frame.belt is not None:
                self._watch_end(other, frame.belt, seen)

    def _watch_end(self, number: int, index: int, belt_from_part: Transform) -> None:
        """Note when a part reaches the end of a belt."""
        conveyor, belt = self._cell.conveyors[index], self._cell.belts[index]
        end_m = conveyor.length_mm * MM - float(belt_from_part.translation[0])
        if end_m <= belt.travel[-1]:
            time_s = float(np.interp(end_m, belt.travel, belt.times))
            self._leave_later(number, time_s, self._end_of_belt)

    def _settle(self, number: int, time_s: float) -> None:
        """Report a part on an open gripper that has moved until an instant."""
        part = self._at.parts[number]
        if part.loose is None:
            return
        (at, begin_s), part.loose = part.loose, None
        way = self._at.pose(number, time_s).translation - self._at.pose(number, begin_s).translation
        event = self._events[at]
        if float(np.linalg.norm(way)) >= _MOVED_M and event.violation is None:
            said = f"{event.carrier}, on which it lies, moves on without a grip on it"
            fault = LeftInTheAir(event.part, event.time_s, said, _CLOSE)
            self._events[at] = replace(event, change=PartChange.DROPPED, violation=fault)

    def _log(
        self,
        time_s: float,
        change: PartChange,
        number: int | None,
        carrier: str,
        holder: PartHolder | None = None,
        violation: Violation | None = None,
        meets: str = "",
        signals: tuple[str, ...] = (),
    ) -> None:
        self._events.append(
            PartEvent(
                time_s,
                change,
                "" if number is None else self._at.name(number),
                carrier,
                0 if holder is None else holder.robot,
                signals if holder is None else holder.signals,
                violation,
                meets,
                0.0 if number is None else time_s - self._at.parts[number].since_s,
            )
        )
