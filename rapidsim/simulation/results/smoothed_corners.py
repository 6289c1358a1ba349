"""Corners through which the smoothing takes the arm faster than its axes can turn.

The command keeps the accelerations of the axes. Smoothing along the path carries some of the speed
of the straight sections into the corners, whose curvature then exceeds these accelerations.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.executed_moves import ExecutedMoves
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.runs import CornerTooFast
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.external_axes import Axes
from rapidsim.motion.timing.axis_limits import Limits, limits_along
from rapidsim.motion.timing.constraints import axis_rows
from rapidsim.motion.timing.discretisation import GridPoints
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.values import value_class

_WORTH_SAYING = 3.0
"""Reported load, as a multiple of an axis' acceleration limit."""


@value_class(frozen=True, slots=True)
class _Corner:
    """A corner whose middle loads an axis beyond its limit; `load` is a multiple of it."""

    move: ExecutedMove
    load: float
    limit: str


def corner_findings(
    moves: ExecutedMoves, trajectory: Trajectory, limits: Limits, axes: Axes, model: MotionModel
) -> tuple[Diagnostic, ...]:
    """Return one note on the worst such corner of a run; empty if there is none.

    Args:
        moves: Moves of one robot.
        trajectory: Its motion.
        limits: Limits of its axes.
        axes: Their names.
        model: Motion model of the controller.
    """
    if not model.window or model.smoothing == "axes" or model.slows_for_bends:
        return ()
    corners = {move.index: move for move in moves if move.corner is CornerKind.FLY_BY}
    found = [
        corner
        for piece in trajectory.pieces
        for corner in _too_fast(piece, corners, trajectory, limits, axes)
    ]
    if not found:
        return ()
    worst = max(found, key=lambda corner: corner.load)
    more = len(found) - 1
    others = f", and {more} more {'corner' if more == 1 else 'corners'} likewise" if more else ""
    violation = CornerTooFast(worst.load, worst.limit, others)
    place = worst.move.place
    return (Diagnostic(violation, place.span, routine=place.routine),)


def _too_fast(
    piece: Piece,
    corners: dict[int, ExecutedMove],
    trajectory: Trajectory,
    limits: Limits,
    axes: Axes,
) -> Iterator[_Corner]:
    path = piece.path
    middles = path.segment_bounds[1:]
    passed = [
        (k, corners[piece.first + k])
        for k in range(len(path.segments))
        if piece.first + k in corners and piece.from_s < middles[k] < piece.to_s
    ]
    if not passed:
        return
    s = middles[[k for k, _ in passed]]
    seen = trajectory.speed_at(np.array([move.end_s for _, move in passed]))
    commanded = np.interp(s, piece.timing.s, piece.timing.speed)
    # The command keeps the limits: only where it is much slower can there be a corner to report.
    faster = np.flatnonzero(seen**2 > _WORTH_SAYING * commanded**2)
    if not len(faster):
        return
    at = path.layout.piece_at(s[faster])
    limits = limits_along(path, limits)
    rows = axis_rows(path, GridPoints(s[faster], at, path.rates(s[faster], at)), limits)
    loads = np.abs(rows.bend) * seen[faster, None] ** 2
    for number, load in zip(faster.tolist(), loads, strict=True):
        if load.max() > _WORTH_SAYING:
            limiter = rows.limiters[int(load.argmax())]
            yield _Corner(passed[number][1], float(load.max()), limiter.text(axes))
