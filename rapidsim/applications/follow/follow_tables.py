"""Results of `rapidsim follow` as tables."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

import numpy as np
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.frames.euler import Convention, euler_from_rotation
from rapidsim.frames.transform import Array, Transform, quaternion_from_matrix
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.waypoints.follow import FollowedTrajectory
from rapidsim.motion.waypoints.plan import Plan, Refused, Way
from rapidsim.motion.waypoints.points import Points, linear_turn_rates, posed, turn
from rapidsim.motion.waypoints.reachability import PointReach
from rapidsim.motion.waypoints.solver_seeds import SeededSolve
from rapidsim.report.untruncated_table import UntruncatedTable
from rapidsim.values import value_class

_MOST_ROWS = 30
"""With more points, only those out of reach are listed."""
_LEAST_TURN_DEG = 0.5
_MOST_TURNS = 10


@value_class(frozen=True, slots=True, eq=False)
class RequestedPoints:
    """Points as the user gave them, and what the arm can do about each."""

    robot: Robot
    points: Points
    reached: tuple[PointReach, ...]
    attitudes: Array
    """Shape (k, 4) or (k, 1); chosen where they are free."""
    plan: Plan
    world_from_base: Transform
    convention: Convention
    """Convention of the Euler angles shown."""

    @property
    def positions_mm(self) -> Array:
        """Positions of the points in the world (k, 3)."""
        return 1000.0 * self.world_from_base.apply(self.points.positions) + 0.0

    @property
    def quaternions(self) -> Array:
        """Orientations of the tool in the world (k, 4), also those chosen by pitch."""
        return quaternion_from_matrix(self._turned) + 0.0

    @property
    def euler_deg(self) -> Array:
        """The orientations as Euler angles (k, 3)."""
        return np.degrees(euler_from_rotation(self._turned, self.convention)) + 0.0

    @property
    def _turned(self) -> Array:
        return (self.world_from_base @ posed(self.points.positions, self.attitudes)).rotation


@value_class(frozen=True, slots=True)
class Attempt:
    """One kind of path through the points, and its cost."""

    plan: Plan
    result: FollowedTrajectory | Refused
    seconds: float
    """By the clock on the wall; nothing depends on it."""

    @property
    def possible(self) -> bool:
        """Whether the arm can follow it at the requested speed."""
        return isinstance(self.result, FollowedTrajectory) and not over_speed(self.result)


def points_page(requested: RequestedPoints) -> RenderableType:
    """A row a point: where, and whether the arm gets there, or what is missing."""
    reached, positions = requested.reached, requested.positions_mm
    count = len(reached)
    missing = [number for number, point in enumerate(reached) if not point.reachable]
    facts = Text(f"{count - len(missing)} of {count} points reached", "red" if missing else "green")
    shown = range(count) if count <= _MOST_ROWS else missing[:_MOST_ROWS]
    parts: list[RenderableType] = [Text(requested.robot.title, "bold"), facts]
    if shown:
        free = any(point.pitch is not None for point in reached)
        turned = requested.euler_deg
        named = tuple(f"{name} [deg]" for name in requested.convention.names)
        attitude = ("pitch [deg]", "possible") if free else named
        table = _table("point", "x [mm]", "y [mm]", "z [mm]", *attitude)
        table.add_column("", no_wrap=False)
        for number in shown:
            point = reached[number]
            table.add_row(
                str(number + 1),
                *(f"{value:.1f}" for value in positions[number].tolist()),
                *(
                    _pitch(point)
                    if free
                    else (f"{round(angle, 2) + 0.0:.2f}" for angle in turned[number].tolist())
                ),
                point.message or "reached",
                style="" if point.reachable else "red",
            )
        parts += [Text(), table]
    if len(missing) > len(shown):
        parts.append(Text(f"and {len(missing) - len(shown)} more out of reach", "red"))
    return Group(*parts)


def trajectory_page(attempt: Attempt) -> RenderableType:
    """Duration, deviation and speed; or the reason of the failure."""
    result, plan = attempt.result, attempt.plan
    if isinstance(result, Refused):
        return refused_text(result)
    if len(result.points) == 1:
        return _joints_at_rest(result)
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="cyan", no_wrap=True)
    facts.add_column()
    profile = "" if plan.kind is Way.JOINT_QUINTIC else f", {plan.profile.value}"
    facts.add_row("path", f"{plan.kind.value}{profile}, {result.path_length * 1000.0:.1f} mm")
    facts.add_row(
        "duration", f"{result.duration:.3f} s, at constant speed {result.even_duration:.3f} s"
    )
    facts.add_row(
        "TCP speed",
        f"at most {result.peak_speed * 1000.0:.1f} mm/s, requested {plan.speed * 1000.0:g} mm/s",
    )
    off = "from the path" if plan.kind.of_tcp else "from the straight lines between the points"
    facts.add_row(
        "deviation",
        f"rms {length(result.deviation_rms)}, at most {length(result.deviation_max)} {off}",
    )
    if plan.kind.of_tcp:
        facts.add_row("", f"at most {degrees(result.turn_deviation):.0e} deg of turn")
    facts.add_row(
        "solver", f"{result.poses_solved} poses solved in {attempt.seconds * 1000.0:.1f} ms"
    )
    return Group(facts, Text(), _joints(result))


def compare_page(attempts: Sequence[Attempt]) -> RenderableType:
    """A row per kind of path: its cost, and its deviation from straight lines."""
    table = _table("path", "poses", "solver", "off the line", "way", "time", "axis")
    refused = []
    for attempt in attempts:
        result = attempt.result
        if isinstance(result, Refused):
            refused.append(Text.assemble((f"{attempt.plan.kind.value}: ", "red"), result.message))
            continue
        known = [ratio for ratio in result.speed_ratios if ratio is not None]
        table.add_row(
            attempt.plan.kind.value,
            str(result.poses_solved),
            f"{attempt.seconds * 1000.0:.1f} ms",
            length(result.from_chord),
            f"{result.path_length * 1000.0:.1f} mm",
            f"{result.duration:.3f} s",
            f"{100.0 * max(known):.0f} %" if known else "?",
        )
    said = (
        "poses: solved by inverse kinematics; solver: time on this computer; off the line: "
        "largest distance from the straight lines between the points; axis: peak speed of the "
        "fastest axis, as a share of its limit"
    )
    return Group(table, *refused, Text(said, "dim"))


def scaling_page(attempts: Sequence[Attempt]) -> RenderableType:
    """A row a step in time: how poses and time of the solver grow with them."""
    table = _table("dt", "poses", "solver", "a pose")
    refused = []
    for attempt in attempts:
        result = attempt.result
        if isinstance(result, Refused):
            refused.append(refused_text(result))
            break
        table.add_row(
            f"{result.dt:g} s",
            str(result.poses_solved),
            f"{attempt.seconds * 1000.0:.1f} ms",
            f"{attempt.seconds * 1e6 / result.poses_solved:.1f} µs",
        )
    said = "solver: time on this computer"
    return Group(table, *refused, Text(said, "dim"))


def starts_page(tried: Sequence[SeededSolve]) -> RenderableType:
    """A row a solver and start: how often it found the pose, what that took."""
    table = _table("solver", "start", "found", "starts", "steps a pose", "time a pose")
    for one in tried:
        table.add_row(
            one.solver,
            "warm" if one.warm else "cold",
            f"{one.solved_count} of {one.poses}",
            f"{one.starts / one.poses:.2f}",
            f"{one.iterations / one.poses:.1f}",
            f"{one.seconds * 1000.0 / one.poses:.1f} ms",
        )
    said = (
        "cold: from joints at 0 at every pose; warm: from the joints of the pose before; where a "
        "start fails, others spread over the limits follow; time on this computer"
    )
    return Group(table, Text(said, "dim"))


def turns_page(attitudes: Array) -> RenderableType | None:
    """Evenness of the rotation between points, by slerp and by linear quaternions."""
    if attitudes.shape[1] != 4:
        return None
    table = _table("turn", "angle", "slerp", "linear, at the ends", "in the middle")
    turned = 0
    for number in range(len(attitudes) - 1):
        angle = turn(attitudes[number], attitudes[number + 1])
        if degrees(angle) < _LEAST_TURN_DEG:
            continue
        turned += 1
        if turned <= _MOST_TURNS:
            ends, middle = linear_turn_rates(angle)
            table.add_row(
                f"{number + 1} - {number + 2}",
                f"{degrees(angle):.2f} deg",
                *(f"{degrees(rate):.2f}" for rate in (angle, ends, middle)),
            )
    if not turned:
        return None
    said = "rates in deg per section; lines here turn by slerp"
    if turned > _MOST_TURNS:
        said += f"; and {turned - _MOST_TURNS} turns more"
    return Group(table, Text(said, "dim"))


def over_speed(followed: FollowedTrajectory) -> tuple[str, ...]:
    """A line for each joint that would have to be faster than it can."""
    return tuple(
        f"joint {number} would need {degrees(peak):.1f} {joint.measure}/s, "
        f"its limit is {degrees(joint.max_speed):g} {joint.measure}/s"
        for number, (joint, peak) in enumerate(
            zip(followed.robot.joints, followed.joint_peaks.tolist(), strict=True), start=1
        )
        if joint.max_speed is not None and peak > joint.max_speed * (1.0 + 1e-9)
    )


def refused_text(refused: Refused) -> RenderableType:
    """Why there is no trajectory, what would help, and what other configurations would need."""
    text = Text.assemble(("no trajectory: ", "red"), refused.message)
    if refused.help:
        text.append(f"\n help: {refused.help}")
    if not refused.other_branches:
        return text
    table = Table.grid(padding=(0, 2))
    table.add_column(style="cyan", no_wrap=True)
    table.add_column()
    for conf, message in refused.other_branches:
        words = Text("lasts all the way", "green") if message is None else Text(message)
        table.add_row(f"[{','.join(map(str, conf))}]", words)
    return Group(text, Text(), Text("other configurations", "bold"), table)


def length(metres: float) -> str:
    """In mm, also where it is next to nothing."""
    mm = metres * 1000.0
    return f"{mm:.3f} mm" if mm >= 1e-3 else f"{mm:.0e} mm"


def _joints(result: FollowedTrajectory) -> Table:
    quintic = result.plan.kind is Way.JOINT_QUINTIC
    table = _table("joint", "peak speed", "limit", "", *(("overshoot",) if quintic else ()))
    for joint, peak, ratio, beyond in zip(
        result.robot.joints,
        result.joint_peaks.tolist(),
        result.speed_ratios,
        result.overshoot.tolist(),
        strict=True,
    ):
        unit = joint.measure
        limit = "?" if joint.max_speed is None else f"{degrees(joint.max_speed):g} {unit}/s"
        table.add_row(
            joint.name,
            f"{degrees(peak):.2f} {unit}/s",
            limit,
            "" if ratio is None else f"{100.0 * ratio:.0f} %",
            *((f"{degrees(beyond):.3f} {unit}",) if quintic else ()),
            style="red" if ratio is not None and ratio > 1.0 else "",
        )
    return table


def _joints_at_rest(result: FollowedTrajectory) -> Table:
    table = _table("joint", "angle")
    angles = np.degrees(result.samples.joints[0]).tolist()
    for joint, angle in zip(result.robot.joints, angles, strict=True):
        table.add_row(joint.name, f"{angle:.3f} {joint.measure}")
    return table


def _pitch(point: PointReach) -> tuple[str, str]:
    if point.pitches is None or point.pitch is None:
        return "", ""
    low, high = (degrees(pitch) for pitch in point.pitches)
    return f"{degrees(point.pitch):.1f}", f"{low:.1f}..{high:.1f}"


def _table(first: str, *others: str) -> Table:
    table = UntruncatedTable.without_lines()
    table.add_column(first, no_wrap=True)
    for name in others:
        table.add_column(name, justify="right", no_wrap=True)
    return table
