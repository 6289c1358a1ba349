"""Position and speed on a path as exact functions of time."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import overload

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array
from rapidsim.motion.derived_values import derived_value
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.constraints import Limiter

Numbers = npt.NDArray[np.int16]
"""Indices of limits, of which there are few."""

_COUNTED_S = 1.0
"""Interval [s] after which integrals of a motion restart, so that they keep their digits."""


@dataclass(frozen=True, eq=False)
class TimeScaling:
    """Position on a path as a function of time; time 0 is at its start."""

    s: Array
    """Nodes (k,) [m]."""
    speed: Array
    """Path speed ds/dt at the nodes, shape (k,) [m/s]."""
    start_excess: float
    """Excess [m/s] of the start speed over the speed that can be braked within the limits, else 0.
    A little of it may result from other nodes than those of the previous plan."""
    limiters: tuple[Limiter, ...] = ()
    """Limits that are active in some cell."""
    active: Numbers | None = None
    """Index (k - 1,) of the active limit in each cell among `limiters`; None if unknown."""
    standing: Array | None = None
    """Time [s] at rest in each cell (k - 1,): at stops within the path, which are cells of zero
    width. None if there are none."""

    @derived_value
    def acceleration(self) -> Array:
        """Path acceleration in each cell, shape (k - 1,) [m/s2]."""
        change: Array = np.diff(self.speed**2) / np.maximum(2.0 * np.diff(self.s), 1e-300)
        return change

    @derived_value
    def times(self) -> Array:
        """Time at the nodes, shape (k,) [s]."""
        pace = self.speed[1:] + self.speed[:-1]
        steps = 2.0 * np.diff(self.s) / np.maximum(pace, 1e-300)
        if self.standing is not None:
            steps = steps + self.standing
        return np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def duration(self) -> float:
        """[s]"""
        return float(self.times[-1])

    @property
    def braking_s(self) -> float:
        """Time [s] before its end during which the motion only slows down."""
        rises = np.flatnonzero(np.diff(self.speed) >= 0.0)
        return self.duration - float(self.times[rises[-1] + 1] if len(rises) else 0.0)

    @overload
    def s_at(self, t: float) -> float: ...

    @overload
    def s_at(self, t: Array) -> Array: ...

    def s_at(self, t: float | Array) -> float | Array:
        """Return positions [m] at times [s], one or (k,); at rest before and after the motion."""
        k, since = self._cell(t)
        place: Array = self.s[k] + since * (self.speed[k] + 0.5 * since * self.acceleration[k])
        place = np.clip(place, self.s[0], self.s[-1])
        return place if np.ndim(t) else float(place)

    @overload
    def speed_at(self, t: float) -> float: ...

    @overload
    def speed_at(self, t: Array) -> Array: ...

    def speed_at(self, t: float | Array) -> float | Array:
        """Return path speeds [m/s] at times [s], one or (k,)."""
        k, since = self._cell(t)
        speed: Array = self.speed[k] + since * self.acceleration[k]
        speed = np.maximum(speed, 0.0)
        return speed if np.ndim(t) else float(speed)

    @overload
    def time_at(self, s: float) -> float: ...

    @overload
    def time_at(self, s: Array) -> Array: ...

    def time_at(self, s: float | Array) -> float | Array:
        """Return times [s] at positions [m], one or (k,)."""
        place = np.clip(np.asarray(s, dtype=np.float64), self.s[0], self.s[-1])
        k = np.clip(np.searchsorted(self.s, place, side="right") - 1, 0, len(self.s) - 2)
        way = place - self.s[k]
        speed = np.sqrt(np.maximum(self.speed[k] ** 2 + 2.0 * self.acceleration[k] * way, 0.0))
        time: Array = self.times[k] + 2.0 * way / np.maximum(speed + self.speed[k], 1e-300)
        return time if np.ndim(s) else float(time)

    def parameter_integral(self, t: Array) -> Array:
        """Return the integral of s - s[0] from time 0 to times (k,) [m s]."""
        k, since = self._cell(t)
        cubic = since * (
            self.s[k] - self.s[0] + since * (self.speed[k] / 2 + since * self.acceleration[k] / 6)
        )
        integral: Array = self.integrals[k] + cubic
        return integral

    def smoothed(self, window: float, times: Array | None = None) -> tuple[Array, Array]:
        """Return positions [m] and speeds [m/s], (k,), averaged over a window [s] before instants.

        Before the first node the motion is assumed to have had the speed that it has there.

        Args:
            window: Width [s].
            times: Instants (k,) [s], also after the end; None for those of the nodes.
        """
        now, place, integral = self.times, self.s, self.integrals
        if times is not None:
            now, place, integral = times, self.s_at(times), self.parameter_integral(times)
            integral = integral + np.maximum(now - self.duration, 0.0) * (self.s[-1] - self.s[0])
        early = now - window
        before, after = np.minimum(early, 0.0), np.maximum(early - self.duration, 0.0)
        old = self.s_at(early) + self.speed[0] * before
        sum_before = self.parameter_integral(early) + 0.5 * self.speed[0] * before**2
        sum_before += after * (self.s[-1] - self.s[0])
        mean = self.s[0] + (integral - sum_before) / window
        return mean, (place - old) / window

    @derived_value
    def integrals(self) -> Array:
        """Integral of s - s[0] from time 0 to the nodes, shape (k,) [m s]."""
        step = np.diff(self.times)
        way, speed = self.s[:-1] - self.s[0], self.speed[:-1]
        parts = step * (way + step * (speed / 2 + step * self.acceleration / 6))
        return np.concatenate([[0.0], np.cumsum(parts)])

    @cached_property
    def marks(self) -> Index:
        """Nodes (m,) at which integrals restart, including the first node."""
        period = np.floor(self.times[:-1] / _COUNTED_S)
        return np.flatnonzero(np.diff(period, prepend=-1.0))

    @derived_value
    def since_marks(self) -> Array:
        """Distance [m], its integral [m s] and double integral [m s2] since the last mark, (3, k).

        The last node counts as a mark.
        """
        since = np.zeros((3, len(self.s)))
        bounds = [*self.marks.tolist(), len(self.s) - 1]
        for first, last in pairwise(bounds):
            cells = slice(first, last - 1)
            step, speed, change = (
                one[cells] for one in (np.diff(self.times), self.speed, self.acceleration)
            )
            way = self.s[first:last] - self.s[first]
            parts = step * (way[:-1] + step * (speed / 2 + step * change / 6))
            once = np.concatenate([[0.0], np.cumsum(parts)])
            cubic = way[:-1] / 2 + step * (speed / 6 + step * change / 24)
            twice = np.concatenate([[0.0], np.cumsum(step * (once[:-1] + step * cubic))])
            since[:, first:last] = way, once, twice
        return since

    def _cell(self, t: float | Array) -> tuple[Index, Array]:
        time = np.clip(np.asarray(t, dtype=np.float64), 0.0, self.times[-1])
        k = np.clip(np.searchsorted(self.times, time, side="right") - 1, 0, len(self.s) - 2)
        return k, time - self.times[k]


def with_rests(path: Path, nodes: Array, speed: Array) -> tuple[Array, Array, Array | None]:
    """Return nodes and speeds (k,) with a rest at each stop, and the times at rest [s].

    A rest lasts long enough for the smoothed motion to come to rest too: it could not follow a kink
    in motion. The times (k - 1,) are None if there are no stops.
    """
    stops = np.flatnonzero(np.isin(nodes[1:-1], path.stops)) + 1
    if not len(stops) or not path.window:
        return nodes, speed, None
    nodes, speed = np.insert(nodes, stops, nodes[stops]), np.insert(speed, stops, 0.0)
    return nodes, speed, np.where(np.diff(nodes) == 0.0, path.window, 0.0)
