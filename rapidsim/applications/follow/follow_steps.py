"""The steps of `rapidsim follow`; imports NumPy, so the command imports it late."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from time import perf_counter

import numpy as np
from rich.console import Group, RenderableType
from rich.text import Text

from rapidsim.applications.follow.follow_tables import (
    Attempt,
    RequestedPoints,
    compare_page,
    over_speed,
    points_page,
    scaling_page,
    trajectory_page,
    turns_page,
)
from rapidsim.cli.open_command import open_command
from rapidsim.cli.options.poses import tool
from rapidsim.files import InputError
from rapidsim.frames.euler import Convention
from rapidsim.frames.transform import (
    Array,
    Transform,
    matrix_from_quaternion,
    quaternion_from_matrix,
)
from rapidsim.motion.configurations.pose_solutions import solve_pose_as
from rapidsim.motion.kinematics.closed_form.five_axis import FiveAxis
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.waypoints.follow import FollowedTrajectory, follow
from rapidsim.motion.waypoints.keep_out_sphere import ThroughBaseError, pushed_out
from rapidsim.motion.waypoints.plan import Plan, Refused, Way
from rapidsim.motion.waypoints.points import Points, posed
from rapidsim.motion.waypoints.random_points import DOWN
from rapidsim.motion.waypoints.reachability import reach
from rapidsim.motion.waypoints.solver_seeds import SeededSolve
from rapidsim.report.run.summary import OutputFile, files_text
from rapidsim.values import value_class

_QUATERNION = 4
_METRES = 10.0
"""Points that are all nearer to the origin than this [mm] were hardly meant in mm."""


@value_class(frozen=True, slots=True)
class FollowOptions:
    """Options as typed, in mm and degrees."""

    robot: Robot
    tool: tuple[float, ...]
    world_from_base: Transform
    plan: Plan
    via_speed: tuple[float, ...] | None
    start: tuple[float, ...] | None
    conf: tuple[float, ...] | None
    dt: float
    skip_unreachable: bool
    convention: Convention


@value_class(frozen=True, slots=True, eq=False)
class PreparedPoints:
    """Points with attitudes, ready to be followed."""

    requested: RequestedPoints
    points: Points
    """Those to be followed."""
    attitudes: Array
    flange_from_tcp: Transform
    missing: int
    """Number of points out of reach and not skipped."""
    start: Array | None
    first: Array | None
    dt: float
    remarks: tuple[str, ...]
    """Assumptions, a line each."""

    @property
    def all_reached(self) -> bool:
        """Whether the arm reaches every point of the table."""
        return all(point.reachable for point in self.requested.reached)


def prepared(options: FollowOptions, points: Points) -> PreparedPoints:
    """Complete points, and find out which the arm reaches.

    Raises:
        InputError: If options do not fit the arm.
    """
    robot, base_from_world = options.robot, options.world_from_base.inverse()
    flange_from_tcp = tool(options.tool)
    remarks = []
    points = _in_base(points, base_from_world)
    if options.plan.avoid:
        outside = _moved_out(points, options.plan.least_radius)
        moved = int(np.any(outside.positions != points.positions, axis=1).sum())
        remarks += [f"points inside the sphere are moved to its surface: {moved}"] if moved else []
        points = outside
    if points.attitudes is None and isinstance(robot.kinematics, FiveAxis):
        remarks.append("no column gives the pitch of the tool: it is chosen point by point")
    elif points.attitudes is None:
        down = base_from_world.rotation @ matrix_from_quaternion(np.array(DOWN))
        attitudes_down = np.tile(quaternion_from_matrix(down), (len(points), 1))
        points = replace(points, attitudes=attitudes_down)
        remarks.append("no column gives the attitude of the tool: it points straight down")
    if options.via_speed is not None:
        points = replace(points, speeds=_via_speeds(robot, points, options.via_speed))
    reached, attitudes = reach(robot, points, flange_from_tcp)
    rows = np.flatnonzero([point.reachable for point in reached])
    some, some_attitudes = points, attitudes
    missing = len(points) - len(rows)
    if missing and options.skip_unreachable:
        some, some_attitudes, missing = points.some(rows), attitudes[rows], 0
    first = None
    if options.conf is not None and not missing and len(some):
        pose = posed(some.positions[:1], some_attitudes[:1])[0] @ flange_from_tcp.inverse()
        first = _first(robot, pose, options.conf)
    return PreparedPoints(
        requested=RequestedPoints(
            robot,
            points,
            reached,
            attitudes,
            options.plan,
            options.world_from_base,
            options.convention,
        ),
        points=some,
        attitudes=some_attitudes,
        flange_from_tcp=flange_from_tcp,
        missing=missing,
        start=None if options.start is None else _joints(robot, options.start, "--start"),
        first=first,
        dt=options.dt,
        remarks=tuple(remarks),
    )


def attempt_all(task: PreparedPoints, plan: Plan, path_kinds: Sequence[Way]) -> tuple[Attempt, ...]:
    """Solve the trajectory for several kinds of path, and measure the time."""
    return tuple(attempt(task, replace(plan, kind=way)) for way in path_kinds)


def started(result: FollowedTrajectory | Refused) -> tuple[SeededSolve, ...]:
    """The numerical solvers at poses of a trajectory, from cold and from warm starts."""
    if isinstance(result, Refused):
        return ()
    from rapidsim.motion.waypoints.solver_seeds import compared_starts

    return compared_starts(result)


def unused(task: PreparedPoints, plan: Plan) -> tuple[str, ...]:
    """Assumptions and options without effect, a line each."""
    points, quintic = task.requested.points, plan.kind is Way.JOINT_QUINTIC
    remarks = list(task.remarks)
    furthest_mm = 1000.0 * float(np.abs(points.positions).max())
    if furthest_mm < _METRES:
        remarks.append(f"no coordinate is beyond {furthest_mm:g} mm: x, y and z are mm, not m")
    for values, what in (
        (points.speeds, "joint speeds"),
        (points.accelerations, "joint accelerations"),
        (points.times, "times"),
    ):
        if values is not None and not quintic:
            remarks.append(f"{what} at the points count for --path joint-quintic only")
    if points.knots is not None and plan.kind is not Way.SPLINE:
        remarks.append("knots count for --path spline only")
    if plan.least_radius and not plan.kind.of_tcp:
        remarks.append("--min-radius is not checked between points in joint space")
    return tuple(remarks)


def written(
    results: Sequence[FollowedTrajectory | Refused],
    title: str,
    recording: Path | None,
    trace: Path | None,
    plots: Path | None,
    requested: RequestedPoints,
) -> tuple[OutputFile, ...]:
    """Write the requested files, if there is a trajectory through two points or more.

    Of several there are only pictures, in folders with the names of their paths.
    """
    made = [one for one in results if isinstance(one, FollowedTrajectory) and len(one.points) > 1]
    if not made:
        return ()
    result = made[0]
    files = []
    if recording:
        from rapidsim.recording.layout.waypoint_recording import record_followed

        record_followed(result, Path(title).name, recording, requested.world_from_base)
        files.append(OutputFile(recording, "recording", open_command(recording)))
    if trace:
        from rapidsim.export.trace import write_samples

        write_samples(result.samples, trace, requested.convention)
        files.append(OutputFile(trace, "trace"))
    if plots:
        from rapidsim.plots.followed_pictures import write_followed_plots

        if len(results) > 1:
            plots.mkdir(exist_ok=True)
        for one in made:
            folder = plots if len(results) == 1 else plots / one.plan.kind.value
            write_followed_plots(one, Path(title).name, folder)
        files.append(OutputFile(plots, "plots"))
    return tuple(files)


def render_result(
    task: PreparedPoints, attempts: Sequence[Attempt], files: Sequence[OutputFile], *, compare: bool
) -> RenderableType:
    """The whole output for a person."""
    parts: list[RenderableType] = [points_page(task.requested), Text()]
    if not compare and len(attempts) > 1:
        return Group(*parts, scaling_page(attempts))
    if compare:
        parts.append(compare_page(attempts))
        turns = turns_page(task.attitudes)
        parts += [] if turns is None else [Text(), turns]
        parts += [Text(), files_text(files)] if files else []
        return Group(*parts)
    (attempt,) = attempts
    parts.append(trajectory_page(attempt))
    if isinstance(attempt.result, FollowedTrajectory):
        over = over_speed(attempt.result)
        parts += [Text(line, "red") for line in over]
        if over:
            most = max(ratio for ratio in attempt.result.speed_ratios if ratio is not None)
            parts.append(Text(f" help: about {100.0 / most:.2g} % of the speed would do"))
        if any(joint.max_speed is None for joint in task.requested.robot.joints):
            parts.append(Text("no source gives the axis speeds of this arm: not checked", "dim"))
    if files:
        parts += [Text(), files_text(files)]
    return Group(*parts)


def attempt(task: PreparedPoints, plan: Plan) -> Attempt:
    """Solve a trajectory, and take the time that it costs."""
    if task.missing:
        count = len(task.requested.points)
        refused = Refused(
            f"{task.missing} of {count} points are out of reach",
            "--skip-unreachable leaves them out",
        )
        return Attempt(plan, refused, 0.0)
    began = perf_counter()
    result = follow(
        task.requested.robot,
        task.points,
        task.attitudes,
        task.flange_from_tcp,
        plan,
        start=task.start,
        first=task.first,
        dt=task.dt,
    )
    return Attempt(plan, result, perf_counter() - began)


def _in_base(points: Points, base_from_world: Transform) -> Points:
    """Points of the world as the robot sees them; a pitch counts against its base."""
    if np.array_equal(base_from_world.matrix, np.eye(4)):
        return points
    attitudes = points.attitudes
    if attitudes is not None and attitudes.shape[1] == _QUATERNION:
        turned = base_from_world.rotation @ matrix_from_quaternion(attitudes)
        attitudes = quaternion_from_matrix(turned)
    return replace(points, positions=base_from_world.apply(points.positions), attitudes=attitudes)


def _joints(robot: Robot, degrees: tuple[float, ...], option: str) -> Array:
    if len(degrees) != len(robot.joints):
        raise InputError(
            f"{option} has {len(degrees)} numbers, but {robot.name} has {len(robot.joints)} joints"
        )
    angles: Array = np.radians(np.array(degrees, dtype=np.float64))
    return angles


def _moved_out(points: Points, radius: float) -> Points:
    """Points with those inside a sphere [m] around the base moved to its surface."""
    try:
        return replace(points, positions=pushed_out(points.positions, radius))
    except ThroughBaseError:
        raise InputError(
            "a point lies in the origin of the base: no side of it is nearer", "move it"
        ) from None


def _via_speeds(robot: Robot, points: Points, values: tuple[float, ...]) -> Array:
    """Joint speeds (k, n) [rad/s]: at rest at both ends, the same at all points between."""
    if points.speeds is not None:
        raise InputError("--via-speed: the table has joint speeds of its own", "leave one out")
    if len(values) == 1:
        values *= len(robot.joints)
    speeds = np.tile(_joints(robot, values, "--via-speed"), (len(points), 1))
    speeds[[0, -1]] = 0.0
    return speeds


def _first(robot: Robot, base_from_flange: Transform, conf: tuple[float, ...]) -> Array:
    """Joints (n,) [rad] of the first pose in a configuration."""
    if any(value != int(value) for value in conf):
        raise InputError("--conf takes whole numbers: cf1, cf4, cf6 and cfx")
    found = solve_pose_as(robot, base_from_flange, [int(value) for value in conf])
    if found.reason is not None:
        raise InputError(f"--conf: the first point cannot be taken so: {found.reason}")
    return found.solutions[0].joints
