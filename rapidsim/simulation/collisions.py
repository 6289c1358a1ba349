"""Contacts and clearances of a run, as part of the result and as findings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from rapidsim.collisions.along_motion import search
from rapidsim.collisions.contact import CollisionReport, Contact
from rapidsim.collisions.geometry import CellGeometry
from rapidsim.collisions.outer_hull import HullStore
from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.controller.cell.watchdog import Watchdog
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.diagnostics import Diagnostic, Related
from rapidsim.findings.collisions import Collision, LowClearance, NotJudged
from rapidsim.findings.runs import CutOff
from rapidsim.simulation.cell_scene import cell_scene
from rapidsim.simulation.results.collisions import Collisions
from rapidsim.simulation.results.part_statements import place_of
from rapidsim.simulation.results.simulation import End, RobotRun, Simulation

_MM = 1e3


def with_collisions(
    simulation: Simulation,
    geometry: CellGeometry,
    conveyors: Sequence[ConveyorScript],
    hulls: HullStore | None,
    watchdog: Watchdog,
) -> Simulation:
    """Return a run with the contacts and clearances of its bodies.

    The search ends at the limit of the run on the computer's clock, and so does the run then.
    """
    made = cell_scene(simulation, geometry, conveyors, hulls)
    found = search(
        made.scene,
        simulation.motion_end_s,
        made.bodies,
        has_depths=geometry.has_depths,
        may_go_on=lambda: watchdog.left_s > 0.0,
    )
    remarks = (*made.remarks, *_unsearched(found))
    collisions = Collisions(
        geometry, found, made.scene, remarks, made.objects, made.parts, made.events
    )
    findings = tuple(_findings(simulation, collisions))
    if found.until_s < math.inf and simulation.end is not End.ERROR:
        cut_off = Diagnostic(CutOff(f"the search for collisions {watchdog.cut_off}"), None)
        simulation = replace(simulation, end=End.TIME_LIMIT)
        findings = (*findings, cut_off)
    return replace(
        simulation,
        collisions=collisions,
        diagnostics=(*simulation.diagnostics, *findings),
    )


def _findings(simulation: Simulation, collisions: Collisions) -> Iterator[Diagnostic]:
    found, robots = collisions.report, simulation.robots
    for first, *later in collisions.crashes:
        others = [pair for pair in map(_pair_of, later) if pair != _pair_of(first)]
        violation = Collision(
            first.first.name,
            first.second.name,
            first.time_s,
            _deep((first, *later), stops=collisions.geometry.stops),
            _also(first.second.name, list(dict.fromkeys(others))),
        )
        move = robots[first.robot].move(first.move)
        yield _at(move, violation, tuple(_others(robots, first)))
    for event in collisions.part_errors:
        place, fault = place_of(simulation, event), event.violation
        if fault is not None:
            span, routine = (None, None) if place is None else (place.span, place.routine)
            yield Diagnostic(fault, span, routine=routine)
    yield from _near(simulation, found, collisions.geometry.clearance_m)
    if collisions.remarks:
        yield Diagnostic(NotJudged("; ".join(collisions.remarks)), None)


def _unsearched(report: CollisionReport) -> Iterator[str]:
    if not report.decided:
        yield "some intervals in which bodies slide along each other"
    if report.until_s < math.inf:
        yield f"all motion from {report.until_s:.3f} s on"


def _pair_of(contact: Contact) -> tuple[str, str]:
    return contact.first.name, contact.second.name


def _also(second: str, pairs: list[tuple[str, str]]) -> str:
    """Describe the other pairs of a crash, first those that hit the same body."""
    alike = [first for first, hit in pairs if hit == second]
    said = f"; so {'do' if len(alike) > 1 else 'does'} {' and '.join(alike)}" if alike else ""
    others = [f"{first} hits {hit}" for first, hit in pairs if hit != second]
    return f"{said}; {' and '.join(others)}" if others else said


def _deep(contacts: tuple[Contact, ...], *, stops: bool) -> str:
    """Describe the largest depth of a crash: of a run that it stops, that at the end of braking."""
    known = [one.depth_m for one in contacts if one.depth_m is not None]
    when = " when the arm has braked" if stops else ""
    return f", {max(known) * _MM:.1f} mm deep{when}" if known else ""


def _near(
    simulation: Simulation, report: CollisionReport, clearance_m: float
) -> Iterator[Diagnostic]:
    touched = {(one.robot, one.move) for one in report.contacts}
    for near in report.clearances:
        if near.distance_m < clearance_m and (near.robot, near.move) not in touched:
            violation = LowClearance(
                near.first.name,
                near.second.name,
                near.distance_m * _MM,
                clearance_m * _MM,
                near.time_s,
            )
            yield _at(simulation.robots[near.robot].move(near.move), violation)


def _others(robots: tuple[RobotRun, ...], contact: Contact) -> Iterator[Related]:
    """Yield the move of the other robot of a contact at that time."""
    for other in {contact.first.robot, contact.second.robot} - {None, contact.robot}:
        if other is None:
            continue
        move = robots[other].move(int(robots[other].sample(contact.time_s).move[0]))
        if move is not None:
            yield Related(move.place.span, f"{robots[other].task} is here then")


def _at(
    move: ExecutedMove | None,
    violation: Collision | LowClearance,
    related: tuple[Related, ...] = (),
) -> Diagnostic:
    if move is None:
        return Diagnostic(violation, None, related)
    return Diagnostic(violation, move.place.span, related, routine=move.place.routine)
