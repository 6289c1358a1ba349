"""Several timings joined end to end, evaluated at many instants at once.

A run has one timing per section between stop points. Evaluating them one by one takes a few NumPy
calls each, which costs more than planning if there are many short sections.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.values import value_class

_FEW = 4
"""Number of timings up to which searching one by one is cheaper."""


@value_class(frozen=True, slots=True, eq=False)
class TimeScalings:
    """Time scalings (t,), their nodes (k,), in sections (m,) between marks; see `TimeScaling`."""

    begin: Index
    """Shape (t,): first section of each timing."""
    first: Index
    """Shape (m,): first node of each section."""
    last: Index
    """Shape (m,): last node of each section, often the first of the next one."""
    s: Array
    speed: Array
    times: Array
    acceleration: Array
    """Shape (k,): in the cell that begins at each node; 0 at the last node of each timing."""
    since: Array
    """Shape (3, k): see `TimeScaling.since_marks`."""

    def since_marks(self, number: Index, t: Array) -> Array:
        """Return distance [m], integral [m s] and double integral [m s2] since marks, (3, k).

        Args:
            number: Index of the section (k,) whose mark to use.
            t: Times (k,) [s], in the time of each timing; clamped to the section.
        """
        t = np.clip(t, self.times[self.first[number]], self.times[self.last[number]])
        k = self._cell(number, t)
        step, speed, change = t - self.times[k], self.speed[k], self.acceleration[k]
        way, once, twice = self.since[:, k]
        whole = self.s[self.last[number]] - self.s[self.first[number]]
        result = np.empty((3, len(t)))
        result[0] = np.clip(way + step * (speed + 0.5 * step * change), 0.0, whole)
        result[1] = once + step * (way + step * (speed / 2 + step * change / 6))
        result[2] = twice + step * (
            once + step * (way / 2 + step * (speed / 6 + step * change / 24))
        )
        return result

    def _cell(self, number: Index, t: Array) -> Index:
        """Return the first node (k,) of the cell that contains each time (k,)."""
        lowest, highest = int(number.min()), int(number.max())
        if highest - lowest < _FEW:
            cell = np.empty_like(number)
            for each in range(lowest, highest + 1):
                at = slice(None) if lowest == highest else number == each
                first, last = self.first[each], self.last[each]
                past = np.searchsorted(self.times[first : last + 1], t[at], side="right")
                cell[at] = first + np.clip(past - 1, 0, last - 1 - first)
            return cell
        low, high = self.first[number], self.last[number] - 1
        while (low < high).any():
            middle = (low + high + 1) // 2
            before = self.times[middle] <= t
            low, high = np.where(before, middle, low), np.where(before, high, middle - 1)
        return low


def timings_of(timings: Sequence[TimeScaling]) -> TimeScalings:
    """Join one or more timings end to end."""
    count = np.array([len(one.s) for one in timings])
    marks = np.array([len(one.marks) for one in timings])
    node, begin = np.cumsum(count) - count, np.cumsum(marks) - marks
    first = np.concatenate([one.marks for one in timings]) + np.repeat(node, marks)
    last = np.append(first[1:], 0)
    last[begin + marks - 1] = node + count - 1
    return TimeScalings(
        begin=begin,
        first=first,
        last=last,
        s=np.concatenate([one.s for one in timings]),
        speed=np.concatenate([one.speed for one in timings]),
        times=np.concatenate([one.times for one in timings]),
        acceleration=np.concatenate([np.append(one.acceleration, 0.0) for one in timings]),
        since=np.concatenate([one.since_marks for one in timings], axis=1),
    )
