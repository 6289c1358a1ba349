"""Segments as columns: what they share, and their ends as rows of arrays."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.repeated_rows import Index
from rapidsim.row_sequence import RowSequence
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class WaypointRows:
    """Waypoints (m,)."""

    joints: Array
    """Shape (m, n) [rad]."""
    base_from_tcp: Transform
    """Shape (m,)."""
    external: Array
    """Shape (m, e) [m or rad]."""

    aims: Mapping[int, Array] = field(default_factory=dict)
    """By row; see `Waypoint`."""

    def __getitem__(self, row: int) -> Waypoint:
        """Return a waypoint."""
        return Waypoint(
            self.joints[row], self.base_from_tcp[row], self.external[row], self.aims.get(row)
        )

    def at(self, rows: Index) -> WaypointRows:
        """Return the waypoints of some rows."""
        aims = {at: self.aims[row] for at, row in enumerate(rows.tolist()) if row in self.aims}
        return WaypointRows(self.joints[rows], self.base_from_tcp[rows], self.external[rows], aims)


@value_class(frozen=True, slots=True, eq=False)
class SegmentRows(RowSequence[Segment]):
    """Segments (m,); each is created when it is needed."""

    kinds: Sequence[Segment]
    """Segments, of which each differs from some of these at most in its ends and its branch."""
    kind: Index
    """Shape (m,): index of that segment."""
    start: WaypointRows
    end: WaypointRows
    branch: Index
    """Shape (m,)."""

    def __len__(self) -> int:
        """Return the number of segments."""
        return len(self.kind)

    def _element(self, row: int) -> Segment:
        like = self.kinds[int(self.kind[row])]
        start, end = self.start[row], self.end[row]
        return replace(like, start=start, end=end, branch=int(self.branch[row]))

    def at(self, rows: Index) -> SegmentRows:
        """Return the segments of some rows."""
        start, end = self.start.at(rows), self.end.at(rows)
        return SegmentRows(self.kinds, self.kind[rows], start, end, self.branch[rows])


def of_each(segments: Sequence[Segment], fact: Callable[[Segment], Any]) -> npt.NDArray[Any]:
    """Return a fact about each segment (m, ...) that does not depend on ends and branch."""
    if isinstance(segments, SegmentRows):
        found: npt.NDArray[Any] = np.array(list(map(fact, segments.kinds)))[segments.kind]
        return found
    return np.array(list(map(fact, segments)))


def branches_of(segments: Sequence[Segment]) -> Index:
    """Return the branches (m,) of segments."""
    if isinstance(segments, SegmentRows):
        return segments.branch
    return np.array([segment.branch for segment in segments])
