"""The path in the cell: as programmed, thin, and as travelled, in the colour of the move.

Where a corner was cut the travelled path has the corner's colour.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import numpy.typing as npt
import rerun as rr

from rapidsim.frames.transform import Array
from rapidsim.language.controller import Interpolation
from rapidsim.motion.targets import base_from_tcp
from rapidsim.recording import palette
from rapidsim.recording.circle import arc_through
from rapidsim.recording.sampled import SampledRun
from rapidsim.recording.transforms import BASE, BASE_FROM_WORLD
from rapidsim.simulation.result import CornerKind, ExecutedMove

PROGRAMMED = "path/programmed"
TRAVELLED = "path/travelled"

_CURVE_POINTS = 48
"""Points that make a joint move or an arc look round."""
_STANDSTILL = 1e-6
"""[m]; shorter steps do not show."""


def log_paths(stream: rr.RecordingStream, run: SampledRun) -> None:
    """Log both paths of a run."""
    strips = list(programmed(run))
    if strips:
        stream.log(
            PROGRAMMED,
            rr.CoordinateFrame(BASE),
            rr.LineStrips3D(
                strips,
                radii=rr.Radius.ui_points(0.8),
                colors=palette.rgba(palette.PROGRAMMED, 150),
            ),
            static=True,
        )
    for name, (colour, pieces) in _travelled(run).items():
        stream.log(
            f"{TRAVELLED}/{name}",
            rr.CoordinateFrame(BASE),
            rr.LineStrips3D(pieces, radii=rr.Radius.ui_points(2.2), colors=palette.rgba(colour)),
            static=True,
        )


def programmed(run: SampledRun) -> Iterator[Array]:
    """The curve (k, 3) [m] of each move in the base, corners not cut."""
    kinematics = run.simulation.robot.kinematics
    joints = run.samples.joints[0]
    flange = kinematics.forward(joints)
    for move in run.simulation.moves:
        flange_from_tcp = move.tcp_from_flange.inverse()
        start = flange.apply(flange_from_tcp.translation)
        end = move.base_from_tcp.translation
        match move.move.interpolation:
            case Interpolation.JOINT | Interpolation.AXES:
                share = np.linspace(0.0, 1.0, _CURVE_POINTS)[:, None]
                between = joints + share * (move.joints - joints)
                yield (kinematics.forward(between) @ flange_from_tcp).translation
            case Interpolation.LINE:
                yield np.stack([start, end])
            case Interpolation.CIRCLE:
                yield arc_through(start, _circle_point(move), end, _CURVE_POINTS)
        joints = move.joints
        flange = move.base_from_tcp @ move.tcp_from_flange


def _circle_point(move: ExecutedMove) -> Array:
    assert move.move.circle_point is not None
    via = base_from_tcp(move.move.circle_point, move.move.wobj, BASE_FROM_WORLD)
    return via.translation


def _travelled(run: SampledRun) -> dict[str, tuple[palette.Colour, list[Array]]]:
    """Pieces of the travelled path by what they are, in the order they first occur."""
    samples = run.samples
    moves = run.simulation.moves
    points = samples.base_from_tcp.translation
    kinds = _kinds(run)
    pieces: dict[str, tuple[palette.Colour, list[Array]]] = {}
    changes = np.flatnonzero(kinds[1:] != kinds[:-1]) + 1
    bounds = [0, *changes.tolist(), len(kinds)]
    for begin, end in pairwise(bounds):
        move_index = int(samples.move[begin])
        if not 0 <= move_index < len(moves):
            continue
        move = moves[move_index]
        corner = bool(kinds[begin] % 2)
        name = "corner" if corner else move.move.instruction
        colour = palette.CORNER if corner else palette.of_move(move)
        # A piece ends where the next one begins, so that the path has no gaps.
        piece = points[begin : end + 1]
        if np.ptp(piece, axis=0).max() < _STANDSTILL:
            continue
        pieces.setdefault(name, (colour, []))[1].append(piece)
    return pieces


def _kinds(run: SampledRun) -> npt.NDArray[np.int64]:
    """A number for each sample (k,), equal for neighbours of one move; odd within a corner."""
    samples = run.samples
    kinds = 2 * samples.move
    rows_of = defaultdict[int, slice](lambda: slice(0, 0))
    moves = run.simulation.moves
    edges = np.searchsorted(samples.move, np.arange(len(moves) + 1))
    for move in moves:
        rows_of[move.index] = slice(int(edges[move.index]), int(edges[move.index + 1]))
    points = samples.base_from_tcp.translation
    for move in moves:
        if move.corner is not CornerKind.FLY_BY or move.zone_m <= 0.0:
            continue
        for index in (move.index, move.index + 1):
            rows = rows_of[index]
            distance = np.linalg.norm(points[rows] - move.base_from_tcp.translation, axis=1)
            kinds[rows] |= (distance < move.zone_m).astype(np.int64)
    return kinds
