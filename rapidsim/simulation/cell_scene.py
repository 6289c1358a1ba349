"""Build the moving bodies of a run in its cell, and the pairs of them to check for collisions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import combinations, pairwise

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.contact import BodyName
from rapidsim.collisions.geometry import (
    Attachment,
    CellGeometry,
    CellObject,
    IgnoredPair,
    ParentKind,
)
from rapidsim.collisions.link_shapes import link_shapes
from rapidsim.collisions.scene import (
    SHORTEST_S,
    STEP_S,
    WORLD,
    Arm,
    AttachedBody,
    Body,
    Pair,
    Scene,
    SceneFrame,
    arm_frames,
)
from rapidsim.collisions.self_pairs import judged_pairs
from rapidsim.collisions.shape import sphere
from rapidsim.collisions.support import RESTS_M
from rapidsim.controller.cell.conditions import Condition, read_condition
from rapidsim.frames.transform import Transform
from rapidsim.language.data import WobjData
from rapidsim.motion.configurations.targets import transform
from rapidsim.simulation.part_courses import (
    MovingCell,
    PartCourses,
    PartHolder,
    Reach,
    part_courses,
)
from rapidsim.simulation.results.parts import PartEvent
from rapidsim.simulation.results.signal_history import Changes, signal_changes
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

_POINT = sphere(1e-6)
"""The TCP as a body."""
_STOPPING_S = 0.5
"""Longest time [s] for which an arm moves after its last command."""


@value_class(frozen=True, slots=True, eq=False)
class CellScene:
    """Bodies of a run that are checked for collisions, with remarks on those that are not."""

    scene: Scene
    remarks: tuple[str, ...]
    """Reasons why bodies or pairs are not checked."""
    objects: Mapping[int, CellObject]
    """Objects of the station by their number among the bodies."""
    bodies: Bodies
    """Bodies of the scene, laid out for distance computations."""
    parts: tuple[int, ...]
    """Numbers of the bodies that grippers take."""
    events: tuple[PartEvent, ...]
    """Changes of their carriers."""


def cell_scene(simulation: Simulation, geometry: CellGeometry) -> CellScene:
    """Return the bodies of a run and the pairs of them that must not touch."""
    return _Builder(simulation, geometry).built()


class _Builder:
    def __init__(self, simulation: Simulation, geometry: CellGeometry) -> None:
        self._simulation, self._geometry = simulation, geometry
        self._runs = simulation.robots
        self._arms = tuple(map(_arm, self._runs))
        self._bodies: list[Body] = []
        self._objects: dict[int, CellObject] = {}
        self._remarks: list[str] = []
        self._holders: dict[int, set[int]] = {}
        """Robots whose grippers may hold a body."""
        self._grips: set[frozenset[int]] = set()
        """Bodies of tools, with the parts that they may hold."""
        self._tools: set[int] = set()
        self._used: set[IgnoredPair] = set()
        self._signals = {
            name.lower(): changes
            for name, changes in signal_changes(simulation, still=True).items()
        }

    def built(self) -> CellScene:
        """Return the scene of the run."""
        of_links: dict[tuple[int, int], int] = {}
        for number, one in enumerate(self._runs):
            shapes = link_shapes(one.robot)
            self._remarks += shapes.remarks
            for link in shapes.links:
                of_links[number, link.number] = len(self._bodies)
                name = "the base" if link.number == 0 else f"link {link.number}"
                fixed = AttachedBody(0.0, SceneFrame(number, link.number), Transform.identity())
                self._bodies.append(Body(self._named(name, number), link.shape, (fixed,)))
        for placed in self._geometry.objects:
            self._add_object(placed)
        bodies = Bodies([*(body.shape.parts for body in self._bodies), _POINT.parts])
        courses = self._courses(bodies)
        for number, carried in courses.carried.items():
            self._bodies[number] = replace(self._bodies[number], carried=carried)
        pairs = tuple(self._pairs(of_links))
        for ignored in self._geometry.ignored:
            if ignored not in self._used:
                self._remarks.append(
                    f"the station ignores `{ignored.first}` and `{ignored.second}`: no such pair"
                )
        scene = Scene(self._arms, tuple(self._bodies), pairs)
        return CellScene(
            self._lying(scene, bodies),
            tuple(dict.fromkeys(self._remarks)),
            self._objects,
            bodies,
            tuple(sorted(self._holders)),
            courses.events,
        )

    def _lying(self, scene: Scene, bodies: Bodies) -> Scene:
        """Return the scene with pairs touch-only if one body lies on the other or is put there.

        A part leaves the body it lies on, and approaches the one it is put on: near on purpose.
        """
        pairs = list(scene.pairs)
        for number, pair in enumerate(pairs):
            carried = [one for one in (pair.first, pair.second) if one in self._holders]
            if pair.touch_only or not carried:
                continue
            times = sorted({one.from_s for body in carried for one in self._bodies[body].carried})
            poses = scene.poses(np.array(times))
            seen = poses.seen(pair.first, pair.second)
            here = np.zeros(len(times), dtype=np.int64)
            enough = np.full(len(times), RESTS_M)
            gaps = bodies.gaps(here + pair.first, here + pair.second, seen, enough)
            if gaps.distances_found.min() < RESTS_M:
                pairs[number] = replace(pair, touch_only=True)
        return replace(scene, pairs=tuple(pairs))

    def _named(self, name: str, robot: int) -> BodyName:
        whose = f" of {self._runs[robot].task}" if len(self._runs) > 1 else ""
        return BodyName(f"{name}{whose}", robot)

    def _robot(self, task: str | None, owner: str) -> int | None:
        """Number of the robot of a task; None, with a remark, if the task has no robot."""
        if task is None:
            return 0
        for number, one in enumerate(self._runs):
            if one.task.lower() == task.lower():
                return number
        self._remarks.append(f"`{owner}`: no robot of a task `{task}` is in the run")
        return None

    def _add_object(self, item: CellObject) -> None:
        number = len(self._bodies)
        placed = self._placed(item)
        if not placed:
            return
        first = placed[0].frame
        label = BodyName(f"`{item.name}`", None if first.axes else first.robot)
        self._objects[number] = item
        self._bodies.append(Body(label, item.shape, placed))

    def _placed(self, item: CellObject) -> tuple[AttachedBody, ...]:
        """Return the frames of an object while no robot carries it; empty if they are unknown."""
        parent, pose = item.parent, item.parent_from_object
        if parent.kind is ParentKind.WORLD:
            return (AttachedBody(0.0, WORLD, pose),)
        robot = self._robot(parent.robot, item.name)
        if robot is None:
            return ()
        joints = len(self._runs[robot].robot.joints)
        if parent.kind is ParentKind.TOOL:
            return (AttachedBody(0.0, SceneFrame(robot, joints + 1), pose),)
        if parent.kind is ParentKind.LINK:
            if parent.link <= joints:
                return (AttachedBody(0.0, SceneFrame(robot, parent.link), pose),)
            self._remarks.append(
                f"`{item.name}`: {self._runs[robot].robot.name} has no link {parent.link}"
            )
            return ()
        if parent.kind is ParentKind.UNIT:
            unit = self._unit(parent.name, parent.link)
            if unit is None:
                which = f"axis {parent.link} of " if parent.link else ""
                self._remarks.append(
                    f"`{item.name}`: no positioner of the run has {which}`{parent.name}`"
                )
            return () if unit is None else (AttachedBody(0.0, unit, pose),)
        return self._in_work_object(item, robot, joints)

    def _unit(self, name: str, count: int = 0) -> SceneFrame | None:
        """Frame moved by the first `count` axes of a positioner (0: all); None if there is none."""
        for robot, run in enumerate(self._runs):
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
        runs = (
            (self._runs[robot], *self._runs) if item.parent.robot is None else (self._runs[robot],)
        )
        for run in runs:
            for move in run.moves:
                wobj = move.move.wobj
                name = move.place.arguments.get("wobj", "wobj0")
                if name.strip().lower() != item.parent.name.lower() or wobj == last:
                    continue
                unit = None if wobj.ufprog else self._unit(wobj.ufmec)
                if unit is None and not wobj.ufprog:
                    self._remarks.append(f"`{item.name}`: `{wobj.ufmec}` moves its work object")
                    return ()
                frame = unit or (SceneFrame(robot, joints + 1) if wobj.robhold else WORLD)
                user = Transform.identity() if unit else transform(wobj.uframe)
                pose = user @ transform(wobj.oframe) @ item.parent_from_object
                placed.append(AttachedBody(move.start_s if placed else 0.0, frame, pose))
                last = wobj
            if placed:
                return tuple(placed)
        self._remarks.append(
            f"`{item.name}`: no move of the run uses the work object {item.parent.name}"
        )
        return ()

    def _courses(self, bodies: Bodies) -> PartCourses:
        """Return what carries each part of the run."""
        grippers = [*self._grippers()]
        changes = {time_s for gripper in grippers for time_s, _ in gripper.changes}
        if not changes:
            return PartCourses({}, ())
        times = sorted({*changes, self._simulation.motion_end_s})
        used = {one.frame for body in self._bodies for one in body.carried}
        used |= {gripper.frame for gripper in grippers}
        still = Transform(np.tile(np.eye(3), (len(times), 1, 1)), np.zeros((len(times), 3)))
        frames, tcps = {WORLD: still}, []
        for number, (arm, run) in enumerate(zip(self._arms, self._runs, strict=True)):
            frames.update(arm_frames(number, arm, arm.at(np.array(times)), used))
            base_from_tcp = run.sample(np.array(times)).base_from_tcp
            tcps.append(frames[SceneFrame(number, 0)] @ base_from_tcp)
        for number in self._holders:
            if len(self._bodies[number].carried) > 1:
                name = self._bodies[number].label.name
                self._remarks.append(f"{name}: its work object changes while robots carry it")
        return part_courses(MovingCell(self._bodies, bodies, frames, tcps), grippers, times)

    def _grippers(self) -> Iterator[PartHolder]:
        """Yield holders of parts; tables with one condition and one holder are one gripper."""
        alike: dict[tuple[str, str, int, SceneFrame, int | None], list[Attachment]] = {}
        for table in self._geometry.attachments:
            for holder in self._holder(table):
                alike.setdefault((table.when.lower(), *holder), []).append(table)
        numbers = {item.name.lower(): number for number, item in self._objects.items()}
        for (_, name, robot, frame, body), tables in alike.items():
            condition = read_condition(tables[0].when)
            reaches = [
                Reach(
                    tuple(numbers[one.lower()] for one in table.objects if one.lower() in numbers),
                    table.reach_m,
                )
                for table in tables
            ]
            for part in {part for reach in reaches for part in reach.parts}:
                holders = self._holders.setdefault(part, set())
                holders |= set() if frame.axes else {robot}
                if body is not None:
                    self._grips.add(frozenset({part, body}))
                    self._tools.add(body)
                for signal in condition.signals():
                    if signal.lower() not in self._signals:
                        label = self._bodies[part].label.name
                        self._remarks.append(
                            f"{label}: nothing sets or declares the signal {signal}"
                        )
            changes = tuple(_truths(condition, self._signals))
            yield PartHolder(name, robot, frame, body, tuple(reaches), condition.signals(), changes)

    def _holder(self, table: Attachment) -> Iterator[tuple[str, int, SceneFrame, int | None]]:
        """Yield name, robot, frame and body of what holds objects, if the run has it."""
        to, owner = table.to, ", ".join(table.objects)
        if to.kind is ParentKind.UNIT:
            unit = self._unit(to.name, to.link)
            if unit is not None and unit.robot is not None:
                yield f"`{to.name}`", unit.robot, unit, None
            else:
                self._remarks.append(f"`{owner}`: no positioner of the run has `{to.name}`")
            return
        body = next(
            (at for at, item in self._objects.items() if item.name.lower() == to.name.lower()), None
        )
        task = to.robot
        if task is None and body is not None:
            task = self._objects[body].parent.robot
        robot = self._robot(task, owner)
        if robot is None:
            return
        flange = SceneFrame(robot, len(self._runs[robot].robot.joints) + 1)
        if not to.name:
            yield self._named("the gripper", robot).name, robot, flange, None
        elif body is None:
            self._remarks.append(f"`{owner}`: `{to.name}`, which holds it, has no position")
        else:
            yield f"`{to.name}`", robot, flange, body

    def _pairs(self, of_links: Mapping[tuple[int, int], int]) -> Iterator[Pair]:
        """Yield each pair to check once."""
        links = {body: key for key, body in of_links.items()}
        own: set[tuple[int, int]] = set()
        if self._geometry.own_links:
            for number, one in enumerate(self._runs):
                for a, b in judged_pairs(one.robot, link_shapes(one.robot)):
                    own.add((of_links[number, a], of_links[number, b]))
        for a, b in combinations(range(len(self._bodies)), 2):
            if a in links and b in links and links[a][0] == links[b][0]:
                if (a, b) in own and not self._is_ignored(a, b):
                    yield Pair(a, b, links[a][0], touch_only=True)
                continue
            if not self._is_ignored(a, b):
                yield from self._pairs_of(a, b)

    def _pairs_of(self, a: int, b: int) -> Iterator[Pair]:
        """Yield the pairs of an object and a body, or of bodies of two robots, with their times."""
        fixed_a, fixed_b = self._fixed_to(a), self._fixed_to(b)
        if fixed_a is not None and fixed_b is not None and fixed_a[0] == fixed_b[0]:
            # Tool and last link touch, as all things that are bolted to each other do.
            if self._geometry.own_links and abs(fixed_a[1] - fixed_b[1]) > 2:
                yield Pair(a, b, fixed_a[0], touch_only=True)
            return
        if frozenset({a, b}) in self._grips:
            return
        for part, fixed in ((a, fixed_b), (b, fixed_a)):
            if fixed is not None and fixed[0] in self._holders.get(part, ()):
                # Fingers close on the part that they carry, and a tool is bolted to the wrist.
                near = 1 if part in self._tools else 0
                if fixed[1] >= len(self._runs[fixed[0]].robot.joints) - near:
                    return
        found: list[Pair] = []
        for from_s, until_s, frame_a, frame_b in self._intervals(a, b):
            if frame_a == frame_b or (self._is_still(frame_a) and self._is_still(frame_b)):
                # Bodies on one frame, or on two that never move, do not approach each other.
                continue
            (first, moves), (second, _) = (a, frame_a), (b, frame_b)
            if self._is_still(frame_a):
                (first, moves), (second, _) = (b, frame_b), (a, frame_a)
            assert moves.robot is not None
            last = found[-1] if found else None
            if last and (last.first, last.owner, last.until_s) == (first, moves.robot, from_s):
                found[-1] = replace(last, until_s=until_s)
            else:
                found.append(Pair(first, second, moves.robot, False, from_s, until_s))
        yield from found

    def _intervals(self, a: int, b: int) -> Iterator[tuple[float, float, SceneFrame, SceneFrame]]:
        """Yield the intervals [s] in which two bodies have the same carriers, with their frames."""
        first, second = self._bodies[a].carried, self._bodies[b].carried
        later = {one.from_s for one in (*first[1:], *second[1:])}
        edges = [-np.inf, *sorted(later), np.inf]
        for from_s, until_s in pairwise(edges):
            frames = (
                next((x.frame for x in reversed(carried) if x.from_s <= from_s), carried[0].frame)
                for carried in (first, second)
            )
            frame_a, frame_b = frames
            yield from_s, until_s, frame_a, frame_b

    def _is_still(self, frame: SceneFrame) -> bool:
        """Whether a frame never moves: it is the world, or a base without a track."""
        return frame.robot is None or (
            not frame.axes and frame.link == 0 and not self._runs[frame.robot].robot.external
        )

    def _frames(self, body: int) -> set[SceneFrame]:
        """Frames that carry a body at any time."""
        return {one.frame for one in self._bodies[body].carried}

    def _fixed_to(self, body: int) -> tuple[int, int] | None:
        """Robot and link that a body always belongs to; None if robots carry it at times."""
        frames = self._frames(body)
        (frame, *others) = frames
        if others or frame.robot is None or frame.axes or body in self._holders:
            return None
        return frame.robot, frame.link

    def _is_ignored(self, a: int, b: int) -> bool:
        names_a, names_b = self._names(a), self._names(b)
        found = False
        for one in self._geometry.ignored:
            first, second = one.first.lower(), one.second.lower()
            if (first in names_a and second in names_b) or (first in names_b and second in names_a):
                self._used.add(one)
                found = True
        return found

    def _names(self, body: int) -> set[str]:
        """Names by which a station may refer to a body."""
        one = self._bodies[body]
        if body in self._objects:
            names = {self._objects[body].name.lower()}
            if self._objects[body].parent.kind is ParentKind.TOOL:
                names.add("tool")
            return names
        robot = one.label.robot
        task = "" if robot is None else self._runs[robot].task.lower()
        name = one.label.name.split(" of ")[0].removeprefix("the ").lower()
        return {"robot", name, task, f"{name} of {task}"}


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
