"""The two clocks of a recording: virtual time, and the number of the move under way.

Stepping through `move` shows the arm at the end of each one.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import rerun as rr

from rapidsim.frames.transform import Array
from rapidsim.simulation.result import ExecutedMove

SIM_TIME = "sim_time"
MOVE = "move"


def indexes(times: Array, moves: npt.NDArray[np.int64]) -> list[rr.TimeColumn]:
    """The time columns of rows at `times` (k,) [s] during `moves` (k,)."""
    # Rounded to the viewer's nanoseconds here; seconds as floats would be cut off.
    nanoseconds = np.round(times * 1e9).astype("timedelta64[ns]")
    return [rr.TimeColumn(SIM_TIME, duration=nanoseconds), rr.TimeColumn(MOVE, sequence=moves)]


def indexes_at(times_s: Sequence[float], moves: Sequence[ExecutedMove]) -> list[rr.TimeColumn]:
    """The time columns of things that happened at `times_s`: during the last move begun by then."""
    starts = [move.start_s for move in moves]
    begun = np.searchsorted(starts, times_s, side="right") - 1
    return indexes(np.array(times_s, dtype=np.float64), np.maximum(begun, 0).astype(np.int64))


def set_instant(stream: rr.RecordingStream, time_s: float, moves: Sequence[ExecutedMove]) -> None:
    """Let what is logged next happen at an instant [s]."""
    stream.set_time(SIM_TIME, duration=np.timedelta64(round(time_s * 1e9), "ns"))
    begun = bisect_right(moves, time_s, key=lambda move: move.start_s) - 1
    stream.set_time(MOVE, sequence=max(begun, 0))
