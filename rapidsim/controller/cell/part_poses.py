"""Poses of parts that a torch searches."""

from __future__ import annotations

from rapidsim.language.data import Pose
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class PartPose:
    """Pose of a part in the work object in which it was taught."""

    pose: Pose
    wobj: str | None = None
    """The work object of the searches; None for all."""
    search: str | None = None
    """The `\\SearchName` of the search; None for all."""

    def applies_to(self, wobj: str, search: str) -> bool:
        """Whether a search in a work object, with a name or none, meets this part."""
        return (self.wobj is None or self.wobj.lower() == wobj.lower()) and (
            self.search is None or self.search.lower() == search.lower()
        )
