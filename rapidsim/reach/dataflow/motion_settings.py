"""Motion settings of a program that is not running: which are certain, and which may differ.

Instructions such as ConfL, VelSet and PDispSet are the library's own; they are run against a
`Recorder`.
"""

from __future__ import annotations

from dataclasses import field

from rapidsim.language.moves import MotionSettings
from rapidsim.values import value_class

DISPLACEMENTS = frozenset({"displacement", "axis_offsets"})
"""Settings without which no target is known."""


@value_class(frozen=True, slots=True)
class KnownSettings:
    """The settings in force at a statement."""

    settings: MotionSettings = field(default_factory=MotionSettings)
    uncertain: frozenset[str] = frozenset()
    """Fields that may hold something else."""

    def forgetting(self, fields: frozenset[str]) -> KnownSettings:
        """These settings after something that may have set some fields."""
        return KnownSettings(self.settings, self.uncertain | fields) if fields else self

    def joined(self, other: KnownSettings) -> KnownSettings:
        """The settings where two control-flow paths join."""
        differing = frozenset(
            name
            for name in MotionSettings.__dataclass_fields__
            if getattr(self.settings, name) != getattr(other.settings, name)
        )
        return self.forgetting(other.uncertain | differing)
