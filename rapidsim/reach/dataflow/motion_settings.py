"""Motion settings in static analysis: certain ones, and ones that may differ in a run.

Instructions such as ConfL, VelSet and PDispSet are the library's own; they are executed on a
`ControllerStub`.
"""

from __future__ import annotations

from dataclasses import field

from rapidsim.language.moves import MotionSettings
from rapidsim.values import value_class

DISPLACEMENTS = frozenset({"displacement", "axis_offsets"})
"""Settings without which all targets are unknown."""


@value_class(frozen=True, slots=True)
class KnownSettings:
    """Settings in effect at a statement."""

    settings: MotionSettings = field(default_factory=MotionSettings)
    uncertain: frozenset[str] = frozenset()
    """Fields that may have another value."""

    def forgetting(self, fields: frozenset[str]) -> KnownSettings:
        """Return these settings after an effect that may have set some fields."""
        return KnownSettings(self.settings, self.uncertain | fields) if fields else self

    def joined(self, other: KnownSettings) -> KnownSettings:
        """Return the settings at the join of two control-flow paths."""
        differing = frozenset(
            name
            for name in MotionSettings.__dataclass_fields__
            if getattr(self.settings, name) != getattr(other.settings, name)
        )
        return self.forgetting(other.uncertain | differing)
