"""Actors on the parts of a run, from the tables of the station: holders, sources, sinks."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.collisions.geometry import Attachment, CellGeometry, ParentKind
from rapidsim.collisions.scene import SceneFrame
from rapidsim.controller.cell.conditions import read_condition
from rapidsim.simulation.cell_bodies import CellBodies
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Reach:
    """Parts of which a holder takes the nearest."""

    parts: tuple[int, ...]
    """Indices of the bodies."""
    distance_m: float


@value_class(frozen=True, slots=True)
class PartHolder:
    """A gripper or clamp that a condition on signals closes."""

    name: str
    robot: int
    frame: SceneFrame
    """The flange, or the frame of a positioner."""
    body: int | None
    """Index of the body that holds; None for all on its frame, and the TCP."""
    reaches: tuple[Reach, ...]
    signals: tuple[str, ...]
    changes: tuple[tuple[float, bool], ...]
    """Times [s] at which it closes and opens."""

    @property
    def is_of_arm(self) -> bool:
        """Whether an arm carries it."""
        return not self.frame.axes

    @property
    def parts(self) -> frozenset[int]:
        """Indices of the bodies that it may hold."""
        return frozenset(part for reach in self.reaches for part in reach.parts)


@value_class(frozen=True, slots=True)
class PartSink:
    """A body from which parts disappear."""

    body: int
    after_s: float
    empties: tuple[float, ...]
    """Times [s] at which it is emptied."""
    is_emptied: bool
    """Whether only a condition empties it."""
    capacity: int | None


def part_holders(cell: CellBodies, geometry: CellGeometry) -> Iterator[PartHolder]:
    """Yield holders of parts; tables with one condition and one holder are one gripper."""
    alike: dict[tuple[str, str, int, SceneFrame, int | None], list[Attachment]] = {}
    for table in geometry.attachments:
        for holder in _holder(cell, table):
            alike.setdefault((table.when.lower(), *holder), []).append(table)
    for (_, name, robot, frame, body), tables in alike.items():
        condition = read_condition(tables[0].when)
        reaches = tuple(
            Reach(tuple(at for one in table.objects for at in cell.numbers(one)), table.reach_m)
            for table in tables
        )
        changes = cell.changes(condition, f"`{', '.join(tables[0].objects)}`")
        yield PartHolder(name, robot, frame, body, reaches, condition.signals(), changes)


def part_sinks(cell: CellBodies, geometry: CellGeometry) -> Iterator[PartSink]:
    """Yield the sinks of a run."""
    for table in geometry.sinks:
        for body in cell.numbers(table.surface):
            empties = cell.begins(table.when, f"`{table.surface}`")
            yield PartSink(body, table.after_s, empties, bool(table.when), table.capacity)


def _holder(
    cell: CellBodies, table: Attachment
) -> Iterator[tuple[str, int, SceneFrame, int | None]]:
    """Yield name, robot, frame and body of what holds objects, if the run has it."""
    to, owner = table.to, ", ".join(table.objects)
    if to.kind is ParentKind.UNIT:
        unit = cell.unit(to.name, to.link)
        if unit is not None and unit.robot is not None:
            yield f"`{to.name}`", unit.robot, unit, None
        else:
            cell.remarks.append(f"`{owner}`: no positioner of the run has `{to.name}`")
        return
    body = next(iter(cell.numbers(to.name)), None)
    task = to.robot
    if task is None and body is not None:
        task = cell.objects[body].parent.robot
    robot = cell.robot_of(task, owner)
    if robot is None:
        return
    flange = SceneFrame(robot, len(cell.runs[robot].robot.joints) + 1)
    if not to.name:
        yield cell.name_of("the gripper", robot).name, robot, flange, None
    elif body is None:
        cell.remarks.append(f"`{owner}`: `{to.name}`, which holds it, has no position")
    else:
        yield f"`{to.name}`", robot, flange, body
