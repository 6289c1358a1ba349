"""Conveyor belts that robots follow: their travel over time, and how a segment follows one.

A belt may start and stop at once, an arm cannot. The travel that robots follow is therefore smooth:
after each change of speed its distance from the belt is a polynomial of the fifth degree that ends
after `CATCH_UP_S`, with speed and acceleration continuous throughout. Our own, as ABB publishes no
law.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import field

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.values import value_class

_SAME_DIRECTION = 1e-9
CATCH_UP_S = 0.3
"""Time [s] after which robots move with a belt again that has started or stopped."""


@value_class(slots=True, eq=False)
class BeltCourse:
    """Travel of a belt over time; it can only be extended."""

    name: str
    """Name of its mechanical unit."""
    speed: float
    """Its current speed [m/s]."""
    _times: list[float] = field(default_factory=lambda: [0.0])
    """Times [s] of the changes of speed."""
    _rows: list[tuple[float, ...]] = field(init=False)
    """For each: travel [m] and speed [m/s] of the belt, then the polynomial of `_distances`."""

    def __post_init__(self) -> None:
        """Begin at zero, with robots that move with the belt."""
        self._rows = [(0.0, self.speed, 0.0, 0.0, 0.0)]

    @property
    def speeds(self) -> tuple[tuple[float, float, float], ...]:
        """Times [s], with travel [m] and speed [m/s] of the belt from then on."""
        rows = zip(self._times, self._rows, strict=True)
        return tuple((time_s, travel, speed) for time_s, (travel, speed, *_) in rows)

    def change(self, time_s: float, speed: float) -> None:
        """Let the belt run at another speed [m/s] from a time [s] on."""
        if speed == self.speed:
            return
        since_s, (travel, old, *_) = time_s - self._times[-1], self._rows[-1]
        distance, rate, bend = self._distances(np.array([time_s]), len(self._rows) - 1)[:, 0]
        rate += old - speed
        first = 3.0 * distance + CATCH_UP_S * rate
        second = 0.5 * CATCH_UP_S**2 * bend + 3.0 * (first - distance)
        self.speed = speed
        self._times.append(time_s)
        self._rows.append((travel + old * since_s, speed, float(distance), first, second))

    def belt_at(self, time_s: float) -> float:
        """Return the travel [m] of the belt itself at a time [s]."""
        row = max(bisect_right(self._times, time_s) - 1, 0)
        travel, speed, *_ = self._rows[row]
        return travel + speed * (time_s - self._times[row])

    def time_at(self, travel: float) -> float:
        """Return the time [s] at which the belt has travelled a distance [m]; infinite if never."""
        for row in range(len(self._rows) - 1, -1, -1):
            begin, speed, *_ = self._rows[row]
            if begin <= travel and speed > 0.0:
                return self._times[row] + (travel - begin) / speed
        return np.inf

    def at(self, times: Array) -> Array:
        """Return the travel (k,) [m] that robots follow at times (k,) [s]."""
        rows = np.maximum(np.searchsorted(self._times, times, side="right") - 1, 0)
        travel = np.empty(len(times))
        for row in np.unique(rows).tolist():
            at = np.flatnonzero(rows == row)
            begin, speed, *_ = self._rows[row]
            travel[at] = begin + speed * (times[at] - self._times[row])
            travel[at] += self._distances(times[at], row)[0]
        return travel

    def _distances(self, times: Array, row: int) -> Array:
        """Return how far robots are ahead of the belt [m], with two derivatives, shape (3, k)."""
        _, _, *powers = self._rows[row]
        share = np.clip((times - self._times[row]) / CATCH_UP_S, 0.0, 1.0)
        left = 1.0 - share
        poly = powers[0] + share * (powers[1] + share * powers[2])
        slope = powers[1] + 2.0 * share * powers[2]
        return np.stack(
            [
                left**3 * poly,
                (left**3 * slope - 3.0 * left**2 * poly) / CATCH_UP_S,
                (2.0 * left**3 * powers[2] - 6.0 * left**2 * slope + 6.0 * left * poly)
                / CATCH_UP_S**2,
            ]
        )


@value_class(frozen=True, slots=True, eq=False)
class BeltRide:
    """Relation of a segment to an object on a belt that the arm follows.

    The path of the segment is that of an axis which carries the work object, at its expected travel
    over time. Where the belt is ahead of that, the arm is ahead by as much, times a weight that
    grows or falls along the segment.
    """

    course: BeltCourse
    direction: Array
    """Shape (3,): direction of the travel in the base of the robot, unit length."""
    zero: float
    """Travel [m] of the belt at which the axis is at zero."""
    begin: float
    """Weight at the start of the segment: 1 where the arm follows the object, 0 where not yet."""
    end: float
    """Weight at its end."""
    zones: tuple[float, float] = (0.0, 0.0)
    """Radii [m] of the programmed zones at its ends, in which the weight does not change."""

    def is_along(self, direction: Array) -> bool:
        """Whether a direction (3,) in base is that of the travel."""
        return bool(np.abs(direction - self.direction).max() < _SAME_DIRECTION)

    @property
    def changes(self) -> bool:
        """Whether the arm begins or ends to follow the object on the segment."""
        return self.begin != self.end
