"""Limits of a motion at the points of a path, ready for the solver."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.timing.constraints import (
    NO_PACES,
    AccelerationRows,
    Paces,
    SpeedRows,
    acceleration_rows,
    speed_rows,
)
from rapidsim.motion.timing.discretisation import GridCells
from rapidsim.values import value_class

_LEAST_SLOWNESS = 1e-6
HELD_BEND = 1.25
"""Factor by which less of the acceleration is used for the bend of the path where smoothing may add
a change of speed that the command does not have there; measured on random programs."""


@value_class(frozen=True, slots=True, eq=False)
class Problem:
    """All limits at the points (k,) of the cells of a path."""

    path: Path
    limits: Limits
    cells: GridCells
    speeds: SpeedRows
    accelerations: AccelerationRows
    slowness: Array
    """Shape (k,) [s/m]: inverse of the largest path speed of the arm."""


def problem_of(path: Path, cells: GridCells, limits: Limits, paces: Paces = NO_PACES) -> Problem:
    """Collect the limits of a motion.

    Args:
        path: The geometry.
        cells: The discretisation; the motion comes to rest after the last cell.
        limits: Axis limits.
        paces: Maximum path speeds [m/s] of segments with a programmed time, by index; they
            replace the programmed speeds there.
    """
    speeds = speed_rows(path, cells.places, limits, paces)
    accelerations = acceleration_rows(path, cells.places, limits)
    slowness = _slowness(path, speeds, accelerations)
    return Problem(path, limits, cells, speeds, accelerations, slowness)


def at_pace(problem: Problem, paces: Paces) -> Problem:
    """Return the problem with other paces; see `problem_of`."""
    speeds = speed_rows(problem.path, problem.cells.places, problem.limits, paces)
    slowness = _slowness(problem.path, speeds, problem.accelerations)
    return replace(problem, speeds=speeds, slowness=slowness)


def _slowness(path: Path, speeds: SpeedRows, accelerations: AccelerationRows) -> Array:
    """Return the inverse of the largest path speeds (k,) that the arm may have at the points.

    If the smoothed motion is to keep accelerations, these are speeds that use most of them where
    the path bends; the rest is for the change of speed.
    """
    slowness = speeds.largest
    if path.model.slows_for_bends:
        slowness = np.maximum(slowness, np.sqrt(HELD_BEND * accelerations.largest_bend))
    return np.maximum(slowness, _LEAST_SLOWNESS)
