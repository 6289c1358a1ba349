"""Collisions of moves that no run of main made, but whose start and end are known.

Each is executed separately, among the bodies as the run of main left them. Parts of a move that a
corner path would cut off are not checked, nor are bodies that are carried at times.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.collisions.along_motion import search
from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.contact import Contact
from rapidsim.collisions.scene import SHORTEST_S, Arm, Scene
from rapidsim.controller.moves.configuration_choice import conf_text
from rapidsim.controller.moves.move_data import zone_of
from rapidsim.diagnostics import Diagnostic, Related
from rapidsim.findings.collisions import CollisionNotRun
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import configurations
from rapidsim.motion.geometry.segments import Geometry, Segment, Waypoint
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import JointSamples
from rapidsim.reach.arm_configurations import EndConfigurations
from rapidsim.reach.move_segments import segments_of
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.reach.wording import target_span, target_text
from rapidsim.repeated_rows import Index

MOST_MOVES = 200
"""Largest number of moves that are checked."""
_MOST_CURES = 5
"""Largest number of moves for which a suggestion is searched."""
_HEIGHTS_MM = (20.0, 50.0, 100.0, 200.0)
_MOST_CONFIGURATIONS = 6
_LOOK_RAD_S, _LOOK_M_S = 1.0, 1.0
"""Speed of a move for the check: a step of the search is then a degree, or a few mm."""


@dataclass(eq=False)
class UnrunMoves:
    """Collision search of moves that were not run."""

    program: Program
    posed: PosedMoves
    stances: EndConfigurations
    robot: Robot
    model: MotionModel
    scene: Scene
    """Bodies whose poses depend on the moves only; motion of the arm in the scene has no effect."""
    base_from_world: Transform
    _bodies: Bodies = field(init=False)
    _suggestion_count: int = field(init=False, default=0)

    def __post_init__(self) -> None:
        """Lay out the bodies once, and limit the search to contacts."""
        pairs = tuple(replace(pair, touch_only=True) for pair in self.scene.pairs)
        self.scene = replace(self.scene, pairs=pairs)
        self._bodies = self.scene.shapes()

    def findings(self, rows: Index) -> Iterator[Diagnostic]:
        """Yield the collisions of the moves of rows, whose starts must be known."""
        joints = self.stances.joints
        segments = segments_of(self.posed, joints, self.robot, self.model, rows)
        for row, segment in zip(rows.tolist(), segments, strict=True):
            path = self._path(segment)
            if path is None:
                continue
            hit = self._first_contact(path, *self._between_corners(row, path.length))
            if hit is not None:
                yield self._finding(row, segment, *hit)

    def _path(self, segment: Segment) -> Path | None:
        path = build_path(self.robot, [replace(segment, zone=None)], self.model)
        return None if isinstance(path, PathFault) else path

    def _between_corners(self, row: int, length: float) -> tuple[float, float]:
        """Return the section [m] of a move's path that remains whatever its corner paths are."""
        moves = self.posed.moves
        previous = moves[row].previous
        assert previous is not None
        cut = [
            0.0 if (zone := zone_of(moves[at].move)) is None else min(zone.position, 0.5 * length)
            for at in (previous, row)
        ]
        return cut[0], length - cut[1]

    def _first_contact(self, path: Path, begin: float, end: float) -> tuple[Contact, float] | None:
        """Return the first contact between two positions [m] of a path, and its position [m]."""
        if end <= begin:
            return None
        places = np.linspace(begin, end, 20)
        turned = float(np.abs(np.diff(path.evaluate(places).joints, axis=0)).max(axis=1).sum())
        lasts = max(turned / _LOOK_RAD_S, (end - begin) / _LOOK_M_S, 0.1)

        def at(times: Array) -> JointSamples:
            points = path.evaluate(begin + (end - begin) * np.clip(times / lasts, 0.0, 1.0))
            return JointSamples(
                np.zeros(len(times), dtype=np.int64), points.joints, points.external
            )

        world_from_base = self.base_from_world.inverse()
        arm = Arm(self.robot, world_from_base, at, ((0.0, lasts),))
        found = search(replace(self.scene, arms=(arm,)), lasts, self._bodies)
        # A contact at the end of the previous move belongs to that move.
        later = [one for one in found.contacts if begin or one.time_s > SHORTEST_S]
        if not later:
            return None
        return later[0], begin + (end - begin) * later[0].time_s / lasts

    def _finding(self, row: int, segment: Segment, hit: Contact, place: float) -> Diagnostic:
        known = self.posed.moves[row]
        assert known.previous is not None
        path = self._path(segment)
        whole = 1.0 if path is None else path.length
        deep = "" if hit.depth_m is None else f", {1e3 * hit.depth_m:.1f} mm deep"
        violation = CollisionNotRun(
            hit.first.name,
            hit.second.name,
            100.0 * place / whole,
            deep,
            self._suggestion(row, segment),
        )
        start = target_span(self.program, self.posed.moves[known.previous])
        related = (Related(start, "the path starts here"),)
        span = target_span(self.program, known)
        return Diagnostic(violation, span, related, routine=known.routine)

    def _suggestion(self, row: int, segment: Segment) -> str:
        """Describe a change that keeps the arm free; empty if no nearby one was found."""
        self._suggestion_count += 1
        if self._suggestion_count > _MOST_CURES or segment.geometry is Geometry.ARC:
            return ""
        name = target_text(self.program, self.posed.moves[row])
        for height in _HEIGHTS_MM:
            for start in (False, True):
                tried = self._raised(row, segment, height / 1e3, start=start)
                if tried is not None and self._is_free(row, tried):
                    which = f"`{name}` and the start" if start else f"`{name}`"
                    return f"the way is free with {which} {height:g} mm higher"
        if segment.geometry is Geometry.JOINT and not self.posed.to_axes[row]:
            near = segment.start.joints
            ways = configurations(self.robot, self.posed.base_from_flange[row])
            others = sorted(ways, key=lambda way: float(np.abs(way.joints - near).max()))
            for way in others[:_MOST_CONFIGURATIONS]:
                end = replace(segment.end, joints=way.joints)
                if self._is_free(row, replace(segment, end=end)):
                    conf = conf_text(way.confdata)
                    return f"the way is free to `{name}` in the configuration {conf}"
        return ""

    def _is_free(self, row: int, segment: Segment) -> bool:
        path = self._path(segment)
        if path is None:
            return False
        return self._first_contact(path, *self._between_corners(row, path.length)) is None

    def _raised(self, row: int, segment: Segment, height: float, *, start: bool) -> Segment | None:
        """Return a move to a higher position, or also from one; None if it is unreachable."""
        end = self._higher(row, segment.end, height)
        begin = self._higher(row, segment.start, height) if start else segment.start
        if end is None or begin is None:
            return None
        return replace(segment, start=begin, end=end)

    def _higher(self, row: int, waypoint: Waypoint, height: float) -> Waypoint | None:
        up = self.base_from_world.rotation @ np.array([0.0, 0.0, height])
        pose = waypoint.base_from_tcp
        raised = Transform(pose.rotation, pose.translation + up)
        ways = configurations(self.robot, raised @ self.posed.placed(row).tcp_from_flange)
        if not ways:
            return None
        joints = min((way.joints for way in ways), key=lambda q: np.abs(q - waypoint.joints).max())
        return replace(waypoint, joints=joints, base_from_tcp=raised)
