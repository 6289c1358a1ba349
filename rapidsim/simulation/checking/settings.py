"""Motion settings of a program that is not running: what is set for sure, and what may be.

Instructions such as ConfL, VelSet and PDispSet are the library's own; they are run against a
recorder that has settings, takes moves, and refuses whatever asks for a robot.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NoReturn

from rapidsim.language.controller import MotionSettings, Move
from rapidsim.language.data import ToolData, WobjData

DISPLACEMENTS = frozenset({"displacement", "axis_offsets"})
"""Settings without which no target is known."""

_DISPLACEMENT = ("displacement",)
_OFFSETS = ("axis_offsets",)
_FIELDS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "accset": ("acceleration_percent", "ramp_percent", "fine_ramp_percent"),
        "cirpathmode": ("circle_path",),
        "confj": ("conf_j",),
        "confl": ("conf_l",),
        "eoffsoff": _OFFSETS,
        "eoffson": _OFFSETS,
        "eoffsset": _OFFSETS,
        "pdispoff": _DISPLACEMENT,
        "pdispon": _DISPLACEMENT,
        "pdispset": _DISPLACEMENT,
        "singarea": ("singular_area",),
        "velset": ("speed_override_percent", "max_speed_mm_s"),
    }
)


class NeedsRunError(Exception):
    """An instruction asked something of the controller that only a run can answer."""


def fields_set_by(instruction: str) -> tuple[str, ...]:
    """The settings that an instruction, by folded name, changes."""
    return _FIELDS.get(instruction, ())


@dataclass(frozen=True, slots=True)
class KnownSettings:
    """The settings where a statement stands."""

    settings: MotionSettings = field(default_factory=MotionSettings)
    uncertain: frozenset[str] = frozenset()
    """Fields that may hold something else."""

    def forgetting(self, fields: frozenset[str]) -> KnownSettings:
        """The same after something that may have set some fields."""
        return KnownSettings(self.settings, self.uncertain | fields) if fields else self

    def joined(self, other: KnownSettings) -> KnownSettings:
        """The settings where two ways through a program meet."""
        differing = frozenset(
            name
            for name in MotionSettings.__dataclass_fields__
            if getattr(self.settings, name) != getattr(other.settings, name)
        )
        return self.forgetting(other.uncertain | differing)


@dataclass(slots=True)
class Recorder:
    """Stands for the controller: keeps settings, takes moves, and knows nothing of a robot."""

    settings: MotionSettings
    moves: list[Move] = field(default_factory=list)
    left: int = 0
    place: object = None
    errno: float = 0.0
    intno: float = 0.0

    def move(self, move: Move) -> None:
        """Keep a move."""
        self.moves.append(move)

    def not_simulated(self, routine: str, treated_as: str) -> None:
        """The run that meets it says so."""

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Outputs change nothing about the moves."""

    def active_tool(self) -> ToolData:
        """Refuse: the last move may have been anywhere."""
        raise NeedsRunError

    def active_wobj(self) -> WobjData:
        """Refuse: the last move may have been anywhere."""
        raise NeedsRunError

    def __getattr__(self, name: str) -> NoReturn:
        """Refuse whatever a run would have to answer."""
        raise NeedsRunError(name)
