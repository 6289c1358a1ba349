"""Motion whose average over the window of a ramp needs no more torque than without a ramp.

A ramp of AccSet averages the speed along the path over a window W (`trajectory/ramps`). Where the
command is slow for a short time, in a corner or where it enters one, its average is faster, and
would need torques that the arm does not have. There the command keeps the low speed for W / 2
before and afterwards. Its average is then nowhere faster than the command without ramps, which
keeps all limits, and it changes its speed more gently.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.interruption import Look
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.problem import Problem
from rapidsim.motion.timing.smoothed_speed_limits import held_speeds, lowest_over
from rapidsim.motion.timing.time_optimal import Division, StageMotion, drive
from rapidsim.motion.timing.time_scaling import TimeScaling, with_rests

_FASTER = 1.01
"""Share of the command's speed above which its average counts as faster."""
_STAGES = 16
"""Number of stages in a window, around places where the speed is held."""
_MOST_PARTS = 32
_LEAST_SPEED = 1e-6
"""Path speed [m/s] that replaces 0 at stops, where the average comes to rest, too."""
_TOLERANCE = 1e-6
_LATER = (0.0, 0.5, 1.0, 2.0, 4.0)
"""Windows after the start of a motion in which nothing is held, if it starts too fast for that."""


def ramped_drive(
    problem: Problem,
    division: Division,
    free: StageMotion,
    start_speed: float,
    check_deadline: Look,
) -> StageMotion:
    """Return the fastest motion that holds low speeds as the ramps of its path require.

    Args:
        problem: The limits.
        division: The stages of the motion without held speeds.
        free: That motion.
        start_speed: Path speed [m/s] at its start.
        check_deadline: Called regularly.
    """
    speeds = _speeds(problem, division, free)
    parts = _parts(problem, division, speeds)
    if parts is None:
        return free
    division = division.cut(problem, parts)
    free = drive(problem, division, start_speed)
    nodes, speeds = division.stages.nodes, _speeds(problem, division, free)
    windows = _windows_at(problem, nodes)
    too_fast = _faster(problem.path, nodes, speeds, windows)
    slow_enough = min(start_speed**2, free.fastest_start) * (1.0 - _TOLERANCE)
    start, positive = nodes[division.driven], np.maximum(speeds, _LEAST_SPEED)
    for later in _LATER:
        check_deadline()
        near = start + later * float(windows.max()) * start_speed
        needed = too_fast & ((nodes < start) | (nodes >= near))
        if not needed.any():
            break
        held = np.full(len(speeds), np.inf)
        for window in np.unique(windows[needed]).tolist():
            own = needed & (windows == window)
            np.minimum(held, held_speeds(nodes, positive, own, window), out=held)
        motion = drive(problem, division, start_speed, held**2)
        if motion.fastest_start >= slow_enough:
            return motion
    return free


def _speeds(problem: Problem, division: Division, free: StageMotion) -> Array:
    """Return the speeds (m + 1,) [m/s] at all nodes without held ones, also before the start."""
    if division.driven:
        whole = replace(division, driven=0)
        fastest = float(np.sqrt(drive(problem, whole, 0.0).fastest_start))
        free = drive(problem, whole, fastest)
    speeds: Array = np.sqrt(free.x)
    return speeds


def _windows_at(problem: Problem, nodes: Array) -> Array:
    """Return the widths (m + 1,) [s] of the windows at nodes, the largest of neighbouring moves."""
    path = problem.path
    widths = np.pad(path.ramp_windows, 1, mode="edge")
    widest = np.maximum(np.maximum(widths[:-2], widths[1:-1]), widths[2:])
    segment = np.searchsorted(path.segment_starts, nodes, side="right") - 1
    return widest[np.clip(segment, 0, len(widest) - 1)]


def _faster(path: Path, nodes: Array, speeds: Array, windows: Array) -> Mask:
    """Mask (m + 1,) of the nodes at which the average is faster than the command."""
    rested, speed, standing = with_rests(path, nodes, speeds)
    motion = TimeScaling(rested, speed, 0.0, standing=standing)
    faster: Mask = np.zeros(len(nodes), dtype=bool)
    for window in np.unique(windows[windows > 0.0]).tolist():
        # Also after the end, until the window contains only rest.
        times = np.union1d(motion.times, motion.times + window)
        too_fast = np.interp(nodes, *motion.smoothed(window, times)) > _FASTER * speeds
        faster |= too_fast & (windows == window) & (speeds > 0.0)
    return faster


def _parts(problem: Problem, division: Division, speeds: Array) -> Index | None:
    """Return parts (m,) of the stages around places where the speed will be held; None if none."""
    nodes = division.stages.nodes
    windows = _windows_at(problem, nodes)
    faster = _faster(problem.path, nodes, speeds, windows)
    if not faster.any():
        return None
    times = TimeScaling(nodes, speeds, 0.0).times
    widest, at = float(windows.max()), times[faster]
    first = np.searchsorted(times, at - widest, side="left")
    after = np.searchsorted(times, at + widest, side="right")
    near = np.isfinite(lowest_over(first, after, at, len(times)))
    beside = near[1:] | near[:-1]
    parts: Index = np.ones(len(times) - 1, dtype=np.int64)
    least = widest / _STAGES
    parts[beside] = np.ceil(np.diff(times)[beside] / least).clip(1, _MOST_PARTS).astype(np.int64)
    return parts
