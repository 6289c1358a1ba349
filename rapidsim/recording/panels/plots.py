"""Plots of joint angles, speeds and accelerations with their limits, and of TCP speed.

Joints have different limits. To show them against one pair of lines, each joint is also plotted as
a share of its limit: 0 in the middle of its range or at rest, 100 % at a limit.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
import rerun as rr

from rapidsim.controller.moves.executed_moves import MoveColumns
from rapidsim.frames.transform import Array
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.stream import ROWS_AT_ONCE

ANGLES = "joints/angle"
RANGE = "joints/range"
JOINT_SPEED = "joints/speed"
JOINT_ACCELERATION = "joints/acceleration"
LIMITS = "joints/limits"
EXTERNAL = "joints/external"
SPEED = "tcp/speed"
PROGRAMMED_SPEED = "tcp/programmed_speed"

SHARES: Mapping[str, str] = MappingProxyType(
    {
        RANGE: "range [%]",
        JOINT_SPEED: "speed [%]",
        JOINT_ACCELERATION: "accel. [%]",
    }
)
"""Entities plotted as shares of their limits, with the titles of the plots."""

_MOST_DRAWN = 20_000
"""Number of samples that are plotted individually; with more, pixels show their extremes."""


def log_plots(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log the data of all plots."""
    _log_joints(stream, run)
    if run.robot.external:
        _log_external(stream, run)
    _log_speed(stream, run)


def shares(run: RecordedRobot, entity: str) -> Array:
    """Return the values of an entity in `SHARES`, of each joint (k, n) [%]."""
    match entity:
        case "joints/range":
            return run.sampled.range_shares
        case "joints/speed":
            return run.sampled.speed_shares
        case _:
            return run.sampled.acceleration_shares


def _log_joints(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    samples = run.samples
    count = len(run.robot.joints)
    colours = [palette.rgba(palette.JOINTS[k % len(palette.JOINTS)]) for k in range(count)]
    look = rr.SeriesLines(
        names=[f"J{k}" for k in range(1, count + 1)],
        colors=np.array(colours, dtype=np.uint32),
        widths=np.full(count, 1.6),
        aggregation_policy=_aggregation(run),
    )
    index = run.clock.columns(samples.times)
    drawn = {ANGLES: np.degrees(samples.joints), **{one: shares(run, one) for one in SHARES}}
    for entity, values in drawn.items():
        stream.log(run.entity(entity), look, static=True)
        stream.send_columns(
            run.entity(entity),
            indexes=index,
            columns=rr.Scalars.columns(scalars=values.reshape(-1)).partition(
                [count] * len(samples.times)
            ),
        )
    stream.log(
        run.entity(LIMITS),
        rr.SeriesLines(
            names=["lower limit", "upper limit"],
            colors=np.full(2, palette.rgba(palette.LIMIT), dtype=np.uint32),
            widths=[1.0, 1.0],
        ),
        static=True,
    )
    stream.send_columns(
        run.entity(LIMITS),
        indexes=run.clock.columns([0.0, run.sampled.end_s]),
        columns=rr.Scalars.columns(scalars=[-100.0, 100.0] * 2).partition([2, 2]),
    )


def _log_external(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log the external axes in mm or degrees, as in targets."""
    axes = run.robot.external
    colours = [palette.rgba(palette.JOINTS[k % len(palette.JOINTS)]) for k in range(len(axes))]
    stream.log(
        run.entity(EXTERNAL),
        rr.SeriesLines(
            names=[f"{axis.unit} {axis.component} [{axis.measure}]" for axis in axes],
            colors=np.array(colours, dtype=np.uint32),
            widths=np.full(len(axes), 1.6),
            aggregation_policy=_aggregation(run),
        ),
        static=True,
    )
    values = run.samples.external * np.array([axis.scale for axis in axes])
    stream.send_columns(
        run.entity(EXTERNAL),
        indexes=run.clock.columns(run.samples.times),
        columns=rr.Scalars.columns(scalars=values.reshape(-1)).partition([len(axes)] * len(values)),
    )


def _log_speed(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    samples = run.samples
    stream.log(
        run.entity(PROGRAMMED_SPEED),
        rr.SeriesLines(
            names="programmed",
            colors=palette.rgba(palette.PROGRAMMED),
            widths=1.2,
            # The mean over a microsecond of rest and the next move would not be a speed.
            aggregation_policy=rr.components.AggregationPolicy.Max,
            interpolation_mode=rr.components.InterpolationMode.StepAfter,
        ),
        static=True,
    )
    stream.log(
        run.entity(SPEED),
        rr.SeriesLines(
            names="TCP",
            colors=palette.rgba(palette.TCP_SPEED),
            widths=1.8,
            aggregation_policy=_aggregation(run),
        ),
        static=True,
    )
    stream.send_columns(
        run.entity(SPEED),
        indexes=run.clock.columns(samples.times),
        columns=rr.Scalars.columns(scalars=samples.tcp_speed * 1000.0),
    )
    if not run.robot_run.moves:
        return
    times, speeds = _programmed_steps(run.robot_run.moves.columns, run.sampled.end_s)
    for begin in range(0, len(times), ROWS_AT_ONCE):
        some = slice(begin, begin + ROWS_AT_ONCE)
        stream.send_columns(
            run.entity(PROGRAMMED_SPEED),
            indexes=run.clock.columns(times[some]),
            columns=rr.Scalars.columns(scalars=speeds[some]),
        )


def _programmed_steps(moves: MoveColumns, end_s: float) -> tuple[Array, Array]:
    """Return instants [s] and the programmed speed [mm/s] from each on; 0 without motion.

    Recordings count nanoseconds: for two speeds within one of them the viewer would draw the mean.
    """
    # To where the arm was nothing is drawn; the move after it may have begun already.
    moving = moves.end_s > moves.start_s
    bounds = np.stack([moves.end_s, moves.start_s], axis=-1)[moving].reshape(-1)
    times = np.concatenate([[0.0], np.round(np.append(end_s, bounds), 9)])
    speeds = np.zeros(len(times))
    speeds[3::2] = moves.speed_mm_s[moving]
    # Of equal times the last counts.
    found, last = np.unique(times[::-1], return_index=True)
    return found, speeds[::-1][last]


def _aggregation(run: RecordedRobot) -> rr.components.AggregationPolicy:
    """Return the viewer's aggregation; its default, the mean, would hide peaks and stops."""
    if len(run.samples.times) <= _MOST_DRAWN:
        return rr.components.AggregationPolicy.Off
    return rr.components.AggregationPolicy.MinMax
