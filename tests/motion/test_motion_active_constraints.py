"""The active limit of a stretch: raised there it makes the motion faster; no other limit does."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from laws import examples
from motion_programs import (
    LIMITS,
    MODEL,
    ROBOT,
    Programmer,
    path_or_fault,
    programs,
    zone,
)

from rapidsim.motion.interruption import undisturbed
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.timing.active_constraints import active_limits
from rapidsim.motion.timing.axis_limits import Limits, limits_of
from rapidsim.motion.timing.constraints import Limiter, Quantity
from rapidsim.motion.timing.discretisation import cells_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.problem import HELD_BEND, Problem, problem_of
from rapidsim.motion.timing.ramped_drive import ramped_drive
from rapidsim.motion.timing.stages import Stages, _fill_in
from rapidsim.motion.timing.time_optimal import Division, StageMotion, drive, fastest_drive
from rapidsim.motion.timing.two_pass import solve
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory

RAISED = 1.2
OF_CAPS = (Quantity.CORNER, Quantity.CYCLE, Quantity.RAMP)
"""Limits of the command's speed that come from other places or from no row."""
FEWEST = 4
"""Stages of a stretch."""
LONG_S = 0.02
NEARLY = 0.95
"""Share of a limit from which on it may decide soon."""


@dataclass(frozen=True, slots=True)
class Stretch:
    """Consecutive stages with one active limit, all others being farther from theirs."""

    first: int
    after: int
    limit: Limiter


def stretches(problem: Problem, motion: StageMotion) -> Iterator[Stretch]:
    limiters, active = active_limits(problem, motion)
    number = np.where(is_shared(problem, motion), -1, active)
    ends = [0, *(np.flatnonzero(np.diff(number)) + 1).tolist(), len(number)]
    for first, after in pairwise(ends):
        if after - first >= FEWEST and number[first] >= 0:
            yield Stretch(first, after, limiters[number[first]])


def is_shared(problem: Problem, motion: StageMotion) -> Mask:
    """Whether two limits are reached, or nearly so, in stages (m,), so that neither decides."""
    stages, x = motion.stages, motion.x
    u = np.diff(x) / np.maximum(2.0 * stages.width, 1e-300)
    used = np.abs(u[:, None] + stages.tilt * x[:-1, None]) / stages.slack
    names = problem.accelerations.limiters * 2
    of_limits = [
        used[:, [name == one for name in names]].max(axis=1) for one in dict.fromkeys(names)
    ]
    shares_of_caps = np.sqrt(x / np.maximum(motion.caps, 1e-12))
    at_cap = np.maximum(shares_of_caps[:-1], shares_of_caps[1:])
    shares = np.sort([*of_limits, at_cap], axis=0)
    shared: Mask = shares[-2] > NEARLY
    return shared


def raised(problem: Problem, limits: set[Limiter]) -> Problem:
    """The problem with some limits raised everywhere."""
    speeds, rows = problem.speeds, problem.accelerations
    of_speeds = np.where([one in limits for one in speeds.limiters], RAISED, 1.0)
    of_rows = np.where([one in limits for one in rows.limiters], RAISED, 1.0)
    speeds = replace(speeds, rate=speeds.rate / of_speeds)
    rows = replace(rows, slope=rows.slope / of_rows, bend=rows.bend / of_rows)
    slowness = speeds.largest
    if problem.path.model.slows_for_bends:
        slowness = np.maximum(slowness, np.sqrt(HELD_BEND * rows.largest_bend))
    slowness = np.maximum(slowness, 1e-6)
    return replace(problem, speeds=speeds, accelerations=rows, slowness=slowness)


def time_in(
    problem: Problem,
    division: Division,
    motion: StageMotion,
    stretch: Stretch,
    limits: set[Limiter],
) -> float:
    """The time [s] of the motion with some limits raised in one stretch alone."""
    other = raised(problem, limits)
    stages = motion.stages
    parts = stages_like(stages, other)
    caps = motion.caps.copy()
    nodes = slice(stretch.first, stretch.after + 1)
    if stretch.limit.quantity not in OF_CAPS:
        caps[nodes] = drive(other, replace(division, stages=parts), 0.0).caps[nodes]
    elif stretch.limit in limits:
        caps[nodes] *= RAISED**2
    inside = np.zeros(len(stages.cell), dtype=bool)
    inside[stretch.first : stretch.after] = True
    mixed = replace(
        stages,
        slack=np.where(inside[:, None], parts.slack, stages.slack),
        tilt=np.where(inside[:, None], parts.tilt, stages.tilt),
        widest=np.where(inside, parts.widest, stages.widest),
    )
    return float(replace(motion, x=solve(mixed, caps, 0.0)[0]).times.sum())


def stages_like(stages: Stages, problem: Problem) -> Stages:
    """The same stages with the limits of another problem."""
    copied = replace(
        stages,
        nodes=stages.nodes.copy(),
        slack=stages.slack.copy(),
        tilt=stages.tilt.copy(),
        widest=stages.widest.copy(),
    )
    _fill_in(copied, problem.cells, problem.accelerations, np.arange(len(stages.cell)))
    return copied


def misnamed(
    program: Programmer, model: MotionModel, limits: Limits, ramp: float = 1.0
) -> Iterator[str]:
    """Yield the stretches whose named limit is not the one that decides; with a ramp, of these."""
    segments = [replace(one, ramp=ramp, stop_ramp=ramp) for one in program.segments]
    path = path_or_fault(segments, model)
    if isinstance(path, PathFault):
        return
    problem = problem_of(path, cells_of(path, limits, 0.0), limits)
    division, motion = fastest_drive(problem, 0.0)
    if ramp < 1.0:
        motion = ramped_drive(problem, division, motion, 0.0, undisturbed)
    every = {*problem.speeds.limiters, *problem.accelerations.limiters}
    before_s = float(motion.times.sum())
    for stretch in stretches(problem, motion):
        if ramp < 1.0 and stretch.limit.quantity is not Quantity.RAMP:
            continue
        took_s = float(motion.times[stretch.first : stretch.after].sum())
        own = before_s - time_in(problem, division, motion, stretch, {stretch.limit})
        others = before_s - time_in(problem, division, motion, stretch, every - {stretch.limit})
        if own < 1e-4 * took_s or others > 1e-3 * took_s:
            s = motion.stages.nodes[stretch.first]
            yield f"{stretch.limit} at {s:.4f} m for {took_s:.4f} s: {own:.1e}, others {others:.1e}"


@pytest.mark.parametrize(
    ("model", "limits"),
    [
        (MODEL, LIMITS),
        (MotionModel(), LIMITS),
        (MotionModel(), limits_of(ROBOT, MotionModel())),
    ],
    ids=["unsmoothed", "smoothed", "torques"],
)
@examples(60)
@given(program=programs())
def test_the_named_limit_decides_alone(
    program: Programmer, model: MotionModel, limits: Limits
) -> None:
    assert not list(misnamed(program, model, limits))


@examples(60)
@given(program=programs())
def test_a_ramp_decides_alone_where_it_holds_the_speed(program: Programmer) -> None:
    assert not list(misnamed(program, MotionModel(), LIMITS, ramp=0.3))


def limits_in(program: Programmer, model: MotionModel, **options: float) -> set[str]:
    """The active limits of a program whose segments have some options, without those of moments."""
    segments = [replace(one, **options) for one in program.segments]  # type: ignore[arg-type]
    path = path_or_fault(segments, model)
    assert not isinstance(path, PathFault)
    timing = plan(path, LIMITS)
    trajectory = Trajectory(segments[0].start, model.window, model.smoothing)
    trajectory.append(Piece(0.0, path, timing, 0.0, path.length))
    (piece,) = trajectory.command.pieces
    active, took_s = piece.timing.active, np.diff(piece.timing.times)
    assert active is not None
    total = np.bincount(active, took_s)
    return {str(piece.timing.limiters[one]) for one in np.flatnonzero(total > LONG_S).tolist()}


def test_a_ramp_is_named_where_it_adds_most_of_the_time() -> None:
    short = Programmer().line((0.0, 0.02, 0.0))
    assert "AccSet's ramp" not in limits_in(short, MotionModel())
    assert "AccSet's ramp" in limits_in(short, MotionModel(), ramp=0.1)


def test_a_slow_corner_is_named_before_and_after_it() -> None:
    # Smoothed along the path, a corner must not be entered faster than it can be passed.
    model = MotionModel(smoothing="path", filter_time=0.08, accelerations_kept_by="motion")
    turn = Programmer().line((0.2, 0.0, 0.0), z=zone(10)).line((0.0, 0.2, 0.0))
    assert "corner" in limits_in(turn, model)
    assert "corner" not in limits_in(turn, replace(model, smoothing="axes", filter_time=0.0))
