"""Contacts and clearances of the bodies of a cell in a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from rapidsim.collisions.contact import Clearance, CollisionReport, Contact
from rapidsim.collisions.geometry import CellGeometry, CellObject
from rapidsim.collisions.scene import Body, Scene
from rapidsim.values import value_class

_WIDEST_M = 10.0
"""Wider objects are floors or walls, which would hide the rest of a picture."""


@value_class(frozen=True, slots=True, eq=False, repr=False)
class Collisions:
    """Contacts and clearances of a run."""

    geometry: CellGeometry
    """Bodies and settings of the station."""
    report: CollisionReport
    scene: Scene
    """The bodies, and the pairs of them that were checked."""
    remarks: tuple[str, ...]
    """Remarks on bodies and pairs that were not checked."""
    objects: Mapping[int, CellObject]
    """Objects of the station by their number among the bodies."""

    def __repr__(self) -> str:
        """One line."""
        return f"<{len(self.report.contacts)} contacts, {len(self.scene.pairs)} pairs judged>"

    @property
    def hits(self) -> tuple[Contact, ...]:
        """Contacts that begin during the run; an object lying on a table touched it before."""
        return tuple(one for one in self.report.contacts if not one.continued)

    def drawn_objects(self) -> Iterator[tuple[int, CellObject, Body]]:
        """Yield the objects that still pictures show, with their numbers among the bodies."""
        for number, one in self.objects.items():
            body = self.scene.bodies[number]
            if float(np.ptp(body.shape.vertices, axis=0).max()) <= _WIDEST_M:
                yield number, one, body

    @property
    def uncarried(self) -> Scene:
        """The same bodies, with only the pairs whose poses depend on the moves alone."""
        carried = {one.object.lower() for one in self.geometry.attachments}
        loose = {at for at, one in self.objects.items() if one.name.lower() in carried}
        loose |= {at for at, one in enumerate(self.scene.bodies) if len(one.carried) > 1}
        pairs = (one for one in self.scene.pairs if not {one.first, one.second} & loose)
        return replace(self.scene, pairs=tuple(pairs))

    @property
    def nearest(self) -> Clearance | None:
        """Smallest clearance of the whole run; None if no bodies came near each other."""
        return min(self.report.clearances, key=lambda one: one.distance_m, default=None)

    @property
    def hollow_m(self) -> float:
        """Largest amount [m] by which a body may be deeper than the shape that was checked."""
        return max((body.shape.hollow_m for body in self.scene.bodies), default=0.0)
