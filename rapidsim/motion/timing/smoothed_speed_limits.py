"""Limits of the command's speed such that the smoothed motion keeps the maximum speeds.

The arm's place p and its speed are the command's, averaged over the filter time W. Let v be the
maximum speed at p, and let the command keep below a line through it, v + a (s - p), wherever the
solution g of g' = v + a (g - p) with mean p goes within W. Where the command crosses g it cannot
get ahead of g afterwards, nor have been behind it before, so its mean speed is at most that of g,
which is v: the mean of values on a line is the line at the mean position. For averages one after
the other this holds as well, because the logarithm of their weights is concave.

g travels v W: half of it on either side of p, shifted by a v W^2 / 12 towards the faster side.
Distance decides, not the time that a faster neighbour would need for it: such a neighbour is slow
near p, too.

Any line is valid. A level line suits minima; where the maximum speed rises or falls linearly, as it
does along a joint move, a level line would cost time, and the line that follows it costs none.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.numba_jit import jit_function
from rapidsim.motion.timing import smoothed_speed_loops

_LEVEL = 2e-4
"""Share of its speed by which a line may change over the window and still count as level."""
_STEEP = 1.0
"""Share by which it changes at most; more needs a longer series of the shift."""
_WIDEST = 1.0 + _STEEP / 6.0 + 1e-9
"""Factor on the half width of a level line that covers the shift of any other."""
_PAIRS = 2_000_000
"""Number of pairs of a line and a point evaluated at once, which bounds the memory."""


def held_speeds(places: Array, speeds: Array, needed: Mask, window: float) -> Array:
    """Return maximum speeds of the command.

    Args:
        places: Shape (k,) [m], ascending.
        speeds: Shape (k,) [m/s]: maximum speeds of the arm there.
        needed: Shape (k,): mask of the points where the smoothed motion would exceed them; at
            others it suffices that the command keeps them.
        window: The filter time [s].

    Returns:
        Shape (k,) [m/s].
    """
    at = np.flatnonzero(needed)
    # Where two stages meet, both have a point.
    at = at[(np.diff(places[at], prepend=-1.0) > 0.0) | (np.diff(speeds[at], prepend=-1.0) != 0.0)]
    slopes, first, after = _lines(places, speeds, at, window)
    level = slopes == 0.0
    held = lowest_over(first[level], after[level], speeds[at[level]], len(places))
    if not level.all():
        lined = (one[~level] for one in (slopes, at, first, after))
        kernel = jit_function(smoothed_speed_loops, "keep_below_lines", len(places))
        (kernel or _keep_below_lines)(held, places, speeds, *lined)
    return np.minimum(held, speeds)


def deciding_points(places: Array, speeds: Array, wanted: Index, window: float) -> Index:
    """Return the point (j,) whose line bounds the command most at each wanted point (j,).

    Of equal bounds, that of the point itself decides, then that of the first.

    Args:
        places: Shape (k,) [m], ascending.
        speeds: Shape (k,) [m/s]: maximum speeds of the arm there.
        wanted: Points, ascending, shape (j,).
        window: The filter time [s].
    """
    # The lines of other points end before each wanted one.
    wanted_before = np.searchsorted(wanted, np.arange(len(places) + 1))
    first, after = spans_around(places, places, _WIDEST * speeds, window)
    at = np.flatnonzero(wanted_before[after] > wanted_before[first])
    slopes, first, after = _lines(places, speeds, at, window)
    level, sloped = np.flatnonzero(slopes == 0.0), np.flatnonzero(slopes)
    # A level line has one value, so that its number in order of these decides everywhere.
    level = level[np.argsort(speeds[at[level]], kind="stable")]
    numbers = np.arange(float(len(level)))
    order = lowest_over(first[level], after[level], numbers, len(places))[wanted]
    covered = np.isfinite(order)
    deciding, lowest = wanted.copy(), np.full(len(wanted), np.inf)
    deciding[covered] = at[level[order[covered].astype(np.int64)]]
    lowest[covered] = speeds[deciding[covered]]
    ends = (wanted_before[end[sloped]] for end in (first, after))
    kernel = jit_function(smoothed_speed_loops, "decide_by_lines", len(places))
    (kernel or _decide_by_lines)(
        deciding, lowest, places, speeds, slopes[sloped], at[sloped], wanted, *ends
    )
    return np.where(lowest < speeds[wanted], deciding, wanted)


def _lines(places: Array, speeds: Array, at: Index, window: float) -> tuple[Array, Index, Index]:
    """Return slopes (j,) [1/s] of lines through points (j,), and the spans in which they hold.

    A span is its first point and the one after its last.
    """
    middle, most = places[at], speeds[at]
    first, after = spans_around(places, middle, most, window)
    slopes = _slopes(places, speeds, at, (first, after - 1)).clip(-_STEEP / window, _STEEP / window)
    slopes[np.abs(slopes) < _LEVEL / window] = 0.0
    lean = np.flatnonzero(slopes)
    shifted = middle[lean] + slopes[lean] * most[lean] * window**2 / 12.0
    first[lean], after[lean] = spans_around(places, shifted, most[lean], window)
    return slopes, first, after


def spans_around(places: Array, middle: Array, speeds: Array, window: float) -> tuple[Index, Index]:
    """Return points (j,) between which the command is while the arm is in the middle (j,) [m].

    They are the first and the one after the last. A point beyond each end represents the interval
    up to it.
    """
    reach = 0.5 * window * speeds
    first = np.searchsorted(places, middle - reach, side="left") - 1
    after = np.searchsorted(places, middle + reach, side="right") + 1
    return np.maximum(first, 0), np.minimum(after, len(places))


def _slopes(places: Array, speeds: Array, at: Index, ends: tuple[Index, Index]) -> Array:
    """Return slopes (j,) [1/s] of lines through points (j,): towards lower speeds, not below these.

    They are 0 where no speed is lower. `ends` (j,) are the first and the last point of each window.
    """
    drops = []
    for end in ends:
        least = np.full(len(at), np.inf)
        for other in (end, (end + at) // 2):
            way = np.abs(places[other] - places[at])
            drop = (speeds[at] - speeds[other]) / np.where(way > 0.0, way, np.inf)
            np.minimum(least, drop, out=least, where=way > 0.0)
        drops.append(least)
    # Beyond an end of the path no speed is lower.
    left, right = (np.where(own < np.inf, own, -other) for own, other in (drops, drops[::-1]))
    return np.maximum(left, 0.0) - np.maximum(right, 0.0)


def _keep_below_lines(
    bounded: Array,
    places: Array,
    speeds: Array,
    slopes: Array,
    at: Index,
    first: Index,
    after: Index,
) -> None:
    """Do what `smoothed_speed_loops.keep_below_lines` does, by columns."""
    for line, other in _pairs(first, after):
        own = at[line]
        np.minimum.at(bounded, other, speeds[own] + slopes[line] * (places[other] - places[own]))


def _decide_by_lines(
    deciding: Index,
    lowest: Array,
    places: Array,
    speeds: Array,
    slopes: Array,
    at: Index,
    wanted: Index,
    first: Index,
    after: Index,
) -> None:
    """Do what `smoothed_speed_loops.decide_by_lines` does, by columns."""
    for number, other in _pairs(first, after):
        line = at[number]
        values = speeds[line] + slopes[number] * (places[wanted[other]] - places[line])
        before = lowest.copy()
        np.minimum.at(lowest, other, values)
        is_first = (values < before[other]) | (line < deciding[other])
        # Of equal lines the first one counts: it is written last.
        least = np.flatnonzero((values == lowest[other]) & is_first)[::-1]
        deciding[other[least]] = line[least]


def _pairs(first: Index, after: Index) -> Iterator[tuple[Index, Index]]:
    """Yield, in batches, pairs of the number of a span and a point in it, for spans (j,)."""
    size = after - first
    ends = np.cumsum(size)
    cuts = np.searchsorted(ends, np.arange(_PAIRS, size.sum(), _PAIRS))
    for part in np.split(np.arange(len(first)), cuts):
        count = size[part]
        line = np.repeat(part, count)
        other = np.arange(len(line)) + np.repeat(first[part] - np.cumsum(count) + count, count)
        yield line, other


def lowest_over(first: Index, after: Index, values: Array, count: int) -> Array:
    """Return the lowest of values (j,) at each of some points, infinite where there is none.

    Args:
        first: The first point of each value, shape (j,).
        after: The point after its last, shape (j,), larger.
        values: Shape (j,).
        count: Number of points.

    Returns:
        Shape (count,).
    """
    lowest = np.full(count, np.inf)
    # Two spans of a power of two cover a span; from the widest on, each is two of half the width.
    power = np.frexp(after - first)[1] - 1
    for width in range(int(power.max(initial=0)), -1, -1):
        own = power == width
        np.minimum.at(lowest, first[own], values[own])
        np.minimum.at(lowest, after[own] - 2**width, values[own])
        half = 2**width // 2
        if half:
            lowest[half:] = np.minimum(lowest[half:], lowest[:-half])
    return lowest
