"""A whole run's motion as a function of time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """The arm at some instants."""

    times: Array
    """Shape (k,) [s]."""
    move: npt.NDArray[np.int64]
    """Shape (k,): index of the move under way; the last one while standing still after it."""
    joints: Array
    """Shape (k, n) [rad]."""
    base_from_tcp: Transform
    """Shape (k,); the tool is that of the move."""
    tcp_speed: Array
    """Shape (k,) [m/s]."""


class Trajectory:
    """Where the arm is at any time; nothing is interpolated between samples."""

    @property
    def duration(self) -> float:
        """Last instant [s]."""
        raise NotImplementedError

    def at(self, times: Array) -> Samples:
        """The arm at some instants (k,) [s], by exact evaluation of path and inverse kinematics."""
        raise NotImplementedError
