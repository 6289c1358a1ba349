"""A programmed move, resolved to the arm: where it starts and ends and how it gets there.

Segments are what geometry and timing are planned from. All units are SI.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rapidsim.frames.transform import Array, Transform


class Geometry(Enum):
    """The curve of a segment."""

    JOINT = "joint"
    """All joints proportional to each other."""
    LINE = "line"
    """The TCP straight, the orientation turning evenly."""
    ARC = "arc"
    """The TCP on a circle through a third point."""


@dataclass(frozen=True, slots=True, eq=False)
class Waypoint:
    """A joint vector and the pose of the TCP it gives."""

    joints: Array
    """Shape (n,) [rad]."""
    base_from_tcp: Transform


@dataclass(frozen=True, slots=True)
class Zone:
    """The zone around a segment's end within which the corner path may run."""

    position: float
    """Radius [m] for the TCP."""
    orientation: float
    """Radius [m] of TCP travel for the orientation; at least `position`."""
    angle: float
    """Radius [rad] for reorientation without TCP travel."""


@dataclass(frozen=True, slots=True)
class Speed:
    """Programmed speeds; the slowest wins."""

    tcp: float
    """[m/s]"""
    reorientation: float
    """[rad/s]"""


@dataclass(frozen=True, slots=True, eq=False)
class Segment:
    """One move from the end of the last to its own end."""

    index: int
    """Number of the move in the run; segments of one path are consecutive."""
    geometry: Geometry
    start: Waypoint
    end: Waypoint
    tcp_from_flange: Transform
    """The inverse of the tool frame: turns a TCP pose into a flange pose."""
    branch: int
    """The branch of inverse kinematics that lines and arcs stay on."""
    speed: Speed
    zone: Zone | None
    """None where the arm stops at the end."""
    via: Transform | None = None
    """base_from_tcp of the circle point of an arc."""
    duration: float | None = None
    """Time [s] of the whole segment, which replaces the speed."""
    joint_corner: bool = False
    """The corner at the end must run in joint space: tool or work object change there."""
    acceleration_share: float = 1.0
    """AccSet: the share of the axis accelerations that is used."""
