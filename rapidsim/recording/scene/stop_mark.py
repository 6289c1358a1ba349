"""Mark in the cell at the point of a stop that was not programmed."""

from __future__ import annotations

import numpy as np
import rerun as rr

from rapidsim.diagnostics import Severity
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot
from rapidsim.simulation.results.simulation import End

MARK = "stopped/mark"
NAME = "stopped/name"


def log_stopped(stream: rr.RecordingStream, run: RecordedRobot, above_m: float) -> None:
    """Log the TCP position at which an error ended the run; with several robots, of the failed one.

    Args:
        stream: The recording.
        run: The run.
        above_m: Height [m] of the error's code and name above the mark, clear of other names.
    """
    if run.sampled.simulation.end is not End.ERROR or (run.name and not run.robot_run.failed_moves):
        return
    errors = [
        finding.violation
        for finding in run.sampled.simulation.diagnostics
        if finding.severity is Severity.ERROR
    ]
    label = f"stopped: {errors[-1].code} {errors[-1].name}" if errors else "stopped"
    place = run.places[-1]
    for entity in (MARK, NAME):
        stream.log(run.entity(entity), rr.CoordinateFrame(run.still_frame), static=True)
    run.clock.set(stream, run.sampled.end_s)
    colour = palette.rgba(palette.STOPPED)
    stream.log(
        run.entity(MARK), rr.Points3D([place], radii=rr.Radius.ui_points(8.0), colors=colour)
    )
    # An infeasible move shows its reason at its own point of failure.
    if not any(failed.violation in errors for failed in run.robot_run.failed_moves):
        stream.log(
            run.entity(NAME),
            rr.Points3D(
                [place + np.array([0.0, 0.0, above_m])],
                radii=rr.Radius.ui_points(0.0),
                colors=colour,
                labels=[label],
                show_labels=True,
            ),
        )
    stream.reset_time()
