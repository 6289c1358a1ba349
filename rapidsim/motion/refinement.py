"""Which cells to cut, and where: limits broken inside of them, or time lost."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.curves import Index
from rapidsim.motion.problem import LARGEST_X, Problem

ACCELERATION_EXCESS = 0.002
"""Share of an acceleration by which it may be exceeded within a cell."""
_SPEED_EXCESS = 1e-3
_WORTHWHILE = 1e-5
"""Share of its segment's time that a cut must save."""
_WORTHWHILE_S = 2e-7
_IDLE = 5e-5
"""Share of its segment's time that a cell may spend with nothing at its limit."""
_IDLE_S = 4e-6
_SMALLEST_PART = 0.02
_SHARES = np.array([[0.75, 0.5, 0.25], [0.25, 0.5, 0.75]])
"""From values at both ends of a cell to its quarters, on a straight line."""
_QUARTERS = np.array([[0.375, 0.0, -0.125], [0.75, 1.0, 0.75], [-0.125, 0.0, 0.375]])
"""From values at start, middle and end of a cell to its quarters, on a parabola."""


def refinement(problem: Problem, x: Array, among: Index) -> tuple[Index, Array]:
    """Find cells to cut.

    Args:
        problem: What limits the motion.
        x: Its squares of speed (c + 1,) at the nodes.
        among: The cells (k,) in question, increasing.

    Returns:
        Cells (j,), increasing, and where (j,) to cut them [m].
    """
    cells, path = problem.cells, problem.path
    whole_times = _pass(cells.width, x[:-1], x[1:])
    segment = path.segment_of(cells.piece)
    matters = np.bincount(segment, whole_times)[segment[among]]

    at = cells.at[among]
    s = cells.places.s[at]
    width, times = s[:, 2] - s[:, 0], whole_times[among]
    x_start, x_end = x[among], x[among + 1]
    middle = 0.5 * (x_start + x_end)
    between = np.stack([x_start, x_end], axis=1) @ _SHARES  # (k, 3)
    used, most_used = loads(problem, x, among)
    steepest = np.abs(problem.accelerations.bend[at[:, 1]]).max(axis=1)
    largest = problem.by_speed[among]
    by_speed = largest[:, 1]
    # x is straight within a cell and its limit bends, so they may cross off the middle, too.
    slowness = (1.0 / np.sqrt(largest)) @ _QUARTERS
    fast = (between * slowness**2 > 1.0 + _SPEED_EXCESS).any(axis=1)
    over = (most_used > 1.0 + ACCELERATION_EXCESS) | fast

    # Somewhere a limit is reached all the time; where none is, both ends of a cell are at odds.
    used = np.maximum(used, np.sqrt(middle / by_speed))
    idle = 0.5 * times * (1.0 - used) > np.maximum(_IDLE * matters, _IDLE_S)
    halve = (over | idle) & (width > 1e-9 * path.length)

    # Within a cell u is constant. Time is gained by a node where speeding up turns into braking, or
    # where the largest speed is reached or left.
    slack, tilt = problem.slack[among], problem.tilt[among]
    speed_up = (slack - tilt * x_start[:, None]).min(axis=1)
    brake = (-slack - tilt * x_start[:, None]).max(axis=1)
    top = np.minimum(by_speed, 1.0 / np.maximum(steepest, 1.0 / LARGEST_X))
    with np.errstate(all="ignore"):
        turn = (x_end - x_start - 2.0 * brake * width) / (2.0 * (speed_up - brake))
        reached = (top - x_start) / (2.0 * speed_up)
        left = width - (x_end - top) / (2.0 * brake)
        steps = np.stack([turn, reached, left])
        peaks = np.stack([np.minimum(x_start + 2.0 * speed_up * turn, top), top, top])
        quicker = _pass(steps, x_start, peaks) + _pass(width - steps, peaks, x_end)
        inside = (steps > _SMALLEST_PART * width) & (steps < (1.0 - _SMALLEST_PART) * width)
        # Only where the line of speeding up is below the top until then, and that of braking after.
        inside[1] &= reached <= turn
        inside[2] &= left >= turn
        gain = np.where(inside, times - quicker, 0.0)
    best = gain.argmax(axis=0)
    columns = np.arange(len(width))
    switch = (gain[best, columns] > np.maximum(_WORTHWHILE * matters, _WORTHWHILE_S)) & ~over
    place = np.where(switch, s[:, 0] + steps[best, columns], s[:, 1])
    chosen = np.flatnonzero(halve | switch)
    return among[chosen], place[chosen]


def loads(problem: Problem, x: Array, among: Index) -> tuple[Array, Array]:
    """Shares (k,) of the tightest acceleration that some cells use: in the middle, and at most.

    `x` (c + 1,) is given at the nodes; limits within a cell follow a parabola.
    """
    accelerations, at = problem.accelerations, problem.cells.at[among]
    s = problem.cells.places.s[at]
    u = (x[among + 1] - x[among]) / np.maximum(2.0 * (s[:, 2] - s[:, 0]), 1e-300)
    between = np.stack([x[among], x[among + 1]], axis=1) @ _SHARES
    middle, most = np.zeros(len(at)), np.zeros(len(at))
    for number in range(accelerations.slope.shape[1]):
        slope, bend = accelerations.slope[:, number][at], accelerations.bend[:, number][at]
        load = np.abs((slope @ _QUARTERS) * u[:, None] + (bend @ _QUARTERS) * between)
        np.maximum(middle, load[:, 1], out=middle)
        for column in range(3):
            np.maximum(most, load[:, column], out=most)
    return middle, most


def _pass(way: Array, x_start: Array, x_end: Array) -> Array:
    """Time (k,) [s] over ways (k,) [m] between squares of speed (k,)."""
    pace = np.sqrt(np.maximum(x_start, 0.0)) + np.sqrt(np.maximum(x_end, 0.0))
    time: Array = 2.0 * way / np.maximum(pace, 1e-300)
    return time
