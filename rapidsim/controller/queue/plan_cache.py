"""Cache of plans for blocks that a robot travels repeatedly.

A cycle that repeats exactly has the same path with the same timing: only the time at which it
begins is new. A robot that is stopped anywhere, again and again, has plans that nothing repeats. So
there are two parts: a small one for new plans, and one for those that were needed again after they
had been discarded from the first: of their blocks hashes were stored. Requests shortly after each
other, before and after a stop, say nothing about a cycle.

Source: T. Johnson, D. Shasha, "2Q: A low overhead high performance buffer management replacement
algorithm", VLDB 1994.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field, fields
from typing import Final, TypeAlias

import numpy as np

from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.time_scaling import TimeScaling

_MOST_SEGMENTS = 200
"""Longer blocks are not cached: cycles rarely repeat them, and they take memory."""
_OF_PLAN: Final = 4
"""Memory of a plan without its segments, in that of a segment, which is 4 KB."""
_MOST: Final = 6_000
"""Memory of each part: a pallet has hundreds of blocks."""
_MOST_NEW: Final = 1_500
"""Memory of the new plans of a controller that stays on, some 250 blocks; a run keeps its plans in
any case."""
_MOST_HASHES: Final = 10_000

Plan: TypeAlias = tuple[Path, TimeScaling]


@dataclass(slots=True)
class _Plans:
    """Plans by their blocks; the first one is discarded next."""

    _plans: dict[Hashable, Plan] = field(default_factory=dict)
    _size: int = 0

    def get(self, key: Hashable) -> Plan | None:
        """Return a plan; None if it is not here."""
        return self._plans.get(key)

    def refresh(self, key: Hashable) -> None:
        """Let a plan that is here be discarded last."""
        self._plans[key] = self._plans.pop(key)

    def put(self, key: Hashable, plan: Plan) -> list[Hashable]:
        """Add a plan; return the blocks whose plans it has displaced."""
        self._plans[key] = plan
        self._size += _size_of(plan)
        return self.trim(_MOST)

    def trim(self, most: int) -> list[Hashable]:
        """Discard plans that take more memory; return their blocks."""
        displaced = []
        while self._size > most:
            oldest = next(iter(self._plans))
            self._size -= _size_of(self._plans.pop(oldest))
            displaced.append(oldest)
        return displaced


def _size_of(plan: Plan) -> int:
    return _OF_PLAN + sum(len(part.segments) for part in plan[0].parts)


@dataclass(slots=True, eq=False)
class PlanCache:
    """The plans of blocks of one or more robots."""

    _new: _Plans = field(default_factory=_Plans)
    _repeated: _Plans = field(default_factory=_Plans)
    _discarded: dict[int, None] = field(default_factory=dict)
    """Hashes of blocks whose new plans were discarded."""
    _last: tuple[Hashable, Path, TimeScaling] | None = None
    """The last plan, with its start."""

    def plan(
        self,
        rows: Sequence[Sequence[Segment]],
        start: Hashable,
        make: Callable[[], Plan],
    ) -> Plan:
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
        if (new := self._new.get(key)) is not None:
            return new
        if (known := self._repeated.get(key)) is not None:
            self._repeated.refresh(key)
            return known
        path, timing = make()
        if _is_of(path, rows):
            # Otherwise a move was changed to what can be made: that must be found and reported each
            # time.
            self._add(key, (path, timing))
            self._last = start, path, timing
        return path, timing

    def _add(self, key: Hashable, plan: Plan) -> None:
        if hash(key) in self._discarded:
            del self._discarded[hash(key)]
            self._repeated.put(key, plan)
            return
        self._note(self._new.put(key, plan))

    def forget(self) -> None:
        """Discard most of the new plans, as a controller that stays on does."""
        self._note(self._new.trim(_MOST_NEW))

    def _note(self, discarded: Sequence[Hashable]) -> None:
        self._discarded.update((hash(one), None) for one in discarded)
        while len(self._discarded) > _MOST_HASHES:
            del self._discarded[next(iter(self._discarded))]


def _is_of(path: Path, rows: Sequence[Sequence[Segment]]) -> bool:
    """Whether a path consists of these very segments."""
    return all(
        len(part.segments) == len(row) and all(map(operator.is_, part.segments, row))
        for part, row in zip(path.parts, rows, strict=True)
    )


_NAMES = ("start", "end", "tcp_from_flange", "via", "carrier_axes")
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
        case np.ndarray():
            return value.tobytes()
        case tuple():
            return tuple(map(_value, value))
        case Hashable():
            # A carrier is compared by identity: it is one object per tool and work object.
            return value
    raise TypeError(f"a {type(value).__name__} of a segment cannot be compared")
