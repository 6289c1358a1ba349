"""Data of the pictures: a run, its samples, and texts for its moves."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Array
from rapidsim.simulation.results.relative_motion import is_on_track, shown_end, shown_from_base
from rapidsim.simulation.results.sampling import SampledRun, sampled
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.simulation.results.time_shares import end_point

MM = 1000.0
_DT = 0.004
"""[s]; fine enough that a corner looks round on paper."""
_MOST_SAMPLES = 20_000
_MOST_EDGES = 20_000
_NAME_LETTERS = 20


def sample_run(simulation: Simulation, robot_run: RobotRun) -> SampledRun:
    """Sample the run of one robot for its pictures."""
    step_s = max(_DT, simulation.motion_end_s / _MOST_SAMPLES)
    return sampled(simulation, robot_run, step_s, most_moves=_MOST_EDGES)


def title_of(run: SampledRun) -> str:
    """Return a title of the program and the robot."""
    whose = f"{run.robot_run.task}, " if len(run.simulation.robots) > 1 else ""
    return f"{run.simulation.title} on {whose}{run.robot_run.robot.title}"


def number_of(run: SampledRun) -> int:
    """Return the index of the robot among those of the run."""
    return next(k for k, one in enumerate(run.simulation.robots) if one is run.robot_run)


def frame_of(run: SampledRun) -> str:
    """Return the name of the frame of the pictures: each robot has its own."""
    return "world" if is_on_track(run.robot_run.robot) else "base frame"


def places_mm(run: SampledRun) -> Array:
    """Return the TCP positions (k, 3) [mm] of all samples, in the frame of the pictures."""
    in_world = is_on_track(run.robot_run.robot)
    shown = shown_from_base(run.robot_run, run.samples.external, in_world=in_world)
    return MM * shown.apply(run.samples.base_from_tcp.translation)


def end_mm(run: SampledRun, move: ExecutedMove) -> Array:
    """Return the programmed end (3,) [mm] of a move in the frame of the pictures."""
    return (
        MM * shown_end(run.robot_run, move, in_world=is_on_track(run.robot_run.robot)).translation
    )


def target_name(move: ExecutedMove) -> str:
    """Return the end of a move as a short text."""
    words = end_point(move.place)
    return words if len(words) <= _NAME_LETTERS else f"{words[: _NAME_LETTERS - 1]}…"


def pieces(mask: npt.NDArray[np.bool_]) -> list[slice]:
    """Return the contiguous ranges of a mask (k,), each one sample longer so that lines join."""
    padded = np.concatenate([[False], mask, [False]])
    bounds = np.flatnonzero(padded[1:] != padded[:-1])
    return [
        slice(int(begin), min(int(end) + 1, len(mask)))
        for begin, end in zip(bounds[::2], bounds[1::2], strict=True)
    ]
