"""Plot of the travel of the belts of a cell."""

from __future__ import annotations

import numpy as np
import rerun as rr

from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot

ENTITY = "conveyors"
_MM = 1e3


def log_belts(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log the travel [mm] of each belt of the cell, if it has any."""
    belts = run.sampled.simulation.belts
    if not belts:
        return
    colours = [palette.rgba(palette.JOINTS[k % len(palette.JOINTS)]) for k in range(len(belts))]
    look = rr.SeriesLines(
        names=[f"{belt.name} [mm]" for belt in belts],
        colors=np.array(colours, dtype=np.uint32),
        widths=np.full(len(belts), 1.6),
    )
    stream.log(ENTITY, look, static=True)
    times = run.samples.times
    travel = _MM * np.stack([belt.at(times) for belt in belts], axis=-1)
    stream.send_columns(
        ENTITY,
        indexes=run.clock.columns(times),
        columns=rr.Scalars.columns(scalars=travel.reshape(-1)).partition([len(belts)] * len(times)),
    )
