"""MoveJ against MoveL: the way that each would take to the same target.

Between two targets MoveJ turns all joints in proportion, which is quick and not straight; MoveL
keeps the TCP on the line. Shown for the move of the program that reaches farthest.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.figure import Figure

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.frames.transform import Array
from rapidsim.language.moves import Interpolation
from rapidsim.library.motion import PLAIN_MOVES
from rapidsim.plots.drawn import MM, target_name, title_of
from rapidsim.plots.look import Theme, new_figure
from rapidsim.simulation.results.sampling import SampledRun

_POINTS = 101


def comparison_picture(run: SampledRun, theme: Theme) -> Figure | None:
    """Both ways from two sides, and how far apart they are; None where nothing moves far."""
    ways = [_ways(run, before, move) for before, move in _pairs(run)]
    if not ways:
        return None
    longest = max(ways, key=lambda way: float(np.linalg.norm(way[1][-1] - way[1][0])))
    move, line, joint = longest
    name = f"{target_name(move)} (line {move.place.span.line})"
    figure = new_figure(f"MoveJ and MoveL to {name}: {title_of(run)}", width=11.0, height=4.3)
    above, side, apart = figure.subplots(1, 3)
    for axes, (first, second), title in (
        (above, (0, 1), "from above"),
        (side, (0, 2), "from the side"),
    ):
        for way, kind in ((joint, Interpolation.JOINT), (line, Interpolation.LINE)):
            label = PLAIN_MOVES[kind]
            axes.plot(way[:, first], way[:, second], color=theme.moves[kind], label=label)
        axes.plot(line[[0, -1], first], line[[0, -1], second], "o", color=theme.ink, markersize=3)
        axes.set_title(title)
        axes.set_xlabel(f"{'xyz'[first]} [mm]")
        axes.set_ylabel(f"{'xyz'[second]} [mm]")
        axes.set_aspect("equal", adjustable="datalim")
    above.legend()
    distance = _distance_to_chord(joint, line[0], line[-1])
    apart.plot(np.linspace(0.0, 100.0, _POINTS), distance, color=theme.moves[Interpolation.JOINT])
    apart.set_title(f"MoveJ leaves the line by up to {distance.max():.1f} mm")
    apart.set_xlabel("way [%]")
    apart.set_ylabel("distance from the line [mm]")
    apart.set_ylim(bottom=0.0)
    return figure


def _pairs(run: SampledRun) -> list[tuple[ExecutedMove, ExecutedMove]]:
    """Moves with the move before them, where the tool is the same and the TCP goes somewhere."""
    moves = run.one.moves
    return [
        (before, move)
        for before, move in pairwise(moves)
        if before.move.tool == move.move.tool
        and move.length_m > 0.0
        # Where a track or a positioner moves, the line is none in the base.
        and not run.one.robot.external
    ]


def _ways(
    run: SampledRun, before: ExecutedMove, move: ExecutedMove
) -> tuple[ExecutedMove, Array, Array]:
    """The straight way and the way of proportional joints, (k, 3) [mm] each."""
    share = np.linspace(0.0, 1.0, _POINTS)[:, None]
    start, end = before.base_from_tcp.translation, move.base_from_tcp.translation
    joints = before.joints + share * (move.joints - before.joints)
    base_from_flange = run.one.robot.kinematics.forward(joints)
    joint = (base_from_flange @ move.tcp_from_flange.inverse()).translation
    return move, MM * (start + share * (end - start)), MM * joint


def _distance_to_chord(way: Array, start: Array, end: Array) -> Array:
    """Distance (k,) of points (k, 3) from the line through two places (3,)."""
    chord = end - start
    length = float(np.linalg.norm(chord))
    if length == 0.0:
        distance: Array = np.linalg.norm(way - start, axis=1)
    else:
        distance = np.linalg.norm(np.cross(way - start, chord), axis=1) / length
    return distance
