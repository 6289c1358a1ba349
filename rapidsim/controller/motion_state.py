"""State of a task's motion that persists from move to move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rapidsim.language.data import TOOL0, WOBJ0, Pos, ToolData, WobjData
from rapidsim.language.moves import MotionSettings, Move


@dataclass(slots=True, eq=False)
class MotionState:
    """The settings of a task's motion, and the data of its last move."""

    settings: MotionSettings = field(default_factory=MotionSettings)
    tool: ToolData = TOOL0
    wobj: WobjData = WOBJ0
    concurrent: int = 0
    r"""Moves with \Conc since the last without."""

    searches: bool = False
    """Whether a search is in progress."""

    corrections: dict[int, Pos] = field(default_factory=dict)
    """Offset of the path [mm] by each connected correction generator."""
    tool_name: str = "tool0"
    wobj_name: str = "wobj0"

    def use(self, move: Move, arguments: Mapping[str, str]) -> None:
        """Store the tool and work object of a move, and their names in its call."""
        self.tool, self.wobj = move.tool, move.wobj
        self.tool_name = arguments.get("tool", self.tool_name)
        if "tool" in arguments:
            self.wobj_name = arguments.get("wobj", "wobj0")
