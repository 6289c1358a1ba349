"""Limits of the command's speed such that the smoothed motion keeps the maximum speeds.

The arm's speed is the mean of the command's over the filter time, and its position the mean of the
command's positions. When the arm is at p, the command passes p in the middle of that time, and is
ahead or behind by at most half the time; where it is slow on one side, it spends longer there. If
around p it stays below one straight line through the maximum speed at p, so does its mean: the mean
of values on a line is the line at the mean position.

Any line is valid. A level line suits minima; where the maximum speed rises or falls linearly, as it
does along a joint move, a level line would cost time, and the line that follows it costs none.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.numba_jit import jit_function
from rapidsim.motion.timing import smoothed_speed_loops
from rapidsim.motion.timing.smoothed_speed_loops import EVEN, LEVEL, NEXT, STEEP

_REACH = 0.5
"""Share of the window by which the command is away from the arm at most, to either side."""
_PAIRS = 2_000_000


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
    # Lower bounds of the command's times. A point where the TCP only turns has nearly zero maximum
    # speed, so the distance travelled follows from all the points on the path.
    steps = 0.5 * np.diff(places) * (1.0 / speeds[1:] + 1.0 / speeds[:-1])
    times = np.concatenate([[0.0], np.cumsum(steps)])
    reach = _REACH * window
    kernel = jit_function(smoothed_speed_loops, "hold", len(places))
    if kernel is not None:
        result = np.empty(len(places))
        kernel(places, speeds, needed, times, reach, result)
        return result
    near = first, after = within(times, reach)
    # If points are farther apart than the window, their neighbours represent the interval between.
    own = np.arange(len(places))
    next_before = np.maximum(own - NEXT, 0)
    next_after = np.minimum(own + NEXT + 1, len(places))
    lonely = (first > next_before) | (after < next_after)
    first, after = np.minimum(first, next_before), np.maximum(after, next_after)
    slopes = np.zeros(len(places))
    at = np.flatnonzero(needed)
    slopes[at] = _slopes(places, speeds, at, first[at], after[at] - 1)
    lined = lonely | (slopes != 0.0)
    held = least_around(np.where(lined | ~needed, np.inf, speeds), near)
    _keep_below_lines(held, places, speeds, slopes, np.flatnonzero(lined & needed), first, after)
    return np.minimum(held, speeds)


def level_speeds(places: Array, speeds: Array, needed: Mask, window: float) -> Array:
    """Return maximum speeds of the command as `held_speeds`, for a wide window.

    All lines are level, and each is as long as the command travels at its speed in half of the
    window; at the maximum speeds around it would travel much farther.
    """
    reach = _REACH * window * speeds
    # A point beyond each end represents the interval between.
    first = np.maximum(np.searchsorted(places, places - reach, side="left") - 1, 0)
    after = np.minimum(np.searchsorted(places, places + reach, side="right") + 1, len(places))
    held = speeds.copy()
    level = np.zeros(len(places))
    _keep_below_lines(held, places, speeds, level, np.flatnonzero(needed), first, after)
    return held


def _slopes(places: Array, speeds: Array, at: Index, first: Index, last: Index) -> Array:
    """Return slopes (j,) [1/s] of the lines to keep below around points (j,), 0 for level ones.

    `first` and `last` (j,) are the points at the ends of their windows.
    """
    way, rise = places[last] - places[first], speeds[last] - speeds[first]
    steepness = np.abs(rise)
    rising = (steepness > LEVEL * speeds[at]) & (steepness < STEEP * speeds[at]) & (way > 0.0)
    slopes = np.where(rising, rise / np.where(rising, way, 1.0), 0.0)
    off = np.zeros(len(at))
    for other in (first, (first + at) // 2, (at + last) // 2, last):
        line = speeds[at] + slopes * (places[other] - places[at])
        np.maximum(off, np.abs(speeds[other] - line), out=off)
    return np.where(off < EVEN * steepness, slopes, 0.0)


def _keep_below_lines(
    bounded: Array,
    places: Array,
    speeds: Array,
    slopes: Array,
    lined: Index,
    first: Index,
    after: Index,
) -> None:
    """Lower speeds (k,) to the lines through some points within their windows."""
    if not len(lined):
        return
    ends = np.cumsum(after[lined] - first[lined])
    parts = np.split(lined, np.searchsorted(ends, np.arange(_PAIRS, ends[-1], _PAIRS)))
    for part in parts:
        count = after[part] - first[part]
        owner = np.repeat(part, count)
        number = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
        other = first[owner] + number
        line = speeds[owner] + slopes[owner] * (places[other] - places[owner])
        np.minimum.at(bounded, other, line)


def within(times: Array, window: float) -> tuple[Index, Index]:
    """Return indices (k,) of the first time within a window [s] of each, and past the last."""
    first = np.searchsorted(times, times - window, side="left")
    return first, np.searchsorted(times, times + window, side="right")


def least_around(speeds: Array, near: tuple[Index, Index]) -> Array:
    """Return the minimum of speeds (k,) [m/s] around each point; `near` is from `within`."""
    # `reduceat` takes the minimum from each index to the next; every second interval is a window.
    bounds = np.stack(near, axis=1).ravel()
    least: Array = np.minimum.reduceat(np.append(speeds, np.inf), bounds)[::2]
    return least
