"""Segments without a program: of tests and benchmarks, which name only what they are about."""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import Any

from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import (
    CircleMode,
    Geometry,
    Segment,
    Speed,
    Waypoint,
    Zone,
)

_NOTHING_SPECIAL = MappingProxyType(
    {
        "via": None,
        "duration": None,
        "joint_corner": False,
        "acceleration_share": 1.0,
        "ramp": 1.0,
        "stop_ramp": 1.0,
        "carrier": None,
        "wrist_in_joints": False,
        "circle_mode": CircleMode.PATH_FRAME,
        "tcp_acceleration": math.inf,
        "tcp_deceleration": math.inf,
        "world_acceleration": math.inf,
        "external_linear": (),
        "external_speeds": (),
    }
)


def plain_segment(
    geometry: Geometry,
    start: Waypoint,
    end: Waypoint,
    tcp_from_flange: Transform,
    branch: int,
    speed: Speed,
    zone: Zone | None,
    **others: Any,
) -> Segment:
    """A segment as of a program without settings, but for the fields in `others`."""
    fields: dict[str, Any] = {**_NOTHING_SPECIAL, **others}
    return Segment(geometry, start, end, tcp_from_flange, branch, speed, zone, **fields)
