"""Several timings laid end to end, to be asked about many instants at once.

A run has a timing for each stretch between stop points. Asking them one by one costs a few calls of
NumPy each, which is more than the planning where there are many short stretches.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.timing.time_scaling import Timing

_FEW = 4
"""So many timings are cheaper to look through one by one."""


@dataclass(frozen=True, slots=True, eq=False)
class Timings:
    """Timings (t,) with all their nodes (k,); see `Timing`."""

    first: Index
    """Shape (t,): the first node of each."""
    last: Index
    """Shape (t,): the last node of each."""
    s: Array
    speed: Array
    times: Array
    acceleration: Array
    """Shape (k,): in the cell that begins at each node; the last of each timing has none."""
    integrals: Array

    def place_and_integral(self, number: Index, t: Array) -> tuple[Array, Array]:
        """What `Timing.s_at` and `Timing.way_integral` say of times (k,) [s].

        Args:
            number: Which timing (k,) is asked.
            t: Times (k,) [s], each counted as that timing does.
        """
        t = np.clip(t, 0.0, self.times[self.last[number]])
        k = self._cell(number, t)
        since = t - self.times[k]
        begin = self.s[self.first[number]]
        acceleration = self.acceleration[k]
        place = self.s[k] + since * (self.speed[k] + 0.5 * since * acceleration)
        place = np.clip(place, begin, self.s[self.last[number]])
        cubic = self.s[k] - begin + since * (self.speed[k] / 2 + since * acceleration / 6)
        return place, self.integrals[k] + since * cubic

    def _cell(self, number: Index, t: Array) -> Index:
        """The node (k,) at which the cell begins that holds each time (k,)."""
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


def timings_of(timings: Sequence[Timing]) -> Timings:
    """Lay timings end to end, at least one."""
    count = np.array([len(one.s) for one in timings])
    last = np.cumsum(count) - 1
    return Timings(
        first=last + 1 - count,
        last=last,
        s=np.concatenate([one.s for one in timings]),
        speed=np.concatenate([one.speed for one in timings]),
        times=np.concatenate([one.times for one in timings]),
        acceleration=np.concatenate([np.append(one.acceleration, 0.0) for one in timings]),
        integrals=np.concatenate([one.integrals for one in timings]),
    )
