"""Carriers of the parts of a cell during a run.

A part is a body that grippers take. A gripper that closes takes the nearest of its parts within
reach; a part that it releases rests on the body below it and moves with that, be it a positioner, a
part or another robot's gripper. The parts on a part move with it. All follows from the signals of
the run and the motion of its arms, in order of time; at one time grippers close before others open,
as a part that changes hands is never loose.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.convex import Index
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.collisions.scene import WORLD, AttachedBody, Body, SceneFrame
from rapidsim.collisions.support import DEEPEST_M, RESTS_M, Support, support
from rapidsim.diagnostics import Violation
from rapidsim.findings.collisions import LeftInTheAir, NothingGripped, PlaceOccupied
from rapidsim.frames.transform import Array, Transform
from rapidsim.simulation.results.parts import PartChange, PartEvent
from rapidsim.values import value_class

_MM = 1e3
_UP = np.array([0.0, 0.0, 1.0])
_FARTHEST_M = 10.0
"""Distance [m] up to which the nearest part of a gripper is named."""
_MOVED_M = 5e-3
"""Travel [m] of a body on which a part lies loosely."""


@value_class(frozen=True, slots=True)
class Reach:
    """Parts of which a gripper takes the nearest."""

    parts: tuple[int, ...]
    """Indices of the bodies."""
    distance_m: float


@value_class(frozen=True, slots=True)
class PartHolder:
    """A gripper or clamp that a condition on signals closes."""

    name: str
    robot: int
    frame: SceneFrame
    """The flange, or the frame of a positioner."""
    body: int | None
    """Index of the body that holds; None for all on its frame, and the TCP."""
    reaches: tuple[Reach, ...]
    signals: tuple[str, ...]
    changes: tuple[tuple[float, bool], ...]
    """Times [s] at which it closes and opens."""

    @property
    def is_of_arm(self) -> bool:
        """Whether an arm carries it."""
        return not self.frame.axes


@value_class(frozen=True, slots=True, eq=False)
class MovingCell:
    """Bodies with their first carriers, and all frames at the times at which grippers act."""

    bodies: Sequence[Body]
    distances: Bodies
    """The bodies; behind them a point."""
    frames: Mapping[SceneFrame, Transform]
    """World from each frame (k,)."""
    tcps: Sequence[Transform]
    """World from TCP (k,) of each robot."""


@value_class(frozen=True, slots=True, eq=False)
class PartCourses:
    """Carriers and events of the parts of a run."""

    carried: Mapping[int, tuple[AttachedBody, ...]]
    """Carriers of each part in order of time, by the index of its body."""
    events: tuple[PartEvent, ...]
    """Events in order of time."""


def part_courses(
    cell: MovingCell, grippers: Sequence[PartHolder], times: Sequence[float]
) -> PartCourses:
    """Follow the parts of a run.

    Args:
        cell: Its bodies.
        grippers: Its grippers.
        times: The instants (k,) [s] of the frames of the cell.
    """
    return _Tracker(cell, grippers, times).courses()


class _Tracker:
    def __init__(
        self, cell: MovingCell, grippers: Sequence[PartHolder], times: Sequence[float]
    ) -> None:
        self._cell, self._grippers, self._times = cell, grippers, times
        self._rows = {time_s: row for row, time_s in enumerate(times)}
        parts = {part for gripper in grippers for reach in gripper.reaches for part in reach.parts}
        self._parts = sorted(parts)
        self._carried = {part: [cell.bodies[part].carried[0]] for part in self._parts}
        self._holders: dict[int, PartHolder] = {}
        """Grippers of the parts that are held."""
        self._since: dict[int, float] = {}
        """Times [s] at which these closed."""
        self._below: dict[int, int] = {}
        """Bodies that parts rest on, or that hold them."""
        self._loose: dict[int, tuple[int, int]] = {}
        """Event and instant at which a part was put on a gripper that has not closed on it."""
        self._events: list[PartEvent] = []

    def courses(self) -> PartCourses:
        """Return carriers and events of the parts."""
        for part in self._parts:
            found = self._support(part, 0, self._parts)
            if found is not None:
                self._below[part] = found.body
        changes = (
            (time_s, not closes, number)
            for number, gripper in enumerate(self._grippers)
            for time_s, closes in gripper.changes
        )
        for time_s, opens, number in sorted(changes):
            gripper, row = self._grippers[number], self._rows[time_s]
            if opens:
                self._open(gripper, row)
            else:
                self._close(gripper, row)
        for part in [*self._loose]:
            self._settle(part, len(self._times) - 1)
        carried = {part: tuple(frames) for part, frames in self._carried.items()}
        return PartCourses(carried, tuple(sorted(self._events, key=lambda one: one.time_s)))

    def _close(self, gripper: PartHolder, row: int) -> None:
        held = [part for part, holder in self._holders.items() if holder is gripper]
        near: list[tuple[float, int]] = []
        taken: list[int] = []
        for reach in gripper.reaches:
            parts = [part for part in reach.parts if part not in held and part != gripper.body]
            distances = self._distances(gripper, parts, row)
            near += zip(distances.tolist(), parts, strict=True)
            if parts and distances.min() <= reach.distance_m:
                taken.append(parts[int(distances.argmin())])
        if not taken:
            said = "the station has no part for it"
            if near:
                distance_m, part = min(near)
                where = f"is {distance_m * _MM:.1f} mm away"
                if not np.isfinite(distance_m):
                    where = f"is more than {_FARTHEST_M * _MM:g} mm away"
                said = f"the nearest part, {self._name(part)}, {where}"
            miss = NothingGripped(gripper.name, self._times[row], said)
            self._log(row, PartChange.MISSED, "", gripper, gripper.name, miss)
        for part in dict.fromkeys(taken):
            fault: Violation | None = None
            others = [
                other
                for other, holder in self._holders.items()
                if gripper.body is not None and holder.body == gripper.body and other != part
            ]
            if others:
                where = f"{gripper.name} holds {self._name(others[0])} already"
                fault = PlaceOccupied(self._name(part), where, self._times[row])
            self._settle(part, row)
            self._holders[part], self._since[part] = gripper, self._times[row]
            self._attach(part, row, gripper.body, self._frame_of(gripper))
            self._log(row, PartChange.GRIPPED, self._name(part), gripper, gripper.name, fault)

    def _open(self, gripper: PartHolder, row: int) -> None:
        for part in [part for part, holder in self._holders.items() if holder is gripper]:
            del self._holders[part]
            below = self._bodies_below(part, gripper)
            found = self._support(part, row, below)
            held_s = self._times[row] - self._since[part]
            fault: Violation | None = None
            if meets := self._occupant(part, row):
                where = f"{meets} is there already"
                fault = PlaceOccupied(self._name(part), where, self._times[row])
            if found is None:
                self._attach(part, row, None, WORLD)
                deep = self._support(part, row, below, DEEPEST_M)
                said = "nothing is below it"
                if deep is not None:
                    said = f"{self._name(deep.body)} is {deep.drop_m * _MM:.0f} mm below it"
                fault = fault or LeftInTheAir(self._name(part), self._times[row], said)
                self._log(
                    row, PartChange.DROPPED, self._name(part), gripper, "", fault, meets, held_s
                )
                continue
            frame = self._carrier(found.body, row).frame
            self._attach(part, row, found.body, frame)
            if self._could_hold(frame, part):
                self._loose[part] = len(self._events), row
            carrier = self._name(found.body)
            self._log(
                row, PartChange.PLACED, self._name(part), gripper, carrier, fault, meets, held_s
            )

    def _attach(self, part: int, row: int, below: int | None, frame: SceneFrame) -> None:
        """Let a frame carry a part, and all parts that rest on it, from an instant on."""
        if below is None:
            self._below.pop(part, None)
        else:
            self._below[part] = below
        waiting, moved = [part], []
        while waiting:
            moved.append(waiting.pop())
            waiting += [
                other
                for other, body in self._below.items()
                if body == moved[-1] and other not in moved
            ]
        for other in moved:
            pose = self._pose(other, row)
            seen = self._cell.frames[frame][row].inverse() @ pose
            self._carried[other].append(AttachedBody(self._times[row], frame, seen))

    def _frame_of(self, gripper: PartHolder) -> SceneFrame:
        if gripper.body in self._carried:
            return self._carried[gripper.body][-1].frame
        return gripper.frame

    def _carrier(self, body: int, row: int) -> AttachedBody:
        """Return the carrier of a body at an instant."""
        if body in self._carried:
            return self._carried[body][-1]
        first, *later = self._cell.bodies[body].carried
        begun = [one for one in later if one.from_s <= self._times[row]]
        return begun[-1] if begun else first

    def _pose(self, body: int, row: int) -> Transform:
        carrier = self._carrier(body, row)
        return self._cell.frames[carrier.frame][row] @ carrier.frame_from_body

    def _distances(self, gripper: PartHolder, parts: Sequence[int], row: int) -> Array:
        """Return the distances (k,) [m] of parts from a gripper; inf beyond the farthest."""
        holders = [] if gripper.body is None else [gripper.body]
        if gripper.body is None:
            holders = [
                body
                for body in range(len(self._cell.bodies))
                if self._carrier(body, row).frame == gripper.frame and body not in parts
            ]
        poses = [self._pose(body, row) for body in holders]
        if gripper.body is None and gripper.is_of_arm:
            holders.append(len(self._cell.bodies))
            poses.append(self._cell.tcps[gripper.robot][row])
        if not holders:
            return np.zeros(len(parts))
        first, second = np.repeat(parts, len(holders)), np.tile(holders, len(parts))
        seen = [pose.inverse() @ self._pose(part, row) for part in parts for pose in poses]
        found = self._gaps(first, second, Transform.stacked(seen))
        nearest: Array = found.reshape(len(parts), len(holders)).min(axis=1, initial=np.inf)
        return nearest

    def _gaps(self, first: Index, second: Index, second_from_first: Transform) -> Array:
        enough = np.full(len(first), _FARTHEST_M)
        gaps = self._cell.distances.gaps(first, second, second_from_first, enough)
        return np.maximum(gaps.distances_found, 0.0)

    def _bodies_below(self, part: int, gripper: PartHolder) -> list[int]:
        """Indices of bodies that may carry a part: not those of the arm that releases it."""
        return [
            body
            for body in range(len(self._cell.bodies))
            if not (gripper.is_of_arm and _is_of_arm(self._frame_now(body), gripper.robot))
        ]

    def _frame_now(self, body: int) -> SceneFrame:
        frames = self._carried.get(body) or self._cell.bodies[body].carried
        return frames[-1].frame

    def _support(
        self, part: int, row: int, bodies: Iterable[int], deepest_m: float = RESTS_M
    ) -> Support | None:
        """Return the body below a part."""
        above = {part}
        while more := {other for other, body in self._below.items() if body in above} - above:
            above |= more
        below = np.array([body for body in bodies if body not in above], dtype=np.int64)
        if not len(below):
            return None
        poses = Transform.stacked([self._pose(body, row) for body in below.tolist()])
        here = self._pose(part, row)
        return support(self._cell.distances, part, below, here, poses, deepest_m)

    def _occupant(self, part: int, row: int) -> str:
        """Name of the part that is where another one is put, also when lifted a little; or ""."""
        others = [other for other in self._parts if other != part and other not in self._holders]
        if not others:
            return ""
        here = self._pose(part, row)
        overlaps = np.ones(len(others), dtype=np.bool_)
        for up_m in (0.0, RESTS_M):
            lifted = Transform(here.rotation, here.translation + up_m * _UP)
            seen = [self._pose(other, row).inverse() @ lifted for other in others]
            first, second = np.full(len(others), part), np.array(others)
            enough = np.zeros(len(others))
            gaps = self._cell.distances.gaps(first, second, Transform.stacked(seen), enough)
            overlaps &= gaps.distances_found < -TOUCH_M
        return self._name(others[int(overlaps.argmax())]) if overlaps.any() else ""

    def _could_hold(self, frame: SceneFrame, part: int) -> bool:
        """Whether a frame is that of an arm with a gripper for a part."""
        return any(
            gripper.is_of_arm
            and _is_of_arm(frame, gripper.robot)
            and any(part in reach.parts for reach in gripper.reaches)
            for gripper in self._grippers
        )

    def _settle(self, part: int, row: int) -> None:
        """Report a part on an open gripper that has moved until an instant."""
        if part not in self._loose:
            return
        number, begin = self._loose.pop(part)
        way = self._pose(part, row).translation - self._pose(part, begin).translation
        event = self._events[number]
        if float(np.linalg.norm(way)) < _MOVED_M or event.violation is not None:
            return
        said = f"{event.carrier}, on which it lies, moves on without a grip on it"
        self._events[number] = replace(
            event,
            change=PartChange.DROPPED,
            violation=LeftInTheAir(event.part, event.time_s, said),
        )

    def _name(self, body: int) -> str:
        return self._label(body).name

    def _label(self, body: int) -> BodyName:
        return self._cell.bodies[body].label

    def _log(
        self,
        row: int,
        change: PartChange,
        part: str,
        gripper: PartHolder,
        carrier: str,
        violation: Violation | None,
        meets: str = "",
        held_s: float = 0.0,
    ) -> None:
        self._events.append(
            PartEvent(
                self._times[row],
                change,
                part,
                carrier,
                gripper.robot,
                gripper.signals,
                violation,
                meets,
                held_s,
            )
        )


def _is_of_arm(frame: SceneFrame, robot: int) -> bool:
    """Whether a link of an arm, or its flange, carries a frame; its base is no link."""
    return frame.robot == robot and not frame.axes and frame.link > 0
