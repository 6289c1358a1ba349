"""The errors of a run as a table: where they were raised, and what ERROR clauses did about them."""

from __future__ import annotations

from pathlib import Path

from rapidsim.language.error_answers import answer_words, shown_name
from rapidsim.report.html.elements import section, table, text
from rapidsim.report.run.error_records import dropped_error_count, error_count
from rapidsim.simulation.results.simulation import Simulation

_MOST = 200
"""Rows of the table."""


def error_section(simulation: Simulation) -> str:
    """The table; empty if the program raised no error."""
    tallies = simulation.errors
    if not tallies:
        return ""
    several = len(simulation.tasks) > 1
    rows = []
    for tally in tallies[:_MOST]:
        span, routine = tally.error.raised.span, tally.error.raised.routine
        place = f"{Path(span.file).name}:{span.line} in {routine}"
        times = f"{tally.time_s:.3f}"
        if tally.count > 1:
            times += f" to {tally.last_s:.3f}"
        rows.append(
            (
                times,
                text(shown_name(tally.error)),
                text(f"{tally.task}: {place}" if several else place),
                str(tally.count),
                text(answer_words(tally.error)),
                text(tally.error.message),
            )
        )
    heads = (">time [s]", "error", "raised at", ">times", "outcome", "message")
    body = f'<div class="scrolled">{table(heads, rows, kind="events")}</div>'
    if len(tallies) > _MOST:
        body += f'<p class="aside">and {len(tallies) - _MOST} more kinds of errors</p>'
    dropped = dropped_error_count(simulation)
    remark = f"{error_count(simulation)} raised"
    return section(
        "errors", "Errors", body, f"{remark}, {dropped} fell through" if dropped else remark
    )
