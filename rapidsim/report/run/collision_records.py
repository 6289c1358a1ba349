"""Contacts and clearances of a run as records in mm and seconds, as the JSON has them."""

from __future__ import annotations

from collections.abc import Sequence
from operator import attrgetter
from typing import Annotated

import numpy as np

from rapidsim.collisions.contact import Clearance, Contact
from rapidsim.frames.transform import Array, Transform
from rapidsim.json_records.declarations import Key, OrAbsent, Rounded
from rapidsim.report.run.records import PoseRecord
from rapidsim.simulation.results.collisions import Collisions
from rapidsim.simulation.results.part_statements import place_of
from rapidsim.simulation.results.parts import PartChange
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class

_MM = 1000.0


@value_class(frozen=True, slots=True)
class ContactRecord:
    """Two bodies touched."""

    time_s: Rounded
    first: str
    second: str
    task: str
    """Robot of the move."""
    move: int
    """Its index among all moves."""
    file: str | None
    line: int | None
    routine: str | None
    point_mm: tuple[Rounded, ...]
    """Position in the world."""
    depth_mm: Rounded | None
    """Greatest penetration depth during the move; None after many contacts."""
    continued: bool
    """Whether they touched when the move began."""
    tcp: PoseRecord
    """Position of the TCP."""


@value_class(frozen=True, slots=True)
class ClearanceRecord:
    """Least distance of bodies in one move."""

    distance_mm: Rounded
    time_s: Rounded
    first: str
    second: str
    task: str
    move: int
    file: str | None
    line: int | None
    routine: str | None
    point_mm: tuple[Rounded, ...]
    """Position in the world, on the second body."""


@value_class(frozen=True, slots=True)
class PartEventRecord:
    """A part changed its carrier, or a gripper closed on nothing."""

    time_s: Rounded
    change: PartChange
    part: str
    """Its name; empty if a gripper closed on nothing."""
    carrier: str
    """The gripper, or the body on which it rests; empty in the air."""
    task: str
    """Robot of the gripper; the first one if there is none."""
    file: str | None
    line: int | None
    routine: str | None


@value_class(frozen=True, slots=True)
class PartsRecord:
    """The parts of a run."""

    total: Annotated[int, Key("made")]
    """All parts."""
    moved: int
    """Parts that were put down somewhere."""
    delivered: int
    """Parts that disappeared at a sink."""
    lost: int
    """Parts that were dropped and not taken again."""
    events: tuple[PartEventRecord, ...]
    """Changes of their carriers in order of time."""


@value_class(frozen=True, slots=True)
class RunCollisions:
    """Contacts and clearances of a run; absent if the station has no bodies."""

    collisions: tuple[ContactRecord, ...]
    """Contacts in order of time."""
    clearance_mm: Rounded | None
    """Least clearance of the run; null if no body came near."""
    clearances: tuple[ClearanceRecord, ...]
    """Least clearance of each move with a body nearby, the worst first."""
    not_judged: tuple[str, ...]
    """Parts of the cell without a search for contacts."""
    parts: OrAbsent[PartsRecord] = None
    """Parts that grippers take; absent if the station has none."""


def run_collisions(simulation: Simulation) -> RunCollisions | None:
    """Contacts and least clearances; None if the station has no bodies."""
    collisions = simulation.collisions
    if collisions is None:
        return None
    nearest = collisions.nearest
    return RunCollisions(
        contact_records(simulation),
        None if nearest is None else nearest.distance_m * _MM,
        clearance_records(simulation),
        tuple(collisions.remarks),
        _parts(simulation, collisions) if collisions.parts else None,
    )


def _parts(simulation: Simulation, collisions: Collisions) -> PartsRecord:
    counts, events = collisions.part_counts, part_event_records(simulation, collisions)
    return PartsRecord(counts.total, counts.moved, counts.delivered, counts.lost, events)


def part_event_records(
    simulation: Simulation, collisions: Collisions
) -> tuple[PartEventRecord, ...]:
    """The events of parts in order of time."""
    records = []
    for one in collisions.part_events:
        task, place = simulation.robots[one.robot].task, place_of(simulation, one)
        file, line, routine = (
            (None, None, None)
            if place is None
            else (place.span.file, place.span.line, place.routine)
        )
        names = (one.change, one.part, one.carrier)
        records.append(PartEventRecord(one.time_s, *names, task, file, line, routine))
    return tuple(records)


def contact_records(simulation: Simulation) -> tuple[ContactRecord, ...]:
    """The contacts of a run in order of time; none where nothing is judged."""
    found = simulation.collisions
    return () if found is None else _records(simulation, found.report.contacts)


def crash_records(simulation: Simulation) -> tuple[ContactRecord, ...]:
    """The contact that each crash begins with, in order of time; all contacts if none is one."""
    found = simulation.collisions
    if found is None:
        return ()
    begins = [first for first, *_ in found.crashes]
    return _records(simulation, sorted(begins, key=attrgetter("time_s")) or found.hits)


def _records(simulation: Simulation, contacts: Sequence[Contact]) -> tuple[ContactRecord, ...]:
    poses: list[Transform] = [Transform.identity()] * len(contacts)
    for number, robot in enumerate(simulation.robots):
        rows = [row for row, one in enumerate(contacts) if one.robot == number]
        at = robot.sample(np.array([contacts[row].time_s for row in rows])).base_from_tcp
        for k, row in enumerate(rows):
            poses[row] = at[k]
    return tuple(_contact(simulation, one, pose) for one, pose in zip(contacts, poses, strict=True))


def clearance_records(simulation: Simulation) -> tuple[ClearanceRecord, ...]:
    """Least clearance of each move with a body nearby, the worst first."""
    if simulation.collisions is None:
        return ()
    found = simulation.collisions.report.clearances
    nearest_first = sorted(found, key=lambda one: (one.distance_m, one.time_s))
    return tuple(_clearance(simulation, one) for one in nearest_first)


def _contact(simulation: Simulation, contact: Contact, pose: Transform) -> ContactRecord:
    tcp = PoseRecord(_mm(pose.translation), tuple(pose.quaternion.tolist()), "base")
    task, move, file, line, routine = _place(simulation, contact.robot, contact.move)
    return ContactRecord(
        time_s=contact.time_s,
        first=contact.first.name,
        second=contact.second.name,
        task=task,
        move=move,
        file=file,
        line=line,
        routine=routine,
        point_mm=_mm(contact.point),
        depth_mm=None if contact.depth_m is None else contact.depth_m * _MM,
        continued=contact.continued,
        tcp=tcp,
    )


def _clearance(simulation: Simulation, clearance: Clearance) -> ClearanceRecord:
    task, move, file, line, routine = _place(simulation, clearance.robot, clearance.move)
    return ClearanceRecord(
        distance_mm=clearance.distance_m * _MM,
        time_s=clearance.time_s,
        first=clearance.first.name,
        second=clearance.second.name,
        task=task,
        move=move,
        file=file,
        line=line,
        routine=routine,
        point_mm=_mm(clearance.point),
    )


def _place(
    simulation: Simulation, robot: int, move: int
) -> tuple[str, int, str | None, int | None, str | None]:
    """Task, number among all moves, file, line and routine of a move of one robot."""
    one = simulation.robots[robot]
    index = simulation.move_offsets[robot] + move
    made = one.move(move)
    if made is None:
        return one.task, index, None, None, None
    return one.task, index, made.place.span.file, made.place.span.line, made.place.routine


def _mm(point: Array) -> tuple[float, ...]:
    return tuple((point * _MM).tolist())
