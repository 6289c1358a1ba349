"""What holds a motion back: which axis, or which programmed speed, for most of a segment's time."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.problem import Problem
from rapidsim.motion.rows import Limiter, Quantity

_REACHED = 0.99


def limiters_of(problem: Problem, x: Array) -> tuple[Limiter, ...]:
    """Find what holds each segment of a path back, given x (c + 1,) at the nodes."""
    path, cells = problem.path, problem.cells
    speeds, accelerations = problem.speeds, problem.accelerations
    segment = path.segment_of(cells.piece)
    width = cells.width
    u = np.diff(x) / np.maximum(2.0 * width, 1e-300)
    places = zip(cells.at.T, (x[:-1], 0.5 * (x[:-1] + x[1:]), x[1:]), strict=True)
    kind = np.zeros(len(u), dtype=np.int64)
    most = np.zeros(len(u))
    held = np.zeros(len(u), dtype=bool)
    for at, square in places:
        speed = np.sqrt(square)
        # A speed that is reached holds back, however much of the acceleration is used.
        for number in range(len(speeds.limiters)):
            usage = speeds.rate[at, number] * speed
            reached = usage > _REACHED
            better = np.where(held, reached & (usage > most), reached)
            kind[better], most[better] = number, usage[better]
            held |= reached
        for number in range(len(accelerations.limiters)):
            load = np.abs(
                accelerations.slope[at, number] * u + accelerations.bend[at, number] * square
            )
            better = ~held & (load > most)
            kind[better], most[better] = len(speeds.limiters) + number, load[better]

    kinds = (*speeds.limiters, *accelerations.limiters, Limiter(Quantity.NOTHING))
    speed = np.sqrt(x)
    time = 2.0 * width / np.maximum(speed[:-1] + speed[1:], 1e-300)
    total = np.zeros((len(path.segments), len(kinds)))
    np.add.at(total, (segment, kind), time)
    found = np.where(total.any(axis=1), total.argmax(axis=1), len(kinds) - 1)
    return tuple(kinds[number] for number in found.tolist())
