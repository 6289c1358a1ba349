"""How the tool turns on the arcs of a program that is not running: what CirPathMode surely says."""

from __future__ import annotations

from rapidsim.controller.moves.move_data import circle_mode_of
from rapidsim.language.moves import Interpolation
from rapidsim.motion.geometry.segments import WRIST_PAIRS
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.known_moves import KnownMove


def led_by_wrist(known: KnownMove, robot: Robot) -> bool:
    """Whether two wrist axes lead a move for sure, which then ends elsewhere than its target is.

    Moves of a carried work object are looked at by runs alone, so none is asked for here.
    """
    if known.move.interpolation is not Interpolation.CIRCLE:
        return False
    mode = circle_mode_of(known.move, known.settings, None, robot)
    return mode in WRIST_PAIRS and "circle_path" not in known.uncertain


def may_be_led_by_wrist(known: KnownMove, robot: Robot) -> bool:
    """Whether two wrist axes lead a move, or nobody knows whether they do."""
    unsure = "circle_path" in known.uncertain
    arc = known.move.interpolation is Interpolation.CIRCLE
    return (arc and unsure) or led_by_wrist(known, robot)
