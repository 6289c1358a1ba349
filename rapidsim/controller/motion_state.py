"""What stays from one move of a task to the next."""

from __future__ import annotations

from dataclasses import dataclass, field

from rapidsim.language.data import TOOL0, WOBJ0, ToolData, WobjData
from rapidsim.language.moves import MotionSettings, Move


@dataclass(slots=True, eq=False)
class MotionState:
    """The settings of a task's motion, and what its last move used."""

    settings: MotionSettings = field(default_factory=MotionSettings)
    tool: ToolData = TOOL0
    wobj: WobjData = WOBJ0
    concurrent: int = 0
    r"""Moves with \Conc since the last without."""

    def use(self, move: Move) -> None:
        """Keep tool and work object of a move."""
        self.tool, self.wobj = move.tool, move.wobj
