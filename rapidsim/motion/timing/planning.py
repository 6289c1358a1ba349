"""Time-optimal motion along a path within limits and programmed times."""

from __future__ import annotations

import math

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.active_constraints import active_limits
from rapidsim.motion.timing.axis_limits import Limits, limits_along
from rapidsim.motion.timing.constraints import Paces
from rapidsim.motion.timing.discretisation import cells_of
from rapidsim.motion.timing.problem import Problem, at_pace, problem_of
from rapidsim.motion.timing.ramped_drive import ramped_drive
from rapidsim.motion.timing.time_optimal import Division, drive, fastest_drive
from rapidsim.motion.timing.time_scaling import TimeScaling, with_rests

_TIMED_ROUNDS = 4
_TIMED_HALVINGS = 16
_TIME_TOLERANCE = 1e-3
_LEAST_TIME_S = 1e-6


def plan(
    path: Path,
    limits: Limits,
    *,
    start: float = 0.0,
    start_speed: float = 0.0,
    spent_s: float | None = None,
    check_deadline: Look = undisturbed,
) -> TimeScaling:
    """Find the fastest motion to rest at the end of a path.

    Args:
        path: The geometry.
        limits: Axis limits; the segments contain the limits of the TCP.
        start: Position [m] where the motion starts.
        start_speed: Path speed [m/s] there. If it is too fast to brake within the limits, it is
            kept, the motion brakes as hard as the arm can, harder only as far as it must, and
            `TimeScaling.start_excess` is set.
        spent_s: Time [s] already spent in the segment where the motion starts; None takes the
            corresponding share of its programmed time.
        check_deadline: Called regularly.
    """
    if start >= path.length:
        return TimeScaling(np.full(2, path.length), np.zeros(2), start_excess=start_speed)
    limits = limits_along(path, limits)
    timed, driven = _timed(path, start, spent_s)
    unpaced = {**driven, **dict.fromkeys(timed, math.inf)}
    problem = problem_of(path, cells_of(path, limits, start, check_deadline), limits, unpaced)
    division, motion = fastest_drive(problem, start_speed, check_deadline)
    # A pace is not a limit of the arm: a faster start is slowed down to it.
    fastest_start = motion.fastest_start
    if timed:
        paces = _paces(problem, division, start_speed, timed, driven, check_deadline)
        division, _ = fastest_drive(at_pace(problem, paces), start_speed, check_deadline)
        paces = _paces(problem, division, start_speed, timed, driven, check_deadline)
        problem = at_pace(problem, paces)
        motion = drive(problem, division, start_speed)
    if path.ramp_windows.any():
        motion = ramped_drive(problem, division, motion, start_speed, check_deadline)
    limiters, active = active_limits(problem, motion)
    nodes, speed, standing = with_rests(path, motion.stages.nodes, np.sqrt(motion.x))
    return TimeScaling(
        s=nodes,
        speed=speed,
        start_excess=max(0.0, start_speed - float(np.sqrt(fastest_start))),
        limiters=limiters,
        active=active[np.searchsorted(motion.stages.nodes[1:-1], nodes[:-1], side="right")],
        standing=standing,
    )


def _timed(
    path: Path, start: float, spent_s: float | None
) -> tuple[dict[int, float], dict[int, float]]:
    """Return the remaining programmed time [s] of each timed segment, and the finished segments.

    Finished segments have neither a pace nor the speed that their time replaces: smoothing would
    apply it to the motion after them.
    """
    begins, ends = path.segment_bounds[:-1], path.segment_bounds[1:]
    times, driven = {}, {}
    for i, segment in enumerate(path.segments):
        if segment.duration is None:
            continue
        if ends[i] <= max(start, begins[i]):
            driven[i] = math.inf
        elif begins[i] < start and spent_s is not None:
            times[i] = max(segment.duration - spent_s, _LEAST_TIME_S)
        else:
            share = (ends[i] - max(start, begins[i])) / (ends[i] - begins[i])
            times[i] = max(segment.duration * float(share), _LEAST_TIME_S)
    return times, driven


def _paces(
    problem: Problem,
    division: Division,
    start_speed: float,
    timed: dict[int, float],
    driven: Paces,
    check_deadline: Look,
) -> Paces:
    """Return the path speed that yields each timed segment's time; infinite if that is too short.

    Neighbours share the ramps between them, so all are bisected together, and again around the
    result until the times agree.
    """
    index = np.array(list(timed))
    wanted = np.array(list(timed.values()))
    path, stages = problem.path, division.stages.beyond(division.driven)
    segment, width = path.segment_of(problem.cells.piece[stages.cell]), stages.width
    way = np.bincount(segment, width, minlength=len(path.segments))[index]

    def spent(trial: Array) -> Array:
        """Return the time spent in the timed segments at these paces."""
        check_deadline()
        attempt = {**driven, **dict(zip(timed, trial.tolist(), strict=True))}
        step = drive(at_pace(problem, attempt), division, start_speed).times
        time: Array = np.bincount(segment, step, minlength=len(path.segments))[index]
        return time

    fastest = spent(np.full(len(index), np.inf))
    # A segment that takes no time has no remaining path.
    feasible = (fastest > 0.0) & (fastest < wanted * (1.0 - _TIME_TOLERANCE))
    # Half the mean speed is slow enough even if a fast start has to be braked first.
    low = 0.5 * way / wanted
    high = low + np.divide(4.0 * way, fastest, out=np.full(len(way), np.inf), where=feasible)
    found = high
    for _ in range(_TIMED_ROUNDS):
        for _ in range(_TIMED_HALVINGS):
            middle = np.where(feasible, 0.5 * (low + high), np.inf)
            slow = spent(middle) > wanted
            low, high = np.where(slow, middle, low), np.where(slow, high, middle)
        found = np.where(feasible, 0.5 * (low + high), np.inf)
        miss = np.abs(spent(found) - wanted) / wanted
        if not (feasible & (miss > _TIME_TOLERANCE)).any():
            break
        low, high = found / 1.3, found * 1.3
    return {**driven, **dict(zip(timed, found.tolist(), strict=True))}
