"""Names of kinds of moves, by which page, recording and pictures colour them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from rapidsim.language.moves import Interpolation

CORNER: Final = "corner"
"""Corner path between two moves."""
MOVE_KINDS: Mapping[Interpolation, str] = MappingProxyType(
    {
        Interpolation.JOINT: "joint",
        Interpolation.AXES: "axes",
        Interpolation.EXTERNAL_AXES: "axes",
        Interpolation.LINE: "line",
        Interpolation.CIRCLE: "circle",
    }
)
DRAWN_KINDS = (*dict.fromkeys(MOVE_KINDS.values()), CORNER)
"""Each kind once, in the order of the table."""
