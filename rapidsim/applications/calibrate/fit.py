"""Fit the motion model to logs of moves that a real controller made.

The parameters are factors on the torques of axes 1 to 3 and on the accelerations of the wrist (or,
if no torques are known, one time for all axes), the smoothing, the dwell at stop points, and the
share of the limits that is used in zones. All are fitted at once and weighted by their evidence.

Each log comes with the program that ran while it was taken. The path does not depend on the model,
so every row of a log has one position on our path; the fit minimises the differences of the times
at these positions. Each log has one free time offset, since the delay between the start of the
command and the start of the log is unknown.

A parameter with little evidence in the logs stays near its prior, the closer the better that is
known: only strong evidence overrides a value measured on an arm, and the result reports it. The
residuals of the best fit count as noise: large residuals make weak evidence.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Annotated

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.applications.calibrate.joint_log import JointLog
from rapidsim.applications.calibrate.log_comparison import MotionByPlace
from rapidsim.files import InputError
from rapidsim.frames.transform import Array
from rapidsim.json_records.declarations import Key, OrAbsent
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import constants_of, model_of, torques_of
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.simulation.simulate import simulate
from rapidsim.values import value_class

Residuals = Callable[[Array], Array]

_STILL_M_S = 0.02
_MOST_ROWS = 400
_FARTHEST_RAD = math.radians(1.0)
_NOISE_S = 3e-3
"""Noise of logs and planning [s]; a parameter is changed only by stronger evidence."""
_ROUNDS = 12
_STEP = 0.04
_SMALL = 0.1
"""The last round changes the residuals by less than this share of the noise."""
_SEEN = 0.5
_LEAST_S = 4e-3
_LEAST_FACTOR = 0.2
_MEASURED_SPREAD = 0.04
"""Prior spread of factors on the torques of an arm that was measured."""
_PRIOR_SPREAD = 0.3
"""Prior spread of factors on values scaled from other arms."""
_CONTRADICTS = 2.0
"""Deviation from a measured value, in spreads, that contradicts the measurement."""


@value_class(frozen=True, slots=True)
class LoggedRun:
    """A program, and the log of a controller that ran it from the pose of the first row."""

    program: Program
    log: JointLog


@value_class(frozen=True, slots=True)
class Fitted:
    """One parameter of the motion model."""

    name: str
    """Name, such as `torque of axis 2`, or its key in the station file."""
    table: str
    """Table of the station file that contains it."""
    key: str
    value: float
    uncertainty: float
    """Standard deviation."""
    start: Annotated[float, Key("known")]
    """Value before the fit."""
    seen: bool
    """Whether the logs determine it better than the prior does."""
    contradicts: bool
    """Whether the logs contradict the value measured on this arm."""
    value_s: OrAbsent[float]
    """The value again, if it is a time."""
    uncertainty_s: OrAbsent[float]


@value_class(frozen=True, slots=True)
class LogFit:
    """Agreement of the motion model with one log, in times at the same positions."""

    name: str
    rows: int
    duration_s: float
    """Duration of the logged motion."""
    rms_before_s: float
    rms_after_s: float
    end_before_s: float
    """Our duration less the log's, with the model as it was."""
    end_after_s: float
    rms_left_out_s: float | None
    """Deviation if only the other logs are fitted; null without other logs."""
    end_left_out_s: float | None
    """Deviation if only the other logs are fitted; null without other logs."""


@value_class(frozen=True, slots=True)
class Calibration:
    """Result of a fit of the motion model to logs."""

    model: MotionModel
    parameters: tuple[Fitted, ...]
    logs: tuple[LogFit, ...]


@value_class(frozen=True, slots=True)
class _Parameter:
    name: str
    table: str
    key: str
    start: float
    spread: float
    """Standard deviation of the prior around `start`."""
    least: float
    put: Callable[[MotionModel, float], MotionModel]
    measured: bool = False
    in_seconds: bool = False


@value_class(frozen=True, slots=True, eq=False)
class _Rows:
    """Rows of one log in which the arm moves."""

    run: LoggedRun
    times: Array
    places: Array


def calibrate(runs: Sequence[LoggedRun], robot: Robot, model: MotionModel) -> Calibration:
    """Fit accelerations, smoothing, dwell at stop points and corners.

    Args:
        runs: Logs with their programs.
        robot: The arm.
        model: Start of the fit; all other fields remain unchanged.

    Raises:
        InputError: If a program does not run to its end, or a log does not follow its path.
    """
    parameters = _parameters(robot, model)
    rows = [_rows(run, robot, model, len(parameters)) for run in runs]
    known = np.array([parameter.start for parameter in parameters])
    spread = np.array([parameter.spread for parameter in parameters])
    least = np.array([parameter.least for parameter in parameters])

    def with_values(values: Array) -> MotionModel:
        trial = model
        for parameter, value in zip(parameters, values.tolist(), strict=True):
            trial = parameter.put(trial, value)
        return trial

    def misses(values: Array) -> list[Array]:
        trial = with_values(values)
        return [_misses(one, robot, trial) for one in rows]

    def residuals(values: Array) -> Array:
        weighted = [miss / math.sqrt(len(miss)) for miss in misses(values)]
        return np.concatenate([*weighted, _NOISE_S * (values - known) / spread])

    values, slopes = _least_squares(residuals, known, least)
    before, after = misses(known), misses(values)
    # Residuals of the best fit raise all uncertainties: other noise, or another law than ours.
    noise_s = max(_NOISE_S, math.sqrt(np.mean([_rms(miss) ** 2 for miss in after])))
    # The prior is as certain as before.
    said = slopes[: -len(parameters)] / noise_s
    sigma = np.sqrt(np.diag(np.linalg.inv(said.T @ said + np.diag(spread**-2.0))))
    left_out: list[Array | None] = [None] * len(rows)
    if len(rows) > 1:
        now = residuals(values)
        ends = np.cumsum([len(one.times) for one in rows])
        for number, (one, end) in enumerate(zip(rows, ends.tolist(), strict=True)):
            # Near the fit one step suffices to compute the fit without the rows of this log.
            kept = np.ones(len(now), dtype=bool)
            kept[end - len(one.times) : end] = False
            step = -np.linalg.lstsq(slopes[kept], now[kept], rcond=None)[0]
            left_out[number] = _misses(one, robot, with_values(np.maximum(values + step, least)))
    return Calibration(
        model=with_values(values),
        parameters=tuple(
            Fitted(
                name=parameter.name,
                table=parameter.table,
                key=parameter.key,
                value=value,
                uncertainty=s,
                start=parameter.start,
                seen=s < _SEEN * parameter.spread,
                contradicts=parameter.measured
                and abs(value - parameter.start) > _CONTRADICTS * parameter.spread,
                value_s=value if parameter.in_seconds else None,
                uncertainty_s=s if parameter.in_seconds else None,
            )
            for parameter, value, s in zip(parameters, values.tolist(), sigma.tolist(), strict=True)
        ),
        logs=tuple(
            LogFit(
                name=one.run.log.name,
                rows=len(one.times),
                rms_before_s=_rms(old),
                rms_after_s=_rms(new),
                duration_s=float(one.times[-1] - one.times[0]),
                end_before_s=float(old[-1] - old[0]),
                end_after_s=float(new[-1] - new[0]),
                rms_left_out_s=None if out is None else _rms(out),
                end_left_out_s=None if out is None else float(out[-1] - out[0]),
            )
            for one, old, new, out in zip(rows, before, after, left_out, strict=True)
        ),
    )


def _parameters(robot: Robot, model: MotionModel) -> tuple[_Parameter, ...]:
    """Parameters to fit for an arm, without accelerations that the station file defines."""
    found: list[_Parameter] = []
    arms = torques_of(robot, model)
    measured = constants_of(robot, model).is_measured
    own = model_of(robot, model)
    for _ in arms:
        spread = _MEASURED_SPREAD if measured else _PRIOR_SPREAD
        found += [
            _Parameter(
                f"torque of axis {axis + 1}",
                "dynamics",
                "torque",
                model.torque[axis],
                spread,
                _LEAST_FACTOR,
                partial(_with_torque, axis),
                measured,
            )
            for axis in range(len(model.torque))
        ]
        found.append(
            _Parameter(
                "wrist", "dynamics", "wrist", model.wrist, 2.0 * spread, _LEAST_FACTOR, _with_wrist
            )
        )
    if not arms and model.acceleration is None:
        found.append(
            _time("acceleration_time", model.acceleration_time, 0.08, _with_acceleration_time)
        )
    found += [
        _time("filter_time", own.window, 0.042, _with_filter_time),
        _time("fine_dwell", own.fine_dwell or 0.0, 0.05, _with_fine_dwell),
    ]
    if model.version != "1":
        found.append(
            _Parameter(
                "zone_share",
                "motion",
                "zone_share",
                own.share_in_zones,
                0.15,
                0.1,
                _with_zone_share,
            )
        )
    return tuple(found)


def _time(
    key: str, start: float, spread: float, put: Callable[[MotionModel, float], MotionModel]
) -> _Parameter:
    return _Parameter(key, "motion", key, start, spread, _LEAST_S, put, in_seconds=True)


def _with_torque(axis: int, model: MotionModel, value: float) -> MotionModel:
    first, second, third = (
        value if number == axis else old for number, old in enumerate(model.torque)
    )
    return replace(model, torque=(first, second, third))


def _with_wrist(model: MotionModel, value: float) -> MotionModel:
    return replace(model, wrist=value)


def _with_acceleration_time(model: MotionModel, value: float) -> MotionModel:
    return replace(model, acceleration_time=value, own_accelerations=False)


def _with_filter_time(model: MotionModel, value: float) -> MotionModel:
    return replace(model, filter_time=value)


def _with_fine_dwell(model: MotionModel, value: float) -> MotionModel:
    return replace(model, fine_dwell=value)


def _with_zone_share(model: MotionModel, value: float) -> MotionModel:
    return replace(model, zone_share=min(value, 1.0))


def _rows(run: LoggedRun, robot: Robot, model: MotionModel, parameters: int) -> _Rows:
    progress = MotionByPlace.of(simulated(run, robot, model).only.trajectory, 0.0)
    every = max(1, len(run.log.times) // _MOST_ROWS)
    times, joints = run.log.times[::every], run.log.joints[::every]
    places, distances = progress.nearest(joints)
    if distances.max() > _FARTHEST_RAD:
        row = int(distances.argmax())
        raise InputError(
            f"{run.log.name}: at {times[row]:.3f} s the arm is {math.degrees(distances[row]):.1f} "
            "degrees off the path of its program",
            "log from standstill before the program starts, on the arm that --robot names, with "
            "the tools and work objects of the program",
        )
    moving = progress.speed_at(places) > _STILL_M_S
    if np.count_nonzero(moving) < parameters + 1:
        raise InputError(f"{run.log.name}: the arm hardly moves")
    return _Rows(run, times[moving], places[moving])


def _misses(rows: _Rows, robot: Robot, model: MotionModel) -> Array:
    """Return our times less those of the log (k,) [s], less their mean, the offset of the log."""
    trajectory = simulated(rows.run, robot, model).only.trajectory
    lead = trajectory.time_at_place(rows.places) - rows.times
    misses: Array = lead - lead.mean()
    return misses


def simulated(run: LoggedRun, robot: Robot, model: MotionModel) -> Simulation:
    """Return our run of a logged program, from the pose of the first row.

    Raises:
        InputError: If it does not run to its end, or makes no move.
    """
    start = tuple(float(angle) for angle in np.degrees(run.log.joints[0]))
    options = RunOptions(model=model, nearest_configuration=True, start_joints_deg=start)
    simulation = simulate(run.program, robot, options=options)
    if simulation.end is not End.ENDED or not simulation.moves:
        what = (
            "; ".join(d.violation.message for d in simulation.diagnostics[-1:])
            or "it makes no move"
        )
        raise InputError(f"the program of {run.log.name} does not run to its end: {what}")
    return simulation


def _least_squares(residuals: Residuals, start: Array, least: Array) -> tuple[Array, Array]:
    """Values (p,) that minimise residuals, and the slopes (r, p) there: damped Gauss-Newton."""
    values, now = start, residuals(start)
    slopes = _slopes(residuals, values, now)
    for _ in range(_ROUNDS):
        step = -np.linalg.lstsq(slopes, now, rcond=None)[0]
        for _ in range(4):
            trial = np.maximum(values + step, least)
            then = residuals(trial)
            if then @ then < now @ now:
                break
            step = 0.5 * step
        else:
            break
        # In units of the noise.
        moved = np.linalg.norm(slopes @ (trial - values)) / _NOISE_S
        values, now = trial, then
        if moved < _SMALL:
            break
        slopes = _slopes(residuals, values, now)
    return values, slopes


def _slopes(residuals: Residuals, values: Array, now: Array) -> Array:
    """Slopes (r, p) of residuals, which are `now` at values (p,), by finite differences."""
    columns = []
    for k, value in enumerate(values):
        step = np.zeros(len(values))
        step[k] = _STEP * max(value, _STEP)
        columns.append((residuals(values + step) - now) / step[k])
    return np.stack(columns, axis=1)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
