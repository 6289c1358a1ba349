"""When the arm is where on a path: the fastest motion within limits and programmed times."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import overload

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.curves import Index
from rapidsim.motion.grid import cells_of
from rapidsim.motion.limiters import limiters_of
from rapidsim.motion.limits import Limits
from rapidsim.motion.path import Path
from rapidsim.motion.problem import Problem, at_pace, cut, problem_of
from rapidsim.motion.refinement import refinement
from rapidsim.motion.rows import Limiter, Quantity
from rapidsim.motion.solver import solve

_ROUNDS = 7
_TIMED_ROUNDS = 4
_TIMED_HALVINGS = 16
_TIME_TOLERANCE = 1e-3


@dataclass(frozen=True, eq=False)
class Timing:
    """Place on a path as a function of time; time 0 is at the place where it starts."""

    s: Array
    """Nodes (k,) [m]."""
    speed: Array
    """Path speed ds/dt at the nodes, shape (k,) [m/s]."""
    start_excess: float
    """How much faster [m/s] the start was than what can be braked within the limits, else 0. Up to
    1 % of the speed comes from looking at other nodes than the plan that led there."""
    limited_by: tuple[Limiter, ...]
    """What holds each segment of the path back for most of its time."""
    standing: Array | None = None
    """Time [s] spent in each cell (k - 1,) beside driving through it: at stops in mid path, which
    are cells without width. None where there are none."""

    @cached_property
    def acceleration(self) -> Array:
        """Path acceleration in each cell, shape (k - 1,) [m/s2]."""
        change: Array = np.diff(self.speed**2) / np.maximum(2.0 * np.diff(self.s), 1e-300)
        return change

    @cached_property
    def times(self) -> Array:
        """Time at the nodes, shape (k,) [s]."""
        pace = self.speed[1:] + self.speed[:-1]
        steps = 2.0 * np.diff(self.s) / np.maximum(pace, 1e-300)
        if self.standing is not None:
            steps = steps + self.standing
        return np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def duration(self) -> float:
        """[s]"""
        return float(self.times[-1])

    @overload
    def s_at(self, t: float) -> float: ...

    @overload
    def s_at(self, t: Array) -> Array: ...

    def s_at(self, t: float | Array) -> float | Array:
        """Place [m] at times [s], one or (k,); outside its time the motion stands."""
        k, since = self._cell(t)
        place: Array = self.s[k] + since * (self.speed[k] + 0.5 * since * self.acceleration[k])
        place = np.clip(place, self.s[0], self.s[-1])
        return place if np.ndim(t) else float(place)

    @overload
    def speed_at(self, t: float) -> float: ...

    @overload
    def speed_at(self, t: Array) -> Array: ...

    def speed_at(self, t: float | Array) -> float | Array:
        """Path speed [m/s] at times [s], one or (k,)."""
        k, since = self._cell(t)
        speed: Array = self.speed[k] + since * self.acceleration[k]
        speed = np.maximum(speed, 0.0)
        return speed if np.ndim(t) else float(speed)

    @overload
    def time_at(self, s: float) -> float: ...

    @overload
    def time_at(self, s: Array) -> Array: ...

    def time_at(self, s: float | Array) -> float | Array:
        """Time [s] at places [m], one or (k,)."""
        place = np.clip(np.asarray(s, dtype=np.float64), self.s[0], self.s[-1])
        k = np.clip(np.searchsorted(self.s, place, side="right") - 1, 0, len(self.s) - 2)
        way = place - self.s[k]
        speed = np.sqrt(np.maximum(self.speed[k] ** 2 + 2.0 * self.acceleration[k] * way, 0.0))
        time: Array = self.times[k] + 2.0 * way / np.maximum(speed + self.speed[k], 1e-300)
        return time if np.ndim(s) else float(time)

    def way_integral(self, t: Array) -> Array:
        """Integral of s - s[0] from time 0 to times (k,) [m s]."""
        k, since = self._cell(t)
        cubic = since * (
            self.s[k] - self.s[0] + since * (self.speed[k] / 2 + since * self.acceleration[k] / 6)
        )
        integral: Array = self._integrals[k] + cubic
        return integral

    @cached_property
    def _integrals(self) -> Array:
        step = np.diff(self.times)
        way, speed = self.s[:-1] - self.s[0], self.speed[:-1]
        parts = step * (way + step * (speed / 2 + step * self.acceleration / 6))
        return np.concatenate([[0.0], np.cumsum(parts)])

    def _cell(self, t: float | Array) -> tuple[Index, Array]:
        time = np.clip(np.asarray(t, dtype=np.float64), 0.0, self.times[-1])
        k = np.clip(np.searchsorted(self.times, time, side="right") - 1, 0, len(self.s) - 2)
        return k, time - self.times[k]


def plan(path: Path, limits: Limits, *, start: float = 0.0, start_speed: float = 0.0) -> Timing:
    """Find the fastest motion to rest at the end of a path.

    Args:
        path: The geometry.
        limits: Of the axes; the segments bring the limits of the TCP.
        start: Place [m] where the motion starts.
        start_speed: Path speed [m/s] there. If it is too fast to brake within the limits, it is
            kept, the first stretch brakes harder than allowed, and `Timing.start_excess` says so.
    """
    if start >= path.length:
        nothing = Limiter(Quantity.NOTHING)
        return Timing(
            s=np.full(2, path.length),
            speed=np.zeros(2),
            start_excess=start_speed,
            limited_by=(nothing,) * len(path.segments),
        )
    pace = np.full(len(path.segments), np.nan)
    timed = _timed(path, start)
    pace[list(timed)] = np.inf
    problem = problem_of(path, cells_of(path, limits, start), limits, pace)
    problem, x, fastest = refined(problem, pace, start_speed)
    if timed:
        pace = _paced(problem, pace, start_speed, timed)
        problem, _, _ = refined(at_pace(problem, pace), pace, start_speed)
        pace = _paced(problem, pace, start_speed, timed)
        problem = at_pace(problem, pace)
        x, fastest = solve(problem, start_speed)
    nodes, speed = problem.cells.nodes, np.sqrt(x)
    stops = np.flatnonzero(np.isin(nodes[1:-1], path.stops)) + 1
    standing = None
    if len(stops) and path.model.filter_time:
        # So long that the smoothed motion comes to rest, too: it could not turn a kink on the way.
        nodes, speed = np.insert(nodes, stops, nodes[stops]), np.insert(speed, stops, 0.0)
        standing = np.where(np.diff(nodes) == 0.0, path.model.filter_time, 0.0)
    return Timing(
        s=nodes,
        speed=speed,
        start_excess=max(0.0, start_speed - float(np.sqrt(fastest))),
        limited_by=limiters_of(problem, x),
        standing=standing,
    )


def refined(problem: Problem, pace: Array, start_speed: float) -> tuple[Problem, Array, float]:
    """Cut cells until the limits hold within them and no time is lost at switching points."""
    among = np.arange(len(problem.widest))
    x, fastest = solve(problem, start_speed)
    for _ in range(_ROUNDS):
        index, at = refinement(problem, x, among)
        if not len(index):
            break
        problem = cut(problem, pace, index, at)
        # Nodes keep their order, with a new one in each cell that was cut; it counts as changed.
        before = np.insert(x, index + 1, np.nan)
        x, fastest = solve(problem, start_speed)
        changed = x != before
        among = np.flatnonzero(changed[:-1] | changed[1:])
    return problem, x, fastest


def _timed(path: Path, start: float) -> dict[int, float]:
    """Programmed time [s] of what is left of each segment that has one."""
    begins = path.segment_starts
    ends = np.append(begins[1:], path.length)
    times = {}
    for i, segment in enumerate(path.segments):
        if segment.duration is not None and ends[i] > max(start, begins[i]):
            share = (ends[i] - max(start, begins[i])) / (ends[i] - begins[i])
            times[i] = segment.duration * float(share)
    return times


def _paced(
    problem: Problem,
    pace: Array,
    start_speed: float,
    timed: dict[int, float],
) -> Array:
    """The path speed (segments,) that gives each timed segment its time; infinite if too short.

    Neighbours share the ramps between them, so all are halved together, and again around what was
    found until the times agree.
    """
    index = np.array(list(timed))
    wanted = np.array(list(timed.values()))
    path, width = problem.path, problem.cells.width
    segment = path.segment_of(problem.cells.piece)
    way = np.bincount(segment, width, minlength=len(path.segments))[index]

    def spent(trial: Array) -> Array:
        """Time of the timed segments at some paces."""
        attempt = pace.copy()
        attempt[index] = trial
        speed = np.sqrt(solve(at_pace(problem, attempt), start_speed)[0])
        step = 2.0 * width / np.maximum(speed[1:] + speed[:-1], 1e-300)
        time: Array = np.bincount(segment, step, minlength=len(path.segments))[index]
        return time

    fastest = spent(np.full(len(index), np.inf))
    feasible = fastest < wanted * (1.0 - _TIME_TOLERANCE)
    # Half the mean speed is slow enough even where a fast start has to be braked away first.
    low = 0.5 * way / wanted
    high = np.where(feasible, 4.0 * way / fastest + low, np.inf)
    found = high
    for _ in range(_TIMED_ROUNDS):
        for _ in range(_TIMED_HALVINGS):
            middle = np.where(feasible, 0.5 * (low + high), np.inf)
            slow = spent(middle) > wanted
            low, high = np.where(slow, middle, low), np.where(slow, high, middle)
        found = np.where(feasible, 0.5 * (low + high), np.inf)
        miss = np.abs(spent(found) - wanted) / wanted
        if not (feasible & (miss > _TIME_TOLERANCE)).any():
            break
        low, high = found / 1.3, found * 1.3
    paced = pace.copy()
    paced[index] = found
    return paced
