"""Colours of a recording: one colour per meaning, in the cell, the plots and the lanes.

Chosen for the dark theme, and different enough to distinguish on a projector.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

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

JOINTS: tuple[Colour, ...] = (
    (239, 83, 80),
    (102, 187, 106),
    (66, 135, 245),
    (255, 202, 40),
    (186, 104, 200),
    (38, 198, 218),
    (255, 138, 101),
    (176, 190, 197),
)
"""Axes 1, 2, ...; the first two automatic colours would be nearly equal pinks."""

MOVES: Mapping[Interpolation, Colour] = MappingProxyType(
    {way: _rgb(kind.on_dark) for way, kind in MOVE_KINDS.items()}
)
CORNER = _rgb(move_kinds.CORNER.on_dark)
STANDSTILL: Colour = (62, 68, 80)
PROGRAMMED: Colour = (150, 158, 172)
"""Programmed path and speed, next to the executed ones."""
TCP_SPEED: Colour = (255, 152, 0)
LIMIT: Colour = (229, 57, 53)

TARGET: Colour = (240, 240, 245)
TARGET_NAME: Colour = (250, 230, 140)
FRAME_NAME: Colour = (160, 200, 235)
STOPPED: Colour = (255, 64, 64)
FAILED: Colour = (255, 64, 64)
"""Infeasible targets and paths, and the points of failure."""
WARNED: Colour = (255, 167, 38)
"""A target with a finding."""

SPEEDS: tuple[Colour, ...] = (
    (62, 38, 168),
    (64, 78, 230),
    (44, 123, 245),
    (18, 163, 220),
    (24, 190, 180),
    (80, 205, 110),
    (180, 205, 50),
    (250, 205, 50),
    (255, 140, 40),
    (255, 70, 70),
)
"""Colours from slow to fast, one per tenth of the range."""

SIGNAL_ON: Colour = (46, 180, 90)
SIGNAL_OFF: Colour = (70, 76, 88)
SIGNAL_VALUE: Colour = (60, 120, 160)

LINK: Colour = (240, 120, 30)
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
