"""What the bodies of a cell touched in a run, and what was looked at."""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.collisions.contact import Clearance, Contact, Found
from rapidsim.collisions.geometry import CellGeometry, CellObject
from rapidsim.collisions.scene import Scene
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Collisions:
    """Contacts and clearances of a run."""

    geometry: CellGeometry
    """What the station says."""
    found: Found
    scene: Scene
    """The bodies and the pairs of them that were judged."""
    remarks: tuple[str, ...]
    """What was not judged."""
    objects: Mapping[int, CellObject]
    """Objects of the station by their number among the bodies."""

    def __repr__(self) -> str:
        """One line."""
        return f"<{len(self.found.contacts)} contacts, {len(self.scene.pairs)} pairs judged>"

    @property
    def hits(self) -> tuple[Contact, ...]:
        """The contacts that begin in the run: what lies on a table touched it before."""
        return tuple(one for one in self.found.contacts if not one.continued)

    @property
    def nearest(self) -> Clearance | None:
        """The nearest of the whole run; None where nothing came near."""
        return min(self.found.clearances, key=lambda one: one.distance_m, default=None)

    @property
    def hollow_m(self) -> float:
        """How much a body may be deeper than what was judged of it, at most."""
        return max((body.shape.hollow_m for body in self.scene.bodies), default=0.0)
