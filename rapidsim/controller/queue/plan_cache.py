"""Blocks that a robot travels repeatedly are planned only once.

A cycle that repeats to the last bit gives the same path with the same timing: only the time at
which it begins is new.
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
"""A pallet has hundreds. A run keeps their plans in any case, a served controller does not."""
_MOST_SEGMENTS = 200
"""Longer blocks are not kept: cycles rarely repeat them, and they take memory."""


@dataclass(slots=True, eq=False)
class PlanCache:
    """The plans of a robot's most recent blocks."""

    _plans: dict[Hashable, tuple[Path, TimeScaling]] = field(default_factory=dict)

    def plan(
        self,
        segments: Sequence[Segment],
        start: Hashable,
        make: Callable[[], tuple[Path, TimeScaling]],
    ) -> tuple[Path, TimeScaling]:
        """The plan of a block, made only if it was not made before.

        Args:
            segments: All of the block.
            start: All that beside them decides the plan.
            make: Plans.
        """
        if len(segments) > _MOST_SEGMENTS:
            return make()
        key = (start, *map(_values, segments))
        known = self._plans.pop(key, None)
        if known is not None:
            # Behind the others: what was asked for last is forgotten last.
            self._plans[key] = known
            return known
        path, timing = make()
        if all(map(operator.is_, path.segments, segments)):
            # Else a move gave way to what can be made: that is found out, and told, each time.
            self._plans[key] = path, timing
            if len(self._plans) > _MOST_BLOCKS:
                del self._plans[next(iter(self._plans))]
        return path, timing


_NAMES = tuple(one.name for one in fields(Segment))


def _values(segment: Segment) -> Hashable:
    """All values of a segment, for comparison."""
    return tuple(_value(getattr(segment, name)) for name in _NAMES)


def _value(value: object) -> Hashable:
    match value:
        case Waypoint(joints=joints, base_from_tcp=pose, external=external, aim=aim):
            aimed = None if aim is None else aim.tobytes()
            return joints.tobytes(), _value(pose), external.tobytes(), aimed
        case Transform(rotation=rotation, translation=translation):
            return rotation.tobytes(), translation.tobytes()
        case Hashable():
            # A carrier is itself: those of one tool and one work object are one.
            return value
    raise TypeError(f"a {type(value).__name__} of a segment cannot be compared")
