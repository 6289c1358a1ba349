"""Options for the base of a robot and the tool; parsed late, as this imports NumPy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from rapidsim.cli.options.numbers import POSITIVE, numbers
from rapidsim.files import InputError

if TYPE_CHECKING:
    from rapidsim.frames.transform import Array, Transform

CONVENTIONS = ("zyx", "xyz", "zyz", "rpy")
UNIT_TOLERANCE = 1e-3

convention_option = click.option(
    "--convention",
    type=click.Choice(CONVENTIONS),
    default="zyx",
    show_default=True,
    help="Euler angles: zyx as in OrientZYX and KUKA's A,B,C; rpy about fixed axes.",
)
euler_option = click.option(
    "--euler", type=numbers(3), metavar="A,B,C", help="Euler angles [deg] by --convention."
)
base_option = click.option(
    "--base",
    metavar="floor|wall|ceiling|X,Y,Z[,Q1..Q4]",
    default="floor",
    show_default=True,
    help="How the robot is mounted in the world; positions are then in the world.",
)

line_option = click.option(
    "--line",
    type=numbers(6),
    metavar="X,Y,Z,X,Y,Z",
    help="Start and end of a line [mm]; --count points on it.",
)

scale_option = click.option(
    "--scale",
    type=POSITIVE,
    metavar="FACTOR",
    help="Scale lengths of a URDF file: 0.001 if they are in mm.",
)

_STANDS = {
    "floor": (1.0, 0.0, 0.0, 0.0),
    # Out of a wall the base looks along x of the world, its own x axis down.
    "wall": (0.5**0.5, 0.0, 0.5**0.5, 0.0),
    "ceiling": (0.0, 1.0, 0.0, 0.0),
}


def world_from_base(text: str) -> Transform:
    """world_from_base of an option.

    Raises:
        InputError: If the option is neither a pose nor a way of mounting.
    """
    if text.lower() in _STANDS:
        return pose((0.0, 0.0, 0.0), _STANDS[text.lower()], "--base")
    try:
        given = numbers(3, 7)(text)
    except click.BadParameter as error:
        raise InputError(
            f"--base: {error.message}",
            "floor, wall, ceiling, or a pose: X,Y,Z,Q1,Q2,Q3,Q4",
        ) from None
    return pose(given[:3], given[3:] or _STANDS["floor"], "--base")


def pose(position: tuple[float, ...], quaternion: tuple[float, ...], option: str) -> Transform:
    """A frame at a position [mm] with an attitude.

    Raises:
        InputError: If the quaternion is not one of a rotation.
    """
    import numpy as np

    from rapidsim.frames.transform import Transform

    length = float(np.linalg.norm(quaternion))
    if abs(length - 1.0) > UNIT_TOLERANCE:
        raise InputError(
            f"{option}: the quaternion has length {length:.4g}, not 1",
            "the scalar part comes first, as RAPID writes it",
        )
    return Transform.from_quaternion(quaternion, [value / 1000.0 for value in position])


def tool(values: tuple[float, ...] | None) -> Transform:
    """flange_from_tcp of `--tool`."""
    values = values or (0.0, 0.0, 0.0)
    return pose(values[:3], values[3:] or _STANDS["floor"], "--tool")


def line_points(line: tuple[float, ...], count: int) -> Array:
    """Places (count, 3) [mm] evenly from the first three numbers of `--line` to the last three.

    Raises:
        InputError: If there is only one.
    """
    import numpy as np

    if count < 2:
        raise InputError("a line needs at least two points", "set their number with --count")
    places: Array = np.linspace(line[:3], line[3:], count)
    return places
