"""Motion settings of a program that is not running: what is set for sure, and what may be.

Instructions such as ConfL, VelSet and PDispSet are the library's own; they are run against a
`Recorder`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from rapidsim.language.moves import MotionSettings

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
