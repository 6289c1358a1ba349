"""Compare a controller's log of joint angles with our run of the same program, by position.

The two are compared at equal positions on the path, not at equal times: each row of the log is
assigned to the nearest position on our path; our time there less the time of the row is our lag.
"""

from __future__ import annotations

from typing import Self

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.values import value_class

STEP_M = 0.5e-3
"""Spacing of the sampled positions of our path; between them joints are interpolated linearly."""
_SPEED_SPAN_S = 4e-3
_AS_NEAR_RAD = 1e-3
_CHORD_RAD = 1e-5
"""Distance that only the linear interpolation between positions makes."""
_EQUAL_RAD = 1e-9


@value_class(frozen=True, slots=True, eq=False)
class MotionByPlace:
    """Our motion from a start time on, as positions S (k,) [m] of the run and the joints there."""

    trajectory: Trajectory
    start_s: float
    """Start time; the times of the methods count from it."""
    places: Array
    joints: Array
    """Shape (k, n) [rad]."""

    @classmethod
    def of(cls, trajectory: Trajectory, start_s: float) -> Self:
        """Return the motion of a trajectory from a start time [s] on."""
        first = float(trajectory.place_at(np.array([start_s]))[0])
        count = max(2, round((trajectory.length - first) / STEP_M))
        even = np.linspace(first, trajectory.length, count)
        # The path may turn sharply at a stop, where many rows of a log lie.
        stops = _stops(trajectory)
        places: Array = np.union1d(even, stops[stops > first])
        joints = trajectory.at(trajectory.time_at_place(places)).joints
        return cls(trajectory, start_s, places, joints)

    def nearest(self, joints: Array, axes: slice = slice(None)) -> tuple[Array, Array]:
        """Ascending positions (k,) [m] nearest to joints (k, n), and distances (k,) [rad].

        Args:
            joints: Rows of a log [rad].
            axes: The axes that are compared.
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
            # A path that passes again is as near there: the first time counts, also where it
            # reverses at a stop and only interpolation would decide.
            first, once = _first_run(apart, _AS_NEAR_RAD)
            start_of_run, run = _first_run(once, _CHORD_RAD)
            best = first + start_of_run + int(np.argmax(run <= run.min() + _EQUAL_RAD))
            reached, within = reached + best, float(share[best])
            width = self.places[reached + 1] - self.places[reached]
            places[row] = self.places[reached] + share[best] * width
            distances[row] = apart[best]
        return places, distances

    def time_at(self, places: Array) -> Array:
        """Times (k,) [s] at positions (k,) [m]."""
        times: Array = self.trajectory.time_at_place(places) - self.start_s
        return times

    def place_at(self, times: Array) -> Array:
        """Positions (k,) [m] at times (k,) [s]."""
        return self.trajectory.place_at(times + self.start_s)

    def speed_at(self, places: Array) -> Array:
        """Path speeds (k,) [m/s] at positions (k,) [m]."""
        times = self.time_at(places)
        before, after = (self.place_at(times + s * _SPEED_SPAN_S / 2) for s in (-1.0, 1.0))
        speed: Array = (after - before) / _SPEED_SPAN_S
        return speed


def _first_run(apart: Array, tolerance: float) -> tuple[int, Array]:
    """Return the first values (k,) in a row that are the least within a tolerance, and where."""
    near = apart <= apart.min() + tolerance
    first = int(np.argmax(near))
    away = np.flatnonzero(~near[first:])
    return first, apart[first : first + away[0]] if len(away) else apart[first:]


def _stops(trajectory: Trajectory) -> Array:
    """Positions (k,) [m] of the run at which the command is at rest."""
    found, start = [np.zeros(1)], 0.0
    for piece in trajectory.pieces:
        on_path = np.append(piece.path.stops, piece.to_s)
        on_path = on_path[(on_path > piece.from_s) & (on_path <= piece.to_s)]
        found.append(start + on_path - piece.from_s)
        start += piece.to_s - piece.from_s
    return np.concatenate(found)
