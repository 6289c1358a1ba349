"""Corners in which a controller is known to have another speed than the motion model.

The share of torques that is used in narrow zones is a fit. Two kinds of corners in the logs of the
measured arm differ from it by more than the cycle times of that arm are accurate: sharp corners,
and arcs between which the orientation changes. For other arms their accuracy includes these.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import StrEnum

import numpy as np

from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.executed_moves import ExecutedMoves
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.runs import CornerSpeedUncertain
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Geometry
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.external_axes import Axes
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.timing.axis_limits import constants_of, torques_of
from rapidsim.motion.trajectory.command import Piece
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.values import value_class

_ACCURATE_PERCENT = 5.0
"""Accuracy of cycle times from which on these corners are included."""
_NARROW_M = (0.005, 0.020)
"""Radii of zones like that of the logs: 10 mm. Those of 1 and of 50 mm differ less."""
_SHARP = np.radians(15.0)
"""Corners of 30 degrees differ, those of 3 to 9 degrees do not."""
_REORIENTED = np.radians(10.0)
"""Arcs in the logs turn the tool by 22 degrees."""


class _Seen(StrEnum):
    """Speed of a controller in a kind of corner, compared with that of the model."""

    SHARP = "up to 24 % faster, and through it up to 15 ms sooner"
    REORIENTED = "up to 18 % slower, and through it up to 45 ms later"


@value_class(frozen=True, slots=True)
class _Corner:
    move: ExecutedMove
    limit: str
    seen: _Seen


def uncertain_corner_findings(
    moves: ExecutedMoves, trajectory: Trajectory, robot: Robot, model: MotionModel
) -> Iterator[Diagnostic]:
    """Yield one note for each kind of such corners, on the first of them.

    Args:
        moves: Moves of one robot.
        trajectory: Its motion.
        robot: The arm.
        model: Motion model of the controller.
    """
    accurate = constants_of(robot, model).cycle_percent
    if accurate is None or accurate > _ACCURATE_PERCENT or not torques_of(robot, model):
        return
    corners = {move.index: move for move in moves if move.corner is CornerKind.FLY_BY}
    found = [
        corner for piece in trajectory.pieces for corner in _uncertain(piece, corners, robot.axes)
    ]
    for kind in _Seen:
        of_kind = [corner for corner in found if corner.seen is kind]
        if of_kind:
            more = len(of_kind) - 1
            others = f" (and in {more} like it)" if more else ""
            violation = CornerSpeedUncertain(of_kind[0].limit, kind.value, others)
            place = of_kind[0].move.place
            yield Diagnostic(violation, place.span, routine=place.routine)


def _uncertain(piece: Piece, corners: dict[int, ExecutedMove], axes: Axes) -> Iterator[_Corner]:
    path, timing = piece.path, piece.timing
    middles = path.segment_bounds[1:-1]
    if timing.active is None or not len(middles):
        return
    stage = np.clip(np.searchsorted(timing.s, middles, "right") - 1, 0, len(timing.active) - 1)
    limit = timing.active[stage]
    forced = np.array([one.is_acceleration for one in timing.limiters])[limit]
    radius = path.zone_radius[path.layout.piece_at(middles)]
    narrow = (radius >= _NARROW_M[0]) & (radius <= _NARROW_M[1])
    within = (piece.from_s < middles) & (middles < piece.to_s)
    found = np.flatnonzero(forced & narrow & within)
    turns = _turns(path, middles[found], radius[found])
    for k, turn in zip(found.tolist(), turns.tolist(), strict=True):
        move = corners.get(piece.first + k)
        kinds = {one.geometry for one in path.segments[k : k + 2]}
        if move is None or Geometry.JOINT in kinds:
            continue
        if turn > _SHARP:
            yield _Corner(move, timing.limiters[int(limit[k])].text(axes), _Seen.SHARP)
        elif kinds == {Geometry.ARC} and _reorientation(path, k) > _REORIENTED:
            yield _Corner(move, timing.limiters[int(limit[k])].text(axes), _Seen.REORIENTED)


def _turns(path: Path, middles: Array, radius: Array) -> Array:
    """Return the angles (k,) [rad] between the directions at both edges of zones (k,)."""
    edges = np.concatenate([middles - 1.01 * radius, middles + 1.01 * radius])
    first = path.tcp_derivatives(edges, path.layout.piece_at(edges))[0]
    lengths = np.linalg.norm(first, axis=1, keepdims=True)
    into, out = np.split(first / np.maximum(lengths, 1e-12), 2)
    turns: Array = np.arccos(np.clip(np.einsum("ki,ki->k", into, out), -1.0, 1.0))
    return turns


def _reorientation(path: Path, k: int) -> float:
    """Return the larger reorientation [rad] of a segment and the next."""
    rows = np.isin(path.active, [k, k + 1])
    return float(path.layout.curves.angle[rows].max(initial=0.0))
