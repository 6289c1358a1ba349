"""Write a run as one `.rrd` file that the rerun viewer opens, layout included.

The same run gives the same recording: its id comes from its content, and nothing in it comes from a
wall clock. (Row ids and the layout's ids are the viewer's own and differ; compare recordings with
`rerun rrd compare --unordered`.)
"""

from __future__ import annotations

import hashlib
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import rerun as rr

from rapidsim.output_files import whole_file
from rapidsim.recording.arm import log_arm
from rapidsim.recording.blueprint import blueprint
from rapidsim.recording.camera import cell_size
from rapidsim.recording.lanes import log_lanes
from rapidsim.recording.listing import log_listing
from rapidsim.recording.log import log_messages
from rapidsim.recording.paths import log_paths
from rapidsim.recording.plots import log_plots
from rapidsim.recording.sampled import SampledRun, sample
from rapidsim.recording.stopped import log_stopped
from rapidsim.recording.targets import Target, extent, log_targets, near_targets, targets_of
from rapidsim.recording.tool import log_tool
from rapidsim.recording.transforms import BASE, BASE_FROM_WORLD, WORLD, static_frame
from rapidsim.recording.work_objects import log_work_objects
from rapidsim.simulation.result import Simulation

APPLICATION = "rapidsim"


def record(simulation: Simulation, path: str | Path, *, dt: float | None = None) -> Path:
    """Write a recording of a run.

    Args:
        simulation: The run.
        path: Where to write; the file appears only when it is complete.
        dt: Time [s] between samples of the motion; None takes 12 ms, or more for runs of hours.

    Returns:
        The path written.

    Raises:
        InputError: When nothing can be written there.
    """
    path = Path(path)
    with whole_file(path) as temporary, _strictly():
        run = sample(simulation, dt)
        targets = targets_of(simulation.moves)
        with rr.RecordingStream(
            APPLICATION, recording_id=_content_id(run), send_properties=False
        ) as stream:
            stream.save(temporary, default_blueprint=blueprint(run, targets))
            stream.set_log_time_enabled(False)
            stream.set_log_tick_enabled(False)
            _log_all(stream, run, targets)
    return path


def _log_all(stream: rr.RecordingStream, run: SampledRun, targets: tuple[Target, ...]) -> None:
    simulation = run.simulation
    stream.send_recording_name(" ".join(Path(name).name for name in simulation.program))
    stream.send_property("run", _properties(run))
    stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, rr.CoordinateFrame(WORLD), static=True)
    stream.log("base", static_frame(WORLD, BASE, BASE_FROM_WORLD.inverse()), static=True)
    near_m = extent(near_targets(targets)) or cell_size(run)
    # Long enough to see in the cell, short enough not to cover a small figure seen from near.
    axis_m = float(np.clip(0.35 * near_m, 0.03 * cell_size(run), 0.1 * cell_size(run)))
    remarks = run.remarks + log_arm(stream, run)
    log_tool(stream, run, 0.7 * axis_m)
    log_work_objects(stream, run, axis_m)
    log_paths(stream, run)
    remarks += log_targets(
        stream, targets, axis_m=min(0.12 * near_m, 0.5 * axis_m), apart_m=0.1 * cell_size(run)
    )
    remarks += log_listing(stream, run)
    log_stopped(stream, run, 0.05 * cell_size(run))
    log_plots(stream, run)
    log_lanes(stream, run)
    log_messages(stream, run, remarks)


def _properties(run: SampledRun) -> rr.AnyValues:
    simulation = run.simulation
    model = simulation.model
    return rr.AnyValues(
        program=list(simulation.program),
        robot=simulation.robot.title,
        end=simulation.end.value,
        time_s=simulation.time_s,
        motion_s=simulation.motion_s,
        wait_s=simulation.wait_s,
        path_mm=simulation.path_m * 1000.0,
        moves=len(simulation.moves),
        sample_interval_s=run.dt,
        acceleration_time_s=model.acceleration_time,
        filter_time_s=model.filter_time,
        fine_dwell_s=model.fine_dwell,
        corner=model.corner,
    )


def _content_id(run: SampledRun) -> uuid.UUID:
    """An id that only the content decides: equal runs are one recording to the viewer."""
    simulation = run.simulation
    digest = hashlib.sha256()
    for text in (*simulation.program, simulation.robot.name, simulation.end.value):
        digest.update(text.encode() + b"\0")
    for array in (run.samples.times, run.samples.joints):
        digest.update(np.ascontiguousarray(array).tobytes())
    for event in simulation.events:
        digest.update(f"{event.time_s!r} {event.kind} {event.message}\0".encode())
    return uuid.UUID(bytes=digest.digest()[:16])


@contextmanager
def _strictly() -> Iterator[None]:
    """Let rerun raise where it would warn and drop data."""
    before = rr.strict_mode()
    rr.set_strict_mode(True)
    try:
        yield
    finally:
        rr.set_strict_mode(before)
