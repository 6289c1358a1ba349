"""Bodies of a cell in a run: links of the arms, objects of the station, belts of conveyors.

An object that a source or a conveyor supplies exists only in copies, which appear one by one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.geometry import CellGeometry, CellObject, ParentKind
from rapidsim.collisions.link_shapes import link_shapes
from rapidsim.collisions.scene import (
    SHORTEST_S,
    STEP_S,
    WORLD,
    Arm,
    AttachedBody,
    Belt,
    Body,
    SceneFrame,
)
from rapidsim.controller.cell.conditions import Condition, read_condition
from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.frames.transform import Transform
from rapidsim.language.data import WobjData
from rapidsim.motion.configurations.targets import MM, transform
from rapidsim.simulation.results.signal_history import Changes, signal_changes
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

_STOPPING_S = 0.5
"""Longest time [s] for which an arm moves after its last command."""
_MOST_COPIES = 500
"""Number of copies of one object above which no more appear."""


@value_class(frozen=True, slots=True)
class Arrival:
    """Appearance of a copy of an object."""

    time_s: float
    belt: int | None = None
    """Index of the belt on which it appears; None for a source."""
    signals: tuple[str, ...] = ()
    """Signals that make it."""


class CellBodies:
    """Bodies with their first carriers, and what was found out about them."""

    def __init__(
        self,
        simulation: Simulation,
        geometry: CellGeometry,
        conveyors: Sequence[ConveyorScript],
    ) -> None:
        """Build the bodies of a run."""
        self.runs = simulation.robots
        self.end_s = simulation.motion_end_s
        self.arms = tuple(map(_arm, self.runs))
        self.bodies: list[Body] = []
        self.objects: dict[int, CellObject] = {}
        """Objects of the station by the index of their body."""
        self.links: dict[int, tuple[int, int]] = {}
        """Robots and links by the index of their body."""
        self.arrivals: dict[int, Arrival] = {}
        """Appearances of copies by the index of their body."""
        self.remarks: list[str] = []
        self._bodies_of: dict[str, list[int]] = {}
        self._signals = {
            name.lower(): changes
            for name, changes in signal_changes(simulation, still=True).items()
        }
        self.conveyors = tuple(conveyors)
        self.belts = tuple(map(self._belt, self.conveyors))
        for number, one in enumerate(self.runs):
            shapes = link_shapes(one.robot)
            self.remarks += shapes.remarks
            for link in shapes.links:
                self.links[len(self.bodies)] = number, link.number
                name = "the base" if link.number == 0 else f"link {link.number}"
                fixed = AttachedBody(0.0, SceneFrame(number, link.number), Transform.identity())
                self.bodies.append(Body(self.name_of(name, number), link.shape, (fixed,)))
        arrivals = self._arrivals(geometry)
        for item in geometry.objects:
            self._add_object(item, arrivals.get(item.name.lower()))

    def numbers(self, name: str) -> Sequence[int]:
        """Indices of the bodies of an object: its own, or those of its copies."""
        return self._bodies_of.get(name.lower(), ())

    def name_of(self, name: str, robot: int) -> BodyName:
        """Name of something of a robot."""
        whose = f" of {self.runs[robot].task}" if len(self.runs) > 1 else ""
        return BodyName(f"{name}{whose}", robot)

    def robot_of(self, task: str | None, owner: str) -> int | None:
        """Index of the robot of a task; None, with a remark, if the task has no robot."""
        if task is None:
            return 0
        for number, one in enumerate(self.runs):
            if one.task.lower() == task.lower():
                return number
        self.remarks.append(f"`{owner}`: no robot of a task `{task}` is in the run")
        return None

    def changes(self, condition: Condition, owner: str) -> tuple[tuple[float, bool], ...]:
        """Return the times [s] at which a condition becomes true or false, with its new value."""
        for signal in condition.signals():
            if signal.lower() not in self._signals:
                self.remarks.append(f"{owner}: nothing sets or declares the signal {signal}")
        return tuple(_truths(condition, self._signals))

    def begins(self, text: str, owner: str) -> tuple[float, ...]:
        """Return the times [s] at which a condition becomes true; none for an empty text."""
        if not text:
            return ()
        changes = self.changes(read_condition(text), owner)
        return tuple(time_s for time_s, holds in changes if holds)

    def belt_of(self, body: int) -> int | None:
        """Index of the belt on whose surface parts travel that rest on a body."""
        name = self.objects[body].name.lower() if body in self.objects else None
        surfaces = ((one.surface or "").lower() for one in self.conveyors)
        return next((at for at, one in enumerate(surfaces) if one and one == name), None)

    def _belt(self, conveyor: ConveyorScript) -> Belt:
        edges, speeds = [0.0], [0.0 if conveyor.runs else 1.0]
        if conveyor.runs is not None:
            for time_s, runs in self.changes(conveyor.runs, f"`{conveyor.unit}`"):
                edges.append(time_s)
                speeds.append(float(runs))
        times = np.array([*edges, max(self.end_s, edges[-1])])
        travel = np.append(0.0, np.cumsum(np.diff(times) * speeds))
        switch = Transform.from_quaternion(conveyor.quaternion, [x * MM for x in conveyor.position])
        return Belt(switch, times, travel * conveyor.speed_mm_s * MM)

    def _arrivals(self, geometry: CellGeometry) -> dict[str, list[Arrival]]:
        """Return the appearances of copies by the folded name of the object."""
        found: dict[str, list[Arrival]] = {}
        for source in geometry.sources:
            times = [*source.times]
            if source.first_s is not None:
                times += _series(source.first_s, source.every_s, self.end_s)
            copies = [Arrival(time_s) for time_s in times]
            if source.when:
                signals = read_condition(source.when).signals()
                begins = self.begins(source.when, f"`{source.object}`")
                copies += [Arrival(time_s, None, signals) for time_s in begins]
            found.setdefault(source.object.lower(), []).extend(copies)
        names = {item.name.lower() for item in geometry.objects}
        for number, (conveyor, belt) in enumerate(zip(self.conveyors, self.belts, strict=True)):
            for name in (conveyor.arrival, conveyor.surface):
                if name is not None and name.lower() not in names:
                    self.remarks.append(f"`{conveyor.unit}`: there is no object `{name}`")
            if conveyor.arrival is not None:
                passed_s = belt.travel / (conveyor.speed_mm_s * MM)
                series = _series(conveyor.first_s, conveyor.every_s, float(passed_s[-1]))
                times = np.interp(series, passed_s, belt.times).tolist()
                copies = [Arrival(time_s, number) for time_s in times]
                found.setdefault(conveyor.arrival.lower(), []).extend(copies)
        for name, arrivals in found.items():
            arrivals.sort(key=lambda one: one.time_s)
            if len(arrivals) > _MOST_COPIES:
                self.remarks.append(f"`{name}`: only {_MOST_COPIES} of its copies are in the run")
                del arrivals[_MOST_COPIES:]
        return found

    def _add_object(self, item: CellObject, arrivals: Sequence[Arrival] | None) -> None:
        placed = self._placed(item)
        if not placed:
            return
        first = placed[0].frame
        robot = None if first.axes else first.robot
        numbers = self._bodies_of.setdefault(item.name.lower(), [])
        for count in range(1 if arrivals is None else len(arrivals)):
            one, number = item, len(self.bodies)
            if arrivals is not None:
                one = replace(item, name=f"{item.name} {count + 1}")
                self.arrivals[number] = arrivals[count]
            numbers.append(number)
            self.objects[number] = one
            self.bodies.append(Body(BodyName(f"`{one.name}`", robot), item.shape, placed))

    def _placed(self, item: CellObject) -> tuple[AttachedBody, ...]:
        """Return the frames of an object while no robot carries it; empty if they are unknown."""
        parent, pose = item.parent, item.parent_from_object
        if parent.kind is ParentKind.WORLD:
            return (AttachedBody(0.0, WORLD, pose),)
        robot = self.robot_of(parent.robot, item.name)
        if robot is None:
            return ()
        joints = len(self.runs[robot].robot.joints)
        if parent.kind is ParentKind.TOOL:
            return (AttachedBody(0.0, SceneFrame(robot, joints + 1), pose),)
        if parent.kind is ParentKind.LINK:
            if parent.link <= joints:
                return (AttachedBody(0.0, SceneFrame(robot, parent.link), pose),)
            self.remarks.append(
                f"`{item.name}`: {self.runs[robot].robot.name} has no link {parent.link}"
            )
            return ()
        if parent.kind is ParentKind.UNIT:
            unit = self.unit(parent.name, parent.link)
            if unit is None:
                which = f"axis {parent.link} of " if parent.link else ""
                self.remarks.append(
                    f"`{item.name}`: no positioner of the run has {which}`{parent.name}`"
                )
            return () if unit is None else (AttachedBody(0.0, unit, pose),)
        return self._in_work_object(item, robot, joints)

    def unit(self, name: str, count: int = 0) -> SceneFrame | None:
        """Frame moved by the first `count` axes of a positioner (0: all); None if there is none."""
        for robot, run in enumerate(self.runs):
            axes = tuple(
                number
                for number, axis in enumerate(run.robot.external)
                if axis.carries == "wobj" and axis.unit.lower() == name.lower()
            )
            if axes and count <= len(axes):
                return SceneFrame(robot, axes=axes[: count or None])
        return None

    def _in_work_object(
        self, item: CellObject, robot: int, joints: int
    ) -> tuple[AttachedBody, ...]:
        placed: list[AttachedBody] = []
        last: WobjData | None = None
        runs = (self.runs[robot], *self.runs) if item.parent.robot is None else (self.runs[robot],)
        for run in runs:
            for move in run.moves:
                wobj = move.move.wobj
                name = move.place.arguments.get("wobj", "wobj0")
                if name.strip().lower() != item.parent.name.lower() or wobj == last:
                    continue
                unit = None if wobj.ufprog else self.unit(wobj.ufmec)
                if unit is None and not wobj.ufprog:
                    self.remarks.append(f"`{item.name}`: `{wobj.ufmec}` moves its work object")
                    return ()
                frame = unit or (SceneFrame(robot, joints + 1) if wobj.robhold else WORLD)
                user = Transform.identity() if unit else transform(wobj.uframe)
                pose = user @ transform(wobj.oframe) @ item.parent_from_object
                placed.append(AttachedBody(move.start_s if placed else 0.0, frame, pose))
                last = wobj
            if placed:
                return tuple(placed)
        self.remarks.append(
            f"`{item.name}`: no move of the run uses the work object {item.parent.name}"
        )
        return ()


def _series(first_s: float, every_s: float | None, end_s: float) -> list[float]:
    """Return times [s] until an end, one if there is no period."""
    if every_s is None:
        return [first_s] if first_s <= end_s else []
    count = int(max(0.0, (end_s - first_s) / every_s + 1.0)) if first_s <= end_s else 0
    return [first_s + number * every_s for number in range(min(count, _MOST_COPIES + 1))]


def _arm(robot_run: RobotRun) -> Arm:
    busy = tuple((move.start_s, move.end_s) for move in robot_run.moves)
    end_s = robot_run.trajectory.duration
    if busy:
        busy = (*busy, (busy[-1][1], max(end_s, busy[-1][1])))
    busy += tuple((stretch.start_s, stretch.end_s) for stretch in robot_run.trajectory.guided)
    brief = [0.5 * (begin + end) for begin, end in busy if SHORTEST_S < end - begin < STEP_S]
    return Arm(
        robot_run.robot,
        robot_run.world_from_base,
        robot_run.trajectory.postures,
        _merge_intervals(busy),
        np.array(brief),
    )


def _merge_intervals(intervals: Iterable[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
    """Merge intervals [s] that overlap or are at most `_STOPPING_S` apart."""
    found: list[tuple[float, float]] = []
    for begin, end in sorted(intervals):
        if found and begin <= found[-1][1] + _STOPPING_S:
            found[-1] = (found[-1][0], max(found[-1][1], end))
        else:
            found.append((begin, end))
    return tuple(found)


def _value(values: Mapping[str, float], signal: str) -> float:
    return values[signal.lower()]


def _truths(condition: Condition, signals: Mapping[str, Changes]) -> list[tuple[float, bool]]:
    """Return the times [s] at which a condition becomes true or false, with its new value."""
    histories: dict[str, Sequence[tuple[float, float]]] = {
        name.lower(): signals.get(name.lower(), [(0.0, 0.0)]) for name in condition.signals()
    }
    found: list[tuple[float, bool]] = []
    holds = False
    for time_s in sorted({t for history in histories.values() for t, _ in history}):
        now = {
            name: next(value for t, value in reversed(history) if t <= time_s)
            for name, history in histories.items()
        }
        held = condition.holds(partial(_value, now))
        if held is not holds:
            found.append((time_s, held))
            holds = held
    return found
