"""Pairs of bodies of a run that must not touch, with the robots that move them and when."""

from __future__ import annotations

from collections.abc import Iterator, Set
from dataclasses import replace
from itertools import combinations, pairwise

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.geometry import CellGeometry, IgnoredPair, ParentKind
from rapidsim.collisions.link_shapes import link_shapes
from rapidsim.collisions.scene import WORLD, Pair, Scene, SceneFrame
from rapidsim.collisions.self_pairs import judged_pairs
from rapidsim.collisions.support import RESTS_M
from rapidsim.simulation.cell_bodies import CellBodies
from rapidsim.simulation.part_supply import PartHolder


class ScenePairs:
    """Selection of the pairs."""

    def __init__(
        self, cell: CellBodies, geometry: CellGeometry, holders: tuple[PartHolder, ...]
    ) -> None:
        """Note who may hold which part."""
        self._cell, self._geometry = cell, geometry
        self._used: set[IgnoredPair] = set()
        self._holders: dict[int, set[int]] = {}
        """Robots whose grippers may hold a body."""
        self._grips: set[frozenset[int]] = set()
        """Bodies of tools, with the parts that they may hold."""
        self._tools: set[int] = set()
        for holder in holders:
            for part in holder.parts:
                robots = self._holders.setdefault(part, set())
                robots |= {holder.robot} if holder.is_of_arm else set()
                if holder.body is not None:
                    self._grips.add(frozenset({part, holder.body}))
                    self._tools.add(holder.body)

    def unused(self) -> Iterator[IgnoredPair]:
        """Yield the pairs that the station ignores and the cell does not have."""
        return (one for one in self._geometry.ignored if one not in self._used)

    def pairs(self) -> Iterator[Pair]:
        """Yield each pair to check once, or once for each robot that moves it."""
        links = self._cell.links
        of_links = {key: body for body, key in links.items()}
        still = [all(map(self._is_still, self._frames(a))) for a in range(len(self._cell.bodies))]
        own: set[tuple[int, int]] = set()
        if self._geometry.own_links:
            for number, one in enumerate(self._cell.runs):
                for a, b in judged_pairs(one.robot, link_shapes(one.robot)):
                    own.add((of_links[number, a], of_links[number, b]))
        for a, b in combinations(range(len(self._cell.bodies)), 2):
            if a in links and b in links and links[a][0] == links[b][0]:
                if (a, b) in own and not self._is_ignored(a, b):
                    yield Pair(a, b, links[a][0], touch_only=True)
                continue
            # Bodies at rest never meet.
            if not self._is_ignored(a, b) and not (still[a] and still[b]):
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
        if self._may_grip(a, fixed_b) or self._may_grip(b, fixed_a):
            return
        found: list[Pair] = []
        for from_s, until_s, frame_a, frame_b in self._intervals(a, b):
            if frame_a == frame_b or (self._is_still(frame_a) and self._is_still(frame_b)):
                # Bodies on one frame, or on two that never move, do not approach each other.
                continue
            ways = [(a, b, frame_a), (b, a, frame_b)]
            movers = [one for one in ways if not self._is_still(one[2])]
            robots = [one[2].robot for one in movers if one[2].robot is not None]
            if not robots:
                # What a belt carries past bodies at rest is on no line of a program.
                continue
            first, second, _ = movers[0]
            last = found[-1] if found else None
            if last and (last.first, last.owner, last.until_s) == (first, robots[0], from_s):
                found[-1] = replace(last, until_s=until_s)
            else:
                found.append(Pair(first, second, robots[0], False, from_s, until_s))
        yield from found

    def _may_grip(self, part: int, fixed: tuple[int, int] | None) -> bool:
        """Whether a body that belongs to a link of a robot touches a part that the robot holds.

        Fingers close on the part that they carry, and a tool is bolted to the wrist.
        """
        if fixed is None or fixed[0] not in self._holders.get(part, ()):
            return False
        near = 1 if part in self._tools else 0
        return fixed[1] >= len(self._cell.runs[fixed[0]].robot.joints) - near

    def _intervals(self, a: int, b: int) -> Iterator[tuple[float, float, SceneFrame, SceneFrame]]:
        """Yield the intervals [s] in which two bodies have the same carriers, with their frames."""
        bodies = self._cell.bodies[a], self._cell.bodies[b]
        first, second = (one.carried for one in bodies)
        begin, end = max(one.from_s for one in bodies), min(one.until_s for one in bodies)
        later = {one.from_s for one in (*first[1:], *second[1:]) if begin < one.from_s < end}
        edges = [begin, *sorted(later), end] if begin < end else []
        for from_s, until_s in pairwise(edges):
            frames = (
                next((x.frame for x in reversed(carried) if x.from_s <= from_s), carried[0].frame)
                for carried in (first, second)
            )
            frame_a, frame_b = frames
            yield from_s, until_s, frame_a, frame_b

    def _is_still(self, frame: SceneFrame) -> bool:
        """Whether a frame never moves: it is the world, or a base without a track."""
        if frame.robot is None:
            return frame == WORLD
        return (
            not frame.axes and frame.link == 0 and not self._cell.runs[frame.robot].robot.external
        )

    def _frames(self, body: int) -> set[SceneFrame]:
        """Frames that carry a body at any time."""
        return {one.frame for one in self._cell.bodies[body].carried}

    def _fixed_to(self, body: int) -> tuple[int, int] | None:
        """Robot and link that a body always belongs to; None if robots carry it at times."""
        frames = self._frames(body)
        (frame, *others) = frames
        if others or frame.robot is None or frame.axes or body in self._holders:
            return None
        return frame.robot, frame.link

    def _is_ignored(self, a: int, b: int) -> bool:
        if not self._geometry.ignored:
            return False
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
        one = self._cell.bodies[body]
        if body in self._cell.objects:
            names = {self._cell.objects[body].name.lower()}
            if body in self._cell.arrivals:
                names |= {name.rpartition(" ")[0] for name in names}
            if self._cell.objects[body].parent.kind is ParentKind.TOOL:
                names.add("tool")
            return names
        robot = one.label.robot
        task = "" if robot is None else self._cell.runs[robot].task.lower()
        name = one.label.name.split(" of ")[0].removeprefix("the ").lower()
        return {"robot", name, task, f"{name} of {task}"}


def lying(scene: Scene, bodies: Bodies, parts: Set[int]) -> Scene:
    """Return the scene with pairs touch-only if one body lies on the other or is put there.

    A part leaves the body it lies on, and approaches the one it is put on: near on purpose.
    """
    pairs = list(scene.pairs)
    if not parts:
        return scene
    changes = sorted({one.from_s for body in parts for one in scene.bodies[body].carried})
    poses = scene.poses(np.array(changes))
    rows = {time_s: row for row, time_s in enumerate(changes)}
    for number, pair in enumerate(pairs):
        both = (pair.first, pair.second)
        times = {one.from_s for at in both if at in parts for one in scene.bodies[at].carried}
        times = {one for one in times if all(scene.bodies[at].exists(one) for at in both)}
        if pair.touch_only or not times:
            continue
        at = [rows[time_s] for time_s in sorted(times)]
        seen = poses.seen(pair.first, pair.second, np.array(at))
        here = np.zeros(len(times), dtype=np.int64)
        enough = np.full(len(times), RESTS_M)
        gaps = bodies.gaps(here + pair.first, here + pair.second, seen, enough)
        if gaps.distances_found.min() < RESTS_M:
            pairs[number] = replace(pair, touch_only=True)
    return replace(scene, pairs=tuple(pairs))
