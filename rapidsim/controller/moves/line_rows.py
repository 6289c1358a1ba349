"""Lines to announced targets as rows of arrays: what their moves have in common, and their ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import ConfData
from rapidsim.language.moves import AnnouncedTargets, Move, Place
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class LineRows:
    """Lines (k,), of which each starts where the one before it ends."""

    joints: Array
    """Joints at the ends, shape (k, n) [rad]."""
    ends: Transform
    """Shape (k,): curve_from_tcp."""
    start: Waypoint
    """Start of the first line, with the pose there of the tool of these."""
    confdata: npt.NDArray[np.int16]
    """Shape (k, 4)."""
    like: Move
    """A move with their parameters."""
    segment_of: Callable[..., Segment]
    """Makes the segment of such a move from its ends."""
    grip_load_kg: float
    targets: AnnouncedTargets
    first: int
    """Number of the target of the first line."""

    def __len__(self) -> int:
        return len(self.joints)

    def end(self, at: int) -> Waypoint:
        """End of a line."""
        return Waypoint(self.joints[at], self.ends[at], self.start.external)

    def segment(self, at: int) -> Segment:
        """Segment of a line."""
        return self.segment_of(start=self.end(at - 1) if at else self.start, end=self.end(at))

    def move(self, at: int) -> Move:
        """The move of a line."""
        return replace(self.like, to=self.targets[self.first + at])

    def place(self, at: int) -> Place:
        """Place of its statement."""
        return self.targets.place(self.first + at)

    def conf(self, at: int) -> ConfData:
        """Configuration at the end of a line."""
        return ConfData(*map(float, self.confdata[at].tolist()))


@value_class(frozen=True, slots=True, eq=False)
class LineRow:
    """One of these lines, and its segment; a `ResolvedMove`."""

    rows: LineRows
    at: int
    segment: Segment

    @property
    def move(self) -> Move:
        """The move."""
        return self.rows.move(self.at)

    @property
    def like(self) -> Move:
        """A move that differs from it in its target alone."""
        return self.rows.like

    @property
    def place(self) -> Place:
        """Place of its statement."""
        return self.rows.place(self.at)

    @property
    def conf(self) -> ConfData:
        """Configuration at its end."""
        return self.rows.conf(self.at)
