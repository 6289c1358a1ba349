"""Path deviations of the TCP from the lines and arcs of a run, by forward kinematics.

Measured between the zones of a move: within them the corner path leaves the curve on purpose.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.curves import Curves, circle_fault, curves_of
from rapidsim.motion.geometry.segments import Geometry, Segment
from rapidsim.simulation.results.linear_alternative import segments_of
from rapidsim.simulation.results.sampling import evaluate
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.values import value_class

_MOST_PLACES = 33
_FEWEST_PLACES = 3
_PLACES = 60_000
"""Total number of samples; with many moves each has fewer."""


@value_class(frozen=True, slots=True)
class CurveDeviation:
    """Distances [m] of the TCP from the programmed curve of one move."""

    largest: float
    rms: float
    """Root of the mean square."""


def all_curve_deviations(simulation: Simulation) -> Mapping[int, CurveDeviation]:
    """Return the deviations of all robots, by number of the move in `Simulation.moves`."""
    return {
        offset + number: deviation
        for one, offset in zip(simulation.robots, simulation.move_offsets, strict=True)
        for number, deviation in curve_deviations(one).items()
    }


def curve_deviations(robot_run: RobotRun) -> Mapping[int, CurveDeviation]:
    """Return the deviations of a robot's lines and arcs, by number of the move.

    Moves without a part between their zones are skipped, and those whose tool or work is moved by
    something other than the arm: they have no curve in base.
    """
    if robot_run.robot.external:
        return {}
    segments = segments_of(robot_run)
    moves = [move for move in robot_run.moves if _has_curve(segments.get(move.index))]
    if not moves:
        return {}
    driven = [segments[move.index] for move in moves]
    places = int(np.clip(_PLACES // len(moves), _FEWEST_PLACES, _MOST_PLACES))
    # The middles of equal intervals: their ends lie in zones, or on the points themselves.
    shares = (np.arange(places) + 0.5) / places
    starts, ends = np.array([(move.start_s, move.end_s) for move in moves]).T
    times = (starts[:, None] + shares * (ends - starts)[:, None]).ravel()
    order = np.argsort(times, kind="stable")
    joints = np.empty((len(times), len(robot_run.robot.joints)))
    joints[order] = evaluate(robot_run.trajectory, times[order]).joints
    row = np.repeat(np.arange(len(moves)), places)
    tcp = (robot_run.robot.forward(joints) @ _flange_from_tcp(driven, row)).translation
    between = _between_zones(robot_run, moves, tcp.reshape(len(moves), places, 3))
    off = _off_the_curves(curves_of(driven, robot_run.robot.kinematics), row, tcp).reshape(
        -1, places
    )
    return {
        move.index: CurveDeviation(
            float(distances[kept].max()), float(np.sqrt(np.mean(distances[kept] ** 2)))
        )
        for move, distances, kept in zip(moves, off, between, strict=True)
        if kept.any()
    }


def _has_curve(segment: Segment | None) -> bool:
    return (
        segment is not None
        and segment.geometry is not Geometry.JOINT
        and segment.carrier is None
        and not segment.rides
        and segment.wrist_pair is None
        and circle_fault(segment) is None
    )


def _flange_from_tcp(segments: Sequence[Segment], row: npt.NDArray[np.int64]) -> Transform:
    """Return the tools (k,) of segments."""
    tools = [segment.tcp_from_flange.inverse() for segment in segments]
    rotations = np.array([tool.rotation for tool in tools])
    return Transform(rotations[row], np.array([tool.translation for tool in tools])[row])


def _between_zones(
    robot_run: RobotRun, moves: Sequence[ExecutedMove], tcp: Array
) -> npt.NDArray[np.bool_]:
    """Return which samples (m, k, 3) [m] are outside the zones at both ends of their moves."""

    def zone(move: ExecutedMove) -> float:
        return move.zone_m if move.corner is CornerKind.FLY_BY else 0.0

    # Moves that were never begun have numbers, too. The first move has no zone at its start: it
    # serves as its own predecessor.
    before_each = {
        move.index: before for before, move in pairwise((robot_run.moves[0], *robot_run.moves))
    }
    before = [before_each[move.index] for move in moves]
    starts = np.array([move.base_from_tcp.translation for move in before])
    ends = np.array([move.base_from_tcp.translation for move in moves])
    at_start, at_end = np.array([(zone(b), zone(m)) for b, m in zip(before, moves, strict=True)]).T
    from_start = np.linalg.norm(tcp - starts[:, None], axis=-1)
    from_end = np.linalg.norm(tcp - ends[:, None], axis=-1)
    outside: npt.NDArray[np.bool_] = (from_start >= at_start[:, None]) & (
        from_end >= at_end[:, None]
    )
    return outside


def _off_the_curves(curves: Curves, row: npt.NDArray[np.int64], tcp: Array) -> Array:
    """Distances (k,) [m] of points (k, 3) from the lines or circles of their curves."""
    chord, spoke, turn = curves.chord[row], curves.spoke[row], curves.frame_turn[row]
    aside = tcp - curves.start.translation[row]
    along = chord / np.maximum(np.linalg.norm(chord, axis=-1, keepdims=True), 1e-12)
    off_line = np.linalg.norm(np.cross(aside, along), axis=-1)
    radius = np.linalg.norm(spoke, axis=-1)
    axis = turn / np.maximum(np.linalg.norm(turn, axis=-1, keepdims=True), 1e-12)
    from_centre = aside + spoke
    up = np.sum(from_centre * axis, axis=-1)
    out = np.linalg.norm(from_centre - up[:, None] * axis, axis=-1) - radius
    off: Array = np.where(radius > 0.0, np.hypot(up, out), off_line)
    return off
