"""Errors of a run and what became of them: rows of the JSON and of Python, and one line of text."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from rapidsim.json_records.declarations import Rounded
from rapidsim.language.error_answers import ErrorOutcome, answer_words, shown_name
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class

_MOST_WORDS = 8
"""Kinds of errors that the line of text names."""


@value_class(frozen=True, slots=True, repr=False)
class ErrorRecord:
    """Errors of one number, raised at one place and handled alike by one ERROR clause."""

    time_s: Rounded
    """Time of the first error."""
    task: str
    number: Rounded
    """ERRNO."""
    name: str
    """The name of the number; the number as text if it has none."""
    file: str
    """Place of the RAISE, as `line` and `routine`."""
    line: int
    routine: str
    answered_by: str | None
    """The routine whose ERROR clause answered; None if none did."""
    outcome: Annotated[str, ErrorOutcome]
    """`retried`, `next`, `returned`, `raised`, `fell through` or `ended the program`."""
    count: int
    last_s: Rounded
    """Time of the last error."""
    message: str
    """Message of the first error."""
    answered_file: str | None
    answered_line: int | None

    def __repr__(self) -> str:
        """One line."""
        times = f"{self.count} " if self.count > 1 else ""
        return f"<{times}{self.name[:40]} at line {self.line}, {self.outcome}>"


def error_records(simulation: Simulation) -> tuple[ErrorRecord, ...]:
    """The errors of all tasks in order of their first times."""
    records = []
    for tally in simulation.errors:
        error, clause = tally.error, tally.error.clause
        records.append(
            ErrorRecord(
                time_s=tally.time_s,
                task=tally.task,
                number=error.number,
                name=error.name,
                file=error.raised.span.file,
                line=error.raised.span.line,
                routine=error.raised.routine,
                answered_by=clause.routine if clause else None,
                outcome=error.outcome.value,
                count=tally.count,
                last_s=tally.last_s,
                message=error.message,
                answered_file=clause.span.file if clause else None,
                answered_line=clause.span.line if clause else None,
            )
        )
    return tuple(records)


def error_count(simulation: Simulation) -> int:
    """The number of errors; one that several clauses raised on counts once."""
    tallies = simulation.errors
    return sum(one.count for one in tallies if one.error.outcome is not ErrorOutcome.RAISED)


def dropped_error_count(simulation: Simulation) -> int:
    """The number of errors that fell through an ERROR clause."""
    tallies = simulation.errors
    return sum(one.count for one in tallies if one.error.outcome is ErrorOutcome.FELL_THROUGH)


def errors_text(simulation: Simulation) -> str:
    """The errors and what became of them, in one line; empty if there were none."""
    # The last ERROR clause that an error passed determines its outcome.
    tallies = [one for one in simulation.errors if one.error.outcome is not ErrorOutcome.RAISED]
    parts, file = [], None
    for tally in tallies[:_MOST_WORDS]:
        span = tally.error.raised.span
        name = "" if span.file == file else Path(span.file).name
        file = span.file
        words = answer_words(tally.error)
        parts.append(f"{tally.count} {shown_name(tally.error)} at {name}:{span.line} {words}")
    if remaining := len(tallies) - len(parts):
        parts.append(f"and {remaining} more kinds")
    return ", ".join(parts)
