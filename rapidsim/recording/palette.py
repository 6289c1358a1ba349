"""Colours of a recording: one colour per meaning, in the cell, the plots and the lanes.

Chosen for the dark theme, and different enough to distinguish on a projector.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rapidsim import colours
from rapidsim.colours import DARK
from rapidsim.language.moves import Interpolation, Move
from rapidsim.motion.timing.constraints import Quantity
from rapidsim.simulation.results import move_kinds
from rapidsim.simulation.results.move_kinds import MOVE_KINDS

Colour = tuple[int, int, int]


def _rgb(colour: str) -> Colour:
    red, green, blue = bytes.fromhex(colour[1:])
    return red, green, blue


BACKGROUND: Colour = (22, 25, 31)
GRID: Colour = (64, 72, 88)

JOINTS: tuple[Colour, ...] = tuple(map(_rgb, DARK.joints))
"""Axes 1, 2, ...; the first two automatic colours would be nearly equal pinks."""

MOVES: Mapping[Interpolation, Colour] = MappingProxyType(
    {way: _rgb(DARK.moves[kind]) for way, kind in MOVE_KINDS.items()}
)
CORNER = _rgb(DARK.moves[move_kinds.CORNER])
STANDSTILL: Colour = (62, 68, 80)
PROGRAMMED = _rgb(DARK.programmed)
"""Programmed path and speed, next to the executed ones."""
TCP_SPEED = _rgb(DARK.tcp)
LIMIT = _rgb(DARK.error)

TARGET: Colour = (240, 240, 245)
TARGET_NAME: Colour = (250, 230, 140)
FRAME_NAME: Colour = (160, 200, 235)
STOPPED = _rgb(DARK.error)
FAILED = _rgb(DARK.error)
"""Infeasible targets and paths, and the points of failure."""
WARNED = _rgb(DARK.warning)
"""A target with a finding."""

SPEEDS: tuple[Colour, ...] = tuple(map(_rgb, colours.SPEEDS))
"""Colours from slow to fast, one per tenth of the range."""

SIGNAL_ON = _rgb(DARK.good)
SIGNAL_OFF: Colour = (70, 76, 88)
SIGNAL_VALUE: Colour = (60, 120, 160)

LINK = _rgb(DARK.arm)
JOINT: Colour = (70, 74, 82)
TOOL: Colour = (190, 196, 206)
WORK_PLANE: Colour = (88, 104, 124)

AXES: tuple[Colour, Colour, Colour] = ((235, 70, 70), (80, 200, 90), (70, 130, 250))
"""x, y, z of a frame."""


def of_move(move: Move) -> Colour:
    """Return the colour of a move by its interpolation."""
    return MOVES[move.interpolation]


def darker(colour: Colour) -> Colour:
    """Return a darker shade of a colour."""
    red, green, blue = colour
    return (red * 7 // 10, green * 7 // 10, blue * 7 // 10)


def rgba(colour: Colour, alpha: int = 255) -> int:
    """Return a colour as the number 0xRRGGBBAA; short lists of numbers are ambiguous to rerun."""
    red, green, blue = colour
    return red << 24 | green << 16 | blue << 8 | alpha


def of_limit(quantity: Quantity, axis: int | None) -> Colour:
    """Return the colour of an active limit: that of its axis, if it is one of a single axis."""
    if axis is not None:
        return JOINTS[(axis - 1) % len(JOINTS)]
    return {Quantity.TCP_SPEED: TCP_SPEED, Quantity.CORNER: CORNER}.get(quantity, WARNED)
