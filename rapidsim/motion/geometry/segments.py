"""A programmed move resolved for the arm: its start, its end and the path between.

Segments are the input of path and time planning. All units are SI.
"""

from __future__ import annotations

import math
from dataclasses import field, replace
from enum import Enum
from types import MappingProxyType

import numpy as np

from rapidsim.frames.moving_frames import Screw
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.values import value_class


class Geometry(Enum):
    """The curve of a segment."""

    JOINT = "joint"
    """All joints proportional to each other."""
    LINE = "line"
    """The TCP straight, the orientation turning evenly."""
    ARC = "arc"
    """The TCP on a circle through a third point."""


class CircleMode(Enum):
    """How the tool turns along an arc: CirPathMode."""

    PATH_FRAME = "path frame"
    """Evenly against the path's own frame, which turns with the arc."""
    OBJECT_FRAME = "object frame"
    """Evenly in the work object, as on a line."""
    CIRCLE_POINT = "circle point"
    """As `PATH_FRAME`, through the orientation of the circle point."""
    WRIST_45 = "axes 4 and 5"
    """Only these two move, and lead the z axis of the tool along the circle; see `wrist_pair`."""
    WRIST_46 = "axes 4 and 6"
    WRIST_56 = "axes 5 and 6"


_LED_SPEED = 1.0
"""What the axes of leaders count as [rad/s] where nothing else moves: it only sets the scale."""

TURNS_WITH_PATH = (CircleMode.PATH_FRAME, CircleMode.CIRCLE_POINT)
WRIST_PAIRS = MappingProxyType(
    {CircleMode.WRIST_45: (3, 4), CircleMode.WRIST_46: (3, 5), CircleMode.WRIST_56: (4, 5)}
)
"""Positions of the two joints that lead an arc."""


def _no_axes() -> Array:
    return np.zeros(0)


@value_class(frozen=True, slots=True, eq=False)
class Waypoint:
    """A joint vector and the TCP pose it gives."""

    joints: Array
    """Shape (n,) [rad]."""
    base_from_tcp: Transform
    """With a `Segment.carrier`: the pose as that defines it."""
    external: Array = field(default_factory=_no_axes)
    """Shape (e,) [m or rad]: the external axes."""
    aim: Array | None = None
    """Shape (3,) [m] in base: after an arc that two wrist axes led, its programmed end, through
    which the z axis of the tool passes; the TCP is a little beside."""


@value_class(frozen=True, slots=True, eq=False)
class CarrierRobot:
    """Another robot of the team, which carries the work object on its flange.

    Its axes follow the external axes in joint vectors: those of the arm, then its external axes.
    """

    number: int
    """Of the robot in the team."""
    kinematics: Kinematics
    base_from_carrier: Transform
    """Its base in the base of the robot, with all external axes at zero."""
    base_screws: tuple[Screw, ...] = ()
    """The axes that carry it, in the base of the robot; they count its axes."""
    column: int = 0
    """Where its axes begin in joint vectors, counted from the first external axis."""


@value_class(frozen=True, slots=True, eq=False)
class Carrier:
    """Anything besides the arm that moves or holds tool or work object.

    Poses of curves are given with all external axes at zero. With the tool held by the robot they
    are base_from_tcp. With a stationary tool they are object_from_tcp, and
    `Segment.tcp_from_flange` is object_from_flange of the held work object.
    """

    base_from_tool: Transform | None = None
    """Where a stationary tool stands; None where the robot holds the tool."""
    object_screws: tuple[Screw, ...] = ()
    """The axes that carry the work object."""
    base_screws: tuple[Screw, ...] = ()
    """The axes that carry the robot."""
    robot: CarrierRobot | None = None
    """The robot that carries the work object; curves are then given in its flange."""


@value_class(frozen=True, slots=True)
class Zone:
    """The zone around a segment's end within which the corner path may run."""

    position: float
    """Radius [m] for the TCP."""
    orientation: float
    """Radius [m] of TCP travel for the orientation."""
    angle: float
    """Radius [rad] for reorientation without TCP travel."""
    linear_axes: float = math.inf
    """Travel [m] of linear external axes, where only they move."""
    rotating_axes: float = math.inf
    """Turn [rad] of rotating external axes, where only they move."""


@value_class(frozen=True, slots=True)
class Speed:
    """Programmed speeds; the one that takes longest counts."""

    tcp: float
    """[m/s]"""
    reorientation: float
    """[rad/s]"""


@value_class(frozen=True, slots=True, eq=False)
class Segment:
    """One move from the end of the previous one to its own end."""

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
    via: Transform | None
    """base_from_tcp of the circle point of an arc."""
    duration: float | None
    """Time [s] of the whole segment, which replaces the speed."""
    joint_corner: bool
    """The corner at the end must run in joint space: tool or work object change there."""
    acceleration_share: float
    """AccSet: the share of the axis accelerations that is used."""
    ramp: float
    """AccSet: how quickly accelerations rise, as a share of what they can; never higher than that
    of the move before, if the arm does not stop in between."""
    stop_ramp: float
    """AccSet \\FinePointRamp: the same on the way to a stop point at the end."""
    carrier: Carrier | None
    """None where the robot stands still and holds the tool, and the work object stands still."""
    wrist_in_joints: bool
    """SingArea \\Wrist: on a line or arc the wrist axes turn evenly instead of the tool."""
    circle_mode: CircleMode
    """How the tool turns along an arc."""
    tcp_acceleration: float
    """PathAccLim: the TCP's largest acceleration along its path [m/s2]."""
    tcp_deceleration: float
    """PathAccLim: the TCP's largest deceleration along its path [m/s2]."""
    world_acceleration: float
    """WorldAccLim: the TCP's largest acceleration in any direction [m/s2]."""
    external_linear: tuple[bool, ...]
    """Whether each external axis is linear."""
    external_speeds: tuple[float, ...]
    """Speed of each external axis [m/s or rad/s]: what is programmed, or what it can."""
    load: float = 0.0
    """What hangs on the wrist and adds to the arm's inertia, in shares of the rated payload."""
    carrier_axes: tuple[Array, Array] | None = None
    """Start and end (l,) [rad, m] of the axes of leaders, which follow the external axes in joint
    vectors; None where nobody leads."""

    @property
    def wrist_pair(self) -> tuple[int, int] | None:
        """Positions of the two joints that lead an arc while the others rest; None elsewhere."""
        return WRIST_PAIRS.get(self.circle_mode) if self.geometry is Geometry.ARC else None


def with_carrier_axes(segment: Segment, start: Array, end: Array) -> Segment:
    """A segment with the axes (l,) [rad, m] of the robots that carry work objects."""
    own, more = len(segment.start.external), len(start)
    return replace(
        segment,
        carrier_axes=(start, end),
        external_linear=(*segment.external_linear[:own], *(False,) * more),
        external_speeds=(*segment.external_speeds[:own], *(_LED_SPEED,) * more),
    )
