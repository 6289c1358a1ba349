"""Plan of a trajectory through points: its path, profile and speeds, and a sphere to avoid.

Converts a `Plan` and points to curves with time laws, or a joint polynomial, before IK.
"""

from __future__ import annotations

from enum import StrEnum
from itertools import pairwise
from math import pi

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.waypoints.curves import Curve, SplineCurve, StraightLine
from rapidsim.motion.waypoints.keep_out_sphere import ThroughBaseError, around, nearest
from rapidsim.motion.waypoints.piecewise_polynomials import Piecewise
from rapidsim.motion.waypoints.points import Points, turn
from rapidsim.motion.waypoints.quintic import quintics
from rapidsim.motion.waypoints.spline import spline
from rapidsim.motion.waypoints.velocity_profiles import Profile, law
from rapidsim.values import value_class

_NOTHING = 1e-12
"""Length [m] below which a section takes no time."""


class Way(StrEnum):
    """Kind of path between points."""

    LINE = "line"
    """Straight, with a stop at each point."""
    SPLINE = "spline"
    """One smooth curve of the TCP through all points, with stops only at its ends."""
    JOINT = "joint"
    """All joints linear, with a stop at each point, as with MoveJ."""
    JOINT_QUINTIC = "joint-quintic"
    """Joint polynomials of degree 5 with specified speeds and accelerations at the points."""

    @property
    def of_tcp(self) -> bool:
        """Whether the path is defined for the TCP, else for the joints."""
        return self in (Way.LINE, Way.SPLINE)


@value_class(frozen=True, slots=True)
class Plan:
    """A requested trajectory."""

    kind: Way = Way.LINE
    profile: Profile = Profile.TRAPEZOID
    speed: float = 0.1
    """Maximum speed of the TCP [m/s]; in joint space it determines the time between points."""
    acceleration: float = 1.0
    """Maximum acceleration along the path [m/s2]."""
    turn_speed: float = 0.5 * pi
    """Rotation speed [rad/s]; determines the time if the TCP turns more than it travels."""
    ease: float = 0.2
    """Share of the time at rest at either end of the sigmoid."""
    least_radius: float = 0.0
    """Minimum distance [m] of the TCP from the origin of the base; 0 for none."""
    avoid: bool = False
    """Whether lines are routed around the sphere of that radius, else refused. Points must be
    outside; `keep_out_sphere.pushed_out` moves them."""


@value_class(frozen=True, slots=True)
class Refused:
    """Refusal of a trajectory, with the reason."""

    message: str
    help: str | None = None
    segment: int | None = None
    """Index of the point before the affected section, from 0; None if no section is affected."""
    other_branches: tuple[tuple[tuple[int, ...], str | None], ...] = ()
    """Other configurations at the first point as confdata, with the reason why each does not follow
    the whole path; None if it does."""


@value_class(frozen=True, slots=True, eq=False)
class TcpMotion:
    """Sequence of curves of the TCP, each from rest to rest."""

    curves: tuple[Curve, ...]
    laws: tuple[Piecewise, ...]
    owner: npt.NDArray[np.int64]
    """Shape (m,): point at which the section of each curve begins."""

    @property
    def starts(self) -> Array:
        """Start times of the curves, and the end of the last, (m + 1,) [s]."""
        return np.concatenate([[0.0], np.cumsum([law.end for law in self.laws])])

    @property
    def travel(self) -> float:
        """Distance travelled by the TCP [m]."""
        return float(sum(curve.travel for curve in self.curves))

    @property
    def peak_speed(self) -> float:
        """Maximum speed of the TCP [m/s]."""
        return max(
            float(law.peak(1)[0]) * curve.travel / curve.length
            for law, curve in zip(self.laws, self.curves, strict=True)
        )

    def at(self, times: Array) -> tuple[Transform, npt.NDArray[np.int64]]:
        """Return base_from_tcp (k,) at times (k,) [s], and the point at which the curve begins."""
        starts = self.starts
        row = np.clip(np.searchsorted(starts, times, side="right") - 1, 0, len(self.curves) - 1)
        rotations = np.empty((len(times), 3, 3))
        positions = np.empty((len(times), 3))
        segment = self.owner[row]
        for number in np.unique(row).tolist():
            at = np.flatnonzero(row == number)
            curve = self.curves[number]
            place = self.laws[number].at(times[at] - starts[number])[:, 0]
            place = np.clip(place, 0.0, curve.length)
            pose = curve.at(place)
            rotations[at], positions[at] = pose.rotation, pose.translation
            if isinstance(curve, SplineCurve):
                segment[at] = curve.positions.piece(curve.parameter(place))
        return Transform(rotations, positions), segment


def tcp_motion(points: Points, attitudes: Array, plan: Plan) -> TcpMotion | Refused:
    """Return the motion of the TCP for a plan of kind `LINE` or `SPLINE`.

    Args:
        points: Two or more points.
        attitudes: Attitude at each point, (k, 4) or (k, 1).
        plan: The requested trajectory.
    """
    if plan.kind is Way.SPLINE:
        made = _spline_curve(points, attitudes)
        if isinstance(made, Refused):
            return made
        curves: list[tuple[int, Curve]] = [(0, made)]
    else:
        curves = [*_lines(points.positions, attitudes, plan)]
    kept = _kept_out(points, curves, plan)
    if isinstance(kept, Refused):
        return kept
    if not kept:
        return Refused("all points are the same: there is no path to follow")
    laws = tuple(
        law(plan.profile, curve.length, plan.speed, plan.acceleration, plan.ease)
        for _, curve in kept
    )
    owner = np.array([number for number, _ in kept], dtype=np.int64)
    return TcpMotion(tuple(curve for _, curve in kept), laws, owner)


@value_class(frozen=True, slots=True, eq=False)
class JointsOverTime:
    """Joints as a function of time."""

    trajectory: Piecewise
    """n components [rad] of the time [s]."""
    passed: Array
    """Time [s] at which each point is passed, (k,)."""


def quintic_motion(points: Points, joints: Array, plan: Plan) -> JointsOverTime | Refused:
    """Return the motion of the joints for a plan of kind `JOINT_QUINTIC`.

    Args:
        points: Two or more points.
        joints: Joints at each point, (k, n) [rad].
        plan: The requested trajectory.
    """
    times = points.times
    if times is None:
        chord = np.linalg.norm(np.diff(points.positions, axis=0), axis=1)
        turned = np.abs(np.diff(joints, axis=0)).max(axis=1)
        widths = np.maximum(chord / plan.speed, turned * (chord < _NOTHING) / plan.turn_speed)
        times = np.concatenate([[0.0], np.cumsum(widths)])
    same = np.flatnonzero(np.diff(times) <= _NOTHING)
    if len(same):
        first = int(same[0])
        return Refused(
            f"{points.pair(first)} are to be passed at the same time",
            "leave one of them out, or give times",
            first,
        )
    speeds, accelerations = points.speeds, points.accelerations
    if speeds is None:
        speeds = np.zeros_like(joints)
    if accelerations is None:
        accelerations = np.zeros_like(joints)
    times = times - times[0]
    return JointsOverTime(quintics(times, joints, speeds, accelerations), times)


def even_joint_motion(joints: Array, offsets: Array, plan: Plan) -> JointsOverTime | Refused:
    """Return synchronised joint motion from point to point, with a stop at each: kind `JOINT`.

    Args:
        joints: Joints at each point, (k, n) [rad].
        offsets: TCP travel between points, (k - 1,) [m].
        plan: Profile and speeds.
    """
    breaks, pieces, passed = [np.zeros(1)], [], [0.0]
    for (first, last), way in zip(pairwise(joints), offsets.tolist(), strict=True):
        begin = passed[-1]
        way = max(way, float(np.abs(last - first).max()) * plan.speed / plan.turn_speed)
        if way > _NOTHING:
            timing = law(plan.profile, way, plan.speed, plan.acceleration, plan.ease)
            piece = timing.coefficients / way * (last - first)
            piece[:, 0] += first
            pieces.append(piece)
            breaks.append(begin + timing.breaks[1:])
            begin += timing.end
        passed.append(begin)
    if not pieces:
        return Refused("all points are the same: there is no path to follow")
    return JointsOverTime(
        Piecewise(np.concatenate(breaks), np.concatenate(pieces)), np.array(passed)
    )


def _lines(positions: Array, attitudes: Array, plan: Plan) -> list[tuple[int, StraightLine]]:
    lines = []
    for number in range(len(positions) - 1):
        start, end = positions[number : number + 2]
        before, after = attitudes[number : number + 2]
        length = max(
            float(np.linalg.norm(end - start)), turn(before, after) * plan.speed / plan.turn_speed
        )
        if length > _NOTHING:
            lines.append((number, StraightLine(start, end, before, after, length)))
    return lines


def _spline_curve(points: Points, attitudes: Array) -> SplineCurve | Refused:
    knots = points.knots
    if knots is None:
        chords = np.linalg.norm(np.diff(points.positions, axis=0), axis=1)
        same = np.flatnonzero(chords < _NOTHING)
        if len(same):
            first = int(same[0])
            message = f"{points.pair(first)} are in the same place"
            return Refused(message, "leave one of them out: a spline passes each once", first)
        knots = np.concatenate([[0.0], np.cumsum(chords)])
    if attitudes.shape[1] == 4:
        attitudes = attitudes.copy()
        for before, now in pairwise(attitudes):
            # Of the two quaternions of an attitude, use the one nearer to the previous quaternion.
            now *= -1.0 if float(before @ now) < 0.0 else 1.0
    return SplineCurve(spline(knots, points.positions), spline(knots, attitudes))


def _kept_out(
    points: Points, curves: list[tuple[int, Curve]], plan: Plan
) -> list[tuple[int, Curve]] | Refused:
    """Return the curves, routed around the sphere about the base if the plan requires it."""
    if plan.least_radius <= 0.0:
        return curves
    kept: list[tuple[int, Curve]] = []
    for number, curve in curves:
        closest = nearest(curve)
        if closest > plan.least_radius - 1e-9:
            kept.append((number, curve))
        elif (
            plan.avoid
            and isinstance(curve, StraightLine)
            and _leaves_sphere(curve, plan.least_radius)
        ):
            try:
                kept += [(number, piece) for piece in around(curve, plan.least_radius)]
            except ThroughBaseError:
                message = (
                    f"the line between {points.pair(number)} goes through the origin of the base"
                )
                return Refused(message, "put a point next to it", number)
        else:
            where = (
                f"the line between {points.pair(number)}" if plan.kind is Way.LINE else "the spline"
            )
            message = (
                f"{where} comes within {closest * 1000.0:.1f} mm of the origin of the base, "
                f"closer than the {plan.least_radius * 1000.0:g} mm to keep"
            )
            help = "only lines are led around" if plan.avoid else "straight lines can be led around"
            return Refused(message, help, number)
    return kept


def _leaves_sphere(line: StraightLine, radius: float) -> bool:
    ends = np.linalg.norm([line.start, line.end], axis=1)
    return bool((ends > radius - 1e-9).all())
