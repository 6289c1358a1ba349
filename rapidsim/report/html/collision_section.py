"""Collisions in a report: contacts, least clearance of each move, bodies not judged."""

from __future__ import annotations

from pathlib import Path

from rapidsim.collisions.contact import FARTHEST_M
from rapidsim.report.html.elements import prose, section, table, text, tile
from rapidsim.report.run.collision_records import (
    ClearanceRecord,
    ContactRecord,
    PartEventRecord,
    clearance_records,
    contact_records,
    crash_records,
    part_event_records,
)
from rapidsim.report.run.summary import shape_margins
from rapidsim.simulation.results.collisions import Collisions
from rapidsim.simulation.results.simulation import Simulation

_MOST = 100
"""Rows of either table."""


def collision_tile(simulation: Simulation) -> str:
    """Whether anything was hit, and how near bodies came; empty where nothing is judged."""
    if simulation.collisions is None:
        return ""
    near = next(iter(clearance_records(simulation)), None)
    if crashes := crash_records(simulation):
        return tile("Collisions", f"{len(crashes)}", f"the first at {crashes[0].time_s:.3f} s")
    if near is None:
        return tile("Smallest clearance", f"> {1000.0 * FARTHEST_M:g} mm")
    between = f"{near.first}, {near.second}".replace("`", "")
    return tile("Smallest clearance", f"{near.distance_mm:.1f} mm", between)


def collision_section(simulation: Simulation) -> str:
    """The tables; empty if the station has no bodies."""
    collisions = simulation.collisions
    if collisions is None:
        return ""
    contacts, nearest = contact_records(simulation), clearance_records(simulation)
    parts = []
    if contacts:
        columns = [">time [s]", "bodies", "line", ">depth [mm]", ">at x, y, z [mm]", ""]
        touching = [
            (
                f"{one.time_s:.3f}",
                prose(f"{one.first} and {one.second}"),
                text(_line(one)),
                "" if one.depth_mm is None else f"{one.depth_mm:.1f}",
                ", ".join(f"{number:.0f}" for number in one.point_mm),
                "from the previous move" if one.continued else "",
            )
            for one in contacts[:_MOST]
        ]
        parts.append(f"<h3>Contacts</h3>{_scrolled(table(columns, touching, kind='events'))}")
        parts.append(_omitted_count(len(contacts), "contacts"))
    if nearest:
        wanted = 1000.0 * collisions.geometry.clearance_m
        heads = (">clearance [mm]", "bodies", "line", ">time [s]", "")
        rows = [
            (
                f"{one.distance_mm:.1f}",
                prose(f"{one.first} and {one.second}"),
                text(_line(one)),
                f"{one.time_s:.3f}",
                f"less than the {wanted:g} mm to keep" if one.distance_mm < wanted else "",
            )
            for one in nearest[:_MOST]
        ]
        parts.append(
            "<h3>Smallest clearance of each move</h3>"
            + _scrolled(table(heads, rows, kind="events"))
        )
        parts.append(_omitted_count(len(nearest), "moves"))
    if collisions.part_events:
        parts.append(_part_events(simulation, collisions))
    if not contacts and not nearest:
        parts.append(f"<p>Nothing came within {1000.0 * FARTHEST_M:g} mm of anything.</p>")
    remarks = [f"not checked: {one}" for one in collisions.remarks]
    for one in (*shape_margins(simulation, collisions), *remarks):
        parts.append(f'<p class="aside">{prose(one)}</p>')
    pairs = collisions.pair_count
    return section("collisions", "Collisions", "".join(parts), f"{pairs} pairs of bodies checked")


def _part_events(simulation: Simulation, collisions: Collisions) -> str:
    """Return the table of the parts' events."""
    rows = [
        (
            f"{one.time_s:.3f}",
            prose(one.part or "no part"),
            one.change.value,
            prose(one.carrier),
            text(_line(one)),
        )
        for one in part_event_records(simulation, collisions)[:_MOST]
    ]
    heads = (">time [s]", "part", "", "by, on", "line")
    omitted = _omitted_count(len(collisions.part_events), "events")
    return f"<h3>Parts</h3>{_scrolled(table(heads, rows, kind='events'))}{omitted}"


def _line(record: ContactRecord | ClearanceRecord | PartEventRecord) -> str:
    routine = "" if record.routine is None else f" in {record.routine}"
    return f"{Path(record.file).name}:{record.line}{routine}" if record.file else record.task


def _omitted_count(count: int, subject: str) -> str:
    return f'<p class="aside">and {count - _MOST} more {subject}</p>' if count > _MOST else ""


def _scrolled(body: str) -> str:
    return f'<div class="scrolled">{body}</div>'
