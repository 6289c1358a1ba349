"""The geometry of one block of moves: segments joined by corner paths, as joints over s.

The path does not depend on how fast it is driven. s runs over the programmed segments one after the
other [m] (see `curves`); the middle of a corner path has the s of the programmed point.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.corners import Corner, Corners, Limit, corners_of, describe
from rapidsim.motion.curves import Index, Motion, circle_fault, curves_of
from rapidsim.motion.following import Arms, Nodes, follow, limit_fault
from rapidsim.motion.following import PathFault as PathFault
from rapidsim.motion.kinematics import Kinematics
from rapidsim.motion.layout import Layout, layout_of
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot import Robot
from rapidsim.motion.segments import Geometry, Segment
from rapidsim.motion.turns import cross, rotate

_SINGULAR_DETERMINANT = 1e-8
_SINGULAR_VALUE = 1e-7
_KINK = 1e-6
_CORNER_CHECKS = 8
_GAUSS_PLACES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True, slots=True, eq=False)
class PathPoints:
    """The arm at places of a path."""

    joints: Array
    """Shape (k, n) [rad]."""
    base_from_tcp: Transform
    """Shape (k,); the tool is that of the segment."""
    segment: Index
    """Shape (k,): position in `Path.segments`."""
    tcp_rate: Array
    """Shape (k,): TCP travel per unit of s; below 1 in corners."""


@dataclass(frozen=True, slots=True, eq=False)
class PathRates:
    """Derivatives with respect to s at places of a path."""

    first: Array
    """Shape (k, n): joints [rad/m]."""
    second: Array
    """Shape (k, n): joints [rad/m2]."""
    tcp_rate: Array
    """Shape (k,): TCP travel [m/m]."""
    turn_rate: Array
    """Shape (k,): reorientation [rad/m]."""


@dataclass(frozen=True, eq=False)
class Path:
    """A row of segments with their corners, ready to be timed and evaluated."""

    segments: tuple[Segment, ...]
    kinematics: Kinematics
    layout: Layout
    arms: Arms
    active: Index
    """Shape (m,): position in `segments` of each curve; segments without length have none."""
    nodes: Nodes
    """Joints along the Cartesian curves: they tell whole turns apart."""
    model: MotionModel

    @property
    def length(self) -> float:
        """Range of s [m]."""
        return float(self.layout.places[-1])

    @cached_property
    def segment_starts(self) -> Array:
        """S (segments,) at the middle of the corner before each segment; 0 for the first."""
        lengths = np.zeros(len(self.segments))
        lengths[self.active] = self.layout.curves.length
        return np.concatenate([[0.0], np.cumsum(lengths)[:-1]])

    @cached_property
    def lengths(self) -> Array:
        """TCP travel (segments,) [m] along the programmed curves, before corners cut them."""
        travel = np.zeros(len(self.segments))
        travel[self.active] = self.layout.curves.travel
        return travel

    @property
    def breakpoints(self) -> Array:
        """S of zone edges, middles of corners, and both ends, increasing."""
        return self.layout.bounds

    @cached_property
    def stops(self) -> Array:
        """S where the arm must come to rest between the ends, increasing."""
        corners, places = self.layout.corners, self.layout.places[1:-1]
        sharp = np.flatnonzero(corners.radius == 0.0)
        kinked = np.ones(len(sharp), dtype=bool)
        may_pass = np.flatnonzero(
            (corners.limit[sharp] != Limit.STOP_POINT) & (corners.limit[sharp] != Limit.TURN_ONLY)
        )
        if len(may_pass):
            place = places[sharp[may_pass]]
            after = self.layout.piece_at(place)
            before = np.maximum(after - 1, 0)
            into = self.rates(place, before).first
            out = self.rates(place, after).first
            scale = np.abs(into).max(axis=-1) + np.abs(out).max(axis=-1)
            kinked[may_pass] = np.abs(into - out).max(axis=-1) > _KINK * scale
        stops: Array = places[sharp[kinked]]
        return stops

    @cached_property
    def corners(self) -> tuple[Corner, ...]:
        """What became of the end of each segment."""
        stop = Corner(0.0, in_joints=False, stops=True, reason=describe_stop(Limit.STOP_POINT))
        idle = dataclasses.replace(stop, reason=describe_stop(Limit.NO_LENGTH))
        found = [idle if segment.zone else stop for segment in self.segments]
        found[-1] = stop
        curves, corners = self.layout.curves, self.layout.corners
        stops = np.isin(self.layout.places[1:-1], self.stops)
        for c, i in enumerate(self.active[:-1]):
            zone = self.segments[i].zone
            if zone is None:
                continue
            radius = float(corners.radius[c])
            turned = float(max(curves.angle[c], curves.angle[c + 1]))
            limit = Limit(int(corners.limit[c]))
            found[i] = Corner(
                radius=radius,
                in_joints=bool(corners.in_joints[c]),
                stops=bool(stops[c]),
                reason=describe(
                    limit, zone.position, radius, zone.angle, turned, stops=bool(stops[c])
                ),
            )
        return tuple(found)

    @cached_property
    def acceleration_share(self) -> Array:
        """Share (p,) of the axis accelerations that may be used on each piece."""
        programmed = np.array([segment.acceleration_share for segment in self.segments])
        share: Array = programmed[self.active[self.layout.row]]
        if self.model.corner == "parabola":
            layout = self.layout
            in_zone = np.maximum(layout.orientation_corner, layout.joint_corner) >= 0
            share = np.where(in_zone, share * self.model.parabola_acceleration, share)
        return share

    def evaluate(self, s: Array) -> PathPoints:
        """The arm at places s (k,) [m] of the path, exactly on it."""
        s = np.clip(np.asarray(s, dtype=np.float64), 0.0, self.length)
        piece = self.layout.piece_at(s)
        row = self.layout.row[piece]
        joints = np.empty((len(s), self.kinematics.joint_count))
        position = np.empty((len(s), 3))
        rotation = np.empty((len(s), 3, 3))
        tcp_rate = np.empty(len(s))
        on_curve, in_joints = self._spaces(piece)
        if len(on_curve):
            motion = self.layout.motion(s[on_curve], piece[on_curve])
            near = self._near(s[on_curve])
            joints[on_curve] = self.arms.joints(motion, row[on_curve], near)[0]
            position[on_curve], rotation[on_curve] = motion.position, motion.rotation
            tcp_rate[on_curve] = np.linalg.norm(motion.velocity, axis=-1)
        if len(in_joints):
            at, first, _ = self._in_joint_space(s[in_joints], piece[in_joints])
            joints[in_joints] = at
            base_from_tcp = self._base_from_tcp(at, row[in_joints])
            position[in_joints] = base_from_tcp.translation
            rotation[in_joints] = base_from_tcp.rotation
            velocity, _ = self._tcp_twist(at, first, row[in_joints])
            tcp_rate[in_joints] = np.linalg.norm(velocity, axis=-1)
        return PathPoints(joints, Transform(rotation, position), self.active[row], tcp_rate)

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Derivatives at places s (k,) of pieces (k,); at breakpoints those of the piece's side."""
        row = self.layout.row[piece]
        first = np.empty((len(s), self.kinematics.joint_count))
        second = np.empty_like(first)
        velocity = np.empty((len(s), 3))
        turning = np.empty((len(s), 3))
        on_curve, in_joints = self._spaces(piece)
        if len(on_curve):
            motion = self.layout.motion(s[on_curve], piece[on_curve])
            near = self._near(s[on_curve])
            _, first[on_curve], second[on_curve] = self._inverse(motion, row[on_curve], near)
            velocity[on_curve], turning[on_curve] = motion.velocity, motion.turning
        if len(in_joints):
            at, d1, d2 = self._in_joint_space(s[in_joints], piece[in_joints])
            first[in_joints], second[in_joints] = d1, d2
            velocity[in_joints], turning[in_joints] = self._tcp_twist(at, d1, row[in_joints])
        return PathRates(
            first, second, np.linalg.norm(velocity, axis=-1), np.linalg.norm(turning, axis=-1)
        )

    def travelled(self, s: Array) -> Array:
        """TCP travel (k,) [m] from the start of the path to places s (k,), corners cut."""
        s = np.clip(np.asarray(s, dtype=np.float64), 0.0, self.length)
        piece = self.layout.piece_at(s)
        start = self.layout.bounds[piece]
        whole = np.concatenate([[0.0], np.cumsum(self._piece_travel)])
        part: Array = whole[piece] + self._travel(start, s, piece)
        return part

    @cached_property
    def _piece_travel(self) -> Array:
        bounds = self.layout.bounds
        return self._travel(bounds[:-1], bounds[1:], np.arange(len(bounds) - 1))

    def _travel(self, start: Array, end: Array, piece: Index) -> Array:
        """TCP travel (k,) [m] from start to end (k,) within pieces (k,), by Gauss's quadrature."""
        half = 0.5 * (end - start)
        s = (start + half)[:, None] + half[:, None] * _GAUSS_PLACES
        on_curve, in_joints = self._spaces(piece)
        rate = np.empty_like(s)
        count = len(_GAUSS_PLACES)
        if len(on_curve):
            motion = self.layout.motion(s[on_curve].ravel(), np.repeat(piece[on_curve], count))
            rate[on_curve] = np.linalg.norm(motion.velocity, axis=-1).reshape(-1, count)
        if len(in_joints):
            pieces = np.repeat(piece[in_joints], count)
            at, first, _ = self._in_joint_space(s[in_joints].ravel(), pieces)
            velocity, _ = self._tcp_twist(at, first, self.layout.row[pieces])
            rate[in_joints] = np.linalg.norm(velocity, axis=-1).reshape(-1, count)
        travel: Array = half * (rate @ _GAUSS_WEIGHTS)
        return travel

    def _spaces(self, piece: Index) -> tuple[Index, Index]:
        """Which of some pieces (k,) are made in Cartesian space and which in joint space."""
        joint = self.layout.curves.in_joints[self.layout.row[piece]]
        joint = joint | (self.layout.joint_corner[piece] >= 0)
        return np.flatnonzero(~joint), np.flatnonzero(joint)

    def _near(self, s: Array) -> Array:
        """Joints (k, n) close to those at places (k,) of Cartesian curves."""
        nodes = self.nodes
        return np.stack(
            [np.interp(s, nodes.s, nodes.joints[:, j]) for j in range(nodes.joints.shape[1])],
            axis=-1,
        )

    def _in_joint_space(self, s: Array, piece: Index) -> tuple[Array, Array, Array]:
        """Joints and derivatives (k, n) on joint moves and in corners made in joint space."""
        row = self.layout.row[piece]
        corner = self.layout.joint_corner[piece]
        joints, first, second = self._on_curve(row, s - self.layout.places[row])
        cut = np.flatnonzero(corner >= 0)
        if len(cut):
            at = corner[cut]
            before, after = self.layout.sides(at, self.layout.corners.radius[at], s[cut])
            into = self._on_curve(at, before[0])
            out = self._on_curve(at + 1, after[0])
            joints[cut] = into[0] + out[0] - self.layout.curves.start_joints[at + 1]
            first[cut] = into[1] * before[1][:, None] + out[1] * after[1][:, None]
            second[cut] = (
                into[2] * before[1][:, None] ** 2
                + into[1] * before[2][:, None]
                + out[2] * after[1][:, None] ** 2
                + out[1] * after[2][:, None]
            )
        return joints, first, second

    def _on_curve(self, row: Index, x: Array) -> tuple[Array, Array, Array]:
        """Joints and derivatives (k, n) at places x (k,) of programmed curves (k,)."""
        curves = self.layout.curves
        x = np.clip(x, 0.0, curves.length[row])
        joints = curves.joints_at(row, x)
        first = curves.joint_travel[row] / np.maximum(curves.length[row], 1e-9)[:, None]
        second = np.zeros_like(joints)
        line = np.flatnonzero(~curves.in_joints[row])
        if len(line):
            motion = curves.at(row[line], x[line])
            near = self._near(self.layout.places[row[line]] + x[line])
            joints[line], first[line], second[line] = self._inverse(motion, row[line], near)
        return joints, first, second

    def _inverse(self, motion: Motion, row: Index, near: Array) -> tuple[Array, Array, Array]:
        """Joints (k, n) of a TCP motion (k,) on curves (k,) and their derivatives."""
        joints, _ = self.arms.joints(motion, row, near)
        lever = rotate(
            motion.rotation, self.arms.tcp_from_flange.translation[row]
        )  # from the TCP to the flange, in base
        swing = cross(motion.turning, lever)
        twist = np.concatenate([motion.velocity + swing, motion.turning], axis=-1)
        change = np.concatenate(
            [
                motion.acceleration
                + cross(motion.turning_change, lever)
                + cross(motion.turning, swing),
                motion.turning_change,
            ],
            axis=-1,
        )
        jacobian = self.kinematics.jacobian(joints)
        first = _solve(jacobian, twist)
        # J' q' as the change of the Jacobian along the motion, over a step of 1e-6 rad: the error
        # of both the difference and the rounding is far below what timing can see.
        step = 1e-6 / np.maximum(np.abs(first).max(axis=-1), 1e-9)[:, None]
        ahead = self.kinematics.jacobian(joints + step * first)
        drift = np.einsum("kij,kj->ki", (ahead - jacobian) / step[..., None], first)
        second = _solve(jacobian, change - drift)
        return joints, first, second

    def _base_from_tcp(self, joints: Array, row: Index) -> Transform:
        flange_from_tcp = self.arms.tcp_from_flange[row].inverse()
        return self.kinematics.forward(joints) @ flange_from_tcp

    def _tcp_twist(self, joints: Array, first: Array, row: Index) -> tuple[Array, Array]:
        """Velocity and angular velocity (k, 3) of the TCP per unit of s."""
        twist = np.einsum("kij,kj->ki", self.kinematics.jacobian(joints), first)
        flange = self.kinematics.forward(joints)
        tcp_in_flange = self.arms.tcp_from_flange[row].inverse().translation
        lever = rotate(flange.rotation, tcp_in_flange)  # from the flange to the TCP, in base
        return twist[:, :3] + cross(twist[:, 3:], lever), twist[:, 3:]


def build_path(robot: Robot, segments: Sequence[Segment], model: MotionModel) -> Path | PathFault:
    """Join segments to a path.

    Args:
        robot: The arm with its joint limits.
        segments: At least one; each starts with the joints that the one before ends with, and has
            speeds above zero.
        model: Shape of corners.

    Returns:
        The path, or the first place where the arm cannot follow it.
    """
    kinematics, lower, upper = robot.kinematics, robot.lower, robot.upper
    for i, segment in enumerate(segments):
        reason = circle_fault(segment) or _unsupported(kinematics, segment)
        if reason is not None:
            return PathFault(i, 0.0, 0.0, 0.0, reason)
    curves = curves_of(segments, kinematics)
    active = np.flatnonzero(curves.length > 0.0).astype(np.int64)
    if not len(active):
        active = np.zeros(1, dtype=np.int64)
    moving = [segments[int(i)] for i in active]
    if len(active) < len(segments):
        curves = curves_of(moving, kinematics)
    corners = corners_of(moving, curves, kinematics, model)
    corners = _without_skipped(corners, active)
    layout = layout_of(curves, corners, model.corner)
    arms = Arms(
        kinematics,
        np.array([segment.branch for segment in moving]),
        Transform(
            np.array([segment.tcp_from_flange.rotation for segment in moving]),
            np.array([segment.tcp_from_flange.translation for segment in moving]),
        ),
    )
    nodes = follow(layout, arms, moving, lower, upper)
    if isinstance(nodes, PathFault):
        return dataclasses.replace(nodes, segment=int(active[nodes.segment]))
    path = Path(tuple(segments), kinematics, layout, arms, active, nodes, model)
    fault = _joint_space_fault(path, lower, upper)
    if fault is not None:
        return dataclasses.replace(fault, segment=int(active[fault.segment]))
    return path


def describe_stop(limit: Limit) -> str:
    """Why the arm stops where no corner was looked for."""
    return describe(limit, 0.0, 0.0, 0.0, 0.0, stops=True)


def _unsupported(kinematics: Kinematics, segment: Segment) -> str | None:
    if segment.geometry is not Geometry.JOINT and kinematics.joint_count > 6:
        return "lines and arcs of arms with more than six axes are not simulated"
    return None


def _without_skipped(corners: Corners, active: Index) -> Corners:
    """Take the corner paths away where a segment without length lies in between."""
    skipped = np.diff(active) > 1
    return dataclasses.replace(
        corners,
        radius=np.where(skipped, 0.0, corners.radius),
        orientation_radius=np.where(skipped, 0.0, corners.orientation_radius),
        limit=np.where(
            skipped & (corners.limit != Limit.STOP_POINT), Limit.NO_LENGTH, corners.limit
        ).astype(np.int64),
    )


def _joint_space_fault(path: Path, lower: Array, upper: Array) -> PathFault | None:
    """Where a joint move or a corner made in joint space leaves the limits."""
    layout = path.layout
    pieces = np.flatnonzero(
        layout.curves.in_joints[layout.row] | (layout.joint_corner >= 0)
    ).astype(np.int64)
    if not len(pieces):
        return None
    share = np.linspace(0.0, 1.0, _CORNER_CHECKS + 1)
    width = np.diff(layout.bounds)[pieces]
    s = (layout.bounds[pieces][:, None] + width[:, None] * share).ravel()
    piece = np.repeat(pieces, len(share))
    joints, _, _ = path._in_joint_space(s, piece)
    return limit_fault(layout, s, layout.row[piece], joints, lower, upper)


def _solve(jacobian: Array, twist: Array) -> Array:
    """Joint rates (k, n) of twists (k, 6); the smallest ones where the arm is singular."""
    rates = np.empty((len(twist), jacobian.shape[-1]))
    regular = np.zeros(len(twist), dtype=bool)
    if jacobian.shape[-1] == 6:
        regular = np.abs(np.linalg.det(jacobian)) > _SINGULAR_DETERMINANT
        rates[regular] = np.linalg.solve(jacobian[regular], twist[regular][..., None])[..., 0]
    if not regular.all():
        inverse = np.linalg.pinv(jacobian[~regular], rcond=_SINGULAR_VALUE)
        rates[~regular] = np.einsum("kij,kj->ki", inverse, twist[~regular])
    return rates
