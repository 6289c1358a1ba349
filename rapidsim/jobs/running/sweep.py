"""`rapidsim sweep`: the same program with the robot at many positions, one variant for each.

First the reach of all variants is checked together; then those that reach everything are run, each
independently and, if requested, in several processes. Neither affects the rows or their order.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import starmap
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from rapidsim.files import InputError, did_you_mean
from rapidsim.frames.euler import Convention, euler_from_rotation, rotation_from_euler
from rapidsim.frames.transform import Array, Transform
from rapidsim.jobs.cache.processes import in_processes
from rapidsim.jobs.inputs.job import Job, job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import (
    LoadedJob,
    ProgramRejectedError,
    executed,
    loaded,
    prepared,
)
from rapidsim.motion.geometry.curves import Index
from rapidsim.reach.placements import reach_from
from rapidsim.station.robot import StationRobot
from rapidsim.values import value_class

_MM_PER_M = 1000.0
_POSITION = ("base.x", "base.y", "base.z")
_ANGLES = ("base.rz", "base.ry", "base.rx")
KEYS = (*_POSITION, *_ANGLES)
"""Parameters that may vary: the position of the robot's base in the world [mm], and its angles as
those of OrientZYX [deg]."""
MOST_VARIANTS = 10_000_000
_ROUNDING = 1e-9
"""Share of a step by which the last value may exceed the end."""
_AT_ONCE = 8
"""Number of variants that a process receives at a time."""


@value_class(frozen=True, slots=True)
class Axis:
    """A parameter that varies, and its values."""

    key: str
    values: tuple[float, ...]


@value_class(frozen=True, slots=True)
class VariantOutcome:
    """Outcome of the run of a variant."""

    end: str
    time_s: float
    findings: int


@value_class(frozen=True, slots=True, eq=False)
class Sweep:
    """Variants (k,) and their results."""

    axes: tuple[Axis, ...]
    number: Index
    """Shape (k,): number among all variants, counted from 0; the last axis changes first."""
    values: Array
    """Shape (k, axes)."""
    moves: int
    """Number of move instructions that were checked."""
    unreachable: Index
    other_configuration: Index
    margin_deg: Array
    """Shape (k,); see `PlacedReach`."""
    margin_measure: str
    """RAPID's unit of margins: `deg or mm` if an axis of the arm is prismatic."""
    runs: tuple[VariantOutcome | None, ...]
    """None for a variant that was not run."""

    @property
    def works(self) -> Array:
        """Which variants (k,) reach every move in its stored configuration."""
        works: Array = (self.unreachable == 0) & (self.other_configuration == 0)
        return works


def axis_of(text: str) -> Axis:
    """Parse `base.x=-200:200:50`: from, to and step; or a single value.

    Raises:
        InputError: If the text has another form.
    """
    key, _, said = text.partition("=")
    key = key.strip().lower()
    if key not in KEYS:
        raise InputError(
            f"--vary {text}: `{key}` cannot be varied",
            did_you_mean(key, KEYS) or f"there are {', '.join(KEYS)}",
        )
    try:
        numbers = [float(part) for part in said.split(":")]
    except ValueError:
        numbers = []
    if len(numbers) not in (1, 3) or not all(map(math.isfinite, numbers)):
        raise InputError(f"--vary {text}: the values are FROM:TO:STEP, as in {key}=-200:200:50")
    if len(numbers) == 1:
        return Axis(key, (numbers[0],))
    first, last, step = numbers
    if step == 0.0 or (last - first) / step < 0.0:
        raise InputError(f"--vary {text}: steps of {step:g} never get from {first:g} to {last:g}")
    steps = (last - first) / step + _ROUNDING
    if steps >= MOST_VARIANTS:
        raise InputError(f"--vary {text}: over {MOST_VARIANTS} values", "use a larger step")
    return Axis(key, tuple(first + number * step for number in range(int(steps) + 1)))


def sweep(
    ready: LoadedJob,
    axes: Sequence[Axis],
    *,
    shard: tuple[int, int] = (1, 1),
    run: bool = True,
    processes: int = 1,
) -> Sweep:
    """Try all variants of a job.

    Args:
        ready: A job of one task with one robot, whose station defines the base.
        axes: The parameters that vary.
        shard: Only every n-th variant starting with the i-th, counted from 1: `(i, n)`.
        run: Whether variants that reach everything are run.
        processes: Number of processes that run them.

    Raises:
        InputError: If there are too many variants, or one key varies twice.
        ProgramRejectedError: If checking finds an error.
    """
    keys = [axis.key for axis in axes]
    if len(set(keys)) < len(keys):
        raise InputError("a key is varied twice", "give each --vary its own key")
    count = math.prod(len(axis.values) for axis in axes)
    if count > MOST_VARIANTS:
        raise InputError(f"{count} variants are over {MOST_VARIANTS}", "use larger steps")
    made = ready.job
    if len(made.tasks) > 1:
        raise InputError(f"there are {len(made.tasks)} tasks", "name one with --task")
    if not ready.tasks:
        raise ProgramRejectedError(ready.diagnostics)
    number = np.arange(count)[shard[0] - 1 :: shard[1]]
    columns = np.unravel_index(number, [len(axis.values) for axis in axes])
    values = np.stack(
        [np.array(axis.values)[at] for axis, at in zip(axes, columns, strict=True)], axis=-1
    )
    places = _placed(made, keys, values)
    reach = reach_from(
        ready.tasks[0].program,
        ready.robot,
        places,
        external=made.station.external_axes,
        exact=made.station.exact_configuration,
    )
    works = (reach.unreachable == 0) & (reach.other_configuration == 0)
    runs: list[VariantOutcome | None] = [None] * len(number)
    if run:
        rows = np.flatnonzero(works).tolist()
        for row, outcome in zip(rows, _outcomes(ready, places[rows], processes), strict=True):
            runs[row] = outcome
    return Sweep(
        tuple(axes),
        number,
        values,
        reach.moves,
        reach.unreachable,
        reach.other_configuration,
        np.degrees(reach.margin),
        "deg or mm" if ready.robot.kinematics.slides.any() else "deg",
        tuple(runs),
    )


def _placed(found_job: Job, keys: Sequence[str], values: Array) -> Transform:
    """Poses (k,) of the base for values (k, axes); other parameters are the station's."""
    stands = found_job.station.world_from_base or Transform.identity()
    position = np.tile(stands.translation, (len(values), 1))
    angles = np.tile(euler_from_rotation(stands.rotation, Convention.ZYX), (len(values), 1))
    for column, key in zip(values.T, keys, strict=True):
        if key in _POSITION:
            position[:, _POSITION.index(key)] = column / _MM_PER_M
        else:
            angles[:, _ANGLES.index(key)] = np.radians(column)
    if not any(key in _ANGLES for key in keys):
        # Exactly as in the station, to the last bit.
        return Transform(np.tile(stands.rotation, (len(values), 1, 1)), position)
    return Transform(rotation_from_euler(angles, Convention.ZYX), position)


def _outcomes(ready: LoadedJob, places: Transform, processes: int) -> Iterator[VariantOutcome]:
    """Run the job with the robot at poses (k,), and yield the outcomes in order."""
    each = list(zip(places.rotation, places.translation, strict=True))
    if processes == 1 or len(each) < 2:
        return starmap(partial(_outcome, ready), each)
    prepare = partial(_prepare, ready.job.request)
    at_once = min(_AT_ONCE, -(-len(each) // processes))
    return in_processes(_variant_outcome, each, processes, begin=prepare, at_once=at_once)


_here: Callable[[Array, Array], VariantOutcome] | None = None
"""Runs the job of a sweep in one of its processes; None in other processes."""


def _prepare(request: RunRequest) -> None:
    """Load the job once in each process."""
    global _here
    _here = partial(_outcome, loaded(job(request)))


def _variant_outcome(place: tuple[Array, Array]) -> VariantOutcome:
    assert _here is not None
    return _here(*place)


def _outcome(ready: LoadedJob, rotation: Array, translation: Array) -> VariantOutcome:
    made = ready.job
    robot = made.station.robots[0] if made.station.robots else StationRobot()
    placed = replace(robot, world_from_base=Transform(rotation, translation))
    station = replace(made.station, robots=(placed, *made.station.robots[1:]))
    with TemporaryDirectory(prefix="rapidsim-sweep-") as home:
        # Files that one variant writes are no inputs of another.
        asked = replace(made.request, home=str(Path(home)))
        varied = replace(ready, job=replace(made, station=station, request=asked))
        finished = executed(prepared(varied)).simulation
    return VariantOutcome(finished.end.value, finished.time_s, len(finished.diagnostics))
