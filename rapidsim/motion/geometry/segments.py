"""A programmed move resolved for the arm: start, end and the path between.

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
from rapidsim.motion.geometry.belts import BeltRide
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.values import value_class


class Geometry(Enum):
    """The curve of a segment."""

    JOINT = "joint"
    """All joints proportional to each other."""
    LINE = "line"
    """TCP on a straight line, orientation turning uniformly."""
    ARC = "arc"
    """TCP on a circle through a third point."""


class CircleMode(Enum):
    """Orientation of the tool along an arc: CirPathMode."""

    PATH_FRAME = "path frame"
    """Uniform relative to the path's own frame, which turns with the arc."""
    OBJECT_FRAME = "object frame"
    """Uniform in the work object, as on a line."""
    CIRCLE_POINT = "circle point"
    """Like `PATH_FRAME`, through the orientation of the circle point."""
    WRIST_45 = "axes 4 and 5"
    """Only these two move, and guide the z axis of the tool along the circle; see `wrist_pair`."""
    WRIST_46 = "axes 4 and 6"
    WRIST_56 = "axes 5 and 6"


_LED_SPEED = 1.0
"""Speed [rad/s] of carrier axes if nothing else moves: only sets the scale of the parameter."""

TURNS_WITH_PATH = (CircleMode.PATH_FRAME, CircleMode.CIRCLE_POINT)
WRIST_PAIRS = MappingProxyType(
    {CircleMode.WRIST_45: (3, 4), CircleMode.WRIST_46: (3, 5), CircleMode.WRIST_56: (4, 5)}
)
"""Indices of the two joints that guide the tool along an arc."""


def _no_axes() -> Array:
    return np.zeros(0)


@value_class(frozen=True, slots=True, eq=False)
class Waypoint:
    """A joint vector and its TCP pose."""

    joints: Array
    """Shape (n,) [rad]."""
    base_from_tcp: Transform
    """With a `Segment.carrier`: the pose in the frame that it defines."""
    external: Array = field(default_factory=_no_axes)
    """Shape (e,) [m or rad]: the external axes."""
    aim: Array | None = None
    """Shape (3,) [m] in base: after an arc with a wrist pair, its programmed end, which is on the z
    axis of the tool; the TCP is slightly off it."""


@value_class(frozen=True, slots=True, eq=False)
class CarrierRobot:
    """Another robot of the team, which carries the work object on its flange.

    Its arm axes, then its external axes, follow the external axes in joint vectors.
    """

    number: int
    """Index of the robot in the team."""
    kinematics: Kinematics
    base_from_carrier: Transform
    """Its base frame in the base of the robot, with all external axes at zero."""
    base_screws: tuple[Screw, ...] = ()
    """Axes that move it, in the base of the robot, with indices into its own axes."""
    column: int = 0
    """Index of its first axis in joint vectors, counted from the first external axis."""


@value_class(frozen=True, slots=True, eq=False)
class Carrier:
    """Frames other than the arm's flange that move or hold the tool or work object.

    Poses of curves are defined with all external axes at zero. With the tool held by the robot they
    are base_from_tcp. With a stationary tool they are object_from_tcp, and
    `Segment.tcp_from_flange` is object_from_flange of the held work object.
    """

    base_from_tool: Transform | None = None
    """Frame of a stationary tool; None if the robot holds the tool."""
    object_screws: tuple[Screw, ...] = ()
    """Axes that carry the work object."""
    base_screws: tuple[Screw, ...] = ()
    """Axes that carry the robot."""
    robot: CarrierRobot | None = None
    """Robot that carries the work object; curves are then in its flange frame."""


@value_class(frozen=True, slots=True)
class Zone:
    """Zone around a segment's end within which the corner path may run."""

    position: float
    """Radius [m] for the TCP."""
    orientation: float
    """Radius [m] of TCP travel for the orientation."""
    angle: float
    """Radius [rad] for reorientation without TCP travel."""
    linear_axes: float = math.inf
    """Travel [m] of linear external axes, if only they move."""
    rotating_axes: float = math.inf
    """Rotation [rad] of rotating external axes, if only they move."""


@value_class(frozen=True, slots=True)
class Speed:
    """Programmed speeds; the slowest part of the move determines its time."""

    tcp: float
    """[m/s]"""
    reorientation: float
    """[rad/s]"""


@value_class(frozen=True, slots=True, eq=False)
class Segment:
    """A move from the end of the previous one to its own end."""

    geometry: Geometry
    start: Waypoint
    end: Waypoint
    tcp_from_flange: Transform
    """Inverse of the tool frame: maps a TCP pose to a flange pose."""
    branch: int
    """Branch of inverse kinematics that lines and arcs stay on."""
    speed: Speed
    zone: Zone | None
    """None if the arm stops at the end."""
    via: Transform | None
    """base_from_tcp of the circle point of an arc."""
    duration: float | None
    """Time [s] of the whole segment, which replaces the speed."""
    joint_corner: bool
    """Whether the end corner must run in joint space, as tool or work object change there."""
    acceleration_share: float
    """AccSet: the share of the axis accelerations that is used."""
    ramp: float
    """AccSet: rate of rise of accelerations, as a share of the maximum; never higher than that of
    the move before, if the arm does not stop in between."""
    stop_ramp: float
    """AccSet \\FinePointRamp: `ramp` for the approach to a stop point at the end."""
    carrier: Carrier | None
    """None if the robot base and work object are stationary and the robot holds the tool."""
    wrist_in_joints: bool
    """SingArea \\Wrist: on a line or arc the wrist axes, not the tool, turn uniformly."""
    circle_mode: CircleMode
    """Orientation of the tool along an arc."""
    tcp_acceleration: float
    """PathAccLim: the TCP's largest acceleration along its path [m/s2]."""
    tcp_deceleration: float
    """PathAccLim: the TCP's largest deceleration along its path [m/s2]."""
    world_acceleration: float
    """WorldAccLim: the TCP's largest acceleration in any direction [m/s2]."""
    external_linear: tuple[bool, ...]
    """Whether each external axis is linear."""
    external_speeds: tuple[float, ...]
    """Speed of each external axis [m/s or rad/s]: programmed, or its maximum."""
    load: float = 0.0
    """Load at the wrist that adds to the arm's inertia, as a share of the rated payload."""
    carrier_axes: tuple[Array, Array] | None = None
    """Start and end (l,) [rad, m] of the carrier axes, which follow the external axes in joint
    vectors; None if no robot or belt carries the work object."""
    rides: tuple[BeltRide, ...] = ()
    """Belts that the arm follows, of which the last carrier axis is the expected travel."""
    slowed_for_belt: bool = False
    """Whether speed and acceleration are lower than programmed, so that the arm can follow."""

    @property
    def wrist_pair(self) -> tuple[int, int] | None:
        """Indices of the two joints that guide the tool along an arc; None for other segments."""
        return WRIST_PAIRS.get(self.circle_mode) if self.geometry is Geometry.ARC else None


def with_belt_axis(
    segment: Segment, start: float, end: float, rides: tuple[BeltRide, ...] | None = None
) -> Segment:
    """Return a segment with the axis [m] of a belt, which limits no speed.

    Args:
        segment: The segment.
        start: Position of the axis at its start.
        end: Position of the axis at its end.
        rides: The belts that it follows; None for those that it follows already.
    """
    own = len(segment.start.external)
    return replace(
        segment,
        carrier_axes=(np.array([start]), np.array([end])),
        external_linear=(*segment.external_linear[:own], True),
        external_speeds=(*segment.external_speeds[:own], math.inf),
        rides=segment.rides if rides is None else rides,
    )


def without_carrier_axes(segment: Segment) -> Segment:
    """Return a segment that nothing carries without the axes of what carries its neighbours."""
    if segment.carrier_axes is None or segment.carrier is not None:
        return segment
    own = len(segment.start.external)
    return replace(
        segment,
        carrier_axes=None,
        external_linear=segment.external_linear[:own],
        external_speeds=segment.external_speeds[:own],
    )


def with_carrier_axes(segment: Segment, start: Array, end: Array) -> Segment:
    """Return a segment with the axes (l,) [rad, m] of the robots that carry work objects."""
    own, more = len(segment.start.external), len(start)
    return replace(
        segment,
        carrier_axes=(start, end),
        external_linear=(*segment.external_linear[:own], *(False,) * more),
        external_speeds=(*segment.external_speeds[:own], *(_LED_SPEED,) * more),
    )
