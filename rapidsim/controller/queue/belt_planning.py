"""Planning of moves that follow a belt.

The path of such a block depends on where the belt is at each of its moves, and that on the times of
the plan: both are found in turn, from plan to plan. The axis that stands for the belt moves along
each segment from its expected travel at the start to that at the end, so that the speeds and
torques of the plan are those of an arm that moves with the belt. What is left, the arm follows by
its offset (`motion.path.belt_offsets`); where that takes more speed or torque than the arm has, the
moves are slowed down until it does not, or as long as that helps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from rapidsim.controller.queue.member import Member
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.belts import BeltRide
from rapidsim.motion.geometry.segments import Segment, Speed, with_belt_axis
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.corrected_section import moved_joints
from rapidsim.motion.trajectory.limit_shares import limit_shares, reasons_lost
from rapidsim.values import value_class

_MOST_PLANS = 12
_SETTLED_M = 5e-4
"""Change of the expected travel [m] below which a plan is final."""
_STEP_S = 0.004
_MARGIN = 0.97
_LEAST_FACTOR = 0.4
_NO_LENGTH_M = 1e-6
_LOST = "the belt carries the end of the move out of reach"
_NO_LENGTH = (
    "the arm is there already and has no way on which to catch up with the belt; begin with a move "
    "from some distance"
)

MakePlan = Callable[[Sequence[Segment]], tuple[Path, TimeScaling] | PathFault]
"""Plans segments, for an arm with the axis of a belt."""


@value_class(frozen=True, slots=True)
class BlockStart:
    """Start of a plan in time and among the moves of the robot."""

    time_s: float
    """Command time [s]."""
    number: int
    """Number of its first move among all moves of the robot."""
    fixed: int
    """Number of segments that must stay as they are, as the arm has begun them."""
    is_at_rest: bool
    """Whether it begins at rest at the start of the first segment."""
    move: int
    distance_m: float
    """Position on the path: a distance past the start of a segment."""


def follows_belt(segments: Sequence[Segment]) -> bool:
    """Whether some segments follow a belt."""
    return any(segment.rides for segment in segments)


def plan_on_belt(
    member: Member, segments: Sequence[Segment], start: BlockStart, make: MakePlan
) -> tuple[Path, TimeScaling] | PathFault:
    """Plan segments of which some follow a belt.

    Args:
        member: The robot.
        segments: As they were resolved or planned before.
        start: Where the plan begins.
        make: Plans segments.

    Returns:
        The plan, or the first point where the arm cannot follow.
    """
    kinematics, lag_s = member.robot.kinematics, 0.5 * member.model.window
    rests = start.is_at_rest and start.time_s >= member.trajectory.duration
    travels, factors = _first_travels(segments, start.time_s, rests=rests), np.ones(len(segments))
    speeds: Array | None = None
    best, least_used = None, np.inf
    plans = 0
    while True:
        plans += 1
        moved = _chained(segments, travels, start.fixed, kinematics)
        if isinstance(moved, PathFault):
            return moved
        planned = make(_slowed(moved, factors, speeds))
        if isinstance(planned, PathFault):
            return planned
        path, timing = planned
        if (fault := _without_length(path)) is not None:
            return fault
        ends_s = start.time_s + lag_s + timing.time_at(path.segment_bounds[1:])
        before, travels = travels, _expected(path.segments, travels, ends_s, start.fixed)
        speeds = _fastest(path, timing) if speeds is None else speeds
        if np.abs(travels - before).max() > _SETTLED_M and plans < _MOST_PLANS:
            continue
        used = _used(member, segments, path, timing, start)
        if isinstance(used, PathFault):
            return used
        # Lower limits on a move that the arm has begun too fast for them only add to the excess.
        if best is None or used.max() < least_used:
            best, least_used = planned, float(used.max())
        if used.max() <= 1.0 or plans >= _MOST_PLANS:
            return best
        factors = factors * np.clip(_MARGIN / np.maximum(used, _MARGIN), _LEAST_FACTOR, 1.0)


def _first_travels(segments: Sequence[Segment], time_s: float, *, rests: bool) -> Array:
    """Return the travel (segments + 1,) [m] of the belt's axis at the ends of segments, at first.

    An arm that rests on a belt before it begins at a time [s] has moved with it meanwhile.
    """
    first = segments[0].carrier_axes
    travels = np.array([0.0 if first is None else first[0][-1], *np.zeros(len(segments))])
    riding = [ride for ride in segments[0].rides if ride.begin == 1.0]
    if riding and rests:
        travels[0] = _travel(riding[0], time_s)
    for number, segment in enumerate(segments):
        own = segment.carrier_axes
        step = 0.0 if own is None else float(own[1][-1] - own[0][-1])
        travels[number + 1] = travels[number] + step
    return travels


def _expected(segments: Sequence[Segment], travels: Array, ends_s: Array, fixed: int) -> Array:
    """Return the travel (segments + 1,) [m] at the ends of segments that end at times (k,) [s]."""
    expected = travels.copy()
    for number, segment in enumerate(segments[fixed:], fixed):
        expected[number + 1] = expected[number]
        if segment.rides and all(ride.end == 1.0 for ride in segment.rides):
            expected[number + 1] = _travel(segment.rides[0], float(ends_s[number]))
    return expected


def _travel(ride: BeltRide, time_s: float) -> float:
    return float(ride.course.at(np.array([time_s]))[0]) - ride.zero


def _chained(
    segments: Sequence[Segment], travels: Array, fixed: int, kinematics: Kinematics
) -> list[Segment] | PathFault:
    """Return segments for other travels (segments + 1,) [m] of the belt's axis."""
    chained: list[Segment] = []
    for number, segment in enumerate(segments):
        begin, end = travels[number : number + 2].tolist()
        if number < fixed:
            chained.append(segment if segment.carrier_axes else with_belt_axis(segment, begin, end))
            continue
        was = (0.0, 0.0)
        if segment.carrier_axes is not None:
            was = float(segment.carrier_axes[0][-1]), float(segment.carrier_axes[1][-1])
        carried = segment.carrier is not None and bool(segment.rides)
        along = segment.rides[-1].direction if carried else np.zeros(3)
        start_joints = segment.start.joints
        if chained:
            start_joints = chained[-1].end.joints
        elif riding := [ride for ride in segment.rides if ride.begin == 1.0]:
            offset = riding[0].direction * (begin - was[0])
            start_joints = _moved(kinematics, start_joints, offset)
        end_joints = _moved(kinematics, segment.end.joints, along * (end - was[1]))
        if np.isnan(start_joints).any() or np.isnan(end_joints).any():
            return _fault(number, 1.0, _LOST)
        shift = _place(kinematics, start_joints) - _place(kinematics, segment.start.joints)
        pose = segment.start.base_from_tcp
        # In the frame of the belt the start is where it was, unless the arm was not on the belt.
        pose = Transform(pose.rotation, pose.translation + shift - along * (begin - was[0]))
        chained.append(
            with_belt_axis(
                replace(
                    segment,
                    start=replace(segment.start, joints=start_joints, base_from_tcp=pose),
                    end=replace(segment.end, joints=end_joints),
                ),
                begin,
                end,
            )
        )
    return chained


def _moved(kinematics: Kinematics, joints: Array, offset: Array) -> Array:
    return moved_joints(kinematics, joints[None], offset[None])[0] if offset.any() else joints


def _place(kinematics: Kinematics, joints: Array) -> Array:
    return kinematics.forward(joints).translation


def _slowed(segments: Sequence[Segment], factors: Array, speeds: Array | None) -> Sequence[Segment]:
    """Return segments that are made with factors (segments,) of speeds (segments,) [m/s]."""
    if speeds is None:
        return segments
    slowed = []
    for segment, factor, fastest in zip(segments, factors.tolist(), speeds.tolist(), strict=True):
        speed, duration = segment.speed, segment.duration
        if factor < 1.0:
            tcp = factor * min(speed.tcp, max(fastest, 1e-3))
            speed = Speed(tcp, speed.reorientation * tcp / speed.tcp)
            duration = None if duration is None else duration / factor
        share = segment.acceleration_share * factor**2
        slowed.append(
            replace(
                segment,
                speed=speed,
                duration=duration,
                acceleration_share=share,
                slowed_for_belt=factor < 1.0,
            )
        )
    return slowed


def _fastest(path: Path, timing: TimeScaling) -> Array:
    """Return the largest path speeds (segments,) [m/s] in segments."""
    speeds = np.zeros(len(path.segments))
    number = np.searchsorted(path.segment_starts, timing.s, side="right") - 1
    np.maximum.at(speeds, number, timing.speed)
    return speeds


def _used(
    member: Member,
    segments: Sequence[Segment],
    path: Path,
    timing: TimeScaling,
    start: BlockStart,
) -> Array | PathFault:
    """Return the factor (segments,) by which the arm is too fast on each; up to 1 it is not."""
    from_m = float(path.segment_starts[start.move]) + start.distance_m
    piece = Piece(start.time_s, path, timing, from_m, path.length, start.number)
    motion = member.trajectory.extended(piece)
    times = np.arange(start.time_s - 2.0 * _STEP_S, motion.duration + 2.0 * _STEP_S, _STEP_S)
    samples, kinematics = motion.at(times), member.robot.kinematics
    segment = np.clip(samples.move - start.number, 0, len(path.segments) - 1)
    load, allowed = (
        np.array([getattr(one, name) for one in segments])[segment]
        for name in ("load", "acceleration_share")
    )
    speed, torque = limit_shares(samples, kinematics, member.limits, load, allowed)
    robot = member.robot
    for at, why in reasons_lost(samples, robot).items():
        return _fault(int(segment[at]), 1.0, f"at {times[at]:.3f} s {why}")
    used = np.zeros(len(path.segments))
    np.maximum.at(used, segment, np.maximum(speed, np.sqrt(torque)))
    # What the arm has passed is as it is.
    used[: start.move] = 0.0
    return used


def _without_length(path: Path) -> PathFault | None:
    lengths = np.diff(path.segment_bounds)
    for number, segment in enumerate(path.segments):
        if lengths[number] < _NO_LENGTH_M and any(ride.changes for ride in segment.rides):
            return _fault(number, 0.0, _NO_LENGTH)
    return None


def _fault(segment: int, fraction: float, reason: str) -> PathFault:
    return PathFault(segment, fraction, 0.0, 0.0, reason)
