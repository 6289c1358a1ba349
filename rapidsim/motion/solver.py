"""The fastest motion along a path that keeps every limit, in closed form.

Along the path parameter s, x is the square of the path speed ds/dt and u the path acceleration,
constant within a cell. Every axis asks |q' u + q'' x| <= acceleration at both ends of a cell. One
pass from the end finds the largest x from which the rest can still be braked, one pass from the
start drives as fast as that allows. Because limits are symmetric, standing still is always
possible, so no stage is without a solution.

Source: the two-pass method of Pham and Pham (2018), A new approach to time-optimal path
parameterization based on reachability analysis, with its linear programs solved by hand.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.curves import Index
from rapidsim.motion.grid import Cells
from rapidsim.motion.limits import Limits
from rapidsim.motion.path import Path
from rapidsim.motion.sweep import sweep

_ACCELERATION_EXCESS = 0.002
_SPEED_EXCESS = 1e-3
_WORTHWHILE = 5e-5
_IDLE = 1e-3
_SMALLEST_PART = 0.02
_LARGEST_X = 1e12
_CHUNK = 4096
_SHARES = np.array([[0.75, 0.5, 0.25], [0.25, 0.5, 0.75]])
"""From values at both ends of a cell to its quarters, on a straight line."""
_QUARTERS = np.array([[0.375, 0.0, -0.125], [0.75, 1.0, 0.75], [-0.125, 0.0, 0.375]])
"""From values at start, middle and end of a cell to its quarters, on a parabola."""


def solve(
    path: Path, cells: Cells, limits: Limits, pace: Array, start_speed: float
) -> tuple[Array, float]:
    """Find the fastest x at the nodes.

    Args:
        path: The geometry.
        cells: Where to look; the motion starts with the first and comes to rest after the last.
        limits: Of the axes.
        pace: Largest path speed (segments,) [m/s] on segments with a programmed time; it replaces
            the programmed speeds there. NaN elsewhere.
        start_speed: Path speed [m/s] at the first node.

    Returns:
        x (c + 1,), and the largest x at the first node from which the rest can be driven.
    """
    caps = _speed_caps(path, cells, limits, pace)
    span = 2.0 * (cells.end - cells.start)
    slack, tilt = _rows(path, cells, limits, span)
    caps[:-1] = np.minimum(caps[:-1], _widest(slack, tilt, span))
    caps[-1] = 0.0
    caps[np.isin(cells.nodes, path.stops)] = 0.0

    # Backwards: the largest x from which u >= -slack - tilt x leads to the node after.
    keeps = 1.0 - span[:, None] * tilt
    reaches = keeps > 1e-12
    safe = np.where(reaches, keeps, 1.0)
    slopes = np.where(reaches, 1.0 / safe, 0.0)
    offsets = np.where(reaches, span[:, None] * slack / safe, np.inf)
    largest = sweep(0.0, slopes[::-1], offsets[::-1], caps[::-1])[::-1]

    # Forwards: the largest u <= slack - tilt x that stays below.
    x = sweep(start_speed**2, keeps, span[:, None] * slack, largest)
    return x, float(largest[0])


def _speed_caps(path: Path, cells: Cells, limits: Limits, pace: Array) -> Array:
    """Largest x at the nodes (c + 1,); a dip within a cell holds at both of its ends."""
    x = _largest_by_speed(path, cells, limits, pace)
    dip = np.where(x[:, 1] < np.minimum(x[:, 0], x[:, 2]), x[:, 1], np.inf)
    caps = np.full(len(x) + 1, np.inf)
    caps[:-1] = np.minimum(x[:, 0], dip)
    caps[1:] = np.minimum(caps[1:], np.minimum(x[:, 2], dip))
    return caps


def _largest_by_speed(path: Path, cells: Cells, limits: Limits, pace: Array) -> Array:
    """Largest x (c, 3) by speeds of axes, TCP and reorientation at starts, middles and ends.

    The arm's speed is the mean of the command's over the filter time. It keeps the largest speed of
    the place where the arm is if the command keeps it as far around as it gets in that time.
    """
    fastest = _fastest_by_speed(path, cells, limits, pace)
    window = path.model.filter_time
    if window == 0.0:
        return fastest**2
    places, speeds = _places(cells), fastest
    if cells.behind is not None:
        before = _fastest_by_speed(path, cells.behind, limits, pace)
        places = np.concatenate([_places(cells.behind), places])
        speeds = np.concatenate([before, speeds])
    held: Array = _least_around(places.ravel(), speeds.ravel(), window)[-fastest.size :]
    return held.reshape(fastest.shape) ** 2


def _fastest_by_speed(path: Path, cells: Cells, limits: Limits, pace: Array) -> Array:
    """Largest path speeds (c, 3) [m/s] of the places themselves."""
    segment = segment_of(path, cells)
    paced = ~np.isnan(pace)
    tcp = np.array([s.speed.tcp for s in path.segments])
    turn = np.array([s.speed.reorientation for s in path.segments])
    tcp_share = np.where(paced, 0.0, 1.0 / tcp)[segment]
    turn_share = np.where(paced, 0.0, 1.0 / turn)[segment]
    slowest = (np.abs(cells.first) / limits.max_speed).max(axis=-1)
    slowest = np.maximum(slowest, cells.tcp_rate * tcp_share[:, None])
    slowest = np.maximum(slowest, cells.turn_rate * turn_share[:, None])
    slowest = np.maximum(slowest, np.where(paced, 1.0 / pace, 0.0)[segment][:, None])
    fastest: Array = np.minimum(1.0 / np.maximum(slowest, 1e-9), np.sqrt(_LARGEST_X))
    return fastest


def _places(cells: Cells) -> Array:
    """S (c, 3) of starts, middles and ends."""
    return np.stack([cells.start, 0.5 * (cells.start + cells.end), cells.end], axis=1)


def _least_around(places: Array, speeds: Array, window: float) -> Array:
    """The least of speeds (k,) [m/s] within the way each makes in a window [s]; places ascend."""
    way = speeds * window
    first = np.searchsorted(places, places - way, side="left")
    after = np.searchsorted(places, places + way, side="right")
    # `reduceat` takes the least from each index to the next; every second one is a window.
    bounds = np.stack([first, after], axis=1).ravel()
    least: Array = np.minimum.reduceat(np.append(speeds, np.inf), bounds)[::2]
    return least


def _rows(path: Path, cells: Cells, limits: Limits, span: Array) -> tuple[Array, Array]:
    """Acceleration limits as |u + tilt x| <= slack, shapes (c, 2 n): cell starts, then ends.

    At the end of a cell x has grown by span u, so its row is |(q' + span q'') u + q'' x| <= a.
    """
    share = path.acceleration_share[cells.piece][:, None]
    limit = np.concatenate([limits.max_acceleration, limits.max_acceleration]) * share
    slope = np.concatenate(
        [cells.first[:, 0], cells.first[:, 2] + span[:, None] * cells.second[:, 2]], axis=1
    )
    bend = np.concatenate([cells.second[:, 0], cells.second[:, 2]], axis=1)
    # Rows that hardly see u get a small share of it instead: their bound on x is then a / |q''|.
    scale = np.abs(slope).max(axis=1, keepdims=True) + span[:, None] * np.abs(bend) + 1e-300
    slope = np.where(np.abs(slope) > 1e-9 * scale, slope, 1e-9 * scale)
    return limit / np.abs(slope), bend / slope


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
        widest[part] = (room / np.maximum(gap, room / _LARGEST_X)).min(axis=1)
    # x + span u >= 0 with u <= slack - tilt x.
    falls = span[:, None] * tilt - 1.0
    grown = span[:, None] * slack / np.where(falls > 1e-12, falls, 1.0)
    ends = np.where(falls > 1e-12, grown, np.inf).min(axis=1)
    result: Array = np.minimum(np.minimum(widest, ends), _LARGEST_X)
    return result


def refinement(
    path: Path, cells: Cells, limits: Limits, pace: Array, x: Array
) -> tuple[Index, Array]:
    """Cells to cut and where: limits broken in the middle, or time lost within the cell."""
    width = cells.end - cells.start
    u = np.diff(x) / np.maximum(2.0 * width, 1e-300)
    middle = 0.5 * (x[:-1] + x[1:])
    limit = limits.max_acceleration * path.acceleration_share[cells.piece][:, None]
    load = np.abs(cells.first[:, 1] * u[:, None] + cells.second[:, 1] * middle[:, None])
    used = (load / limit).max(axis=-1)
    largest = _largest_by_speed(path, cells, limits, pace)
    by_speed = largest[:, 1]
    # x is straight within a cell and its limit bends, so they may cross off the middle, too.
    slowness = (1.0 / np.sqrt(largest)) @ _QUARTERS
    between = np.stack([x[:-1], x[1:]], axis=1) @ _SHARES
    fast = (between * slowness**2 > 1.0 + _SPEED_EXCESS).any(axis=1)
    over = (used > 1.0 + _ACCELERATION_EXCESS) | fast

    # Somewhere a limit is reached all the time; where none is, both ends of a cell are at odds.
    used = np.maximum(used, np.sqrt(middle / by_speed))
    times = _pass(width, x[:-1], x[1:])
    segment = segment_of(path, cells)
    matters = np.bincount(segment, times)[segment]
    idle = 0.5 * times * (1.0 - used) > _IDLE * matters
    halve = (over | idle) & (width > 1e-9 * path.length)

    # Within a cell u is constant. Time is gained by a node where speeding up turns into braking, or
    # where the largest speed is reached or left.
    slack, tilt = _rows(path, cells, limits, 2.0 * width)
    speed_up = (slack - tilt * x[:-1, None]).min(axis=1)
    brake = (-slack - tilt * x[:-1, None]).max(axis=1)
    bend = (np.abs(cells.second[:, 1]) / limit).max(axis=-1)
    top = np.minimum(by_speed, 1.0 / np.maximum(bend, 1.0 / _LARGEST_X))
    with np.errstate(all="ignore"):
        turn = (x[1:] - x[:-1] - 2.0 * brake * width) / (2.0 * (speed_up - brake))
        reached = (top - x[:-1]) / (2.0 * speed_up)
        left = width - (x[1:] - top) / (2.0 * brake)
        steps = np.stack([turn, reached, left])
        peaks = np.stack([np.minimum(x[:-1] + 2.0 * speed_up * turn, top), top, top])
        quicker = _pass(steps, x[:-1], peaks) + _pass(width - steps, peaks, x[1:])
        inside = (steps > _SMALLEST_PART * width) & (steps < (1.0 - _SMALLEST_PART) * width)
        # Only where the line of speeding up is below the top until then, and that of braking after.
        inside[1] &= reached <= turn
        inside[2] &= left >= turn
        gain = np.where(inside, times - quicker, 0.0)
    best = gain.argmax(axis=0)
    columns = np.arange(len(width))
    switch = (gain[best, columns] > _WORTHWHILE * matters) & ~over
    middles = 0.5 * (cells.start + cells.end)
    at = np.where(switch, cells.start + steps[best, columns], middles)
    index = np.flatnonzero(halve | switch).astype(np.int64)
    return index, at[index]


def segment_of(path: Path, cells: Cells) -> Index:
    """Position in `Path.segments` of each cell (c,)."""
    segment: Index = path.active[path.layout.row[cells.piece]]
    return segment


def _pass(way: Array, x_start: Array, x_end: Array) -> Array:
    """Time (k,) [s] over ways (k,) [m] between squares of speed (k,)."""
    pace = np.sqrt(np.maximum(x_start, 0.0)) + np.sqrt(np.maximum(x_end, 0.0))
    time: Array = 2.0 * way / np.maximum(pace, 1e-300)
    return time
