"""What holds a motion back: which axis, or which programmed speed, for most of a segment's time."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.grid import Cells
from rapidsim.motion.limits import Limits
from rapidsim.motion.path import Path
from rapidsim.motion.solver import segment_of

_REACHED = 0.99


class Quantity(Enum):
    """What can be at its limit."""

    AXIS_SPEED = "axis speed"
    AXIS_ACCELERATION = "axis acceleration"
    TCP_SPEED = "TCP speed"
    REORIENTATION_SPEED = "reorientation speed"
    DURATION = "programmed time"
    NOTHING = "nothing"
    """The segment has no length, or lies before the start of the timing."""


@dataclass(frozen=True, slots=True)
class Limiter:
    """A limit that was reached."""

    quantity: Quantity
    axis: int | None = None
    """Counted from 1; None where no single axis is meant."""

    def __str__(self) -> str:
        """Such as `acceleration of axis 2`."""
        match self.quantity:
            case Quantity.AXIS_SPEED:
                return f"speed of axis {self.axis}"
            case Quantity.AXIS_ACCELERATION:
                return f"acceleration of axis {self.axis}"
            case _:
                return str(self.quantity.value)


def limiters_of(
    path: Path, cells: Cells, limits: Limits, pace: Array, x: Array
) -> tuple[Limiter, ...]:
    """Find what holds each segment of a path back, given x (c + 1,) at the nodes.

    `pace` (segments,) [m/s] is the path speed of segments with a programmed time, else NaN.
    """
    axes = cells.first.shape[2]
    kinds = (
        *(Limiter(Quantity.AXIS_SPEED, axis + 1) for axis in range(axes)),
        Limiter(Quantity.TCP_SPEED),
        Limiter(Quantity.REORIENTATION_SPEED),
        Limiter(Quantity.DURATION),
        *(Limiter(Quantity.AXIS_ACCELERATION, axis + 1) for axis in range(axes)),
    )
    segment = segment_of(path, cells)
    speed = np.sqrt(np.stack([x[:-1], 0.5 * (x[:-1] + x[1:]), x[1:]], axis=1))  # (c, 3)
    paced = ~np.isnan(pace)
    tcp = np.where(paced, np.inf, [s.speed.tcp for s in path.segments])[segment]
    turn = np.where(paced, np.inf, [s.speed.reorientation for s in path.segments])[segment]
    usage = np.concatenate(
        [
            np.abs(cells.first) / limits.max_speed,
            (cells.tcp_rate / tcp[:, None])[..., None],
            (cells.turn_rate / turn[:, None])[..., None],
            np.repeat(np.where(paced, 1.0 / pace, 0.0)[segment][:, None, None], 3, axis=1),
        ],
        axis=-1,
    )
    usage = (usage * speed[..., None]).max(axis=1)

    width = cells.end - cells.start
    u = np.diff(x) / np.maximum(2.0 * width, 1e-300)
    load = cells.first * u[:, None, None] + cells.second * (speed**2)[..., None]
    load = np.abs(load).max(axis=1) / limits.max_acceleration
    kind = np.where(
        usage.max(axis=1) > _REACHED, usage.argmax(axis=1), usage.shape[1] + load.argmax(axis=1)
    )
    time = width / np.maximum(speed.mean(axis=1), 1e-300)
    total = np.zeros((len(path.segments), len(kinds)))
    np.add.at(total, (segment, kind), time)
    idle = Limiter(Quantity.NOTHING)
    return tuple(kinds[int(row.argmax())] if row.any() else idle for row in total)
