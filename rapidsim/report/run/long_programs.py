"""Where the time of a program of thousands of moves goes: sections instead of lines."""

from __future__ import annotations

from pathlib import Path

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.json_records.declarations import Rounded
from rapidsim.report.findings.source_frame import printable
from rapidsim.report.untruncated_table import UntruncatedTable
from rapidsim.simulation.results.regions import Region, by_comment
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.slow_sections import SlowSection, slow_lines
from rapidsim.values import value_class

MANY_MOVES = 1000
"""Number of moves from which single lines are not informative."""
_SHOWN = 5
_COMMENT_CELLS = 30


def long_program_text(simulation: Simulation) -> RenderableType | None:
    """The most expensive sections; None for a program whose lines can be listed."""
    if len(simulation.moves) < MANY_MOVES:
        return None
    stretches = slow_lines(simulation)
    regions = by_comment(simulation.moves, simulation.waits)
    parts: list[RenderableType] = []
    if stretches:
        table = _table("below speed", ">time", ">lost", ">mm/s", ">of", "limited by")
        for one in stretches[:_SHOWN]:
            table.add_row(
                lines_of(one.sections[0]),
                f"{one.seconds:.3f} s",
                f"{one.lost_s:.3f} s",
                f"{one.reached_mm_s:.0f}",
                f"{one.programmed_mm_s:.0f}",
                one.sections[0].limit,
            )
        parts.append(table)
    if len(regions) > 1:
        table = _table("by comment", "line", ">moves and waits", ">time")
        for region in regions[:_SHOWN]:
            words = printable(region.comment)
            short = words if len(words) <= _COMMENT_CELLS else words[: _COMMENT_CELLS - 1] + "…"
            where = f"{Path(region.file).name}:{region.line}"
            table.add_row(short, where, str(region.steps), f"{region.seconds:.3f} s")
        parts += [*([Text()] if parts else []), table]
    return Group(*parts) if parts else None


def lines_of(section: SlowSection) -> str:
    """From which line to which it goes."""
    first, last = section.first.place.span, section.last.place.span
    name = f"{Path(first.file).name}:{first.line}"
    if first.file != last.file:
        return f"{name} - {Path(last.file).name}:{last.line}"
    return name if first.line == last.line else f"{name}-{last.line}"


@value_class(frozen=True, slots=True)
class SlowSectionRecord:
    """A section of a robot's motion below the programmed speed."""

    task: str
    file: str
    line: int
    last_file: str
    last_line: int
    moves: int
    """Number of moves in the section."""
    start_s: Rounded
    end_s: Rounded
    lost_s: Rounded
    """Time that would be saved at the programmed speed."""
    programmed_mm_s: Rounded | None
    """Highest programmed speed in the section."""
    mean_mm_s: Rounded
    limit: str
    """Active limit, such as `acceleration of axis 2`."""


@value_class(frozen=True, slots=True)
class RegionRecord:
    """Statements after a comment on its own lines."""

    task: str
    file: str
    line: int
    """Line of the comment."""
    routine: str
    comment: str
    steps: int
    """Number of moves and waits that were executed."""
    time_s: Rounded


def slow_section_record(section: SlowSection) -> SlowSectionRecord:
    """The record of a slow section."""
    first, last = section.first.place.span, section.last.place.span
    return SlowSectionRecord(
        task=section.task,
        file=first.file,
        line=first.line,
        last_file=last.file,
        last_line=last.line,
        moves=section.moves,
        start_s=section.start_s,
        end_s=section.end_s,
        lost_s=section.lost_s,
        programmed_mm_s=section.programmed_mm_s,
        mean_mm_s=section.reached_mm_s,
        limit=section.limit,
    )


def region_record(region: Region) -> RegionRecord:
    """The record of a region."""
    return RegionRecord(
        region.task,
        region.file,
        region.line,
        region.routine,
        region.comment,
        region.steps,
        region.seconds,
    )


def _table(*names: str) -> Table:
    table = UntruncatedTable.without_lines()
    for name in names:
        right = name.startswith(">")
        table.add_column(name.lstrip(">"), justify="right" if right else "left", no_wrap=True)
    return table
