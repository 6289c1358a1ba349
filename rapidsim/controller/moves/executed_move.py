"""A move as executed."""

from __future__ import annotations

from dataclasses import field
from enum import StrEnum

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import ConfData
from rapidsim.language.moves import Move, Place
from rapidsim.values import value_class


class CornerKind(StrEnum):
    """Type of the executed end of a move."""

    FLY_BY = "fly-by"
    STOP = "stop"
    STOP_CORNER_PATH_FAILURE = "stop(corner path failure)"


@value_class(frozen=True, slots=True, eq=False, repr=False)
class ExecutedMove:
    """A move as executed; target, joints and configuration are its programmed end."""

    index: int
    task: str
    move: Move
    place: Place
    corner: CornerKind
    zone_m: float
    """Radius of the zone as executed; 0 for a stop."""
    start_s: float
    end_s: float
    length_m: float
    """Along the programmed path, before corners are cut."""
    base_from_tcp: Transform
    tcp_from_flange: Transform
    joints: Array
    """Shape (n,) [rad]."""
    conf: ConfData
    corner_reason: str = ""
    """Reason why the zone is not the programmed one, or why the arm stops; else empty."""
    external: Array = field(default_factory=lambda: np.zeros(0))
    """Shape (e,) [m or rad]: the external axes at the end."""
    grip_load_kg: float = 0.0
    """Mass that the gripper holds, by GripLoad."""
    conveyor: str | None = None
    """Unit of the conveyor whose object the arm follows at the end."""

    def __repr__(self) -> str:
        """One line."""
        when = f"{self.start_s:.3f} to {self.end_s:.3f} s"
        return f"<{self.move.instruction} at {self.place.span!r}, {when}>"
