"""Names and colours of kinds of moves, common to page, recording and pictures."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from rapidsim.language.moves import Interpolation
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class MoveKind:
    """A kind of move with its colours, in the notation of a style sheet."""

    name: str
    on_light: str
    on_dark: str


_AXES = MoveKind("axes", "#6a5be8", "#9184ff")
CORNER = MoveKind("corner", "#e08a00", "#ffc107")
"""Corner path between two moves."""
MOVE_KINDS: Mapping[Interpolation, MoveKind] = MappingProxyType(
    {
        Interpolation.JOINT: MoveKind("joint", "#2f6fe0", "#5b96ff"),
        Interpolation.AXES: _AXES,
        Interpolation.EXTERNAL_AXES: _AXES,
        Interpolation.LINE: MoveKind("line", "#14954f", "#3fd07c"),
        Interpolation.CIRCLE: MoveKind("circle", "#b53bb8", "#e26be4"),
    }
)
DRAWN_KINDS = (*dict.fromkeys(MOVE_KINDS.values()), CORNER)
"""Each kind once, in the order of the table."""
