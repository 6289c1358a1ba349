"""Numerical solvers at poses of a trajectory: the benefit of a seed near the solution."""

from __future__ import annotations

from time import perf_counter

import numpy as np

from rapidsim.motion.waypoints.follow import FollowedTrajectory
from rapidsim.values import value_class

_MOST_POSES = 100
SOLVERS = ("lm", "trf", "bfgs")


@value_class(frozen=True, slots=True)
class SeededSolve:
    """Result of a solver at a sequence of poses."""

    solver: str
    warm: bool
    """Whether each search is seeded with the joints of the previous pose, else with joints at 0."""
    poses: int
    solved_count: int
    starts: int
    """Total number of starts: one per pose if the first start succeeds."""
    iterations: int
    seconds: float
    """Wall time [s]; nothing depends on it."""


def compared_starts(followed: FollowedTrajectory) -> tuple[SeededSolve, ...]:
    """Return results of SciPy's solvers, cold and warm, at poses spaced evenly on a trajectory."""
    from rapidsim.motion.configurations.scipy_solvers import search  # noqa: PLC0415

    robot, samples = followed.robot, followed.samples
    count = min(_MOST_POSES, len(samples.times))
    rows = np.linspace(0, len(samples.times) - 1, count).astype(np.int64)
    poses = robot.forward(samples.joints[rows])
    zero = np.clip(np.zeros(len(robot.joints)), robot.lower, robot.upper)
    tried = []
    for solver in SOLVERS:
        for warm in (False, True):
            near, found, starts, iterations = zero, 0, 0, 0
            began = perf_counter()
            for row in range(count):
                ended = search(robot, poses[row], solver, near)
                found += ended.solved
                starts += ended.starts
                iterations += ended.iterations
                near = ended.joints if warm else zero
            seconds = perf_counter() - began
            tried.append(SeededSolve(solver, warm, count, found, starts, iterations, seconds))
    return tuple(tried)
