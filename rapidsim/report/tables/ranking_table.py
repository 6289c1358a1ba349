"""Ranking of arms for the targets of a program, as a table and as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.text import Text

from rapidsim.json_records.declarations import Key, OutputRecord
from rapidsim.json_records.encoding import json_of
from rapidsim.reach.arm_ranking import ProgramTargets, RankedArm
from rapidsim.report.untruncated_table import UntruncatedTable
from rapidsim.values import value_class

_MOST_ROWS = 20
_MEANING = (
    "reached: targets within reach and limits; as stored: in the configuration that the target "
    "stores; arms of one rank suit the targets equally well"
)


def ranking_table(targets: ProgramTargets, ranked: Sequence[RankedArm]) -> RenderableType:
    """One row an arm, best first."""
    table = UntruncatedTable.without_lines()
    table.add_column("rank", justify="right", no_wrap=True)
    table.add_column("name", style="bold", no_wrap=True)
    for title in ("reach", "reached", "as stored"):
        table.add_column(title, justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    for arm in ranked[:_MOST_ROWS]:
        notes = ("" if arm.carries else "overloaded", "named" if arm.is_named else "")
        table.add_row(
            str(_rank(arm, ranked)),
            arm.name,
            "?" if arm.reach_m is None else f"{1000.0 * arm.reach_m:.0f} mm",
            f"{arm.reached} of {arm.tried}",
            f"{arm.satisfied} of {arm.tried}",
            ", ".join(note for note in notes if note),
        )
    more = len(ranked) - _MOST_ROWS
    left = f"... and {more} more; " if more > 0 else ""
    facts = f"{targets.count} targets, heaviest tool {targets.heaviest_kg:g} kg"
    return Group(table, Padding(Text(f"{left}{facts}; {_MEANING}", "dim"), (1, 0, 0, 0)))


@value_class(frozen=True, slots=True)
class RankedRobot:
    """An arm of the catalogue in the ranking."""

    rank: int
    """1 for the best; arms of one rank suit the targets equally well."""
    name: str
    reach_mm: float | None
    tried: int
    """Number of targets that were tried; fewer for arms without formulas."""
    reached: int
    """Number of targets within reach and limits."""
    satisfied: Annotated[int, Key("held")]
    """Number of targets reached in the configuration that the target stores."""
    carries: bool
    """Whether the arm is rated for the heaviest tool."""
    is_named: Annotated[bool, Key("named")]
    """Whether a comment, a file name or a backup names its type."""


@value_class(frozen=True, slots=True)
class RankingReport(OutputRecord):
    """The object that `rapidsim robots --for PATH --format json` prints."""

    program: str
    """PATH, as the user named it."""
    targets: int
    """Number of distinct targets that are known without a run, at most some hundred."""
    heaviest_kg: float
    """Mass of the heaviest tool with its load."""
    robots: tuple[RankedRobot, ...]
    """Arms, the best first."""


def ranking_json(
    path: str, targets: ProgramTargets, ranked: Sequence[RankedArm]
) -> dict[str, object]:
    """The ranking of all arms as JSON values."""
    robots = tuple(
        RankedRobot(
            rank=_rank(arm, ranked),
            name=arm.name,
            reach_mm=None if arm.reach_m is None else arm.reach_m * 1000.0,
            tried=arm.tried,
            reached=arm.reached,
            satisfied=arm.satisfied,
            carries=arm.carries,
            is_named=arm.is_named,
        )
        for arm in ranked
    )
    return json_of(RankingReport(path, targets.count, targets.heaviest_kg, robots))


def _rank(arm: RankedArm, ranked: Sequence[RankedArm]) -> int:
    """One more than the number of arms that suit the targets better."""
    return 1 + sum(other.score > arm.score for other in ranked)
