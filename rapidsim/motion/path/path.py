"""Geometry of one block of moves: segments joined by corner paths, as joints over s.

The path does not depend on its speed. s runs over the programmed segments one after the other [m]
(see `curves`); the middle of a corner path has the s of the programmed point.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rapidsim.frames.moving_frames import ExternalCourse
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.derived_values import derived_value
from rapidsim.motion.geometry.blends import (
    Corner,
    Limit,
    describe,
    describe_stop,
)
from rapidsim.motion.geometry.curves import STANDSTILL, Index
from rapidsim.motion.geometry.joint_mapping import JointMapper
from rapidsim.motion.geometry.parameterisation import PathParameterisation
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.motion.kinematics.unwrapping import in_turn_of
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.along_curves import NodeJoints
from rapidsim.motion.path.belt_offsets import BeltOffsets, belt_offsets
from rapidsim.motion.path.joints_on_path import JointsOnPath, in_joint_space, joints_at_corners
from rapidsim.motion.path.line_derivatives import Lines
from rapidsim.motion.path.nominal_times import NominalTimes, nominal_times
from rapidsim.motion.path.path_derivatives import PathPoints, PathRates, norms
from rapidsim.motion.path.segment_columns import (
    SegmentLimits,
    programmed_of,
    ramp_window,
    widths_of,
)

_KINK = 1e-6
_WHILE_WIDENING = 0.9
"""Share of the accelerations that reserves a margin for a widening window; measured on random
programs."""
_GAUSS_PLACES, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(8)


@dataclass(frozen=True, eq=False)
class Path:
    """A sequence of segments with their corners, ready to be timed and evaluated."""

    segments: Sequence[Segment]
    kinematics: Kinematics
    layout: PathParameterisation
    arms: JointMapper
    active: Index
    """Shape (m,): index in `segments` of each curve; segments without length have none."""
    nodes: NodeJoints
    """Joints along the Cartesian curves, which determine whole turns."""
    model: MotionModel
    lines: Lines | None
    """Lines with closed-form joints and derivatives; None if there are none."""

    @property
    def parts(self) -> tuple[Path, ...]:
        """Path of each robot, over the parameter of this one; of a robot alone, this one."""
        return (self,)

    @property
    def axis_count(self) -> int:
        """Number of joints of the arm and external axes."""
        return int(self.layout.curves.start_joints.shape[1])

    @property
    def own_axis_count(self) -> int:
        """Number of joints and external axes, without axes of robots that carry work objects."""
        led = self.segments[0].carrier_axes
        return self.axis_count - (0 if led is None else len(led[0]))

    @property
    def length(self) -> float:
        """Range of s [m]."""
        return float(self.layout.places[-1])

    @cached_property
    def programmed(self) -> SegmentLimits:
        """Limits requested by each segment."""
        return programmed_of(self.segments)

    @derived_value
    def segment_starts(self) -> Array:
        """Parameters s (segments,) at the middle of the corner before each segment, first 0."""
        lengths = np.zeros(len(self.segments))
        lengths[self.active] = self.layout.curves.length
        return np.concatenate([[0.0], np.cumsum(lengths)[:-1]])

    @derived_value
    def segment_bounds(self) -> Array:
        """`segment_starts`, followed by the end of the path: s (segments + 1,)."""
        return np.append(self.segment_starts, self.length)

    @cached_property
    def belts(self) -> BeltOffsets | None:
        """Offsets of the arm from the path; None if it follows no belt."""
        if not any(segment.rides for segment in self.segments):
            return None
        return belt_offsets(self.segments, self.segment_bounds)

    @derived_value
    def lengths(self) -> Array:
        """TCP travel (segments,) [m] along the programmed curves, before corners cut them."""
        travel = np.zeros(len(self.segments))
        travel[self.active] = self.layout.curves.travel
        return travel

    @property
    def nominal(self) -> NominalTimes:
        """Times of the segments at the programmed speeds."""
        return nominal_times(self.segments, self.layout.curves, self.active)

    @property
    def slowest(self) -> Index | None:
        """Robot (segments,) that sets the nominal time of each segment; None for a robot alone."""
        return None

    @property
    def fastest_rate(self) -> float:
        """Upper bound of the TCP travel per unit of s, apart from turning and joint moves."""
        return 1.0

    @property
    def breakpoints(self) -> Array:
        """Parameter s of zone edges, middles of corners, and both ends, ascending."""
        return self.layout.bounds

    @cached_property
    def stops(self) -> Array:
        """Parameter s of the stops between the ends, where the arm must come to rest, ascending."""
        corners, places = self.layout.corners, self.layout.places[1:-1]
        sharp = np.flatnonzero(corners.radius == 0.0)
        kinked = np.ones(len(sharp), dtype=bool)
        may_pass = np.flatnonzero(
            (corners.limit[sharp] != Limit.STOP_POINT)
            & (corners.limit[sharp] != Limit.TURN_ONLY)
            # A shared parameter is computed before it is known whether the arm could pass.
            & (self.layout.carrier_axes is None)
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

    @derived_value
    def corners(self) -> tuple[Corner, ...]:
        """Planned corner at the end of each segment."""
        stop = Corner(0.0, in_joints=False, stops=True, reason=describe_stop(Limit.STOP_POINT))
        idle = dataclasses.replace(stop, reason=describe_stop(Limit.NO_LENGTH))
        found = [idle if segment.zone else stop for segment in self.segments]
        found[-1] = stop
        curves, corners = self.layout.curves, self.layout.corners
        angle, straight = curves.angle, curves.in_joints
        rows = zip(
            self.active[:-1].tolist(),
            corners.radius.tolist(),
            np.maximum(angle[:-1], angle[1:]).tolist(),
            corners.limit.tolist(),
            corners.in_joints.tolist(),
            (corners.in_joints & ~(straight[:-1] & straight[1:])).tolist(),
            curves.turns_only[:-1].tolist(),
            (curves.turned[:-1] * corners.radius / np.maximum(curves.length[:-1], 1e-12)).tolist(),
            np.isin(self.layout.places[1:-1], self.stops).tolist(),
            strict=True,
        )
        limits, texts = tuple(Limit), dict[str, str]()
        for i, radius, turned, limit, in_joints, bridges, turns_only, turn, stops in rows:
            zone = self.segments[i].zone
            if zone is not None:
                reason = describe(
                    limits[limit], zone.position, radius, zone.angle, turned, stops=stops
                )
                if bridges and not stops:
                    # A change of tool, work object or kind of move.
                    reason = "; ".join(filter(None, (reason, "made in joint space")))
                if turns_only and not stops and turn > STANDSTILL:
                    # There the path parameter is not a length.
                    reason = f"within {math.degrees(turn):.3g} deg of the end"
                # Many corners have the same reason, whose text is shared.
                reason = texts.setdefault(reason, reason)
                found[i] = Corner(0.0 if turns_only else radius, in_joints, stops, reason)
        return tuple(found)

    @cached_property
    def window(self) -> float:
        """Width [s] of the smoothing window, the widest required by a ramp of one of the moves."""
        return self.windows[-1]

    @cached_property
    def windows(self) -> tuple[float, ...]:
        """Widths [s] of the smoothing window, ascending: one, or a few while it widens."""
        return widths_of(self.segments, self.model.window)

    @derived_value
    def ramp_windows(self) -> Array:
        """Widths (segments,) [s] of the windows over which ramps average the speed; 0 if none."""
        return np.array([ramp_window(one.ramp, self.model.window) for one in self.segments])

    @derived_value
    def zone_radius(self) -> Array:
        """Radius (p,) [m] of the zone that contains each piece; 0 outside zones."""
        layout = self.layout
        radius = np.zeros(len(layout.row))
        of_position = np.maximum(layout.position_corner, layout.joint_corner)
        turning = layout.orientation_corner, layout.corners.orientation_radius
        for corner, radii in (turning, (of_position, layout.corners.radius)):
            within = np.flatnonzero(corner >= 0)
            radius[within] = radii[corner[within]]
        return radius

    @property
    def zone_extent(self) -> Array:
        """Radius (p,) of the zone that contains each piece, in units of s."""
        return self.zone_radius

    @derived_value
    def zone_speed(self) -> Array:
        """Maximum speed (p,) [m/s] of the command: a zone takes at least an interpolation cycle.

        Infinite outside zones. Source: logs of z1 at 1000 mm/s and above, also without a change of
        direction.
        """
        layout = self.layout
        corner = np.maximum(layout.position_corner, layout.joint_corner)
        fastest = np.full(len(corner), np.inf)
        if self.model.cycle > 0.0:
            within = np.flatnonzero(corner >= 0)
            fastest[within] = 2.0 * layout.corners.radius[corner[within]] / self.model.cycle
        return fastest

    @derived_value
    def acceleration_share(self) -> Array:
        """Share (p,) of the axis accelerations that is available on each piece."""
        programmed = self.programmed.acceleration_share
        share: Array = programmed[self.active[self.layout.row]]
        if self.model.corner == "parabola":
            share = np.where(
                self.layout.in_corner >= 0, share * self.model.parabola_acceleration, share
            )
        if self.model.slows_for_bends and len(self.windows) > 1:
            share = share * _WHILE_WIDENING
        return share

    def segment_of(self, piece: Index) -> Index:
        """Return the index (k,) in `segments` of pieces (k,)."""
        segment: Index = self.active[self.layout.row[piece]]
        return segment

    @cached_property
    def joints_on(self) -> JointsOnPath:
        """Inverse kinematics of the path."""
        return JointsOnPath(self.layout, self.arms, self.nodes, self.lines)

    def joints_at(self, s: Array, *, quick: bool = False) -> Array:
        """Return joints, followed by external axes, (k, n + e) at s (k,) [m]; see `joints_on`."""
        return self.joints_on.at(np.clip(s, 0.0, self.length), quick=quick)

    def evaluate(self, s: Array) -> PathPoints:
        """Return the arm at s (k,) [m], exactly on the path."""
        s = np.clip(np.asarray(s, dtype=np.float64), 0.0, self.length)
        piece = self.layout.piece_at(s)
        row = self.layout.row[piece]
        joints = np.empty((len(s), self.axis_count))
        position = np.empty((len(s), 3))
        rotation = np.empty((len(s), 3, 3))
        tcp_rate = np.empty(len(s))
        on_curve, in_joints = self.joints_on.spaces(piece)
        if len(on_curve):
            motion, joints[on_curve] = self.joints_on.in_space(s[on_curve], piece[on_curve])
            position[on_curve], rotation[on_curve] = motion.position, motion.rotation
            tcp_rate[on_curve] = np.linalg.norm(motion.velocity, axis=-1)
        if len(in_joints):
            at_joints, first, _ = self._in_joint_space(s[in_joints], piece[in_joints])
            joints[in_joints] = at_joints
            velocity, _ = self._tcp_twist(at_joints, first, row[in_joints])
            tcp_rate[in_joints] = np.linalg.norm(velocity, axis=-1)
        elsewhere = np.union1d(in_joints, np.flatnonzero(self.arms.carried_rows[row]))
        if len(elsewhere):
            base_from_tcp = self.arms.base_from_tcp(joints[elsewhere], row[elsewhere])
            position[elsewhere] = base_from_tcp.translation
            rotation[elsewhere] = base_from_tcp.rotation
        arm, external = np.split(joints, [self.kinematics.joint_count], axis=1)
        pose = Transform(rotation, position)
        return PathPoints(arm, external, pose, self.active[row], tcp_rate)

    def nearby_state(
        self, s: Array, joints: Array, rates: Array, speed: Array
    ) -> tuple[Transform, Index, Array]:
        """Return the arm for joints and rates (k, n + e) close to, but not equal to, those at s.

        Args:
            s: Path parameters [m].
            joints: Joints and external axes.
            rates: Their derivatives by time.
            speed: Rate of change (k,) of s [m/s].

        Returns:
            base_from_tcp, index in `segments`, and the speed of the TCP relative to the work
            object.
        """
        del speed
        row = self._row_at(s)
        velocity = self.arms.curve_motion(joints, rates, row).velocity
        tcp_speed: Array = np.linalg.norm(velocity, axis=-1)
        return self.arms.base_from_tcp(joints, row), self.active[row], tcp_speed

    def segment_at(self, s: Array) -> Index:
        """Return the index in `segments` at s (k,)."""
        return self.active[self._row_at(s)]

    def _row_at(self, s: Array) -> Index:
        return self.layout.row[self.layout.piece_at(np.clip(s, 0.0, self.length))]

    def rates(self, s: Array, piece: Index) -> PathRates:
        """Return derivatives at s (k,) on pieces (k,); at breakpoints, `piece` selects the side."""
        if self.lines is None:
            return self._rates_in_general(s, piece)
        rates, holds = self.lines.rates(s, piece)
        others = np.flatnonzero(~holds)
        if len(others):
            rates.put(others, self._rates_in_general(s[others], piece[others]))
        return rates

    def _rates_in_general(self, s: Array, piece: Index) -> PathRates:
        """Return derivatives for any arm and curve, without closed formulas."""
        row = self.layout.row[piece]
        joints, first, second = np.empty((3, len(s), self.axis_count))
        on_curve, in_joints = self.joints_on.spaces(piece)
        speeds = np.empty((len(s), 2))
        if len(on_curve):
            motion = self.layout.motion(s[on_curve], piece[on_curve])
            course = self.layout.course(s[on_curve], piece[on_curve])
            near = self.joints_on.near(s[on_curve], course.value)
            joints[on_curve], first[on_curve], second[on_curve] = self.arms.rates(
                motion, row[on_curve], course, near
            )
            speeds[on_curve] = norms(motion.velocity, motion.turning)
        if len(in_joints):
            at, d1, d2 = self._in_joint_space(s[in_joints], piece[in_joints])
            joints[in_joints], first[in_joints], second[in_joints] = at, d1, d2
            speeds[in_joints] = norms(*self._tcp_twist(at, d1, row[in_joints]))
            # With a wrist pair, the speed is that of the point on the circle, not of the TCP.
            led = self.arms.pair_rows[row] & (self.layout.joint_corner[piece] < 0)
            speeds[led, 0] = 1.0
        stance = self.kinematics.stance(joints[:, : self.kinematics.joint_count])
        return PathRates(first, second, speeds[:, 0], speeds[:, 1], stance)

    def tcp_derivatives(self, s: Array, piece: Index) -> tuple[Array, Array]:
        """Return both derivatives (k, 3) of the TCP's position at s (k,) on pieces (k,)."""
        velocity = np.empty((len(s), 3))
        acceleration = np.empty((len(s), 3))
        on_curve, in_joints = self.joints_on.spaces(piece)
        if len(on_curve):
            motion = self.layout.motion(s[on_curve], piece[on_curve])
            velocity[on_curve], acceleration[on_curve] = motion.velocity, motion.acceleration
        if len(in_joints):
            row = self.layout.row[piece[in_joints]]
            at, d1, d2 = self._in_joint_space(s[in_joints], piece[in_joints])
            now, _ = self._tcp_twist(at, d1, row)
            # The step is 1e-6 rad, as for the joints' own second derivative.
            step = 1e-6 / np.maximum(np.abs(d1).max(axis=-1), 1e-9)[:, None]
            ahead, _ = self._tcp_twist(at + step * d1, d1 + step * d2, row)
            velocity[in_joints], acceleration[in_joints] = now, (ahead - now) / step
        return velocity, acceleration

    def travelled(self, s: Array) -> Array:
        """Return the TCP travel (k,) [m] from the start of the path to s (k,), with corners cut."""
        s = np.clip(np.asarray(s, dtype=np.float64), 0.0, self.length)
        piece = self.layout.piece_at(s)
        start = self.layout.bounds[piece]
        whole = np.concatenate([[0.0], np.cumsum(self._piece_travel)])
        part: Array = whole[piece] + self._travel(start, s, piece)
        return part

    @derived_value
    def _piece_travel(self) -> Array:
        bounds = self.layout.bounds
        return self._travel(bounds[:-1], bounds[1:], np.arange(len(bounds) - 1))

    def _travel(self, start: Array, end: Array, piece: Index) -> Array:
        """Return the TCP travel (k,) [m] from start to end (k,) in pieces, by Gauss quadrature."""
        half = 0.5 * (end - start)
        s = (start + half)[:, None] + half[:, None] * _GAUSS_PLACES
        on_curve, in_joints = self.joints_on.spaces(piece)
        rate = np.empty_like(s)
        if len(on_curve):
            rate[on_curve] = self.layout.speeds(s[on_curve], piece[on_curve])
        if len(in_joints):
            pieces = np.repeat(piece[in_joints], len(_GAUSS_PLACES))
            at, first, _ = self._in_joint_space(s[in_joints].ravel(), pieces)
            velocity, _ = self._tcp_twist(at, first, self.layout.row[pieces])
            rate[in_joints] = np.linalg.norm(velocity, axis=-1).reshape(-1, len(_GAUSS_PLACES))
        travel: Array = half * (rate @ _GAUSS_WEIGHTS)
        return travel

    def _in_joint_space(self, s: Array, piece: Index) -> tuple[Array, Array, Array]:
        """Return joints and derivatives (k, n) on joint moves and in corners in joint space."""
        places = in_joint_space(self.layout, s, piece)
        whole, cut = places.all_rows, places.cut
        on_curves = self._on_curve(places.row, places.x)
        own, into, out = zip(*(places.split(part) for part in on_curves), strict=True)
        joints, first, second = np.empty((3, len(s), self.axis_count))
        joints[whole], first[whole], second[whole] = own
        meet, passing, bending = joints_at_corners(
            self.layout, places.corner, s[cut], lambda row, x: self._on_curve(row, x)[0]
        )
        joints[cut] = into[0] + out[0] - meet
        (before, before2), (after, after2) = (
            (rate[:, None], change[:, None]) for rate, change in places.rates
        )
        first[cut] = into[1] * before + out[1] * after - passing
        second[cut] = into[2] * before**2 + into[1] * before2 + out[2] * after**2 + out[1] * after2
        second[cut] -= bending
        self.layout.fill_carrier_axes(s, piece, joints, first, second)
        return joints, first, second

    def _on_curve(self, row: Index, x: Array) -> tuple[Array, Array, Array]:
        """Return joints and derivatives (k, n) at positions x (k,) of programmed curves (k,)."""
        curves = self.layout.curves
        x = np.clip(x, 0.0, curves.length[row])
        joints = curves.joints_at(row, x)
        first = curves.joint_travel[row] / np.maximum(curves.length[row], 1e-9)[:, None]
        second = np.zeros_like(joints)
        line = np.flatnonzero(~curves.in_joints[row])
        if len(line):
            n = self.kinematics.joint_count
            course = ExternalCourse(joints[line, n:], first[line, n:], second[line, n:])
            s = self.layout.places[row[line]] + x[line]
            self.layout.fill_carrier_axes(s, self.layout.piece_at(s), *course)
            joints[line], first[line], second[line] = self._on_tcp_curve(row[line], x[line], course)
        return joints, first, second

    def _on_tcp_curve(
        self, row: Index, x: Array, course: ExternalCourse
    ) -> tuple[Array, Array, Array]:
        """Return joints and derivatives (k, n) on Cartesian curves; `course` of external axes."""
        s = self.layout.places[row] + x
        near = self.joints_on.near(s, course.value)
        if self.lines is None:
            return self.arms.rates(self.layout.curves.at(row, x), row, course, near)
        rates, holds = self.lines.alone.rates(s, row)
        joints, first, second = self.lines.alone.joints(s, row)[0], rates.first, rates.second
        joints = in_turn_of(joints, holds, near)
        others = np.flatnonzero(~holds)
        if len(others):
            joints[others], first[others], second[others] = self.arms.rates(
                self.layout.curves.at(row[others], x[others]),
                row[others],
                ExternalCourse(*(values[others] for values in course)),
                near[others],
            )
        return joints, first, second

    def _tcp_twist(self, joints: Array, first: Array, row: Index) -> tuple[Array, Array]:
        """Return (angular) velocity (k, 3) of the TCP against its curve per unit of s."""
        motion = self.arms.curve_motion(joints, first, row)
        return motion.velocity, motion.turning
