"""Results of `rapidsim follow` as records of JSON: mm, degrees, seconds of the trajectory.

Nothing in it depends on how long the computer took.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import Annotated

import numpy as np

from rapidsim.applications.follow.follow_tables import Attempt, RequestedPoints
from rapidsim.json_records.declarations import Key, OrAbsent, OutputRecord, ValueForm
from rapidsim.motion.waypoints.follow import FollowedTrajectory
from rapidsim.motion.waypoints.plan import Refused, Way
from rapidsim.motion.waypoints.reachability import PointReach
from rapidsim.motion.waypoints.solver_seeds import SeededSolve
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class EulerConvention:
    """Convention of all Euler angles."""

    convention: str
    names: tuple[str, ...]
    """Names of the angles."""


@value_class(frozen=True, slots=True)
class PointRecord:
    """A point and its reachability."""

    position_mm: Sequence[float]
    quaternion: Sequence[float]
    """Orientation of the tool, scalar first."""
    euler_deg: Sequence[float]
    """That orientation as Euler angles."""
    reachable: bool
    reason: Annotated[str | None, Key("why")]
    """Reason why the point is unreachable; null if it is reached."""
    shortfall_mm: float
    joint: int | None
    """Number of the joint that exceeds its limit, from 1."""
    over_deg: float
    """Excess beyond the limit of the joint."""
    pitch_deg: float | None
    """Chosen pitch; null unless the pitch is free."""
    pitch_range_deg: Sequence[float] | None
    """Pitches in which the point is reached; null unless the pitch is free."""


@value_class(frozen=True, slots=True)
class RequestedPointsRecord(OutputRecord):
    """Requested points."""

    robot: str
    speed_mm_s: float
    acceleration_mm_s2: float
    euler: EulerConvention
    points: tuple[PointRecord, ...]


@value_class(frozen=True, slots=True)
class StartConfiguration:
    """Another configuration in which the path could begin."""

    conf: tuple[int, ...]
    """cf1, cf4, cf6, cfx."""
    possible: bool
    reason: Annotated[str | None, Key("why")]
    """Reason why the path cannot be followed from it; null if it can."""


@value_class(frozen=True, slots=True)
class RefusalRecord:
    """Reason why there is no trajectory."""

    message: str
    help: str | None
    other_configurations: tuple[StartConfiguration, ...]


@value_class(frozen=True, slots=True)
class PathDeviation:
    """Deviation of the trajectory."""

    reference: Annotated[str, Key("from")]
    """`path` or `straight lines`."""
    rms_mm: float
    max_mm: float
    max_deg: float


@value_class(frozen=True, slots=True)
class JointCourse:
    """Motion of a joint; of one that slides, mm stand for degrees."""

    name: str
    start_deg: float
    end_deg: float
    peak_deg_s: float
    limit_deg_s: float | None
    """Null if no source gives the speed of the axis."""
    overshoot_deg: float


@value_class(frozen=True, slots=True)
class TrajectoryRecord:
    """A trajectory through the points; of one point, the rest there."""

    dt_s: float
    """Time between the poses at which the deviation is measured."""
    duration_s: float
    constant_speed_s: float
    """Time along the path of the TCP at the requested speed throughout."""
    path_mm: float
    """Distance travelled by the TCP, corners cut."""
    peak_tcp_speed_mm_s: float
    deviation: PathDeviation
    from_straight_lines_max_mm: float
    poses_solved: int
    samples: int
    joints: tuple[JointCourse, ...]


@value_class(frozen=True, slots=True)
class FollowResult:
    """A trajectory, or the reason why there is none."""

    refused: RefusalRecord | None
    trajectory: TrajectoryRecord | None


@value_class(frozen=True, slots=True)
class SolverStarts:
    """Cost of a numerical solver from cold or warm starts."""

    solver: str
    start: str
    """`cold` or `warm`."""
    poses: int
    solved: Annotated[int, Key("found")]
    """Number of poses that were solved."""
    starts: int
    iterations: int


@value_class(frozen=True, slots=True)
class FollowReport:
    """The object that `rapidsim follow --format json` prints."""

    request: Annotated[RequestedPointsRecord, ValueForm.INLINE]
    path: str
    profile: str | None
    """Null if the path determines its speed."""
    result: Annotated[FollowResult, ValueForm.INLINE]
    starts: OrAbsent[tuple[SolverStarts, ...]]
    """With --starts: cost of numerical solvers from cold and from warm starts."""


@value_class(frozen=True, slots=True)
class ComparedPath:
    """Result of one kind of path."""

    path: str
    result: Annotated[FollowResult, ValueForm.INLINE]


@value_class(frozen=True, slots=True)
class FollowComparison:
    """The object that `rapidsim follow --compare --format json` prints."""

    request: Annotated[RequestedPointsRecord, ValueForm.INLINE]
    profile: str
    compared: tuple[ComparedPath, ...]


def follow_report(
    requested: RequestedPoints, attempts: Sequence[Attempt], tried: Sequence[SeededSolve]
) -> FollowReport:
    """Points, and the trajectory, or the reason why it failed.

    Args:
        requested: The points.
        attempts: The only result.
        tried: Searches of numerical solvers, with `--starts`.
    """
    (attempt,) = attempts
    plan = requested.plan
    profile = None if plan.kind is Way.JOINT_QUINTIC else plan.profile.value
    starts = tuple(map(_starts, tried)) or None
    result = _result(attempt.result)
    return FollowReport(_request(requested), plan.kind.value, profile, result, starts)


def compared_report(requested: RequestedPoints, attempts: Sequence[Attempt]) -> FollowComparison:
    """Points, and each trajectory, or the reason why it failed."""
    return FollowComparison(
        _request(requested),
        requested.plan.profile.value,
        tuple(ComparedPath(one.plan.kind.value, _result(one.result)) for one in attempts),
    )


def _starts(solve: SeededSolve) -> SolverStarts:
    return SolverStarts(
        solver=solve.solver,
        start="warm" if solve.warm else "cold",
        poses=solve.poses,
        solved=solve.solved_count,
        starts=solve.starts,
        iterations=solve.iterations,
    )


def _request(requested: RequestedPoints) -> RequestedPointsRecord:
    convention = requested.convention
    rows = zip(
        requested.positions_mm.tolist(),
        requested.reached,
        requested.quaternions.tolist(),
        requested.euler_deg.tolist(),
        strict=True,
    )
    return RequestedPointsRecord(
        robot=requested.robot.name,
        speed_mm_s=requested.plan.speed * 1000.0,
        acceleration_mm_s2=requested.plan.acceleration * 1000.0,
        euler=EulerConvention(convention.value, convention.names),
        points=tuple(_point(*row) for row in rows),
    )


def _result(result: FollowedTrajectory | Refused) -> FollowResult:
    if isinstance(result, Refused):
        others = tuple(
            StartConfiguration(tuple(conf), message is None, message)
            for conf, message in result.other_branches
        )
        return FollowResult(RefusalRecord(result.message, result.help, others), None)
    return FollowResult(None, _trajectory(result))


def _trajectory(followed: FollowedTrajectory) -> TrajectoryRecord:
    """One trajectory: duration, deviation, speeds."""
    joints = followed.samples.joints
    courses = zip(
        followed.robot.joints,
        np.degrees(joints[0]).tolist(),
        np.degrees(joints[-1]).tolist(),
        followed.joint_peaks.tolist(),
        followed.overshoot.tolist(),
        strict=True,
    )
    return TrajectoryRecord(
        dt_s=followed.dt,
        duration_s=followed.duration,
        constant_speed_s=followed.even_duration,
        path_mm=followed.path_length * 1000.0,
        peak_tcp_speed_mm_s=followed.peak_speed * 1000.0,
        deviation=PathDeviation(
            reference="path" if followed.plan.kind.of_tcp else "straight lines",
            rms_mm=followed.deviation_rms * 1000.0,
            max_mm=followed.deviation_max * 1000.0,
            max_deg=degrees(followed.turn_deviation),
        ),
        from_straight_lines_max_mm=followed.from_chord * 1000.0,
        poses_solved=followed.poses_solved,
        samples=len(followed.samples.times),
        joints=tuple(
            JointCourse(
                name=joint.name,
                start_deg=start,
                end_deg=end,
                peak_deg_s=degrees(peak),
                limit_deg_s=None if joint.max_speed is None else degrees(joint.max_speed),
                overshoot_deg=degrees(beyond),
            )
            for joint, start, end, peak, beyond in courses
        ),
    )


def _point(
    position: list[float], reached: PointReach, quaternion: list[float], euler: list[float]
) -> PointRecord:
    reason, pitches = reached.reason, reached.pitches
    return PointRecord(
        position_mm=position,
        quaternion=quaternion,
        euler_deg=euler,
        reachable=reached.reachable,
        reason=reached.message,
        shortfall_mm=0.0 if reason is None else reason.shortfall * 1000.0,
        joint=None if reason is None else reason.joint,
        over_deg=0.0 if reason is None else degrees(reason.excess),
        pitch_deg=None if reached.pitch is None else degrees(reached.pitch),
        pitch_range_deg=None if pitches is None else [degrees(pitch) for pitch in pitches],
    )
