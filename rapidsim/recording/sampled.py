"""A run looked at often enough to be drawn.

Every change that the eye or a plot could miss between two samples gets its own: starts and ends of
moves, and the last instant.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.trajectory import Samples
from rapidsim.simulation.result import Simulation

DEFAULT_DT = 0.012
"""[s]; the beat at which a controller itself computes its path."""
MOST_SAMPLES = 120_000
"""A longer run is sampled more coarsely unless the user asks otherwise; this is some 60 MB."""
_BLOCK = 20_000
"""Samples evaluated at once, which bounds the memory that the kinematics needs."""


@dataclass(frozen=True, slots=True, eq=False)
class SampledRun:
    """A run and the samples it is drawn from."""

    simulation: Simulation
    dt: float
    """Time [s] between samples; starts and ends of moves have samples of their own."""
    samples: Samples

    @property
    def remarks(self) -> tuple[str, ...]:
        """What sampling leaves out that a user would expect, a line each."""
        if self.dt <= DEFAULT_DT:
            return ()
        return (
            f"the motion is shown every {1000.0 * self.dt:.0f} ms, not {1000.0 * DEFAULT_DT:.0f}",
        )

    @property
    def end_s(self) -> float:
        """The last instant [s]."""
        return float(self.samples.times[-1])


def sample(simulation: Simulation, dt: float | None) -> SampledRun:
    """Sample a run.

    Args:
        simulation: The run.
        dt: Time [s] between samples; None takes `DEFAULT_DT`, or more for a run of hours.
    """
    end_s = max(simulation.time_s, simulation.trajectory.duration)
    step = dt if dt is not None else max(DEFAULT_DT, end_s / MOST_SAMPLES)
    times = _times(simulation, end_s, step)
    return SampledRun(simulation, step, _evaluate(simulation, times))


def _times(simulation: Simulation, end_s: float, dt: float) -> Array:
    grid = np.arange(0.0, end_s, dt)
    edges = [t for move in simulation.moves for t in (move.start_s, move.end_s)]
    times = np.concatenate([grid, np.clip(np.array([0.0, *edges, end_s]), 0.0, end_s)])
    # The viewer counts nanoseconds: instants closer than that would fall on one another.
    return np.unique(np.round(times, 9))


def _evaluate(simulation: Simulation, times: Array) -> Samples:
    blocks = [
        simulation.trajectory.at(times[begin : begin + _BLOCK])
        for begin in range(0, len(times), _BLOCK)
    ]
    return Samples(
        times=times,
        move=np.concatenate([block.move for block in blocks]),
        joints=np.concatenate([block.joints for block in blocks]),
        base_from_tcp=Transform(
            np.concatenate([block.base_from_tcp.rotation for block in blocks]),
            np.concatenate([block.base_from_tcp.translation for block in blocks]),
        ),
        tcp_speed=np.concatenate([block.tcp_speed for block in blocks]),
    )
