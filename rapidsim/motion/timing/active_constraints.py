"""Active constraints: the limit that decides how fast each part of a motion is.

A stage of the solver is as fast as one of its rows allows, which is then at its limit at one of the
stage's ends, or as the maximum speed at one of its ends. If it has neither, it leads to the speed
from which the next stage can brake, so the active constraint is that of the next stage.

The maximum speed is that of a row in the stage, or of a slower place, at its speed half the
smoothing's width away, past which the smoothed motion would otherwise be too fast.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.constraints import Limiter, Quantity
from rapidsim.motion.timing.problem import HELD_BEND, Problem
from rapidsim.motion.timing.smoothed_speed_limits import deciding_points
from rapidsim.motion.timing.stages import fastest, rows_along, weights_of
from rapidsim.motion.timing.time_optimal import StageMotion, between_stops
from rapidsim.motion.timing.time_scaling import Numbers, TimeScaling

_FULL = 1e-4
"""Share of a limit by which a row at its limit may be below it."""
_EQUAL = 1e-6
"""Relative difference below which speeds count as equal."""
_AT_ONCE = 20_000
"""Number of stages evaluated at once, which bounds the memory."""
_FURTHER = (Limiter(Quantity.CYCLE), Limiter(Quantity.CORNER), Limiter(Quantity.RAMP))
_CYCLE, _CORNER, _RAMP = range(-3, 0)


def active_limits(problem: Problem, motion: StageMotion) -> tuple[tuple[Limiter, ...], Numbers]:
    """Return limits, and the index (m,) of the active one among them in each stage of a motion."""
    path, stages = problem.path, motion.stages
    kinds = (*problem.speeds.limiters, *problem.accelerations.limiters, *_FURTHER)
    row, load = _fullest_rows(motion)
    number = len(problem.speeds.limiters) + row
    at_cap = motion.x >= (1.0 - _EQUAL) * motion.caps
    capped = (load < 1.0 - _FULL) & (at_cap[:-1] | at_cap[1:])
    known = capped | (load >= 1.0 - _FULL)
    if capped.any():
        number[capped] = _of_caps(problem, motion, capped)[capped] % len(kinds)
    # The last stage ends at rest, within its rows.
    known[-1] = True
    after = np.where(known, np.arange(len(number)), len(number))
    number = number[np.minimum.accumulate(after[::-1])[::-1]]
    robot = np.full(len(number), -1)
    if path.slowest is not None:
        paced = np.array([kind.is_programmed for kind in kinds])
        segment = path.segment_of(problem.cells.piece[stages.cell])
        robot = np.where(paced[number], path.slowest[segment], -1)
    cases, active = np.unique((robot + 1) * len(kinds) + number, return_inverse=True)
    limiters = []
    for case in cases.tolist():
        setter, kind = divmod(case, len(kinds))
        limiters.append(replace(kinds[kind], robot=setter - 1) if setter else kinds[kind])
    return tuple(limiters), active.astype(np.int16)


def limiters_of_segments(path: Path, timing: TimeScaling) -> tuple[Limiter, ...]:
    """Return the limit that is active for most of the time of each segment of a path."""
    nothing = Limiter(Quantity.NOTHING)
    if timing.active is None:
        return (nothing,) * len(path.segments)
    moving_s = np.diff(timing.times)
    if timing.standing is not None:
        moving_s = moving_s - timing.standing
    segment = np.searchsorted(path.segment_starts, timing.s[:-1], side="right") - 1
    kinds = len(timing.limiters)
    total = np.bincount(segment * kinds + timing.active, moving_s, len(path.segments) * kinds)
    of_segment = total.reshape(-1, kinds)
    most = np.where(of_segment.any(axis=1), of_segment.argmax(axis=1), kinds)
    return tuple((*timing.limiters, nothing)[number] for number in most.tolist())


def _fullest_rows(motion: StageMotion) -> tuple[Index, Array]:
    """Return the acceleration row (m,) that is used most at either end of stages, and its share."""
    stages, x = motion.stages, motion.x
    u = np.diff(x) / np.maximum(2.0 * stages.width, 1e-300)
    row, load = np.empty(len(u), dtype=np.int64), np.empty(len(u))
    rows = stages.slack.shape[1] // 2
    for begin in range(0, len(u), _AT_ONCE):
        some = slice(begin, begin + _AT_ONCE)
        used = np.abs(u[some, None] + stages.tilt[some] * x[:-1][some, None]) / stages.slack[some]
        fullest = used.argmax(axis=1)
        row[some], load[some] = fullest % rows, used[np.arange(len(fullest)), fullest]
    return row, load


def _of_caps(problem: Problem, motion: StageMotion, capped: Mask) -> Index:
    """Return the limit (m,) of the maximum speed in the middle of some stages; see `_FURTHER`."""
    stages = motion.stages
    piece = problem.cells.piece[stages.cell]
    own = fastest(stages, problem.cells, problem.slowness)[:, 1]
    most = np.sqrt(motion.by_speed)
    lowered = capped & (most < (1.0 - _EQUAL) * own)
    in_zones = problem.path.zone_speed[piece]
    cycle = lowered & (most >= (1.0 - _EQUAL) * in_zones)
    held = lowered & ~cycle
    source = np.arange(len(own))
    middle = motion.stages.places[:, 1]
    for part in between_stops(problem, stages) if held.any() else ():
        wanted = np.flatnonzero(held[part])
        deciding = deciding_points(middle[part], own[part], wanted, problem.path.window)
        source[part.start + wanted] = part.start + deciding
    number = np.zeros(len(own), dtype=np.int64)
    evaluated = np.unique(source[capped])
    number[evaluated] = _slowest_rows(problem, motion, evaluated)
    number = number[source]
    in_zone = problem.path.zone_radius[piece] > 0.0
    of_pace = [row for row, one in enumerate(problem.speeds.limiters) if one.is_programmed]
    of_zone = in_zone[source] & ~np.isin(number, of_pace)
    number[held & of_zone & ~in_zone] = _CORNER
    number[cycle] = _CYCLE
    caps = np.minimum(motion.ramp_caps[:-1], motion.ramp_caps[1:])
    number[caps < (1.0 - _EQUAL) * motion.by_speed] = _RAMP
    return number


def _slowest_rows(problem: Problem, motion: StageMotion, some: Index) -> Index:
    """Return the row (j,) that limits the speed most in the middle of some stages (j,)."""
    stages, speeds, bends = motion.stages, problem.speeds, problem.accelerations.bend
    found = np.empty(len(some), dtype=np.int64)
    of_motion = len(speeds.limiters) - speeds.of_command
    for begin in range(0, len(some), _AT_ONCE):
        which = some[begin : begin + _AT_ONCE]
        at = problem.cells.at[stages.cell[which]]
        weights = weights_of(0.5 * (stages.begin + stages.end)[which])
        slowness = np.zeros((len(which), len(speeds.limiters) + bends.shape[1]))
        slowness[:, :of_motion] = rows_along(speeds.rate, at, weights)[:, :of_motion]
        if problem.path.model.slows_for_bends:
            bend = np.abs(rows_along(bends, at, weights))
            slowness[:, len(speeds.limiters) :] = np.sqrt(HELD_BEND * bend)
        found[begin : begin + _AT_ONCE] = slowness.argmax(axis=1)
    return found
