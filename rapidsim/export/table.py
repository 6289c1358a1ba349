"""Table of a run: one row per sampling time, columns in RAPID's units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from rapidsim.files import InputError
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.belts import BeltCourse
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

DEFAULT_DT = 0.012
"""[s]"""
MOST_ROWS = 20_000_000
BLOCK = 20_000
"""Number of rows evaluated at once, so that memory does not grow with the run."""
_SAME_INSTANT_S = 1e-9
_MM_PER_M = 1000.0
DECIMALS = 6
"""Decimals of mm and degrees: fewer than machines agree on, but for rounding ties."""
SPEED_DECIMALS = 3
"""Decimals of mm/s: machines agree less on a derivative."""
UNIT_DECIMALS = 8
"""Decimals of seconds, of quaternions, and of radians in a joint trajectory."""


@value_class(frozen=True, slots=True, eq=False)
class RowBlock:
    """Some rows of the table."""

    move: list[int]
    """Column `move`: index of the active move."""
    numbers: tuple[Array | None, ...]
    """All other numeric columns (k,), in order; None for axes that the robot lacks."""
    task: str | None = None
    """Column `task`, the last one; None if there is only one robot."""


def columns(joint_count: int, external_count: int = 0) -> tuple[str, ...]:
    """Return the names of the columns; `move` is the second and the only integer column."""
    joints = tuple(f"j{k}" for k in range(1, joint_count + 1))
    external = tuple(f"e{k}" for k in range(1, external_count + 1))
    pose = ("x_mm", "y_mm", "z_mm", "q1", "q2", "q3", "q4")
    return ("time_s", "move", *joints, *external, *pose, "tcp_speed_mm_s")


def belt_columns(simulation: Simulation) -> tuple[str, ...]:
    """Return the names of the columns for the travel of belts, in the order of the station."""
    return tuple(f"c{k}_mm" for k in range(1, len(simulation.belts) + 1))


def blocks(simulation: Simulation, dt: float) -> Iterator[RowBlock]:
    """Return the rows in blocks: every `dt` [s] from 0, and the exact end.

    Raises:
        InputError: If `dt` is not positive or results in too many rows.
    """
    times, widths = sample_times(simulation, dt), table_widths(simulation)
    several = len(simulation.robots) > 1
    return (
        _with_belts(
            simulation.belts,
            _block_of(one, offset, times[begin : begin + BLOCK], widths, several=several),
        )
        for one, offset in zip(simulation.robots, simulation.move_offsets, strict=True)
        for begin in range(0, len(times), BLOCK)
    )


def table_widths(simulation: Simulation) -> tuple[int, int]:
    """Return the numbers of columns for joints and external axes."""
    return (
        max(len(one.robot.joints) for one in simulation.robots),
        max(len(one.robot.external) for one in simulation.robots),
    )


def _block_of(
    robot_run: RobotRun, offset: int, times: Array, widths: tuple[int, int], *, several: bool
) -> RowBlock:
    """Return rows of one robot, in the columns of the robot with most axes."""
    own = block(robot_run.trajectory.at(times), robot_run.robot.external)
    joints, external = len(robot_run.robot.joints), len(robot_run.robot.external)
    first_axis, rest = 1 + joints, 1 + joints + external
    numbers = (
        *own.numbers[:first_axis],
        *(None,) * (widths[0] - joints),
        *own.numbers[first_axis:rest],
        *(None,) * (widths[1] - external),
        *own.numbers[rest:],
    )
    moves = [offset + move for move in own.move]
    return RowBlock(moves, numbers, robot_run.task if several else None)


def _with_belts(belts: Sequence[BeltCourse], rows: RowBlock) -> RowBlock:
    """Return rows with the travel [mm] of belts."""
    times = rows.numbers[0]
    if not belts or times is None:
        return rows
    return replace(rows, numbers=(*rows.numbers, *(belt.at(times) * _MM_PER_M for belt in belts)))


def sample_times(simulation: Simulation, dt: float) -> Array:
    """Return the times (k,) [s] of the rows.

    Raises:
        InputError: If `dt` is not positive or results in too many rows.
    """
    end_s = simulation.motion_end_s
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
    return times


def block(samples: Samples, external: Sequence[ExternalAxis] = ()) -> RowBlock:
    """Return the rows at some times; `external` are the external axes."""
    pose = samples.base_from_tcp
    return RowBlock(
        samples.move.tolist(),
        (
            rounded(samples.times, UNIT_DECIMALS),
            *rounded(np.degrees(samples.joints)).T,
            *(rounded(samples.external[:, i] * axis.scale) for i, axis in enumerate(external)),
            *rounded(pose.translation * _MM_PER_M).T,
            *rounded(pose.quaternion, UNIT_DECIMALS).T,
            rounded(samples.tcp_speed * _MM_PER_M, SPEED_DECIMALS),
        ),
    )


def rounded(numbers: Array, decimals: int = DECIMALS) -> Array:
    """Return numbers as they are written, without negative zeros."""
    plain: Array = np.round(numbers, decimals) + 0.0
    return plain
