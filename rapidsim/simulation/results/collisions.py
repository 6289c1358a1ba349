"""What the bodies of a cell touched in a run, and what was looked at."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from rapidsim.collisions.contact import Clearance, CollisionReport, Contact
from rapidsim.collisions.geometry import CellGeometry, CellObject
from rapidsim.collisions.scene import Body, Scene
from rapidsim.values import value_class

_WIDEST_M = 10.0
"""What is wider is a floor or a wall, which would hide the rest of a picture."""


@value_class(frozen=True, slots=True, eq=False, repr=False)
class Collisions:
    """Contacts and clearances of a run."""

    geometry: CellGeometry
    """What the station says."""
    report: CollisionReport
    scene: Scene
    """The bodies and the pairs of them that were judged."""
    remarks: tuple[str, ...]
    """What was not judged."""
    objects: Mapping[int, CellObject]
    """Objects of the station by their number among the bodies."""

    def __repr__(self) -> str:
        """One line."""
        return f"<{len(self.report.contacts)} contacts, {len(self.scene.pairs)} pairs judged>"

    @property
    def hits(self) -> tuple[Contact, ...]:
        """The contacts that begin in the run: what lies on a table touched it before."""
        return tuple(one for one in self.report.contacts if not one.continued)

    def drawn_objects(self) -> Iterator[tuple[int, CellObject, Body]]:
        """The objects that still pictures show, with their numbers among the bodies."""
        for number, one in self.objects.items():
            body = self.scene.bodies[number]
            if float(np.ptp(body.shape.vertices, axis=0).max()) <= _WIDEST_M:
                yield number, one, body

    @property
    def uncarried(self) -> Scene:
        """The same bodies, judged in those pairs whose places the moves alone say."""
        carried = {one.object.lower() for one in self.geometry.attachments}
        loose = {at for at, one in self.objects.items() if one.name.lower() in carried}
        loose |= {at for at, one in enumerate(self.scene.bodies) if len(one.carried) > 1}
        pairs = (one for one in self.scene.pairs if not {one.first, one.second} & loose)
        return replace(self.scene, pairs=tuple(pairs))

    @property
    def nearest(self) -> Clearance | None:
        """The nearest of the whole run; None where nothing came near."""
        return min(self.report.clearances, key=lambda one: one.distance_m, default=None)

    @property
    def hollow_m(self) -> float:
        """How much a body may be deeper than what was judged of it, at most."""
        return max((body.shape.hollow_m for body in self.scene.bodies), default=0.0)
