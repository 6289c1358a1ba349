"""The moves of a run for Python: records one by one, or all of them as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import overload

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array
from rapidsim.report.run.records import MoveRecord, move_records
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False, repr=False)
class MoveArrays:
    """The fields of k moves as arrays, with the names and units of their records."""

    index: npt.NDArray[np.int64]
    """Shape (k,)."""
    line: npt.NDArray[np.int64]
    """Shape (k,)."""
    start_s: Array
    """Shape (k,)."""
    end_s: Array
    """Shape (k,)."""
    length_mm: Array
    """Shape (k,): along the programmed path, before corners are cut."""
    speed_mm_s: Array
    """Shape (k,): as programmed."""
    zone_mm: Array
    """Shape (k,): that was used; 0 for a stop."""
    position_mm: Array
    """Shape (k, 3): the TCP at the programmed end, in the base frame of its robot."""
    joints_deg: Array
    """Shape (k, n) at the programmed end; NaN for axes that a robot of several lacks."""

    def __repr__(self) -> str:
        """One line."""
        return f"<columns of {len(self.index)} moves>"


def _filled(joints: Array, count: int) -> Array:
    """Return joints (..., n) with NaN up to a number of axes."""
    width = [(0, 0)] * (joints.ndim - 1) + [(0, count - joints.shape[-1])]
    return np.pad(joints, width, constant_values=np.nan)


class Moves(Sequence[MoveRecord]):
    """The moves of all robots, robot after robot."""

    def __init__(self, simulation: Simulation) -> None:
        """Take the moves of a run."""
        self._simulation = simulation

    @cached_property
    def _records(self) -> tuple[MoveRecord, ...]:
        return move_records(self._simulation)

    @cached_property
    def columns(self) -> MoveArrays:
        """The moves as arrays: much quicker than their records where there are thousands."""
        columns = self._simulation.moves.columns
        most = max(len(one.robot.joints) for one in self._simulation.robots)
        joints = columns.rows.column(
            lambda lines: _filled(lines.joints(), most), lambda row: _filled(row.joints, most)
        ).reshape(-1, most)
        return MoveArrays(
            index=columns.index,
            line=columns.lines,
            start_s=columns.start_s,
            end_s=columns.end_s,
            length_mm=1000.0 * columns.length_m,
            speed_mm_s=columns.speed_mm_s,
            zone_mm=1000.0 * columns.zone_m,
            position_mm=1000.0 * columns.end_m,
            joints_deg=np.degrees(joints),
        )

    def __len__(self) -> int:
        """Number of moves."""
        return len(self._simulation.moves)

    @overload
    def __getitem__(self, at: int) -> MoveRecord: ...
    @overload
    def __getitem__(self, at: slice) -> tuple[MoveRecord, ...]: ...

    def __getitem__(self, at: int | slice) -> MoveRecord | tuple[MoveRecord, ...]:
        """Return the record of a move, or those of a slice."""
        return self._records[at]

    def __repr__(self) -> str:
        """One line."""
        return f"<{len(self)} moves>"
