"""The programmed speed beside the real one: one value at each instant of the recording."""

from dataclasses import replace

import numpy as np
from recording_cell import cell

from rapidsim.controller.moves.executed_moves import moves_of
from rapidsim.recording.panels.plots import _programmed_steps


def test_two_speeds_are_never_at_one_nanosecond() -> None:
    moves = cell().moves
    first = replace(moves[0], start_s=moves[0].start_s + 1e-14)
    times, speeds = _programmed_steps(moves_of((first, *moves[1:])).columns, moves[-1].end_s)
    assert (np.diff(np.round(times * 1e9)) > 0.5).all()
    begins = np.searchsorted(times, round(first.start_s, 9))
    assert speeds[begins] == first.move.speed.v_tcp
