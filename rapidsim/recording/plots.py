"""Joint angles, the share of their range, and TCP speed over time."""

from __future__ import annotations

import numpy as np
import rerun as rr

from rapidsim.frames.transform import Array
from rapidsim.recording import palette
from rapidsim.recording.sampled import SampledRun
from rapidsim.recording.timelines import indexes, indexes_at
from rapidsim.simulation.result import ExecutedMove

ANGLES = "joints/angle"
RANGE = "joints/range"
RANGE_LIMITS = "joints/range_limits"
SPEED = "tcp/speed"
PROGRAMMED_SPEED = "tcp/programmed_speed"

_MOST_DRAWN = 20_000
"""So many samples are drawn each; of more, those that share a pixel are drawn as their extremes."""


def log_plots(stream: rr.RecordingStream, run: SampledRun) -> None:
    """Log what the plots draw."""
    _log_joints(stream, run)
    _log_speed(stream, run)


def _log_joints(stream: rr.RecordingStream, run: SampledRun) -> None:
    robot = run.simulation.robot
    samples = run.samples
    count = len(robot.joints)
    colours = [palette.rgba(palette.JOINTS[k % len(palette.JOINTS)]) for k in range(count)]
    look = rr.SeriesLines(
        names=[f"J{k}" for k in range(1, count + 1)],
        colors=np.array(colours, dtype=np.uint32),
        widths=np.full(count, 1.6),
        aggregation_policy=_aggregation(run),
    )
    index = indexes(samples.times, samples.move)
    for entity, values in (
        (ANGLES, np.degrees(samples.joints)),
        (RANGE, share_of_range(run)),
    ):
        stream.log(entity, look, static=True)
        stream.send_columns(
            entity,
            indexes=index,
            columns=rr.Scalars.columns(scalars=values.reshape(-1)).partition(
                [count] * len(samples.times)
            ),
        )
    stream.log(
        RANGE_LIMITS,
        rr.SeriesLines(
            names=["lower limit", "upper limit"],
            colors=np.full(2, palette.rgba(palette.LIMIT), dtype=np.uint32),
            widths=[1.0, 1.0],
        ),
        static=True,
    )
    ends = [0.0, run.end_s]
    stream.send_columns(
        RANGE_LIMITS,
        indexes=indexes_at(ends, run.simulation.moves),
        columns=rr.Scalars.columns(scalars=[-100.0, 100.0] * 2).partition([2, 2]),
    )


def share_of_range(run: SampledRun) -> Array:
    """Joints (k, n) [%]: 0 in the middle of their range, -100 and 100 at its limits."""
    robot = run.simulation.robot
    middle = 0.5 * (robot.upper + robot.lower)
    half_range = 0.5 * (robot.upper - robot.lower)
    share: Array = 100.0 * (run.samples.joints - middle) / half_range
    return share


def _log_speed(stream: rr.RecordingStream, run: SampledRun) -> None:
    samples = run.samples
    stream.log(
        PROGRAMMED_SPEED,
        rr.SeriesLines(
            names="programmed",
            colors=palette.rgba(palette.PROGRAMMED),
            widths=1.2,
            interpolation_mode=rr.components.InterpolationMode.StepAfter,
        ),
        static=True,
    )
    stream.log(
        SPEED,
        rr.SeriesLines(
            names="TCP",
            colors=palette.rgba(palette.TCP_SPEED),
            widths=1.8,
            aggregation_policy=_aggregation(run),
        ),
        static=True,
    )
    stream.send_columns(
        SPEED,
        indexes=indexes(samples.times, samples.move),
        columns=rr.Scalars.columns(scalars=samples.tcp_speed * 1000.0),
    )
    moves = run.simulation.moves
    if not moves:
        return
    times, speeds = _programmed_steps(moves, run.end_s)
    stream.send_columns(
        PROGRAMMED_SPEED,
        indexes=indexes_at(times.tolist(), moves),
        columns=rr.Scalars.columns(scalars=speeds),
    )


def _programmed_steps(moves: tuple[ExecutedMove, ...], end_s: float) -> tuple[Array, Array]:
    """Instants [s] and the speed [mm/s] programmed from there on; 0 where nothing moves."""
    steps: dict[float, float] = {0.0: 0.0}
    for move in moves:
        steps[move.end_s] = 0.0
        steps[move.start_s] = move.move.speed.v_tcp
    steps.setdefault(end_s, 0.0)
    times = sorted(steps)
    return np.array(times), np.array([steps[time] for time in times])


def _aggregation(run: SampledRun) -> rr.components.AggregationPolicy:
    """How the viewer thins a plot out; its own choice, the mean, would cut peaks and stops off."""
    if len(run.samples.times) <= _MOST_DRAWN:
        return rr.components.AggregationPolicy.Off
    return rr.components.AggregationPolicy.MinMax
