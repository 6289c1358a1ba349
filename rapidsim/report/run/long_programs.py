"""Where the time of a program of thousands of moves goes: sections instead of lines."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.report.findings.source_frame import printable
from rapidsim.report.run.records import number
from rapidsim.report.untruncated_table import UntruncatedTable
from rapidsim.simulation.results.regions import Region, by_comment
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.slow_sections import SlowSection, slow_sections

MANY_MOVES = 1000
"""Number of moves from which single lines are not informative."""
_SHOWN = 5
_COMMENT_CELLS = 30


def long_program_text(simulation: Simulation) -> RenderableType | None:
    """The most expensive sections; None for a program whose lines can be listed."""
    if len(simulation.moves) < MANY_MOVES:
        return None
    stretches = slow_sections(simulation)
    regions = by_comment((*simulation.moves, *simulation.waits))
    parts: list[RenderableType] = []
    if stretches:
        table = _table("below speed", ">time", ">lost", ">mm/s", ">of", "limited by")
        for one in stretches[:_SHOWN]:
            table.add_row(
                lines_of(one),
                f"{one.seconds:.3f} s",
                f"{one.lost_s:.3f} s",
                f"{one.reached_mm_s:.0f}",
                f"{one.programmed_mm_s:.0f}",
                one.limit,
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


def slow_sections_json(stretches: Sequence[SlowSection]) -> list[dict[str, object]]:
    """The slow sections as JSON values."""
    return [
        {
            "task": one.task,
            "file": one.first.place.span.file,
            "line": one.first.place.span.line,
            "last_file": one.last.place.span.file,
            "last_line": one.last.place.span.line,
            "moves": one.moves,
            "start_s": number(one.start_s),
            "end_s": number(one.end_s),
            "lost_s": number(one.lost_s),
            "programmed_mm_s": number(one.programmed_mm_s),
            "mean_mm_s": number(one.reached_mm_s),
            "limit": one.limit,
        }
        for one in stretches
    ]


def regions_json(regions: Sequence[Region]) -> list[dict[str, object]]:
    """The parts that comments head, as JSON values."""
    return [
        {
            "task": one.task,
            "file": one.file,
            "line": one.line,
            "routine": one.routine,
            "comment": one.comment,
            "steps": one.steps,
            "time_s": number(one.seconds),
        }
        for one in regions
    ]


def _table(*names: str) -> Table:
    table = UntruncatedTable.without_lines()
    for name in names:
        right = name.startswith(">")
        table.add_column(name.lstrip(">"), justify="right" if right else "left", no_wrap=True)
    return table
