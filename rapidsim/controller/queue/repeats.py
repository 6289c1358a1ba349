"""Blocks that a robot travels again and again, planned once.

A cycle that repeats to the last bit gives the same path with the same timing: only the numbers of
its moves and the time at which it begins are new.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, field

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.time_scaling import Timing

_MOST_BLOCKS = 64
_MOST_SEGMENTS = 200
"""Of a longer block nothing is kept: it is not what a cycle repeats, and it takes memory."""


@dataclass(slots=True, eq=False)
class Repeats:
    """The plans of the last blocks of one robot."""

    _plans: dict[Hashable, tuple[Path, Timing]] = field(default_factory=dict)

    def plan(
        self,
        segments: Sequence[Segment],
        start: Hashable,
        make: Callable[[], tuple[Path, Timing]],
    ) -> tuple[Path, Timing]:
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
        path, timing = make() if known is None else known
        # Behind the others: what was asked for last is forgotten last.
        self._plans[key] = path, timing
        if len(self._plans) > _MOST_BLOCKS:
            del self._plans[next(iter(self._plans))]
        return (path if known is None else path.renumbered(tuple(segments))), timing


def _values(segment: Segment) -> Hashable:
    """All that a plan takes from a segment, to be compared: everything but its number."""
    via = segment.via
    return (
        segment.geometry,
        *_waypoint(segment.start),
        *_waypoint(segment.end),
        *_pose(segment.tcp_from_flange),
        segment.branch,
        segment.speed,
        segment.zone,
        None if via is None else _pose(via),
        segment.duration,
        segment.joint_corner,
        segment.acceleration_share,
        segment.ramp,
        segment.stop_ramp,
        segment.carrier,
        segment.wrist_in_joints,
        segment.circle_mode,
        segment.tcp_acceleration,
        segment.tcp_deceleration,
        segment.world_acceleration,
        segment.external_linear,
        segment.external_speeds,
    )


def _waypoint(waypoint: Waypoint) -> tuple[bytes | None, ...]:
    aim: Array | None = waypoint.aim
    return (
        waypoint.joints.tobytes(),
        *_pose(waypoint.base_from_tcp),
        waypoint.external.tobytes(),
        None if aim is None else aim.tobytes(),
    )


def _pose(pose: Transform) -> tuple[bytes, bytes]:
    return pose.rotation.tobytes(), pose.translation.tobytes()
