"""Loops of `smoothed_speed_limits` for compilation; without it, columns are used."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics.arm import Mask

NEXT = 2
"""Number of neighbours on either side that count even outside the window; two may coincide."""
LEVEL = 2e-4
"""Share of a speed by which it may change over the window and still count as level."""
STEEP = 1.0
"""Share above which lines would fall to zero within the window."""
EVEN = 0.25
"""Share of its rise by which the largest speed may be off the line."""


def hold(
    places: Array, speeds: Array, needed: Mask, times: Array, reach: float, bounded: Array
) -> None:
    """Fill in the maximum speeds (k,) [m/s] of the command; see `smoothed_speed_limits`.

    Args:
        places: Shape (k,) [m], ascending.
        speeds: Shape (k,) [m/s].
        needed: Shape (k,).
        times: Shape (k,) [s], ascending: the earliest time of the command at each point.
        reach: Time [s] by which the command is away from the arm at most, to either side.
        bounded: Filled in.
    """
    count = len(places)
    level = np.empty(count)
    for k in range(count):
        bounded[k] = speeds[k]
    first, after = 0, 0
    for k in range(count):
        while times[first] < times[k] - reach:
            first += 1
        while after < count and times[after] <= times[k] + reach:
            after += 1
        level[k] = np.inf
        if not needed[k]:
            continue
        next_before, next_after = max(k - NEXT, 0), min(k + NEXT + 1, count)
        lonely = first > next_before or after < next_after
        low, high = min(first, next_before), max(after, next_after)
        slope = slope_around(places, speeds, k, low, high - 1)
        if lonely or slope != 0.0:
            for other in range(low, high):
                line = speeds[k] + slope * (places[other] - places[k])
                bounded[other] = min(bounded[other], line)
        else:
            level[k] = speeds[k]
    keep_below_levels(level, times, reach, bounded)


def slope_around(places: Array, speeds: Array, k: int, first: int, last: int) -> float:
    """Return the slope [1/s] of the line that bounds speeds around a point; 0 for a level one."""
    way, rise = places[last] - places[first], speeds[last] - speeds[first]
    if not (LEVEL * speeds[k] < abs(rise) < STEEP * speeds[k] and way > 0.0):
        return 0.0
    slope: float = rise / way
    for other in (first, (first + k) // 2, (k + last) // 2, last):
        line = speeds[k] + slope * (places[other] - places[k])
        if abs(speeds[other] - line) >= EVEN * abs(rise):
            return 0.0
    return slope


def keep_below_levels(level: Array, times: Array, reach: float, bounded: Array) -> None:
    """Lower `bounded` (k,) to the minimum of levels (k,) [m/s] within reach [s] of each.

    A level followed by a lower one is never the minimum of a window that holds both, so the
    candidates are kept in a queue with ascending levels.
    """
    count = len(level)
    row = np.empty(count, np.int64)
    head, end, after = 0, 0, 0
    for k in range(count):
        while after < count and times[after] <= times[k] + reach:
            if level[after] < np.inf:
                while end > head and level[row[end - 1]] >= level[after]:
                    end -= 1
                row[end] = after
                end += 1
            after += 1
        while head < end and times[row[head]] < times[k] - reach:
            head += 1
        if head < end:
            bounded[k] = min(bounded[k], level[row[head]])


COMPILED = (slope_around, keep_below_levels, hold)
"""All functions, each after its callees."""
