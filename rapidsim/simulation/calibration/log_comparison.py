"""A controller's log of joint angles beside our run of the same program, place by place.

The two are compared where they are on the path, not when: each row of the log is taken to the
nearest place of our path, and the time at which ours is there less the time of the row says how far
ours lags.
"""

from __future__ import annotations

from typing import Self

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.values import value_class

STEP_M = 0.5e-3
"""Places of our path are this far apart; between them joints run straight."""
_SPEED_SPAN_S = 4e-3
_AS_NEAR_RAD = 1e-3
_EQUAL_RAD = 1e-9


@value_class(frozen=True, slots=True, eq=False)
class MotionByPlace:
    """Our motion from an instant on, as places S (k,) [m] of the run and the joints there."""

    trajectory: Trajectory
    start_s: float
    """The instant; times below count from it."""
    places: Array
    joints: Array
    """Shape (k, n) [rad]."""

    @classmethod
    def of(cls, trajectory: Trajectory, start_s: float) -> Self:
        """What a trajectory does after an instant [s]."""
        first = float(trajectory.place_at(np.array([start_s]))[0])
        count = max(2, round((trajectory.length - first) / STEP_M))
        even = np.linspace(first, trajectory.length, count)
        # The way may turn sharply at a stop, where many rows of a log lie.
        stops = _stops(trajectory)
        places: Array = np.union1d(even, stops[stops > first])
        joints = trajectory.at(trajectory.time_at_place(places)).joints
        return cls(trajectory, start_s, places, joints)

    def nearest(self, joints: Array, axes: slice = slice(None)) -> tuple[Array, Array]:
        """Places (k,) [m] that come nearest to joints (k, n), never back, and how near (k,) [rad].

        Args:
            joints: Rows of a log [rad].
            axes: Which axes count.
        """
        ours, log = self.joints[:, axes], joints[:, axes]
        steps = np.diff(ours, axis=0)
        squares = np.maximum(np.einsum("ki,ki->k", steps, steps), 1e-18)
        places, distances = np.empty(len(log)), np.empty(len(log))
        reached, within = 0, 0.0
        for row, wanted in enumerate(log):
            start, step = ours[reached:-1], steps[reached:]
            share = np.einsum("ki,ki->k", wanted - start, step) / squares[reached:]
            share = np.clip(share, 0.0, 1.0)
            share[0] = max(share[0], within)
            apart = np.linalg.norm(start + share[:, None] * step - wanted, axis=1)
            # A way that comes by again is as near there: the first time counts, also where it turns
            # back at a stop and only rounding would choose.
            near = apart <= apart.min() + _AS_NEAR_RAD
            first = int(np.argmax(near))
            away = np.flatnonzero(~near[first:])
            once = apart[first : first + away[0]] if len(away) else apart[first:]
            best = first + int(np.argmax(once <= once.min() + _EQUAL_RAD))
            reached, within = reached + best, float(share[best])
            width = self.places[reached + 1] - self.places[reached]
            places[row] = self.places[reached] + share[best] * width
            distances[row] = apart[best]
        return places, distances

    def time_at(self, places: Array) -> Array:
        """Times (k,) [s] at places (k,) [m]."""
        times: Array = self.trajectory.time_at_place(places) - self.start_s
        return times

    def place_at(self, times: Array) -> Array:
        """Places (k,) [m] at times (k,) [s]."""
        return self.trajectory.place_at(times + self.start_s)

    def speed_at(self, places: Array) -> Array:
        """Path speeds (k,) [m/s] at places (k,) [m]."""
        times = self.time_at(places)
        before, after = (self.place_at(times + s * _SPEED_SPAN_S / 2) for s in (-1.0, 1.0))
        speed: Array = (after - before) / _SPEED_SPAN_S
        return speed


def _stops(trajectory: Trajectory) -> Array:
    """Places (k,) [m] of the run where the command comes to rest."""
    found, start = [np.zeros(1)], 0.0
    for piece in trajectory.pieces:
        on_path = np.append(piece.path.stops, piece.to_s)
        on_path = on_path[(on_path > piece.from_s) & (on_path <= piece.to_s)]
        found.append(start + on_path - piece.from_s)
        start += piece.to_s - piece.from_s
    return np.concatenate(found)
