"""Stopping on the path, storing it, resuming, and discarding the rest of it.

A stop withdraws what is fixed beyond it: a block that has its end stays in its queue until the next
one begins, so that its rest can be planned again.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace

import numpy as np

from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.queue.block import BlockPlan, Commit
from rapidsim.controller.queue.motion_queue import MotionQueue
from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import Geometry, Segment, Waypoint
from rapidsim.motion.timing.braking import stop_at

_SAME_JOINTS = np.radians(1e-3)
"""Joint distance [rad] below which an arm is where it left a path."""


def halt(queue: MotionQueue, now_s: float, in_s: float = 0.0) -> float:
    """Stop from a time, up to which the path is fixed or not; a guided robot stops being guided.

    Args:
        queue: Of the path.
        now_s: Time [s] at which braking begins.
        in_s: Braking time [s]; as fast as the axes can if 0.

    Returns:
        Command time [s] at which the robots are at rest.

    Raises:
        MotionError: If the path turns out not to be passable.
    """
    if any(member.guided is not None for member in queue.members):
        end_guidance(queue)
        now_s = max(now_s, *(member.trajectory.duration for member in queue.members))
    queue.advance(now_s, slack_s=0.0)
    queue.version += 1
    block = queue.block
    block.is_halted = True
    # In motion, although nothing is fixed from now on.
    flying = block.is_open and block.commit.time_s == now_s and block.commit.speed_m_s > 0.0
    if not flying and (not block.moves or now_s >= queue.command_end):
        return now_s
    while block.driven and block.driven[-1].start_s >= now_s:
        block.driven.pop()
    if flying:
        # If moves queued since then cannot be made, the arm brakes on the path it had before.
        with suppress(MotionError):
            block.driven.append(queue.planned())
    for member, delay_s in zip(queue.members, queue.delays_s, strict=True):
        member.trajectory.cut(now_s + delay_s)
    block.is_closed, block.plan = False, None
    if not block.driven:
        block.commit = Commit(now_s, 0, 0.0, 0.0)
        _take_back(queue, 0)
        return now_s
    under_way = block.driven[-1]
    since_s = now_s - under_way.start_s
    braking = stop_at(under_way.path, queue.planner.limits, under_way.timing, since_s, in_s)
    s, to_m = float(braking.s[0]), float(braking.s[-1])
    if to_m > s:
        stopping = BlockPlan(under_way.path, braking, under_way.first, s, now_s)
        queue.drive(stopping, to_m)
        block.driven.append(stopping)
    starts = under_way.path.segment_starts
    index = under_way.first + int(np.searchsorted(starts, to_m, side="right")) - 1
    rest_s = now_s + braking.duration
    block.commit = Commit(rest_s, index, to_m - under_way.start_of(index), 0.0, None)
    for row in block.rows:
        row[index].was_stopped = True
    _take_back(queue, index + 1)
    return rest_s


def end_guidance(queue: MotionQueue) -> None:
    """Bring robots that sensors guide to rest where they are; the next move begins there."""
    for member in queue.members:
        guided, member.guided = member.guided, None
        if guided is not None:
            guided.release()
            queue.begin_again(guided.section.end_s)
            member.end = member.standing()


def resume(queue: MotionQueue, now_s: float) -> None:
    """Continue from where the robots were stopped; they return there if they have moved since.

    While the path is stored for one of them, all stay halted.
    """
    if queue.stored_by:
        return
    block, left_at = queue.block, dict(queue.left_at)
    queue.left_at.clear()
    if left_at and block.is_open:
        now_s = _regain(queue, left_at, now_s)
    queue.version += 1
    block.is_halted = False
    if block.is_open:
        block.commit = replace(block.commit, time_s=max(now_s, block.commit.time_s))
        block.plan = None
        if not block.driven:
            for row in block.rows:
                row[0].command_start_s = block.commit.time_s


def _regain(queue: MotionQueue, left_at: Mapping[int, Waypoint], now_s: float) -> float:
    """Return to where the path was left, all axes together, at the programmed speed of the path.

    Args:
        queue: Of the path.
        left_at: Positions at which robots, by number, left it, of the flange without a tool.
        now_s: Time [s] at which it begins.

    Returns:
        Command time [s] of the arrival; `now_s` if all are there already.
    """
    stands = [member.standing() for member in queue.members]
    goals = [left_at.get(number, here) for number, here in enumerate(stands)]
    if all(map(_is_same_place, stands, goals)):
        return now_s
    under_way = [row[queue.block.commit.move] for row in queue.block.rows]
    back = [
        [replace(queued, segment=_segment_back(queued.segment, here, there))]
        for queued, here, there in zip(under_way, stands, goals, strict=True)
    ]
    path, timing = queue.planner.plan(back)
    start_s = max(now_s, queue.ready_s)
    whole = BlockPlan(path, timing, queue.block.commit.move, 0.0, start_s)
    queue.drive(whole, path.length)
    dwell_s = queue.members[0].model.dwell_after(timing.braking_s)
    return start_s + timing.duration + dwell_s


def _is_same_place(waypoint: Waypoint, left_at: Waypoint) -> bool:
    """Whether an arm is where it left its path."""
    return bool(np.max(np.abs(waypoint.joints - left_at.joints)) < _SAME_JOINTS)


def _segment_back(segment: Segment, waypoint: Waypoint, left_at: Waypoint) -> Segment:
    """Segment from the position of an arm to where it left another one; all axes move together."""
    return replace(
        segment,
        geometry=Geometry.JOINT,
        start=waypoint,
        end=left_at,
        tcp_from_flange=Transform.identity(),
        zone=None,
        via=None,
        duration=None,
        carrier=None,
        wrist_in_joints=False,
    )


def off_path_reason(queue: MotionQueue) -> str:
    """Distance of a robot from where it left the path to be resumed, as text.

    Empty if all are near enough to return by themselves.
    """
    block = queue.block
    if not block.is_open:
        return ""
    for number, left_at in queue.left_at.items():
        segment = block.rows[number][block.commit.move].segment
        too_far = queue.members[number].distance_from(left_at, segment)
        if too_far:
            return too_far
    return ""


def store(queue: MotionQueue, number: int) -> None:
    """Store the path for one robot, which is at rest; it stays halted until all restore it."""
    queue.version += 1
    queue.stored_by.add(number)
    # A restored path that was not continued keeps the position at which it was left first.
    queue.left_at.setdefault(number, queue.members[number].standing())


def restore(queue: MotionQueue, number: int) -> None:
    """Restore the path for one robot, which is at rest; see `store`."""
    queue.version += 1
    queue.block.plan = None
    queue.stored_by.discard(number)
    if not queue.stored_by:
        queue.next_level = None


def clear(queue: MotionQueue) -> None:
    """Discard the remaining path of robots at rest."""
    queue.version += 1
    queue.left_at.clear()
    block = queue.block
    if block.is_open:
        block.is_closed, block.plan = True, None
        end_s = queue.command_end
        for member, row in zip(queue.members, block.rows, strict=True):
            member.ready_s = end_s
            # The next move waits until the arm is at rest.
            member.settled_s = -math.inf
            for queued in row:
                if queued.started.time is None:
                    # The program no longer waits for it.
                    queued.started.time = end_s
                queued.end_place_m = min(queued.end_place_m, member.trajectory.length)
    for member in queue.members:
        member.settle_correction()
        member.end = member.end_of_command() if member.rides else member.standing()


def leave(queue: MotionQueue) -> None:
    """Leave the robots in motion to the end of their fixed path; planning ends.

    The move that begins at that end counts as begun, because the arm is about to make it.
    """
    block = queue.block
    if not block.is_open or not block.driven:
        return
    for member, row in zip(queue.members, block.rows, strict=True):
        queued = row[block.commit.move]
        if queued.ended_s is None:
            queued.started.time = queued.ended_s = block.commit.time_s
            queued.start_place_m = queued.end_place_m = member.trajectory.length


def _take_back(queue: MotionQueue, index: int) -> None:
    """Withdraw the start of a move of the block and of those after it."""
    for row in queue.block.rows:
        for queued in row[index:]:
            queued.started.time = None
            queued.ended_s = None
