"""The two clocks of a recording: virtual time, and the number of the active move.

Stepping through `move` shows the cell at the end of each move. Moves of several robots are counted
together, in the order of their starts.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import rerun as rr

from rapidsim.controller.moves.executed_moves import ExecutedMoves
from rapidsim.frames.transform import Array
from rapidsim.values import value_class

SIM_TIME = "sim_time"
MOVE = "move"


@value_class(frozen=True, slots=True, eq=False)
class Clock:
    """Converts instants of virtual time to the viewer's times."""

    starts: Array
    """Start times of the moves of the run (m,) [s], in order."""

    def columns(self, times: Array | Sequence[float]) -> list[rr.TimeColumn]:
        """Return the time columns of rows at `times` (k,) [s], with the last move begun by then."""
        instants = np.asarray(times, dtype=np.float64)
        # Rounded to the viewer's nanoseconds here; seconds as floats would be truncated.
        nanoseconds = np.round(instants * 1e9).astype("timedelta64[ns]")
        return [
            rr.TimeColumn(SIM_TIME, duration=nanoseconds),
            rr.TimeColumn(MOVE, sequence=self._move_number(instants)),
        ]

    def set(self, stream: rr.RecordingStream, time_s: float) -> None:
        """Set the time [s] of the following log calls."""
        stream.set_time(SIM_TIME, duration=np.timedelta64(round(time_s * 1e9), "ns"))
        stream.set_time(MOVE, sequence=int(self._move_number(np.array([time_s]))[0]))

    def _move_number(self, times: Array) -> np.typing.NDArray[np.int64]:
        """Return the number of the active move (k,), from 0; 0 also before the first one."""
        # Samples are rounded to nanoseconds: one at the start of a move may lie just before it.
        begun = np.searchsorted(self.starts, times + 0.5e-9, side="right") - 1
        return np.maximum(begun, 0).astype(np.int64)


def clock_of(moves: ExecutedMoves) -> Clock:
    """Return the clock of a run with these moves."""
    return Clock(np.sort(moves.columns.start_s))
