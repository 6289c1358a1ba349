"""The catalogue of robots as a table by maker, and one robot as a page."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from math import degrees

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from rapidsim.jobs.running.picking_cycle import PickingCycle
from rapidsim.motion.robot.external_axes import with_unit
from rapidsim.motion.robot.robot import Joint, Robot
from rapidsim.motion.workspace import ArmWorkspace
from rapidsim.report.untruncated_table import UntruncatedTable

_UNKNOWN = "?"
_MEANING = (
    "? is not known: no source gives it. To run a program on an arm with "
    "unknown axis speeds, give them in rapidsim.toml: [motion] axis_speed = [...] in deg/s, "
    "mm/s for a linear axis."
)


_LENT_MARK = "~"
_LENT = (
    f"{_LENT_MARK} marks axis speeds of another arm, the nearest of the same kind, as no source "
    "gives this arm's; [motion] axis_speed = [...] sets them:"
)


def catalogue_table(robots: Sequence[tuple[Robot, Sequence[str]]]) -> RenderableType:
    """One row a robot with its short names, maker by maker."""
    table = UntruncatedTable.without_lines()
    table.add_column("name", style="bold", no_wrap=True)
    table.add_column("short", no_wrap=True)
    table.add_column("payload", justify="right", no_wrap=True)
    table.add_column("reach", justify="right", no_wrap=True)
    table.add_column("axes", justify="right", no_wrap=True)
    table.add_column("axis speeds", justify="right", no_wrap=True)
    by_maker = sorted(robots, key=_maker)
    for maker, group in groupby(by_maker, key=_maker):
        table.add_row()
        table.add_row(Text(maker, "cyan"))
        for robot, aliases in group:
            table.add_row(
                f"  {robot.name}",
                ", ".join(aliases),
                _payload(robot),
                _reach(robot),
                str(len(robot.joints)),
                f"{_LENT_MARK if robot.axis_speeds_from else ''}{_speeds(robot)}",
            )
    meanings = list(_lenders([robot for robot, _ in robots]))
    if any(_lacks_something(robot) for robot, _ in robots):
        meanings.append(_MEANING)
    if meanings:
        return Group(table, Padding(Text("\n".join(meanings), "dim"), (1, 0, 0, 0)))
    return table


def _lenders(robots: Sequence[Robot]) -> Iterator[str]:
    """The arms that lend their axis speeds, each with its borrowers; empty if none does."""
    users: dict[str, list[str]] = {}
    for robot in robots:
        if robot.axis_speeds_from is not None:
            users.setdefault(robot.axis_speeds_from, []).append(robot.name)
    if users:
        yield _LENT
    for lender, names in users.items():
        yield f"those of {lender}: {', '.join(names)}"


def workspace_page(
    workspace: ArmWorkspace | str, of_wrist: ArmWorkspace | str | None
) -> RenderableType:
    """Volume and extents of what the flange reaches, and the volume of the wrist centre."""
    if isinstance(workspace, str):
        return Text(f"no workspace: {workspace}", "dim")
    near, far, low, high = (f"{1000.0 * value:.0f} mm" for value in workspace.extent)
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="cyan", no_wrap=True)
    facts.add_column()
    facts.add_row("workspace", f"{workspace.volume:.2f} m3, of the flange in any orientation")
    if isinstance(of_wrist, ArmWorkspace):
        known = workspace.robot.wrist_centre_volume
        beside = "" if known is None else f"; {known.volume_m3:g} m3: {known.source}"
        facts.add_row("wrist centre", f"{of_wrist.volume:.2f} m3{beside}")
    facts.add_row("from axis 1", f"{near} to {far}")
    facts.add_row("height", f"{low} to {high}")
    facts.add_row("around", f"{degrees(workspace.swept):.0f} deg")
    facts.add_row("found", f"by sampling postures, in cells of {1000.0 * workspace.cell:.1f} mm")
    return facts


def cycle_page(robot: Robot, cycle: PickingCycle) -> RenderableType:
    """The picking cycle beside a figure from elsewhere."""
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="cyan", no_wrap=True)
    facts.add_column()
    ahead, height = cycle.position_mm
    percent = robot.constants.cycle_percent
    within = "" if percent is None else f" ({percent:g} % either way)"
    facts.add_row(
        "picking cycle", f"25 mm up, 300 mm across, 25 mm down, and back, {cycle.load_kg:g} kg"
    )
    facts.add_row("at", f"{ahead:.0f} mm in front of axis 1, {height:.0f} mm high")
    facts.add_row("z10", f"{cycle.fly_by_s:.3f} s with z10 at the low points{within}")
    facts.add_row("fine", f"{cycle.stop_s:.3f} s with `fine` at the low points")
    known = robot.picking
    if known is None:
        facts.add_row("elsewhere", "no figure is known")
        return facts
    off = 100.0 * (cycle.fly_by_s / known.time_s - 1.0)
    origin = "not from a source" if known.source is None else known.source
    facts.add_row("elsewhere", f"{known.time_s:g} s, {origin}: z10 differs by {off:+.0f} %")
    return facts


def robot_page(robot: Robot, aliases: Sequence[str]) -> RenderableType:
    """One robot with its axes."""
    facts = Table.grid(padding=(0, 2))
    facts.add_column(style="cyan", no_wrap=True)
    facts.add_column()
    facts.add_row("name", ", ".join((robot.name, *aliases)))
    facts.add_row("payload", _payload(robot))
    facts.add_row("reach", _reach(robot))
    facts.add_row("shapes", str(robot.urdf) if robot.urdf else "none")
    own = robot.constants
    facts.add_row("motion", own.limits_text)
    facts.add_row(
        "",
        f"smoothing {own.filter_time:.3f} s, dwell at stop points {own.fine_dwell:.3f} s, "
        f"{100.0 * own.zone_share:.0f} % of these limits in narrow zones",
    )
    if robot.link_excess_m:
        excess = ", ".join(f"{1000.0 * one:.0f}" for one in robot.link_excess_m)
        facts.add_row("", f"95 % of the maker's surface within {excess} mm of them, base first")
    for label, lines in (
        ("source", robot.sources),
        ("checked", robot.checks),
        ("note", robot.notes),
        ("not modelled", robot.not_modelled),
    ):
        for number, line in enumerate(lines):
            facts.add_row("" if number else label, line)
    axes = UntruncatedTable.without_lines()
    axes.add_column("axis", style="bold", no_wrap=True)
    axes.add_column("from", justify="right", no_wrap=True)
    axes.add_column("to", justify="right", no_wrap=True)
    lender = robot.axis_speeds_from
    axes.add_column(f"speed of {lender}" if lender else "speed", justify="right", no_wrap=True)
    measured = any(joint.max_acceleration is not None for joint in robot.joints)
    if measured:
        axes.add_column("acceleration, measured", justify="right", no_wrap=True)
    for joint in robot.joints:
        row = [joint.name, _value(joint, joint.lower), _value(joint, joint.upper)]
        row.append(_UNKNOWN if joint.max_speed is None else f"{_value(joint, joint.max_speed)}/s")
        if joint.max_acceleration is not None:
            row.append(f"{_value(joint, joint.max_acceleration)}/s²")
        axes.add_row(*row)
    page: list[RenderableType] = [Text(robot.title, "bold"), Text(), facts, Text(), axes]
    if _lacks_something(robot):
        page += [Text(), Text(_MEANING, "dim")]
    return Group(*page)


def _value(joint: Joint, value: float) -> str:
    """A value of a joint [rad] with RAPID's unit."""
    return with_unit(f"{degrees(value):.10g}", joint.measure)


def _maker(listed: tuple[Robot, Sequence[str]]) -> str:
    return listed[0].maker or _UNKNOWN


def _lacks_something(robot: Robot) -> bool:
    return _UNKNOWN in (_payload(robot), _reach(robot), _speeds(robot))


def _payload(robot: Robot) -> str:
    return _UNKNOWN if robot.payload_kg is None else f"{robot.payload_kg:g} kg"


def _reach(robot: Robot) -> str:
    return _UNKNOWN if robot.reach_m is None else f"{robot.reach_m * 1000.0:.0f} mm"


def _speeds(robot: Robot) -> str:
    """From the slowest revolute axis to the fastest; `robots NAME` lists the others."""
    known = [(joint.slides, degrees(speed)) for joint in robot.joints if (speed := joint.max_speed)]
    if len(known) < len(robot.joints):
        return _UNKNOWN
    turning = [speed for slides, speed in known if not slides]
    return f"{min(turning):.4g}-{max(turning):.4g}°/s"
