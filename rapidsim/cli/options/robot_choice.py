"""Open the robot a command is to use; imports NumPy, so commands import it late."""

from __future__ import annotations

from rapidsim.cli.terminal import echo
from rapidsim.files import DESCRIPTIONS, InputError
from rapidsim.motion.robot.catalogue import RobotError
from rapidsim.motion.robot.robot import Robot, load_robot


def open_robot(name: str, scale: float | None = None) -> Robot:
    """Load an arm as `robot_of`, and print notes on it on stderr."""
    robot = robot_of(name, scale)
    for notice in robot.notices:
        echo(f"note: {notice}", err=True)
    return robot


def robot_of(name: str, scale: float | None = None) -> Robot:
    """A robot of the catalogue or of a URDF file.

    Args:
        name: As the user named it.
        scale: What lengths of a URDF file are multiplied by.

    Raises:
        InputError: If it is unknown, unreadable, or not supported.
    """
    try:
        return load_robot(name, scale=scale)
    except RobotError as error:
        is_file = name.lower().endswith(DESCRIPTIONS)
        help = None if is_file else "`rapidsim robots` lists the catalogue"
        raise InputError(str(error), help, error.similar) from error
