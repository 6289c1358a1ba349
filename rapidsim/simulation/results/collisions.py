"""Contacts and clearances of the bodies of a cell in a run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property

import numpy as np

from rapidsim.collisions.contact import Clearance, CollisionReport, Contact
from rapidsim.collisions.geometry import CellGeometry, CellObject
from rapidsim.collisions.scene import Body, Scene
from rapidsim.simulation.results.parts import PartCounts, PartEvent, part_counts
from rapidsim.values import value_class

_AT_ONCE_S = 0.5
_WIDEST_M = 10.0
"""Wider objects are floors or walls, which would hide the rest of a picture."""


@value_class(slots=True, eq=False)
class _Crash:
    """Contacts that belong together."""

    robot: int
    move: int
    """Its last move."""
    last_s: float
    """Time [s] of its last contact."""
    bodies: set[str]
    contacts: list[Contact]


@value_class(frozen=True, eq=False, repr=False)
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
    parts: tuple[int, ...]
    """Numbers of the bodies that grippers take."""
    part_events: tuple[PartEvent, ...]
    """Changes of their carriers in order of time."""

    def __repr__(self) -> str:
        """One line."""
        return f"<{len(self.report.contacts)} contacts, {self.pair_count} pairs judged>"

    @property
    def hits(self) -> tuple[Contact, ...]:
        """Contacts that begin during the run; an object lying on a table touched it before."""
        return tuple(one for one in self.report.contacts if not one.continued)

    @cached_property
    def crashes(self) -> tuple[tuple[Contact, ...], ...]:
        """Contacts that begin during the run, by crash."""
        return tuple(_crashes(self.report.contacts, self.part_events))

    @property
    def part_errors(self) -> tuple[PartEvent, ...]:
        """Events of parts that are errors of the program."""
        return tuple(one for one in self.part_events if one.violation is not None)

    def drawn_objects(self) -> Iterator[tuple[int, CellObject, Body]]:
        """Yield the objects that still pictures show, with their numbers among the bodies."""
        for number, one in self.objects.items():
            body = self.scene.bodies[number]
            if float(np.ptp(body.shape.vertices, axis=0).max()) <= _WIDEST_M:
                yield number, one, body

    @property
    def uncarried(self) -> Scene:
        """The same bodies, with only the pairs whose poses depend on the moves alone."""
        loose = {at for at, one in enumerate(self.scene.bodies) if len(one.carried) > 1}
        loose |= {*self.parts}
        pairs = (one for one in self.scene.pairs if not {one.first, one.second} & loose)
        return replace(self.scene, pairs=tuple(pairs))

    @property
    def part_counts(self) -> PartCounts:
        """Numbers of parts that were moved and lost."""
        bodies = (self.scene.bodies[part] for part in self.parts)
        total = sum(body.from_s < body.until_s for body in bodies)
        return part_counts(total, self.part_events)

    @property
    def pair_count(self) -> int:
        """Number of pairs of bodies that were checked."""
        return len({frozenset({one.first, one.second}) for one in self.scene.pairs})

    @property
    def nearest(self) -> Clearance | None:
        """Smallest clearance of the whole run; None if no bodies came near each other."""
        return min(self.report.clearances, key=lambda one: one.distance_m, default=None)

    @property
    def hollow_m(self) -> float:
        """Largest amount [m] by which a body may be deeper than the shape that was checked."""
        return max((body.shape.hollow_m for body in self.scene.bodies), default=0.0)


def _crashes(
    contacts: Iterable[Contact], events: Iterable[PartEvent]
) -> Iterator[tuple[Contact, ...]]:
    """Yield the contacts of each crash in order of time.

    A crash goes on while one of its bodies meets others within half a second, in the same move, or
    in the next one if they still touch. Parts that meet at a place that is taken are reported with
    that place.
    """
    taken = [event for event in events if event.meets]
    crashes: list[_Crash] = []
    for contact in contacts:
        names = {contact.first.name, contact.second.name}
        if any(
            names == {fault.part, fault.meets}
            and fault.time_s - fault.held_s <= contact.time_s <= fault.time_s
            for fault in taken
        ):
            continue
        crash = next(
            (
                crash
                for crash in reversed(crashes)
                if crash.bodies & names
                and (
                    contact.time_s <= crash.last_s + _AT_ONCE_S
                    or (
                        crash.robot == contact.robot
                        and crash.move >= contact.move - contact.continued
                    )
                )
            ),
            None,
        )
        if crash is None:
            crash = _Crash(contact.robot, contact.move, contact.time_s, set(), [])
            crashes.append(crash)
        if crash.robot == contact.robot:
            crash.move = max(crash.move, contact.move)
        crash.last_s = contact.time_s
        crash.bodies |= names
        if not contact.continued:
            crash.contacts.append(contact)
    yield from (tuple(crash.contacts) for crash in crashes if crash.contacts)
