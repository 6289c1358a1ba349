"""The two clocks of a recording: virtual time, and the number of the move under way.

Stepping through `move` shows the cell at the end of each one. With several robots their moves are
counted together, in the order they begin.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
import rerun as rr

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Array
from rapidsim.values import value_class

SIM_TIME = "sim_time"
MOVE = "move"


@value_class(frozen=True, slots=True, eq=False)
class Clock:
    """Turns instants of virtual time into the viewer's times."""

    starts: Array
    """When the moves of the run begin (m,) [s], in order."""

    def columns(self, times: Array | Sequence[float]) -> list[rr.TimeColumn]:
        """The time columns of rows at `times` (k,) [s]: during the last move begun by then."""
        instants = np.asarray(times, dtype=np.float64)
        # Rounded to the viewer's nanoseconds here; seconds as floats would be cut off.
        nanoseconds = np.round(instants * 1e9).astype("timedelta64[ns]")
        return [
            rr.TimeColumn(SIM_TIME, duration=nanoseconds),
            rr.TimeColumn(MOVE, sequence=self._move_number(instants)),
        ]

    def set(self, stream: rr.RecordingStream, time_s: float) -> None:
        """Let what is logged next happen at an instant [s]."""
        stream.set_time(SIM_TIME, duration=np.timedelta64(round(time_s * 1e9), "ns"))
        stream.set_time(MOVE, sequence=int(self._move_number(np.array([time_s]))[0]))

    def _move_number(self, times: Array) -> np.typing.NDArray[np.int64]:
        """Number of the move under way (k,), from 0; 0 before the first one too."""
        # Samples are rounded to nanoseconds: one at the start of a move may lie just before it.
        begun = np.searchsorted(self.starts, times + 0.5e-9, side="right") - 1
        return np.maximum(begun, 0).astype(np.int64)


def clock_of(moves: Iterable[ExecutedMove]) -> Clock:
    """The clock of a run with these moves."""
    return Clock(np.sort(np.array([move.start_s for move in moves], dtype=np.float64)))
