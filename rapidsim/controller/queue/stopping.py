"""Stopping on the path, resuming, and discarding the rest of the path.

A stop withdraws what is fixed beyond it: a block that has its end stays with its planner until the
next one begins, so that its rest can be planned again.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import replace

import numpy as np

from rapidsim.controller.moves.queued_move import MotionError, QueuedMove
from rapidsim.controller.queue.block import BlockPlan, Commit
from rapidsim.controller.queue.path_planner import BlockPlanner
from rapidsim.frames.transform import Transform
from rapidsim.motion.geometry.segments import Geometry, Segment, Waypoint
from rapidsim.motion.timing.braking import stop_at
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.command import Piece

_SAME_JOINTS = np.radians(1e-3)
"""Joint distance [rad] below which an arm is where it left a path."""


def halt(planner: BlockPlanner, now_s: float, in_s: float = 0.0) -> float:
    """Stop from a time, up to which the path is fixed or not.

    Args:
        planner: Of the path.
        now_s: Time [s] at which braking begins.
        in_s: Braking time [s]; as fast as the axes can if 0.

    Returns:
        Command time [s] at which the robot is at rest.

    Raises:
        MotionError: See `BlockPlanner.append`.
    """
    planner.advance(now_s, slack_s=0.0)
    planner.version += 1
    block = planner.block
    block.is_halted = True
    # In motion, although nothing is fixed from now on.
    flying = block.is_open and block.commit.time_s == now_s and block.commit.speed_m_s > 0.0
    if not flying and (not block.moves or now_s >= planner.trajectory.command_end):
        return now_s
    while block.driven and block.driven[-1].start_s >= now_s:
        block.driven.pop()
    if flying:
        # If moves queued since then cannot be made, the arm brakes on the path it had before.
        with suppress(MotionError):
            block.driven.append(planner.planned())
    planner.trajectory.cut(now_s)
    block.is_closed, block.plan = False, None
    if not block.driven:
        block.commit = Commit(now_s, 0, 0.0, 0.0)
        _take_back(planner, 0)
        return now_s
    under_way = block.driven[-1]
    since_s = now_s - under_way.start_s
    braking = stop_at(under_way.path, planner.limits, under_way.timing, since_s, in_s)
    s, to_m = float(braking.s[0]), float(braking.s[-1])
    if to_m > s:
        first = block.moves[under_way.first].number
        planner.trajectory.append(Piece(now_s, under_way.path, braking, s, to_m, first))
        block.driven.append(BlockPlan(under_way.path, braking, under_way.first, s, now_s))
    starts = under_way.path.segment_starts
    index = under_way.first + int(np.searchsorted(starts, to_m, side="right")) - 1
    rest_s = now_s + braking.duration
    block.commit = Commit(rest_s, index, to_m - under_way.start_of(index), 0.0, None)
    block.moves[index].was_stopped = True
    _take_back(planner, index + 1)
    return rest_s


def resume(planner: BlockPlanner, now_s: float) -> None:
    """Continue from where the robot was stopped."""
    planner.version += 1
    block = planner.block
    block.is_halted = False
    if block.is_open:
        block.commit = replace(block.commit, time_s=max(now_s, block.commit.time_s))
        block.plan = None
        if not block.driven:
            block.moves[0].command_start_s = block.commit.time_s


def regain(planner: BlockPlanner, waypoint: Waypoint, left_at: Waypoint, now_s: float) -> float:
    """Return to where the path was left, all axes together, at the programmed speed of the path.

    Args:
        planner: Of the path.
        waypoint: Position of the arm, of the flange without a tool.
        left_at: Position at which it left the path, likewise of the flange.
        now_s: Time [s] at which it begins.

    Returns:
        Command time [s] of its arrival; `now_s` if it is there already.
    """
    if is_same_place(waypoint, left_at):
        return now_s
    move = planner.block.moves[planner.block.commit.move]
    back = replace(move, segment=segment_back(move.segment, waypoint, left_at))
    return go_back(planner, back, now_s)


def is_same_place(waypoint: Waypoint, left_at: Waypoint) -> bool:
    """Whether an arm is where it left its path."""
    return bool(np.max(np.abs(waypoint.joints - left_at.joints)) < _SAME_JOINTS)


def segment_back(segment: Segment, waypoint: Waypoint, left_at: Waypoint) -> Segment:
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


def go_back(planner: BlockPlanner, move: QueuedMove, now_s: float) -> float:
    """Append a move back to the path to the motion; return the command time [s] of its end."""
    path = planner.build([move], None)
    timing = plan(path, planner.limits, check_deadline=planner.check_deadline)
    start_s = max(now_s, planner.ready_s)
    planner.trajectory.append(Piece(start_s, path, timing, 0.0, path.length, move.number))
    return start_s + timing.duration + planner.model.dwell_after(timing.braking_s)


def clear(planner: BlockPlanner) -> None:
    """Discard the remaining path of a robot at rest."""
    planner.version += 1
    block, trajectory = planner.block, planner.trajectory
    if block.is_open:
        block.is_closed, block.plan = True, None
        planner.ready_s = trajectory.command_end
        # The next move waits until the arm is at rest.
        planner.settled_s = -math.inf
        for queued in block.moves:
            if queued.started.time is None:
                # The program no longer waits for it.
                queued.started.time = planner.ready_s
            queued.end_place_m = min(queued.end_place_m, trajectory.length)
    planner.moved(block.moves, None)


def leave(planner: BlockPlanner) -> None:
    """Leave the robot in motion to the end of its fixed path; planning ends.

    The move that begins at that end counts as begun, because the arm is about to make it.
    """
    block = planner.block
    if not block.is_open or not block.driven:
        return
    queued = block.moves[block.commit.move]
    if queued.ended_s is None:
        queued.started.time = queued.ended_s = block.commit.time_s
        queued.start_place_m = queued.end_place_m = planner.trajectory.length
        planner.moved([queued], None)


def _take_back(planner: BlockPlanner, index: int) -> None:
    """Withdraw the start of a move of the block and of those after it."""
    taken = planner.block.moves[index:]
    for queued in taken:
        queued.started.time = None
        queued.ended_s = None
    planner.moved(taken, None)
