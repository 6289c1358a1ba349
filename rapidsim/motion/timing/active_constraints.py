"""Active constraints: the axis or programmed speed that limits a segment for most of its time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.numba_jit import jit_function
from rapidsim.motion.timing import two_pass_loops
from rapidsim.motion.timing.constraints import Limiter, Quantity
from rapidsim.motion.timing.problem import Problem
from rapidsim.motion.timing.stages import Stages, in_the_middle, rows_along, weights_of
from rapidsim.motion.timing.time_optimal import StageMotion

_REACHED = 0.99


def limiters_of(problem: Problem, motion: StageMotion) -> tuple[Limiter, ...]:
    """Return the active constraint of each segment of a path."""
    path, cells = problem.path, problem.cells
    kind = _most_used(problem, motion.stages, motion.x)
    kinds = (*problem.speeds.limiters, *problem.accelerations.limiters, Limiter(Quantity.NOTHING))
    segment = path.segment_of(cells.piece[motion.stages.cell])
    cases = len(path.segments) * len(kinds)
    total = np.bincount(segment * len(kinds) + kind, motion.times, cases).reshape(-1, len(kinds))
    found = np.where(total.any(axis=1), total.argmax(axis=1), len(kinds) - 1)
    limiters = [kinds[number] for number in found.tolist()]
    if path.slowest is not None:
        of_robots = zip(limiters, path.slowest.tolist(), strict=True)
        limiters = [replace(one, robot=n) if one.is_programmed else one for one, n in of_robots]
    return tuple(limiters)


def _most_used(problem: Problem, stages: Stages, x: Array) -> Index:
    """Return the limit (m,) that is used most in the middle of each stage; speeds count first."""
    cells, speeds, accelerations = problem.cells, problem.speeds, problem.accelerations
    middle, u, square = in_the_middle(stages, x)
    kernel = jit_function(two_pass_loops, "held_back_by", len(u))
    if kernel is not None:
        kinds = np.empty(len(u), dtype=np.int64)
        rows = (cells.at, speeds.rate, accelerations.slope, accelerations.bend)
        kernel(rows, stages.cell, middle, u, square, _REACHED, kinds)
        return kinds
    at, weights = cells.at[stages.cell], weights_of(middle)
    # A reached speed is the active constraint, for any share of the acceleration.
    usage = rows_along(speeds.rate, at, weights) * np.sqrt(square)[:, None]
    slope = rows_along(accelerations.slope, at, weights)
    bend = rows_along(accelerations.bend, at, weights)
    load = np.abs(slope * u[:, None] + bend * square[:, None])
    held = (usage.max(axis=1) > _REACHED) | ~load.any(axis=1)
    kind: Index = np.where(held, usage.argmax(axis=1), usage.shape[1] + load.argmax(axis=1))
    return kind
