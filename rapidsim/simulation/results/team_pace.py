"""Robot and programmed speed that set the pace of robots that move together."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.motion.timing.constraints import Quantity
from rapidsim.motion.trajectory.command import Piece
from rapidsim.simulation.results.simulation import RobotRun, Simulation


def pace_setters(simulation: Simulation, robot_run: RobotRun) -> tuple[str, ...]:
    """Return what sets the pace of each move of a robot, such as `TCP speed of T_ROB2, 200 mm/s`.

    Empty for moves that it makes alone, and for those that another limit makes slower.
    """
    texts = [""] * len(robot_run.moves)
    for piece in robot_run.trajectory.pieces:
        team: list[tuple[RobotRun, Piece]] = []
        for k, limiter in enumerate(piece.timing.limited_by):
            if limiter.robot is None or not 0 <= piece.first + k < len(texts):
                continue
            team = team or list(_team_of(simulation, piece))
            setter, its_piece = team[limiter.robot]
            move = setter.move(its_piece.first + k)
            if move is not None:
                programmed = _programmed(limiter.quantity, move)
                texts[piece.first + k] = f"{limiter} of {setter.task}, {programmed}"
    return tuple(texts)


def _team_of(simulation: Simulation, piece: Piece) -> Iterator[tuple[RobotRun, Piece]]:
    """Yield the robots of a team, in its order, with the same piece of their motion."""
    for one in simulation.robots:
        times = np.array([each.start_time for each in one.trajectory.pieces])
        # Commands of different arms differ by less than the duration of their smoothing.
        for at in np.flatnonzero(np.abs(times - piece.start_time) < 1.0).tolist():
            if one.trajectory.pieces[at].timing is piece.timing:
                yield one, one.trajectory.pieces[at]
                break


def _programmed(quantity: Quantity, move: ExecutedMove) -> str:
    match quantity:
        case Quantity.DURATION:
            return f"{move.move.duration_s:g} s"
        case Quantity.REORIENTATION_SPEED:
            return f"{move.move.speed.v_ori:g} deg/s"
        case _:
            return f"{move.move.speed.v_tcp:g} mm/s"
