"""Section of a path on which the TCP is corrected: the arm follows its path with an offset.

The offset is known at knots and linear in between. Joints are those on the path, moved by the
offset.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Kinematics


@dataclass(eq=False)
class CorrectedSection:
    """A corrected section of a path; it can only be extended."""

    start_s: float
    kinematics: Kinematics
    until_s: float = math.inf
    """Time [s] from which on the arm no longer follows this section."""
    _times: list[float] = field(default_factory=list)
    _offsets: list[Array] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Start on the path."""
        self.append(self.start_s, np.zeros(3))

    @property
    def end_s(self) -> float:
        """Time [s] up to which the offset is known; it stays constant after that."""
        return self._times[-1]

    @property
    def end(self) -> Array:
        """Offset (3,) [m] at the current end."""
        return self._offsets[-1]

    def append(self, time_s: float, arc_length: Array) -> None:
        """Extend to a time [s] at which the offset is `arc_length` (3,) [m], in base."""
        self._times.append(time_s)
        self._offsets.append(arc_length)

    def forget(self, before_s: float) -> None:
        """Discard data that queries for a time [s] or later do not need."""
        gone = max(bisect_right(self._times, before_s) - 2, 0)
        del self._times[:gone], self._offsets[:gone]

    def extend(self, start_s: float, cycle_s: float, offsets: Iterable[Array]) -> None:
        """Extend by a cycle [s] for each offset, starting at a time [s]."""
        for number, way in enumerate(offsets, start=1):
            self.append(start_s + number * cycle_s, way)

    def offsets_at(self, times: Array) -> Array:
        """Return the offsets (k, 3) [m] at instants (k,) [s], in base."""
        # A run has many knots, and a query needs few that are close together.
        first = max(0, bisect_right(self._times, float(times.min())) - 1)
        last = bisect_right(self._times, float(times.max())) + 1
        knots, ways = self._times[first:last], np.array(self._offsets[first:last])
        return np.stack([np.interp(times, knots, ways[:, k]) for k in range(3)], axis=-1)

    def speeds_at(self, times: Array) -> Array:
        """Return the rate (k,) [m/s] at which the offset changes."""
        step_s = 1e-3
        change = self.offsets_at(times + step_s) - self.offsets_at(times - step_s)
        speed: Array = np.linalg.norm(change, axis=1) / (2.0 * step_s)
        return speed

    def joints(self, joints: Array, offsets: Array) -> Array:
        """Return joints (k, n) [rad] of an arm moved by offsets (k, 3) [m]; NaN if unreachable."""
        return moved_joints(self.kinematics, joints, offsets)


def moved_joints(kinematics: Kinematics, joints: Array, offsets: Array) -> Array:
    """Return joints (k, n) [rad] of an arm moved by offsets (k, 3) [m]; NaN if unreachable."""
    flange = kinematics.forward(joints)
    led = Transform(flange.rotation, flange.translation + offsets)
    branches = kinematics.branch_of(joints)
    found = np.full_like(joints, np.nan)
    for branch in np.unique(branches).tolist():
        (rows,) = np.nonzero(branches == branch)
        there = kinematics.inverse_on_branch(led[rows], branch, joints[rows])
        found[rows[there.exists]] = there.joints[there.exists]
    return found
