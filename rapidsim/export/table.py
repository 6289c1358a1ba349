"""A run as a table: one row an instant, columns in RAPID's units."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rapidsim.files import InputError
from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory import Samples
from rapidsim.simulation.result import Simulation

DEFAULT_DT = 0.012
"""[s]"""
MOST_ROWS = 20_000_000
_BLOCK = 20_000
"""Rows evaluated at once, so that a long run needs no more memory than a short one."""
_SAME_INSTANT_S = 1e-9
_MM_PER_M = 1000.0


@dataclass(frozen=True, slots=True, eq=False)
class Block:
    """Some rows of the table."""

    move: list[int]
    """The column `move`: index of the move under way."""
    numbers: Array
    """All other columns, in order, shape (k, columns)."""


def columns(simulation: Simulation) -> tuple[str, ...]:
    """Names of the columns; `move` is the second and the only one of whole numbers."""
    joints = tuple(f"j{k}" for k in range(1, len(simulation.robot.joints) + 1))
    pose = ("x_mm", "y_mm", "z_mm", "q1", "q2", "q3", "q4")
    return ("time_s", "move", *joints, *pose, "tcp_speed_mm_s")


def blocks(simulation: Simulation, dt: float) -> Iterator[Block]:
    """The rows: every `dt` [s] from 0, and the exact end.

    Raises:
        InputError: When `dt` is not positive or gives too many rows.
    """
    end_s = max(simulation.time_s, simulation.trajectory.duration)
    if not dt > 0.0:
        raise InputError(f"the time between trace rows must be greater than 0, not {dt:g} s")
    if end_s / dt > MOST_ROWS:
        raise InputError(
            f"a trace of {end_s:.1f} s every {dt:g} s has over {MOST_ROWS} rows",
            "take a larger `--dt`",
        )
    # k * dt and not a running sum: row k is at the same time in every run.
    times = np.append(np.arange(int(np.ceil(end_s / dt))) * dt, end_s)
    if len(times) > 1 and times[-2] > end_s - _SAME_INSTANT_S:
        times = np.delete(times, -2)
    return (
        _block(simulation.trajectory.at(times[begin : begin + _BLOCK]))
        for begin in range(0, len(times), _BLOCK)
    )


def _block(samples: Samples) -> Block:
    pose = samples.base_from_tcp
    return Block(
        samples.move.tolist(),
        np.column_stack(
            [
                samples.times,
                np.degrees(samples.joints),
                pose.translation * _MM_PER_M,
                pose.quaternion,
                samples.tcp_speed * _MM_PER_M,
            ]
        ),
    )
