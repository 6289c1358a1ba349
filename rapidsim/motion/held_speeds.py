"""How fast the command may be where, so that the smoothed motion keeps the largest speeds.

The arm's speed is the mean of the command's over the filter time, and its place the mean of the
command's places. When the arm is at p, the command passes p in the middle of that time, and gets as
far as half the time takes it to either side; where it is slow on one side, it is the longer there.
If around p it stays below one straight line through the largest speed at p, then so does its mean:
that of values on a line is the line at the mean of the places.

Any line will do. A level one fits what dips; where the largest speed rises or falls evenly, as it
does along a joint move, a level one would cost time and the line that follows it costs none.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion import solver_loops
from rapidsim.motion.compiled import compiled
from rapidsim.motion.curves import Index

_REACH = 0.5
"""Share of the window that the command is away from the arm at most, to either side."""
_NEXT = 2
"""As many places to either side count even if they are out of reach; two may be at one place."""
_LEVEL = 2e-4
"""Share of a speed by which it may change over the window and still count as level."""
_STEEP = 1.0
"""Share above which lines would go to nothing within the window."""
_EVEN = 0.25
"""Share of its rise by which the largest speed may be off the line."""
_PAIRS = 2_000_000


def held_speeds(places: Array, speeds: Array, window: float) -> Array:
    """Largest speeds of the command.

    Args:
        places: Shape (k,) [m], ascending.
        speeds: Shape (k,) [m/s]: largest speeds of the arm there.
        window: The filter time [s].

    Returns:
        Shape (k,) [m/s].
    """
    # No command gets there sooner. A place of its own where the TCP only turns has next to no
    # largest speed, so how far it gets follows from all the places on the way.
    steps = 0.5 * np.diff(places) * (1.0 / speeds[1:] + 1.0 / speeds[:-1])
    times = np.concatenate([[0.0], np.cumsum(steps)])
    reach = _REACH * window
    near = first, after = within(times, reach)
    # Where places are farther apart than that, the next ones stand for what lies between.
    own = np.arange(len(places))
    next_before = np.maximum(own - _NEXT, 0)
    next_after = np.minimum(own + _NEXT + 1, len(places))
    lonely = (first > next_before) | (after < next_after)
    first, after = np.minimum(first, next_before), np.maximum(after, next_after)
    slopes = _slopes(places, speeds, first, after - 1)
    lined = lonely | (slopes != 0.0)
    held = least_around(times, np.where(lined, np.inf, speeds), reach, near)
    _keep_below_lines(held, places, speeds, slopes, np.flatnonzero(lined), first, after)
    result: Array = np.minimum(held, speeds)
    return result


def _slopes(places: Array, speeds: Array, first: Index, last: Index) -> Array:
    """The slope (k,) [1/s] of the line to keep below around each place; 0 for a level one."""
    way = places[last] - places[first]
    rise = speeds[last] - speeds[first]
    slopes = np.zeros(len(places))
    rising = (np.abs(rise) > _LEVEL * speeds) & (np.abs(rise) < _STEEP * speeds) & (way > 0.0)
    at = np.flatnonzero(rising)
    if not len(at):
        return slopes
    slope = rise[at] / way[at]
    off = np.zeros(len(at))
    for other in (first[at], (first[at] + at) // 2, (at + last[at]) // 2, last[at]):
        line = speeds[at] + slope * (places[other] - places[at])
        np.maximum(off, np.abs(speeds[other] - line), out=off)
    slopes[at] = np.where(off < _EVEN * np.abs(rise[at]), slope, 0.0)
    return slopes


def _keep_below_lines(
    held: Array,
    places: Array,
    speeds: Array,
    slopes: Array,
    lined: Index,
    first: Index,
    after: Index,
) -> None:
    """Lower speeds (k,) to the lines through some places as far as they reach."""
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
        np.minimum.at(held, other, line)


def within(times: Array, window: float) -> tuple[Index, Index]:
    """The first of ascending times (k,) within a window [s] around each, and the one after it."""
    first = np.searchsorted(times, times - window, side="left")
    return first, np.searchsorted(times, times + window, side="right")


def least_around(times: Array, speeds: Array, window: float, near: tuple[Index, Index]) -> Array:
    """The least of speeds (k,) [m/s] within a window [s] before and after each.

    `near` is what `within` says of these times and this window.
    """
    kernel = compiled(solver_loops, "least_around", len(times))
    if kernel is not None:
        held = np.empty(len(times))
        kernel(times, speeds, window, held)
        return held
    # `reduceat` takes the least from each index to the next; every second one is a window.
    bounds = np.stack(near, axis=1).ravel()
    least: Array = np.minimum.reduceat(np.append(speeds, np.inf), bounds)[::2]
    return least
