"""Fit the motion model's three times to logs of moves that a real controller made.

Each log goes with the program that ran while it was taken. The path does not depend on the model,
so every row of a log belongs to one place of our path; what the fit makes small is the difference
of the times at these places. One offset a log is free: nobody knows how long after the start of the
command a log begins.

Where logs say little about a parameter it stays near its default, and the result says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.files import InputError
from rapidsim.frames.transform import Array
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.simulation.calibration.joint_log import JointLog
from rapidsim.simulation.calibration.log_comparison import Progress
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End, RobotRun
from rapidsim.simulation.simulate import simulate

Residuals = Callable[[Array], Array]

_STILL_M_S = 0.02
_MOST_ROWS = 400
_FARTHEST_RAD = math.radians(1.0)
_NOISE_S = 3e-3
"""What logs and planning leave unexplained; a parameter is moved only for more than that."""
_ROUNDS = 12
_STEP = 0.06
_SMALL = 1e-3
_SEEN = 0.5
_LEAST_S = 4e-3


@dataclass(frozen=True, slots=True)
class LoggedRun:
    """A program, and what was logged while a controller ran it from the first row's pose."""

    program: Program
    log: JointLog


@dataclass(frozen=True, slots=True)
class Fitted:
    """One parameter of the motion model."""

    name: str
    """Its key in the station file."""
    value_s: float
    uncertainty_s: float
    """Standard deviation [s]."""
    seen: bool
    """Whether the logs say more about it than the default does."""


@dataclass(frozen=True, slots=True)
class LogFit:
    """How well a log is met, in times at the same places."""

    name: str
    rows: int
    rms_before_s: float
    rms_after_s: float
    duration_s: float
    """Of the logged motion."""
    end_before_s: float
    """Our duration less the log's, with the model as it was."""
    end_after_s: float


@dataclass(frozen=True, slots=True)
class Calibration:
    """What the logs say."""

    model: MotionModel
    parameters: tuple[Fitted, ...]
    logs: tuple[LogFit, ...]


@dataclass(frozen=True, slots=True)
class _Parameter:
    name: str
    spread_s: float
    """How far from the default the value may well be."""


_PARAMETERS = (
    _Parameter("acceleration_time", 0.08),
    _Parameter("filter_time", 0.03),
    _Parameter("fine_dwell", 0.05),
)


@dataclass(frozen=True, slots=True, eq=False)
class _Rows:
    """The rows of one log in which the arm moves."""

    run: LoggedRun
    times: Array
    places: Array


def calibrate(runs: Sequence[LoggedRun], robot: Robot, model: MotionModel) -> Calibration:
    """Fit acceleration time, filter time and dwell at stop points.

    Args:
        runs: Logs with their programs.
        robot: The arm.
        model: Where the fit starts; everything else of it stays.

    Raises:
        InputError: If a program does not run to its end, or a log does not follow its path.
    """
    rows = [_rows(run, robot, model) for run in runs]
    default = np.array([getattr(model, parameter.name) for parameter in _PARAMETERS])
    spread = np.array([parameter.spread_s for parameter in _PARAMETERS])

    def misses(values: Array) -> list[Array]:
        trial = _with(model, values)
        return [_misses(one, robot, trial) for one in rows]

    def residuals(values: Array) -> Array:
        weighted = [miss / math.sqrt(len(miss)) for miss in misses(values)]
        return np.concatenate([*weighted, _NOISE_S * (values - default) / spread])

    values, slopes = _least_squares(residuals, default)
    curvature = slopes.T @ slopes
    sigma = _NOISE_S * np.sqrt(np.diag(np.linalg.inv(curvature)))
    before, after = misses(default), misses(values)
    return Calibration(
        model=_with(model, values),
        parameters=tuple(
            Fitted(parameter.name, float(value), float(s), bool(s < _SEEN * parameter.spread_s))
            for parameter, value, s in zip(_PARAMETERS, values, sigma, strict=True)
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
            )
            for one, old, new in zip(rows, before, after, strict=True)
        ),
    )


def _with(model: MotionModel, values: Array) -> MotionModel:
    acceleration_time, filter_time, fine_dwell = (float(value) for value in values)
    return replace(
        model,
        acceleration_time=acceleration_time,
        own_accelerations=False,
        acceleration=None,
        filter_time=filter_time,
        fine_dwell=fine_dwell,
    )


def _rows(run: LoggedRun, robot: Robot, model: MotionModel) -> _Rows:
    progress = Progress.of(_simulated(run, robot, model).trajectory, 0.0)
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
    if np.count_nonzero(moving) < len(_PARAMETERS) + 1:
        raise InputError(f"{run.log.name}: the arm hardly moves")
    return _Rows(run, times[moving], places[moving])


def _misses(rows: _Rows, robot: Robot, model: MotionModel) -> Array:
    """Our times less those of the log (k,) [s], with the offset of the log taken out."""
    trajectory = _simulated(rows.run, robot, model).trajectory
    lead = trajectory.time_at_place(rows.places) - rows.times
    misses: Array = lead - lead.mean()
    return misses


def _simulated(run: LoggedRun, robot: Robot, model: MotionModel) -> RobotRun:
    start = tuple(float(angle) for angle in np.degrees(run.log.joints[0]))
    options = RunOptions(model=model, nearest_configuration=True, start_joints_deg=start)
    simulation = simulate(run.program, robot, options=options)
    if simulation.end is not End.ENDED or not simulation.moves:
        what = (
            "; ".join(d.violation.message for d in simulation.diagnostics[-1:])
            or "it makes no move"
        )
        raise InputError(f"the program of {run.log.name} does not run to its end: {what}")
    return simulation.only


def _least_squares(residuals: Residuals, start: Array) -> tuple[Array, Array]:
    """Values (p,) that make residuals least, and the slopes (r, p) there: damped Gauss-Newton."""
    values, now = start, residuals(start)
    for _ in range(_ROUNDS):
        slopes = _slopes(residuals, values)
        step = -np.linalg.lstsq(slopes, now, rcond=None)[0]
        for _ in range(4):
            trial = np.maximum(values + step, _LEAST_S)
            then = residuals(trial)
            if then @ then < now @ now:
                break
            step = 0.5 * step
        else:
            break
        moved = np.abs(trial - values).max()
        values, now = trial, then
        if moved < _SMALL:
            break
    return values, _slopes(residuals, values)


def _slopes(residuals: Residuals, values: Array) -> Array:
    columns = []
    for k, value in enumerate(values):
        step = np.zeros(len(values))
        step[k] = _STEP * value
        columns.append((residuals(values + step) - residuals(values - step)) / (2.0 * step[k]))
    return np.stack(columns, axis=1)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))
