"""Time-optimal motion along a path: stages are divided until their size costs no time.

A stage satisfies every acceleration limit at both of its ends with one path acceleration, so it is
slightly slower than necessary, less so the shorter it is. Cells evaluate the arm and are expensive,
stages are cheap: only they are divided.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise, starmap

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.timing.problem import Problem
from rapidsim.motion.timing.smoothed_speed_limits import held_speeds
from rapidsim.motion.timing.stages import Stages, cut, fastest, loads, stages_of
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.motion.timing.two_pass import solve
from rapidsim.values import value_class

_FIRST_PARTS = 2
_ROUNDS = 3
_MORE_ROUNDS = 3
"""Rounds after those that save time, which cut only stages that break a limit."""
_MOST_PARTS = 8
_FEW = 1e-3
"""Share of the stages that are cut finely because they are the only ones to break a limit."""
_IDLE = 1e-5
"""Share of its segment's time that a stage may lose by its size."""
_IDLE_S = 1e-6
_ACCELERATION_EXCESS = 0.002
"""Share of an acceleration by which it may be exceeded within a stage."""
_SPEED_EXCESS = 5e-4
_NEARLY = 0.9
"""Share of its limit from which on a smoothed speed counts as exceeding it."""


@value_class(frozen=True, slots=True, eq=False)
class StageMotion:
    """A motion over stages (m,)."""

    stages: Stages
    x: Array
    """Squares of the path speed at the nodes, shape (m + 1,)."""
    fastest_start: float
    """Largest x at the start from which the rest is feasible."""
    braked: int
    """Number of first stages in which a faster start is braked, beyond limits."""
    by_speed: Array
    """Largest x by speeds in the middle of the stages, shape (m,)."""
    caps: Array
    """Largest x by speeds and ramps at the nodes, shape (m + 1,)."""
    ramp_caps: Array
    """Largest x by ramps at the nodes, shape (m + 1,)."""

    @property
    def times(self) -> Array:
        """Time (m,) [s] in each stage."""
        speed = np.sqrt(self.x)
        times: Array = 2.0 * self.stages.width / np.maximum(speed[1:] + speed[:-1], 1e-300)
        return times


@value_class(frozen=True, slots=True, eq=False)
class Division:
    """Division of a path's cells into stages, including cells before the start."""

    stages: Stages
    needed: Mask
    """Shape (m,): mask of the stages in which the smoothed motion would be too fast."""
    driven: int
    """First stage of the motion."""

    def cut(self, problem: Problem, parts: Index) -> Division:
        """Divide each stage into a number (m,) of parts."""
        stages = cut(self.stages, problem.cells, problem.accelerations, parts)
        return Division(stages, np.repeat(self.needed, parts), int(parts[: self.driven].sum()))


def fastest_drive(
    problem: Problem, start_speed: float, check_deadline: Look = undisturbed
) -> tuple[Division, StageMotion]:
    """Return the fastest motion from a start speed [m/s] to rest at the end of the path."""
    stages = stages_of(problem.cells, problem.accelerations, _FIRST_PARTS)
    first = problem.cells.driven * _FIRST_PARTS
    division = Division(stages, np.zeros(len(stages.cell), dtype=bool), first)
    if problem.path.window:
        division = Division(stages, _needed(problem, division, start_speed), first)
    result = drive(problem, division, start_speed)
    for number in range(_ROUNDS + _MORE_ROUNDS):
        check_deadline()
        parts = np.ones(len(division.needed), dtype=np.int64)
        parts[division.driven :] = _parts(problem, result, save_time=number < _ROUNDS)
        if (parts == 1).all():
            break
        division = division.cut(problem, parts)
        result = drive(problem, division, start_speed)
    return division, result


def drive(
    problem: Problem, division: Division, start_speed: float, ramp_caps: Array | float = np.inf
) -> StageMotion:
    """Return the fastest motion over these stages.

    Args:
        problem: The limits.
        division: The stages.
        start_speed: Path speed [m/s] at its start.
        ramp_caps: Largest squares of the speed by ramps at the nodes of the division.
    """
    stages = division.stages
    speeds = fastest(stages, problem.cells, problem.slowness)
    if division.needed.any():
        speeds = np.concatenate(
            [
                _command_speeds(
                    stages.places[part], speeds[part], division.needed[part], problem.path.window
                )
                for part in between_stops(problem, stages)
            ]
        )
    in_zones = problem.path.zone_speed
    if np.isfinite(in_zones).any():
        speeds = np.minimum(speeds, in_zones[problem.cells.piece[stages.cell]][:, None])
    own, speeds = stages.beyond(division.driven), speeds[division.driven :]
    of_ramps = np.broadcast_to(ramp_caps, len(stages.nodes))[division.driven :]
    caps = np.minimum(_caps(problem, own, speeds), of_ramps)
    x, fastest_start, braked = solve(own, caps, start_speed)
    return StageMotion(own, x, fastest_start, braked, speeds[:, 1] ** 2, caps, of_ramps)


def between_stops(problem: Problem, stages: Stages) -> Iterator[slice]:
    """Yield the stages of each section between stops: there the smoothed motion is at rest, too."""
    stops = np.flatnonzero(np.isin(stages.nodes[1:-1], problem.path.stops)) + 1
    return starmap(slice, pairwise([0, *stops.tolist(), len(stages.cell)]))


def _command_speeds(places: Array, speeds: Array, needed: Mask, window: float) -> Array:
    """Return `held_speeds` (m, 3) of stages."""
    held = held_speeds(places.ravel(), speeds.ravel(), np.repeat(needed, 3), window)
    return held.reshape(-1, 3)


def _caps(problem: Problem, stages: Stages, speeds: Array) -> Array:
    """Return the largest x (m + 1,) at the nodes from largest speeds (m, 3) of stages.

    A dip within a stage holds at both of its ends.
    """
    dip = np.where(speeds[:, 1] < np.minimum(speeds[:, 0], speeds[:, 2]), speeds[:, 1], np.inf)
    caps = np.append(np.minimum(speeds[:, 0], dip), np.inf)
    caps[1:] = np.minimum(caps[1:], np.minimum(speeds[:, 2], dip))
    caps[np.isin(stages.nodes, problem.path.stops)] = 0.0
    squares: Array = caps**2
    return squares


def _needed(problem: Problem, division: Division, start_speed: float) -> Mask:
    """Mask (m,) of the stages whose speeds must be lowered so that the smoothed motion keeps them.

    These are the stages where a motion without lowered speeds would exceed the limit: the lowered
    motion is slower, and so is its mean.
    """
    stages = division.stages
    speeds = fastest(stages, problem.cells, problem.slowness)
    caps = _caps(problem, stages, speeds)
    x, *_ = solve(stages, caps, float(np.sqrt(caps[0])) if division.driven else start_speed)
    free = TimeScaling(stages.nodes, np.sqrt(x), 0.0)
    needed: Mask = np.zeros(len(speeds), dtype=bool)
    for window in problem.path.windows:
        place, speed = free.smoothed(window, np.union1d(free.times, free.times + window))
        mean = np.interp(stages.places, place, speed)
        needed |= np.any(mean > _NEARLY * speeds, axis=1)
    # An excess between two points shows in one of the next stages.
    near = needed.copy()
    near[1:] |= needed[:-1]
    near[:-1] |= needed[1:]
    return near


def _parts(problem: Problem, result: StageMotion, *, save_time: bool) -> Index:
    """Return the number of parts (m,) to divide stages into, to keep limits and to save time."""
    stages, x = result.stages, result.x
    load = loads(stages, problem.cells, problem.accelerations, x)
    speed = np.sqrt(0.5 * (x[1:] + x[:-1]) / result.by_speed)
    # The excess over a limit between two ends that keep it decreases with the square.
    over = np.maximum((load - 1.0) / _ACCELERATION_EXCESS, (speed - 1.0) / _SPEED_EXCESS)
    over[: result.braked] = 0.0
    parts = np.sqrt(np.maximum(over, 0.0))
    if save_time:
        parts = np.maximum(parts, _parts_worth_while(problem, result, np.maximum(load, speed)))
    elif np.count_nonzero(parts > 1.0) < _FEW * len(parts):
        # A round costs time for all stages: finer parts of a few make the next one unnecessary.
        parts[parts > 1.0] = _MOST_PARTS
    whole: Index = np.clip(np.ceil(parts), 1, _MOST_PARTS).astype(np.int64)
    return whole


def _parts_worth_while(problem: Problem, result: StageMotion, used: Array) -> Array:
    """Return parts (m,) with which stages that use shares (m,) of their limits lose little time."""
    segment = problem.path.segment_of(problem.cells.piece[result.stages.cell])
    times = result.times
    matters = np.bincount(segment, times, minlength=len(problem.path.segments))[segment]
    lost = 0.5 * times * (1.0 - used)
    parts: Array = lost / np.maximum(_IDLE * matters, _IDLE_S)
    return parts
