"""Places of the parts of a cell at the instants of a run, and the bodies near and below them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from rapidsim.collisions.body_distance import Bodies
from rapidsim.collisions.overlap import TOUCH_M
from rapidsim.collisions.scene import AttachedBody, SceneFrame
from rapidsim.collisions.support import RESTS_M, Support, support
from rapidsim.frames.transform import Array, Transform
from rapidsim.simulation.cell_bodies import CellBodies
from rapidsim.simulation.cell_frames import CellFrames
from rapidsim.simulation.part_supply import PartHolder
from rapidsim.values import value_class

FARTHEST_M = 10.0
"""Distance [m] up to which parts are near a holder."""
_UP = np.array([0.0, 0.0, 1.0])


@value_class(slots=True, eq=False)
class PartState:
    """State of a part."""

    carried: list[AttachedBody]
    from_s: float = -np.inf
    until_s: float = np.inf
    holder: PartHolder | None = None
    """Gripper or clamp that holds it."""
    since_s: float = 0.0
    """Time [s] at which that closed."""
    below: int | None = None
    """Body that it rests on, or that holds it."""
    loose: tuple[int, float] | None = None
    """Event and time [s] at which it was put on a gripper that has not closed on it."""


class PartPlaces:
    """Parts in their present state, among all bodies of the cell."""

    def __init__(self, cell: CellBodies, distances: Bodies, holders: Sequence[PartHolder]) -> None:
        """Begin with all parts at their first places."""
        self.cell, self._distances, self._holders = cell, distances, holders
        numbers = {part for holder in holders for part in holder.parts} | cell.arrivals.keys()
        self.parts = {
            number: PartState([cell.bodies[number].carried[0]]) for number in sorted(numbers)
        }
        """By the index of the body."""
        used = {one.frame for body in cell.bodies for one in body.carried}
        used |= {holder.frame for holder in holders}
        self.frames = CellFrames(cell.arms, cell.runs, cell.belts, used)

    def present(self, time_s: float) -> list[int]:
        """Indices of the parts that exist."""
        return [
            number for number, part in self.parts.items() if part.from_s <= time_s < part.until_s
        ]

    def resting_on(self, body: int) -> list[int]:
        """Indices of the parts that lie on a body and that no gripper holds."""
        return [
            number
            for number, part in self.parts.items()
            if part.below == body and part.holder is None
        ]

    def riders(self, number: int) -> list[int]:
        """Indices of the parts that a part carries, directly or on others."""
        found: list[int] = []
        waiting = [number]
        while waiting:
            body = waiting.pop()
            direct = [other for other, part in self.parts.items() if part.below == body]
            new = [other for other in direct if other not in found and other != number]
            found += new
            waiting += new
        return found

    def frame_on(self, body: int, time_s: float) -> SceneFrame:
        """Frame of what rests on a body."""
        belt = self.cell.belt_of(body)
        return self.carrier(body, time_s).frame if belt is None else SceneFrame(belt=belt)

    def carrier(self, body: int, time_s: float) -> AttachedBody:
        """Return the carrier of a body at an instant."""
        if body in self.parts:
            return self.parts[body].carried[-1]
        first, *later = self.cell.bodies[body].carried
        begun = [one for one in later if one.from_s <= time_s]
        return begun[-1] if begun else first

    def pose(self, body: int, time_s: float) -> Transform:
        """Return world from a body at an instant."""
        carrier = self.carrier(body, time_s)
        return self.frames.at(time_s)[carrier.frame] @ carrier.frame_from_body

    def distances_from(self, holder: PartHolder, parts: Sequence[int], time_s: float) -> Array:
        """Return the distances (k,) [m] of parts from a holder; inf beyond the farthest."""
        bodies = [] if holder.body is None else [holder.body]
        if holder.body is None:
            bodies = [
                body
                for body in self.bodies(time_s)
                if body not in holder.parts and self.carrier(body, time_s).frame == holder.frame
            ]
        poses = [self.pose(body, time_s) for body in bodies]
        if holder.body is None and holder.is_of_arm:
            bodies.append(len(self.cell.bodies))
            poses.append(self.frames.tcp(holder.robot, time_s))
        if not bodies or not parts:
            return np.zeros(len(parts))
        first, second = np.repeat(parts, len(bodies)), np.tile(bodies, len(parts))
        seen = [pose.inverse() @ self.pose(part, time_s) for part in parts for pose in poses]
        enough = np.full(len(first), FARTHEST_M)
        gaps = self._distances.gaps(first, second, Transform.stacked(seen), enough)
        found = np.maximum(gaps.distances_found, 0.0).reshape(len(parts), len(bodies))
        nearest: Array = found.min(axis=1)
        return nearest

    def bodies(self, time_s: float, holder: PartHolder | None = None) -> list[int]:
        """Indices of the bodies that exist, without those of the arm that releases a part."""
        present = self.present(time_s)
        return [
            body
            for body in range(len(self.cell.bodies))
            if (body in present or body not in self.parts)
            and not (
                holder is not None
                and holder.is_of_arm
                and _is_of_arm(self.carrier(body, time_s).frame, holder.robot)
            )
        ]

    def support(
        self, number: int, time_s: float, bodies: Iterable[int], deepest_m: float = RESTS_M
    ) -> Support | None:
        """Return the body below a part."""
        above = {number, *self.riders(number)}
        below = np.array([body for body in bodies if body not in above], dtype=np.int64)
        if not len(below):
            return None
        poses = Transform.stacked([self.pose(body, time_s) for body in below.tolist()])
        here = self.pose(number, time_s)
        return support(self._distances, number, below, here, poses, deepest_m)

    def occupant(self, number: int, time_s: float) -> str:
        """Name of the part that is where another one is put, also when lifted a little; or ""."""
        others = [
            other
            for other in self.present(time_s)
            if other != number and self.parts[other].holder is None
        ]
        if not others:
            return ""
        here = self.pose(number, time_s)
        overlaps = np.ones(len(others), dtype=np.bool_)
        for up_m in (0.0, RESTS_M):
            lifted = Transform(here.rotation, here.translation + up_m * _UP)
            seen = [self.pose(other, time_s).inverse() @ lifted for other in others]
            first, second = np.full(len(others), number), np.array(others)
            enough = np.zeros(len(others))
            gaps = self._distances.gaps(first, second, Transform.stacked(seen), enough)
            overlaps &= gaps.distances_found < -TOUCH_M
        return self.name(others[int(overlaps.argmax())]) if overlaps.any() else ""

    def could_hold(self, frame: SceneFrame, number: int) -> bool:
        """Whether a frame is that of an arm with a gripper for a part."""
        return any(
            holder.is_of_arm and _is_of_arm(frame, holder.robot) and number in holder.parts
            for holder in self._holders
        )

    def name(self, body: int) -> str:
        """Name of a body in messages."""
        return self.cell.bodies[body].label.name


def _is_of_arm(frame: SceneFrame, robot: int) -> bool:
    """Whether a link of an arm, or its flange, carries a frame; its base is no link."""
    return frame.robot == robot and not frame.axes and frame.link > 0
