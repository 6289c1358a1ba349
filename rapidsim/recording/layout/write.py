"""Writer of a run as one `.rrd` file for the rerun viewer, layout included.

Equal runs produce equal recordings: the id depends on the content, and the data contain no wall
time. (Row ids and the layout's ids are created by the viewer and differ; compare recordings with
`rerun rrd compare --unordered`.)
"""

from __future__ import annotations

import hashlib
import uuid
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import rerun as rr

from rapidsim.frames.transform import Transform
from rapidsim.motion.timing.axis_limits import limits_of, model_of
from rapidsim.recording.layout.blueprint import blueprint
from rapidsim.recording.layout.camera import cell_size
from rapidsim.recording.panels.belts import log_belts
from rapidsim.recording.panels.log import log_messages
from rapidsim.recording.panels.plots import log_plots
from rapidsim.recording.panels.program_listing import log_listing
from rapidsim.recording.panels.state_lanes import (
    log_clearance,
    log_errors,
    log_limits,
    log_moves,
    log_signals,
)
from rapidsim.recording.samples import RecordedRobot, sample
from rapidsim.recording.scene.arm import log_arm
from rapidsim.recording.scene.failed_moves import log_failed
from rapidsim.recording.scene.paths import log_paths
from rapidsim.recording.scene.speed_path import log_speed_path
from rapidsim.recording.scene.stop_mark import log_stopped
from rapidsim.recording.scene.targets import Targets, extent, log_targets, near_targets, targets_of
from rapidsim.recording.scene.tool import log_tool
from rapidsim.recording.scene.work_objects import log_work_objects
from rapidsim.recording.stream import recording_file
from rapidsim.recording.transforms import BASE, WORLD, moving_frame, static_frame
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.verdict import run_verdict


def record(simulation: Simulation, path: str | Path, *, dt: float | None = None) -> Path:
    """Write a recording of a run.

    Args:
        simulation: The run.
        path: Target file, which appears only when it is complete.
        dt: Time [s] between samples of the motion; None for 12 ms, or more if the motion lasts
            more than half an hour.

    Returns:
        The path written.

    Raises:
        InputError: If the file cannot be written, or `dt` is invalid.
    """
    path = Path(path)
    runs = sample(simulation, dt)
    targets = [targets_of(run) for run in runs]
    layout = blueprint(runs, targets[0])
    with recording_file(path, _content_id(simulation, runs), layout) as stream:
        _log_whole(stream, simulation, runs[0])
        remarks: tuple[str, ...] = runs[0].remarks
        for run in runs:
            # Of a million moves targets take as much memory as all panels.
            remarks += _log_scene(stream, run, targets.pop(0))
            remarks += _log_panels(stream, run)
        if simulation.collisions is not None:
            # The body code is imported only for cells with bodies.
            from rapidsim.recording.scene.bodies import log_bodies  # noqa: PLC0415

            log_bodies(stream, runs)
            log_clearance(stream, runs)
        log_messages(stream, runs[0], remarks)
    return path


def _log_whole(stream: rr.RecordingStream, simulation: Simulation, run: RecordedRobot) -> None:
    """Log data that exist once, for any number of robots."""
    stream.send_recording_name(simulation.title)
    stream.send_property("run", _properties(simulation, run.dt))
    stream.log("/", rr.ViewCoordinates.RIGHT_HAND_Z_UP, rr.CoordinateFrame(WORLD), static=True)
    log_signals(stream, run)
    log_errors(stream, run)
    log_belts(stream, run)


def _log_scene(stream: rr.RecordingStream, run: RecordedRobot, targets: Targets) -> tuple[str, ...]:
    """Log a robot in the cell; return remarks on content that the viewer cannot show correctly."""
    remarks = _log_base(stream, run)
    size_m = cell_size(run)
    near_m = extent(near_targets(targets)) or size_m
    # Long enough to see in the cell, short enough not to cover a small figure in the near view.
    axis_m = float(np.clip(0.35 * near_m, 0.03 * size_m, 0.1 * size_m))
    remarks += log_arm(stream, run).remarks
    log_tool(stream, run, 0.7 * axis_m)
    remarks += log_work_objects(stream, run, axis_m)
    log_paths(stream, run)
    log_speed_path(stream, run)
    remarks += log_targets(
        stream, run, targets, axis_m=min(0.12 * near_m, 0.5 * axis_m), spacing_m=0.1 * size_m
    )
    remarks += log_failed(stream, run, 0.2 * axis_m)
    log_stopped(stream, run, 0.05 * size_m)
    return remarks


def _log_panels(stream: rr.RecordingStream, run: RecordedRobot) -> tuple[str, ...]:
    """Log program text, plots and lanes of a robot; return remarks as for the scene."""
    remarks = log_listing(stream, run)
    log_plots(stream, run)
    log_moves(stream, run)
    log_limits(stream, run)
    return remarks


def _log_base(stream: rr.RecordingStream, run: RecordedRobot) -> tuple[str, ...]:
    """Log the base of a robot; return remarks on content that the viewer cannot show correctly."""
    where = static_frame(WORLD, run.still_frame, run.robot_run.world_from_base)
    if not run.on_track:
        stream.log(run.entity("base"), where, static=True)
        return ()
    stream.log(run.entity("foot"), where, static=True)
    samples = run.samples
    still = Transform(np.eye(3)[None], np.zeros((1, 3)))
    stream.send_columns(
        run.entity("base"),
        indexes=run.clock.columns(samples.times),
        columns=moving_frame(
            run.still_frame, run.frame(BASE), run.still_from(still, samples.external)
        ),
    )
    track = "the robot is on a track: its programmed path is not drawn"
    return (f"{track}, and what failed is drawn with the track at zero",)


def _properties(simulation: Simulation, dt: float) -> rr.AnyValues:
    model = simulation.model
    resolved = [model_of(one.robot, model) for one in simulation.robots]
    return rr.AnyValues(
        program=list(simulation.program),
        robot=" and ".join(one.robot.title for one in simulation.robots),
        end=simulation.end.value,
        verdict=run_verdict(simulation).headline,
        time_s=simulation.time_s,
        motion_s=simulation.motion_s,
        wait_s=simulation.wait_s,
        path_mm=simulation.path_m * 1000.0,
        moves=len(simulation.moves),
        sample_interval_s=dt,
        motion_model=model.version,
        controller=model.controller,
        filter_time_s=max(one.window for one in resolved),
        smoothing=model.smoothing,
        fine_dwell_s=max(one.dwell for one in resolved),
        corner=model.corner,
        # What is None is left out.
        acceleration_time_s=acceleration_time_of(simulation),
    )


def acceleration_time_of(simulation: Simulation) -> float | None:
    """Return the model's time [s] in which axes reach their speed; None if it limits no axis."""
    model = simulation.model
    slower = replace(model, acceleration_time=2.0 * model.acceleration_time)
    for one in simulation.robots:
        ours, theirs = (limits_of(one.robot, each).max_acceleration for each in (model, slower))
        if (ours != theirs).any():
            return model.acceleration_time
    return None


def _content_id(simulation: Simulation, runs: Sequence[RecordedRobot]) -> uuid.UUID:
    """Return an id that depends only on the content: the viewer merges equal recordings."""
    digest = hashlib.sha256()
    robots = (one.robot.name for one in simulation.robots)
    for text in (*simulation.program, *robots, simulation.end.value):
        digest.update(text.encode() + b"\0")
    for run in runs:
        for array in (run.samples.times, run.samples.joints):
            digest.update(np.ascontiguousarray(array).tobytes())
    for event in simulation.events:
        digest.update(f"{event.time_s!r} {event.kind} {event.message}\0".encode())
    return uuid.UUID(bytes=digest.digest()[:16])
