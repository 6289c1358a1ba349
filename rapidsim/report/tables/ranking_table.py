"""Ranking of arms for the targets of a program, as a table and as JSON."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.text import Text

from rapidsim.reach.arm_ranking import ProgramTargets, RankedArm
from rapidsim.report.untruncated_table import UntruncatedTable

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


def ranking_json(
    path: str, targets: ProgramTargets, ranked: Sequence[RankedArm]
) -> dict[str, object]:
    """The ranking of all arms as JSON values."""
    return {
        "schema": 1,
        "program": path,
        "targets": targets.count,
        "heaviest_kg": targets.heaviest_kg,
        "robots": [
            {
                "rank": _rank(arm, ranked),
                "name": arm.name,
                "reach_mm": None if arm.reach_m is None else arm.reach_m * 1000.0,
                "tried": arm.tried,
                "reached": arm.reached,
                "held": arm.satisfied,
                "carries": arm.carries,
                "named": arm.is_named,
            }
            for arm in ranked
        ],
    }


def _rank(arm: RankedArm, ranked: Sequence[RankedArm]) -> int:
    """One more than the number of arms that suit the targets better."""
    return 1 + sum(other.score > arm.score for other in ranked)
