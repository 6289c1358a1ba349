"""What limits a motion at the cells of a path, ready for the solver, and how it grows with them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion import solver_loops
from rapidsim.motion.compiled import compiled
from rapidsim.motion.curves import Index
from rapidsim.motion.grid import Cells, split
from rapidsim.motion.held_speeds import held_speeds
from rapidsim.motion.limits import Limits
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path import Path
from rapidsim.motion.rows import AccelerationRows, SpeedRows, acceleration_rows, speed_rows

LARGEST_X = 1e12
"""Square of a path speed [m2/s2] that nothing reaches."""
_LARGEST_SPEED = 1e6
_CHUNK = 4096
_HELD_BEND = 1.25
"""By this much less of the acceleration is used for the bend of the path where smoothing may add a
change of speed that the command does not have there; measured on random programs."""


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """All limits at the cells (c,) of a path."""

    path: Path
    limits: Limits
    cells: Cells
    speeds: SpeedRows
    """At the places of the cells."""
    accelerations: AccelerationRows
    """At the places of the cells."""
    slack: Array
    """Shape (c, rows of starts, then of ends): |u + tilt x| <= slack."""
    tilt: Array
    widest: Array
    """Shape (c,): largest x at the start for which some u keeps every row."""
    fastest: Array
    """Largest path speeds [m/s] at the places of the cells."""
    by_speed: Array
    """Shape (c, 3): largest x by speeds at starts, middles and ends; see `_largest_by_speed`."""
    behind: tuple[Array, Array]
    """Places before the start, ascending, and the largest path speeds [m/s] there."""


def problem_of(path: Path, cells: Cells, limits: Limits, pace: Array) -> Problem:
    """Collect what limits a motion.

    Args:
        path: The geometry.
        cells: Where to look; the motion starts with the first and comes to rest after the last.
        limits: Of the axes.
        pace: Largest path speed (segments,) [m/s] on segments with a programmed time; it replaces
            the programmed speeds there. NaN elsewhere.
    """
    rows = acceleration_rows(path, cells.places, limits)
    slack, tilt, widest = _stages(rows, cells)
    speeds = speed_rows(path, cells.places, limits, pace)
    fastest = _fastest(path.model, speeds, rows)
    behind = (np.zeros(0), np.zeros(0))
    if cells.behind is not None and path.model.filter_time:
        places = cells.behind.places
        before = _fastest(
            path.model,
            speed_rows(path, places, limits, pace),
            acceleration_rows(path, places, limits),
        )
        behind = (cells.behind.s.ravel(), before[cells.behind.at].ravel())
    by_speed = _largest_by_speed(cells, fastest, path.model.filter_time, behind)
    return Problem(
        path, limits, cells, speeds, rows, slack, tilt, widest, fastest, by_speed, behind
    )


def at_pace(problem: Problem, pace: Array) -> Problem:
    """The same with another pace; see `problem_of`."""
    path, cells = problem.path, problem.cells
    speeds = speed_rows(path, cells.places, problem.limits, pace)
    fastest = _fastest(path.model, speeds, problem.accelerations)
    by_speed = _largest_by_speed(cells, fastest, path.model.filter_time, problem.behind)
    return replace(problem, speeds=speeds, fastest=fastest, by_speed=by_speed)


def cut(problem: Problem, pace: Array, index: Index, at: Array) -> Problem:
    """The same with some cells (k,), in increasing order, cut at places (k,) inside them.

    Only what is new is worked out.
    """
    path, limits = problem.path, problem.limits
    cells = split(path, problem.cells, index, at)
    new = cells.places.beyond(len(problem.cells.places.s))
    new_rows, new_speeds = acceleration_rows(path, new, limits), speed_rows(path, new, limits, pace)
    rows, speeds = problem.accelerations.and_then(new_rows), problem.speeds.and_then(new_speeds)
    fastest = np.concatenate([problem.fastest, _fastest(path.model, new_speeds, new_rows)])
    count = np.ones(len(problem.widest), dtype=np.int64)
    count[index] = 2
    first = index + np.arange(len(index))
    halves = np.stack([first, first + 1], axis=1).ravel()
    slack, tilt, widest = (
        np.repeat(values, count, axis=0) for values in (problem.slack, problem.tilt, problem.widest)
    )
    slack[halves], tilt[halves], widest[halves] = _stages(rows, replace(cells, at=cells.at[halves]))
    return replace(
        problem,
        cells=cells,
        speeds=speeds,
        accelerations=rows,
        slack=slack,
        tilt=tilt,
        widest=widest,
        fastest=fastest,
        by_speed=_largest_by_speed(cells, fastest, path.model.filter_time, problem.behind),
    )


def _fastest(model: MotionModel, speeds: SpeedRows, accelerations: AccelerationRows) -> Array:
    """Largest path speeds (k,) [m/s] that the arm may have at places.

    If the smoothed motion is to keep accelerations, these are speeds that use most of them where
    the path bends; what is left is for the change of speed.
    """
    slowness = speeds.largest
    if model.accelerations_kept_by == "motion":
        slowness = np.maximum(slowness, np.sqrt(_HELD_BEND * accelerations.largest_bend))
    fastest: Array = np.minimum(1.0 / np.maximum(slowness, 1e-9), _LARGEST_SPEED)
    return fastest


def _largest_by_speed(
    cells: Cells, fastest: Array, window: float, behind: tuple[Array, Array]
) -> Array:
    """Largest x (c, 3) of the command by speeds at starts, middles and ends."""
    own = fastest[cells.at]
    if window == 0.0:
        return own**2
    places = np.concatenate([behind[0], cells.s.ravel()])
    around = np.concatenate([behind[1], own.ravel()])
    held = held_speeds(places, around, window)[len(behind[0]) :]
    by_speed: Array = held.reshape(own.shape) ** 2
    return by_speed


def _stages(rows: AccelerationRows, cells: Cells) -> tuple[Array, Array, Array]:
    """Slack, tilt and widest of cells; see `Problem`.

    At the end of a cell x has grown by span u, so its row is |(slope + span bend) u + bend x| <= 1.
    """
    start, end = cells.at[:, 0], cells.at[:, 2]
    span = 2.0 * cells.width
    slope = np.concatenate(
        [rows.slope[start], rows.slope[end] + span[:, None] * rows.bend[end]], axis=1
    )
    bend = np.concatenate([rows.bend[start], rows.bend[end]], axis=1)
    # Rows that hardly see u get a small share of it instead: their bound on x is then 1 / |bend|.
    steepest = np.abs(slope[:, 0])
    for column in range(1, slope.shape[1]):
        np.maximum(steepest, np.abs(slope[:, column]), out=steepest)
    scale = steepest[:, None] + span[:, None] * np.abs(bend) + 1e-300
    slope = np.where(np.abs(slope) > 1e-9 * scale, slope, 1e-9 * scale)
    slack, tilt = 1.0 / np.abs(slope), bend / slope
    kernel = compiled(solver_loops, "widest", len(slack))
    if kernel is not None:
        widest = np.empty(len(slack))
        kernel(slack, tilt, span, LARGEST_X, widest)
        return slack, tilt, widest
    return slack, tilt, _widest(slack, tilt, span)


def _widest(slack: Array, tilt: Array, span: Array) -> Array:
    """Largest x (c,) for which some u keeps every row of a cell and stays above zero.

    Pairs of rows of both ends count: without the mixed ones the limits are broken several times
    over at single nodes.
    """
    count, rows = slack.shape
    i, j = np.triu_indices(rows, 1)
    widest = np.empty(count)
    for begin in range(0, count, _CHUNK):
        part = slice(begin, begin + _CHUNK)
        gap = np.abs(tilt[part][:, i] - tilt[part][:, j])
        room = slack[part][:, i] + slack[part][:, j]
        widest[part] = (room / np.maximum(gap, room / LARGEST_X)).min(axis=1)
    # x + span u >= 0 with u <= slack - tilt x.
    falls = span[:, None] * tilt - 1.0
    grown = span[:, None] * slack / np.where(falls > 1e-12, falls, 1.0)
    ends = np.where(falls > 1e-12, grown, np.inf).min(axis=1)
    result: Array = np.minimum(np.minimum(widest, ends), LARGEST_X)
    return result
