"""The travelled path in the colours of the speed."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import rerun as rr

from rapidsim.frames.transform import Array
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.scene.paths import jumps

ENTITY = "path/speed"

_NO_STEP = 1e-6
"""Length [m] of an invisible piece."""


def log_speed_path(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log the path in the colours of `palette.SPEEDS`, from rest to `top_speed`."""
    if not run.robot_run.moves or top_speed(run) == 0.0:
        return
    speed = run.samples.tcp_speed
    # The colour of a step is that of its faster end: a stop is a point, not a section.
    share = np.maximum(speed[1:], speed[:-1]) / top_speed(run)
    bins = np.minimum((share * len(palette.SPEEDS)).astype(np.int64), len(palette.SPEEDS) - 1)
    strips: list[Array] = []
    colours: list[int] = []
    points = run.places
    jumped = jumps(run)
    breaks = np.flatnonzero((bins[1:] != bins[:-1]) | jumped[1:] | jumped[:-1]) + 1
    for begin, end in pairwise([0, *breaks.tolist(), len(bins)]):
        piece = points[begin : end + 1]
        if jumped[begin:end].any() or np.ptp(piece, axis=0).max() < _NO_STEP:
            continue
        strips.append(piece)
        colours.append(palette.rgba(palette.SPEEDS[int(bins[begin])]))
    stream.log(
        run.entity(ENTITY),
        rr.CoordinateFrame(run.still_frame),
        rr.LineStrips3D(
            strips, radii=rr.Radius.ui_points(2.6), colors=np.array(colours, dtype=np.uint32)
        ),
        static=True,
    )


def top_speed(run: RecordedRobot) -> float:
    """Return the highest speed of the TCP [m/s]."""
    return float(run.samples.tcp_speed.max())
