"""Cache of plans for blocks that a robot travels repeatedly.

A cycle that repeats exactly has the same path with the same timing: only the time at which it
begins is new.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field, fields

from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.time_scaling import TimeScaling

_MOST_BLOCKS = 1_000
"""A pallet has hundreds. A run keeps their plans in any case; a served controller does not."""
_MOST_SEGMENTS = 200
"""Longer blocks are not cached: cycles rarely repeat them, and they take memory."""


@dataclass(slots=True, eq=False)
class PlanCache:
    """The plans of the most recent blocks of one or more robots."""

    _plans: dict[Hashable, tuple[Path, TimeScaling]] = field(default_factory=dict)
    _last: tuple[Hashable, Path, TimeScaling] | None = None
    """The last plan, with its start."""

    def plan(
        self,
        rows: Sequence[Sequence[Segment]],
        start: Hashable,
        make: Callable[[], tuple[Path, TimeScaling]],
    ) -> tuple[Path, TimeScaling]:
        """Return the plan of a block, from the cache if possible.

        Args:
            rows: All segments of the block, of each robot.
            start: All other values that determine the plan.
            make: Plans the block.
        """
        if len(rows[0]) > _MOST_SEGMENTS:
            return make()
        if self._last is not None and self._last[0] == start:
            _, path, timing = self._last
            if _is_of(path, rows):
                return path, timing
        key = (start, *(_values(segment) for row in rows for segment in row))
        known = self._plans.pop(key, None)
        if known is not None:
            # Moved to the end: the plan used last is discarded last.
            self._plans[key] = known
            return known
        path, timing = make()
        if _is_of(path, rows):
            # Otherwise a move was changed to what can be made: that must be found and reported each
            # time.
            self._plans[key] = path, timing
            self._last = start, path, timing
            if len(self._plans) > _MOST_BLOCKS:
                del self._plans[next(iter(self._plans))]
        return path, timing


def _is_of(path: Path, rows: Sequence[Sequence[Segment]]) -> bool:
    """Whether a path consists of these very segments."""
    return all(
        len(part.segments) == len(row) and all(map(operator.is_, part.segments, row))
        for part, row in zip(path.parts, rows, strict=True)
    )


_NAMES = ("start", "end", "tcp_from_flange", "via")
_WITH_ARRAYS = operator.attrgetter(*_NAMES)
_OTHERS = operator.attrgetter(*(one.name for one in fields(Segment) if one.name not in _NAMES))


def _values(segment: Segment) -> Hashable:
    """All values of a segment, for comparison."""
    return _OTHERS(segment), *map(_value, _WITH_ARRAYS(segment))


def _value(value: object) -> Hashable:
    match value:
        case Waypoint(joints=joints, base_from_tcp=pose, external=external, aim=aim):
            aimed = None if aim is None else aim.tobytes()
            return joints.tobytes(), _value(pose), external.tobytes(), aimed
        case Transform(rotation=rotation, translation=translation):
            return rotation.tobytes(), translation.tobytes()
        case Hashable():
            # A carrier is compared by identity: it is one object per tool and work object.
            return value
    raise TypeError(f"a {type(value).__name__} of a segment cannot be compared")
