"""CirPathMode in static analysis: reorientation of the tool on arcs, as far as it is certain."""

from __future__ import annotations

from rapidsim.controller.moves.move_data import circle_mode_of
from rapidsim.language.moves import Interpolation
from rapidsim.motion.geometry.segments import WRIST_PAIRS
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.known_moves import KnownMove


def is_wrist_driven(known_move: KnownMove, robot: Robot) -> bool:
    """Whether two wrist axes certainly orient a move, which then ends elsewhere than at its target.

    Moves of a carried work object are examined in runs only, so they are not considered here.
    """
    if known_move.move.interpolation is not Interpolation.CIRCLE:
        return False
    mode = circle_mode_of(known_move.move, known_move.settings, None, robot)
    return mode in WRIST_PAIRS and "circle_path" not in known_move.uncertain


def may_be_wrist_driven(known_move: KnownMove, robot: Robot) -> bool:
    """Whether two wrist axes orient a move, or may do so."""
    unsure = "circle_path" in known_move.uncertain
    arc = known_move.move.interpolation is Interpolation.CIRCLE
    return (arc and unsure) or is_wrist_driven(known_move, robot)
