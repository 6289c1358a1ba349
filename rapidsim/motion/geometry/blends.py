"""Corner paths: the distance around each programmed point over which the curves are left.

A corner path replaces the last `radius` of one curve and the first `radius` of the next. It adds
the two curves' deviations from the corner, slowed down by a shape phi with phi(0) = phi'(0) = 0,
phi(1) = 1, phi'(1) = 2, so that it meets both curves with their own speed:

    B(t) = C + [in(radius phi(1 - t)) - C] + [out(radius phi(t)) - C],   0 <= t <= 1
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from enum import IntEnum
from typing import assert_never

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.curves import Curves, Index
from rapidsim.motion.geometry.joint_mapping import JointMapper, arms_of
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.motion.model import MotionModel
from rapidsim.values import value_class

_SMALLEST_RADIUS = 1e-6
_SMALLEST_SHARE = 1e-4
_ZONE_SAMPLES = 16
_ZONE_PARTS = 8
_ZONE_ROUNDS = 4


class Limit(IntEnum):
    """Cause that determined the radius of a corner."""

    ZONE = 0
    HALF = 1
    REORIENTATION = 2
    TURN_ONLY = 3
    STOP_POINT = 4
    NO_LENGTH = 5


@value_class(frozen=True, slots=True)
class Corner:
    """The planned corner at the end of a segment."""

    radius: float
    """Radius [m] of the corner path around the programmed point; 0 if there is no corner path, or
    if the TCP position is constant and only its orientation changes."""
    in_joints: bool
    """Whether the corner path is made in joint space."""
    stops: bool
    """Whether the arm comes to a stop at the programmed point."""
    reason: str
    """Reason why the zone was reduced or the arm stops; empty if the zone is as programmed."""


@value_class(frozen=True, slots=True, eq=False)
class Corners:
    """Corners between curves; row c is between curves c and c + 1, shapes (m - 1,)."""

    radius: Array
    """Radius for the position or the joints, in units of the path parameter."""
    orientation_radius: Array
    """Radius for the orientation and external axes, in units of the path parameter; 0 if these do
    not move."""
    in_joints: npt.NDArray[np.bool_]
    limit: npt.NDArray[np.int64]
    """Values of `Limit`."""


def corners_of(
    segments: Sequence[Segment], curves: Curves, arms: JointMapper, model: MotionModel
) -> Corners:
    """Find the corner between each two consecutive curves.

    A zone is reduced to half of either curve, the orientation zone separately. In version 1 with
    `orientation_zone` as documented both are also reduced by the share of the reorientation that
    its angle allows (a zone of 9 deg on a turn of 25 deg leaves 36 % of the curve). Where only one
    of the two curves moves the TCP there is no corner path.

    Source: zonedata and the motion principles of the RAPID reference; for neither zone shrinking
    the other, logs of large turns with small zones.
    """
    count = len(segments) - 1
    zones = [segment.zone for segment in segments[:count]]
    stop = np.array([zone is None for zone in zones], dtype=bool)
    position = np.array([zone.position if zone else 0.0 for zone in zones])
    programmed = model.orientation_zone == "programmed"
    orientation = position
    if model.orientation_zone != "position":
        orientation = np.array([zone.orientation if zone else 0.0 for zone in zones])

    into, out = slice(0, count), slice(1, count + 1)
    turn_only = curves.turns_only[into] != curves.turns_only[out]
    candidates = np.full((2, 3, count), np.inf)
    widest = np.full((2, count), np.inf)
    for side, rows in enumerate((into, out)):
        length = curves.length[rows]
        candidates[side, Limit.ZONE] = _zone_on_curve(
            segments, curves, arms.kinematics, position, side
        )
        candidates[side, Limit.HALF] = 0.5 * length
        if programmed:
            share = _share_of_turns(segments, curves, curves.angle, side)
            candidates[side, Limit.REORIENTATION] = length * share
        widest[side] = np.where(
            curves.turns_only[rows],
            candidates[side, Limit.ZONE],
            np.minimum(orientation * length / np.maximum(curves.travel[rows], 1e-12), 0.5 * length),
        )
        widest[side] = np.minimum(widest[side], candidates[side, Limit.REORIENTATION])
    smallest = candidates.min(axis=0)
    limit = smallest.argmin(axis=0)
    radius = smallest.min(axis=0)
    orientation_radius = widest.min(axis=0)
    if model.orientation_zone == "own":
        moves = (curves.angle > 0.0) | (curves.external > 0.0).any(axis=1)
        orientation_radius = np.where(moves[into] | moves[out], orientation_radius, 0.0)
    else:
        orientation_radius = np.maximum(radius, orientation_radius)

    shorter = np.minimum(curves.length[into], curves.length[out])
    none = stop | turn_only | (radius < np.minimum(_SMALLEST_RADIUS, _SMALLEST_SHARE * shorter))
    limit = np.where(stop, Limit.STOP_POINT, np.where(turn_only, Limit.TURN_ONLY, limit))
    # Where the joints determine the pose of the TCP and not vice versa.
    jointed = curves.in_joints | arms.wrist_rows | arms.pair_rows
    in_joints = jointed[into] | jointed[out] | _tool_changes(segments, arms.tcp_from_flange)
    return Corners(
        radius=np.where(none, 0.0, radius),
        orientation_radius=np.where(none, 0.0, np.where(in_joints, radius, orientation_radius)),
        in_joints=in_joints,
        limit=limit.astype(np.int64),
    )


def without_skipped(corners: Corners, active: Index) -> Corners:
    """Remove corner paths where a segment of zero length lies in between.

    `active` (m,) are the positions of the curves in the sequence of all segments.
    """
    skipped = np.diff(active) > 1
    return replace(
        corners,
        radius=np.where(skipped, 0.0, corners.radius),
        orientation_radius=np.where(skipped, 0.0, corners.orientation_radius),
        limit=np.where(
            skipped & (corners.limit != Limit.STOP_POINT), Limit.NO_LENGTH, corners.limit
        ).astype(np.int64),
    )


def describe(
    limit: Limit, programmed: float, radius: float, angle: float, turned: float, *, stops: bool
) -> str:
    """Reason why a corner is not as programmed; empty if it is.

    Args:
        limit: What determined the radius.
        programmed: Zone [m].
        radius: Radius used [m].
        angle: Zone for reorientation [rad].
        turned: The larger reorientation of the two moves at the corner [rad].
        stops: Whether the arm stops.
    """
    if limit is Limit.ZONE and not stops:
        return ""
    reduced = f"zone {programmed * 1e3:g} mm reduced to {radius * 1e3:.3g} mm"
    match limit:
        case Limit.ZONE:
            text = "zone without size"
        case Limit.HALF:
            text = f"{reduced}: half of the shorter move at it"
        case Limit.REORIENTATION:
            text = (
                f"{reduced}: reorientation of {math.degrees(turned):.1f} deg with a zone of "
                f"{math.degrees(angle):.2g} deg"
            )
        case Limit.TURN_ONLY:
            text = "no corner path between TCP travel and pure reorientation"
        case Limit.STOP_POINT:
            text = "stop point"
        case Limit.NO_LENGTH:
            text = "no corner path at a move without length"
        case _:
            assert_never(limit)
    return text


def _zone_on_curve(
    segments: Sequence[Segment],
    curves: Curves,
    kinematics: Kinematics,
    position: Array,
    side: int,
) -> Array:
    """Zones (m - 1,) in units of the path parameter on the curve before or after each corner."""
    count = len(position)
    rows = slice(side, count + side)
    length = curves.length[rows]
    arc = np.linalg.norm(curves.spoke[rows], axis=-1)
    # The zone is a sphere: on an arc its edge is a chord away.
    half_chord = np.minimum(position / np.maximum(2.0 * arc, 1e-12), 1.0)
    on_arc = 2.0 * arc * np.arcsin(half_chord)
    zone = np.where(arc > 0.0, on_arc, position * length / np.maximum(curves.travel[rows], 1e-12))
    share = _share_of_turns(segments, curves, curves.turned, side)
    zone = np.where(curves.turns_only[rows], length * share, zone)
    moves = np.flatnonzero(curves.in_joints[rows] & ~curves.turns_only[rows] & (position > 0.0))
    if len(moves):
        zone[moves] = _zone_on_joint_moves(
            segments, curves, kinematics, moves + side, position[moves], at_end=side == 0
        )
    return zone


def _share_of_turns(segments: Sequence[Segment], curves: Curves, turned: Array, side: int) -> Array:
    """Return the share (m - 1,) of the curve before or after each corner that its angles allow.

    It is the minimum over the zones for reorientation, for linear and for rotating external axes,
    of whatever moves; `turned` (m,) [rad] is the reorientation.
    """
    count = len(segments) - 1
    rows = slice(side, count + side)
    zones = [segment.zone for segment in segments[:count]]
    angle = np.array([zone.angle if zone else 0.0 for zone in zones])
    share: Array = angle / np.maximum(turned[rows], 1e-12)
    if curves.external.shape[1]:
        pairs = [[z.linear_axes, z.rotating_axes] if z else [0.0, 0.0] for z in zones]
        widths = np.array(pairs).reshape(-1, 2)
        linear = np.array(segments[0].external_linear)
        of_axes = np.where(linear, widths[:, :1], widths[:, 1:])
        share = np.minimum(share, (of_axes / np.maximum(curves.external[rows], 1e-12)).min(axis=1))
    return share


def _zone_on_joint_moves(
    segments: Sequence[Segment],
    curves: Curves,
    kinematics: Kinematics,
    row: npt.NDArray[np.int64],
    position: Array,
    *,
    at_end: bool,
) -> Array:
    """Distance (k,) along joint moves for which the TCP stays within (k,) [m] of the end."""
    moves = [segments[i] for i in row]
    travel = curves.joint_travel[row]
    arms = arms_of(moves, kinematics, travel, np.ones(len(row)))
    corner = (curves.end if at_end else curves.start.translation)[row]

    def distance(share: Array) -> Array:
        """TCP distances (k, j) from the corner at shares (k, j) of the move, counted from it."""
        along = 1.0 - share if at_end else share
        joints = curves.start_joints[row, None] + along[..., None] * travel[:, None]
        number = np.repeat(np.arange(len(row)), share.shape[1])
        tcp = arms.curve_from_tcp(joints.reshape(-1, travel.shape[1]), number).translation
        away: Array = np.linalg.norm(tcp.reshape(*share.shape, 3) - corner[:, None], axis=-1)
        return away

    share = np.broadcast_to(np.linspace(0.0, 0.5, _ZONE_SAMPLES + 1), (len(row), _ZONE_SAMPLES + 1))
    outside = distance(share) > position[:, None]
    leaves = outside.any(axis=1)
    first = np.where(leaves, outside.argmax(axis=1), _ZONE_SAMPLES)
    low = share[0, np.maximum(first - 1, 0)]
    high = share[0, first]
    # The controller itself converts zones of joint moves only to within 10 %.
    for _ in range(_ZONE_ROUNDS):
        step = (high - low) / _ZONE_PARTS
        inner = low[:, None] + step[:, None] * np.arange(1, _ZONE_PARTS)
        # Number of inner points before the first one outside.
        passed = (distance(inner) <= position[:, None]).cumprod(axis=1).sum(axis=1)
        low, high = low + step * passed, low + step * (passed + 1)
    zone: Array = np.where(leaves, low, np.inf) * curves.length[row]
    return zone


def _tool_changes(segments: Sequence[Segment], tcp_from_flange: Transform) -> npt.NDArray[np.bool_]:
    """Mask of the corners, after each segment but the last, that join different tools."""
    rotation, translation = tcp_from_flange.rotation, tcp_from_flange.translation
    other = (rotation[1:] != rotation[:-1]).any(axis=(1, 2))
    other |= (translation[1:] != translation[:-1]).any(axis=1)
    asked = np.array([segment.joint_corner for segment in segments[:-1]], dtype=bool)
    changes: npt.NDArray[np.bool_] = other | asked
    return changes


def describe_stop(limit: Limit) -> str:
    """Reason why the arm stops at a segment end where no corner was planned."""
    return describe(limit, 0.0, 0.0, 0.0, 0.0, stops=True)
