"""How the tool turns on the arcs of a program that is not running: what CirPathMode surely says."""

from __future__ import annotations

from rapidsim.controller.moves.move_data import circle_mode_of
from rapidsim.language.moves import Interpolation
from rapidsim.motion.geometry.segments import WRIST_PAIRS, CircleMode
from rapidsim.motion.geometry.wrist_pair import wrist_meets
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.dataflow.known_moves import KnownMove


def mode_of(known: KnownMove, robot: Robot) -> CircleMode:
    """How the tool turns on an arc; as by default where it is not sure that two wrist axes lead."""
    if known.move.interpolation is not Interpolation.CIRCLE:
        return CircleMode.PATH_FRAME
    mode = circle_mode_of(known.move, known.settings)
    if mode not in WRIST_PAIRS:
        return mode
    sure = "circle_path" not in known.uncertain and wrist_meets(robot.kinematics, robot.start)
    return mode if sure else CircleMode.PATH_FRAME


def led_by_wrist(known: KnownMove, robot: Robot) -> bool:
    """Whether two wrist axes lead a move, which then ends elsewhere than its target is."""
    return mode_of(known, robot) in WRIST_PAIRS


def may_be_led_by_wrist(known: KnownMove, robot: Robot) -> bool:
    """Whether two wrist axes lead a move, or nobody knows whether they do."""
    unsure = "circle_path" in known.uncertain
    arc = known.move.interpolation is Interpolation.CIRCLE
    return (arc and unsure) or led_by_wrist(known, robot)
