"""Paths in the cell: programmed, thin, and travelled, in the colour of the move.

In corners the travelled path has the corner's colour.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import rerun as rr

from rapidsim.controller.moves.executed_moves import MoveRow
from rapidsim.controller.moves.settled_lines import SettledLines
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.moves import Interpolation, Move
from rapidsim.motion.configurations.targets import base_from_tcp
from rapidsim.recording import palette
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.scene.arc import arc_through

PROGRAMMED = "path/programmed"
TRAVELLED = "path/travelled"

_CURVE_POINTS = 48
"""Number of points with which a joint move or an arc looks round."""
_NO_STEP = 1e-6
"""Length [m] of an invisible step."""
_JUMP = 5e-3
"""Step [m] between two samples below which it is due to speed between them."""
_CORNER = "corner"


def log_paths(stream: rr.RecordingStream, run: RecordedRobot) -> None:
    """Log both paths of a run."""
    if not run.robot_run.moves:
        return
    strips = _joined(programmed(run))
    if strips:
        stream.log(
            run.entity(PROGRAMMED),
            rr.CoordinateFrame(run.still_frame),
            rr.LineStrips3D(
                strips,
                radii=rr.Radius.ui_points(0.8),
                colors=palette.rgba(palette.PROGRAMMED, 150),
            ),
            static=True,
        )
    for name, (colour, pieces) in _travelled(run).items():
        stream.log(
            run.entity(f"{TRAVELLED}/{name}"),
            rr.CoordinateFrame(run.still_frame),
            rr.LineStrips3D(pieces, radii=rr.Radius.ui_points(2.2), colors=palette.rgba(colour)),
            static=True,
        )


class _Pose(NamedTuple):
    """A pose of the arm: its joints, the TCP, and the flange relative to it."""

    joints: Array
    tcp: Transform
    tcp_from_flange: Transform

    def start(self, tcp_from_flange: Transform) -> Array:
        """Return where a path with a tool begins."""
        if tcp_from_flange is self.tcp_from_flange:
            return self.tcp.translation
        # Another tool has another TCP on the same flange.
        return (self.tcp @ self.tcp_from_flange @ tcp_from_flange.inverse()).translation


def programmed(run: RecordedRobot) -> Iterator[Array]:
    """Yield the curves (k, 3) [m] of moves in the base, without corners.

    Moves in moving frames have no such curve.
    """
    joints = run.samples.joints[0]
    pose = _Pose(joints, run.robot.kinematics.forward(joints), Transform.identity())
    for part in run.robot_run.moves.columns.rows.parts:
        if isinstance(part, SettledLines) and _has_static_frames(run, part.rows.like):
            yield np.concatenate([pose.start(part[0].tcp_from_flange)[None], part.end_m()])
            pose = _end_of(part[-1])
            continue
        for move in part:
            if _has_static_frames(run, move.move):
                yield _curve(run, pose, move)
            pose = _end_of(move)


def _end_of(move: MoveRow) -> _Pose:
    return _Pose(move.joints, move.base_from_tcp, move.tcp_from_flange)


def _curve(run: RecordedRobot, before: _Pose, move: MoveRow) -> Array:
    """Return the curve (k, 3) [m] of one move from a pose."""
    start, end = before.start(move.tcp_from_flange), move.base_from_tcp.translation
    match move.move.interpolation:
        case Interpolation.JOINT | Interpolation.AXES | Interpolation.EXTERNAL_AXES:
            share = np.linspace(0.0, 1.0, _CURVE_POINTS)[:, None]
            between = before.joints + share * (move.joints - before.joints)
            flange_from_tcp = move.tcp_from_flange.inverse()
            return (run.robot.kinematics.forward(between) @ flange_from_tcp).translation
        case Interpolation.LINE:
            return np.stack([start, end])
        case Interpolation.CIRCLE:
            return arc_through(start, _circle_point(run, move.move), end, _CURVE_POINTS)


def _has_static_frames(run: RecordedRobot, move: Move) -> bool:
    """Whether a move is in a static frame: tool held, work object and robot base static."""
    wobj = move.wobj
    return move.tool.robhold and not wobj.robhold and wobj.ufprog and not run.on_track


def _circle_point(run: RecordedRobot, move: Move) -> Array:
    assert move.circle_point is not None
    base_from_world = run.robot_run.world_from_base.inverse()
    via = base_from_tcp(move.circle_point, move.wobj, base_from_world)
    return via.translation


def _joined(curves: Iterator[Array]) -> list[Array]:
    """Return the curves as few strips: successive curves that meet are joined."""
    strips: list[list[Array]] = []
    for curve in curves:
        if strips and np.linalg.norm(strips[-1][-1][-1] - curve[0]) < _NO_STEP:
            strips[-1].append(curve[1:])
        else:
            strips.append([curve])
    return [np.concatenate(strip) for strip in strips]


def _travelled(run: RecordedRobot) -> dict[str, tuple[palette.Colour, list[Array]]]:
    """Return pieces of the travelled path by kind, in the order of first occurrence."""
    moves = run.robot_run.moves.columns.templates
    kinds = dict.fromkeys(move.instruction for move in moves)
    number_of = {name: number for number, name in enumerate((_CORNER, *kinds))}
    colour_of = {move.instruction: palette.of_move(move) for move in moves}
    colour_of[_CORNER] = palette.CORNER

    of_move = np.array([number_of[move.instruction] for move in moves])
    of_sample = np.where(run.sampled.in_corner, number_of[_CORNER], of_move[_move_index(run)])
    names = tuple(number_of)
    points = run.places
    pieces: dict[str, tuple[palette.Colour, list[Array]]] = {}
    jumped = jumps(run)
    bounds = np.flatnonzero((of_sample[1:] != of_sample[:-1]) | jumped) + 1
    for begin, end in pairwise([0, *bounds.tolist(), len(of_sample)]):
        # A piece ends at the start of the next one, so that the path has only real gaps.
        goes_on = end < len(of_sample) and not jumped[end - 1]
        piece = points[begin : end + 1] if goes_on else points[begin:end]
        if np.ptp(piece, axis=0).max() >= _NO_STEP:
            name = names[of_sample[begin]]
            pieces.setdefault(name, (colour_of[name], []))[1].append(piece)
    return pieces


def jumps(run: RecordedRobot) -> npt.NDArray[np.bool_]:
    """Mask (k - 1,) of steps between samples without a path: the tool was changed."""
    samples = run.samples
    step = np.linalg.norm(np.diff(run.places, axis=0), axis=1)
    faster = np.maximum(samples.tcp_speed[1:], samples.tcp_speed[:-1])
    jumped: npt.NDArray[np.bool_] = step > 2.0 * faster * np.diff(samples.times) + _JUMP
    return jumped


def _move_index(run: RecordedRobot) -> npt.NDArray[np.int64]:
    """Return the index of the active move (k,); the first before any."""
    return np.clip(run.samples.move, 0, len(run.robot_run.moves) - 1)
