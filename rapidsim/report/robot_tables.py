"""The catalogue of robots as a table, and one robot as a page."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.motion.robot import Robot

_UNKNOWN = "?"


def catalogue_table(robots: Sequence[tuple[Robot, Sequence[str]]]) -> Table:
    """One row a robot with its short names."""
    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False, header_style="cyan")
    table.add_column("name", style="bold", no_wrap=True)
    table.add_column("robot")
    table.add_column("short")
    table.add_column("payload", justify="right", no_wrap=True)
    table.add_column("reach", justify="right", no_wrap=True)
    table.add_column("axes", justify="right")
    for robot, aliases in robots:
        table.add_row(
            robot.name,
            robot.title,
            ", ".join(aliases),
            _payload(robot),
            _reach(robot),
            str(len(robot.joints)),
        )
    return table


def robot_page(robot: Robot, aliases: Sequence[str]) -> RenderableType:
    """One robot with its axes."""
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="cyan", no_wrap=True)
    facts.add_column()
    facts.add_row("name", ", ".join((robot.name, *aliases)))
    facts.add_row("payload", _payload(robot))
    facts.add_row("reach", _reach(robot))
    facts.add_row("shapes", str(robot.urdf) if robot.urdf else "none")
    for number, source in enumerate(robot.sources):
        facts.add_row("" if number else "source", source)
    axes = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False, header_style="cyan")
    axes.add_column("axis", style="bold")
    axes.add_column("from", justify="right")
    axes.add_column("to", justify="right")
    axes.add_column("speed", justify="right")
    for joint in robot.joints:
        speed = _UNKNOWN if joint.max_speed is None else f"{degrees(joint.max_speed):.10g}°/s"
        lower, upper = degrees(joint.lower), degrees(joint.upper)
        axes.add_row(joint.name, f"{lower:.10g}°", f"{upper:.10g}°", speed)
    return Group(Text(robot.title, "bold"), Text(), facts, Text(), axes)


def _payload(robot: Robot) -> str:
    return _UNKNOWN if robot.payload_kg is None else f"{robot.payload_kg:g} kg"


def _reach(robot: Robot) -> str:
    return _UNKNOWN if robot.reach_m is None else f"{robot.reach_m * 1000.0:.0f} mm"
