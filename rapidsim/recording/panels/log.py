"""Log of FlexPendant texts, events and findings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import rerun as rr

from rapidsim.controller.journal.events import Event, EventKind, ExecutedLine
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.findings.collisions import time_of_contact_s
from rapidsim.language.error_answers import ErrorOutcome
from rapidsim.language.moves import Place
from rapidsim.recording.samples import RecordedRobot
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class

ENTITY = "log"

SHOWN_LEVELS = ("ERROR", "WARN", "INFO", "DEBUG")
"""Levels shown initially; `TRACE` can be switched on."""
_EVENT_LEVELS = {
    EventKind.TEXT: "INFO",
    EventKind.SIGNAL: "DEBUG",
    EventKind.INTERRUPT: "TRACE",
    EventKind.FILE: "DEBUG",
    EventKind.SOCKET: "DEBUG",
    EventKind.MESSAGE: "DEBUG",
    EventKind.GUIDANCE: "INFO",
    EventKind.CORNER: "WARN",
    EventKind.LIMIT: "WARN",
    EventKind.FAULT: "WARN",
    EventKind.ERROR: "WARN",
}
_LOST_ERRORS = (ErrorOutcome.FELL_THROUGH, ErrorOutcome.ENDED)
_FINDING_LEVELS = {Severity.ERROR: "ERROR", Severity.WARNING: "WARN", Severity.NOTE: "INFO"}


@value_class(frozen=True, slots=True)
class _Row:
    time_s: float
    level: str
    text: str


def log_messages(stream: rr.RecordingStream, run: RecordedRobot, remarks: Sequence[str]) -> None:
    """Log all texts; `remarks` are about the recording itself."""
    simulation = run.sampled.simulation
    # With several tasks, rows contain the name of the task.
    several = len({event.task for event in simulation.events if event.place}) > 1
    sources = {
        "recording": [_Row(0.0, "WARN", remark) for remark in remarks],
        "events": [_event_row(event, several) for event in simulation.events],
        "findings": list(_finding_rows(run)),
    }
    for name, rows in sources.items():
        if not rows:
            continue
        # Milliseconds, as in the log's column; the event file has all digits.
        stream.send_columns(
            f"{ENTITY}/{name}",
            indexes=run.clock.columns([round(row.time_s, 3) for row in rows]),
            columns=rr.TextLog.columns(
                text=[row.text for row in rows], level=[row.level for row in rows]
            ),
        )


def _event_row(event: Event, several: bool) -> _Row:
    where = f"{event.task}  " if several and event.place else ""
    where += _place_text(event.place) if event.place else ""
    what = "" if event.kind is EventKind.TEXT else f"{event.kind.value}: "
    text = event.message if event.message or event.kind is not EventKind.TEXT else "(cleared)"
    lost = event.details.get("outcome") in _LOST_ERRORS
    level = "ERROR" if lost else _EVENT_LEVELS[event.kind]
    return _Row(event.time_s, level, f"{where}{what}{text}")


def _place_text(place: Place) -> str:
    """Return the place as a prefix, as in a listing, because the end of a long line is hidden."""
    return f"{place.routine}:{place.span.line}  "


def _finding_rows(run: RecordedRobot) -> Iterator[_Row]:
    """Yield findings at their time, or when the program first reached their line, or at the end."""
    first: dict[tuple[str, int], float] = {}
    if any(finding.span is not None for finding in run.sampled.simulation.diagnostics):
        for line in sorted(_lines(run.sampled.simulation), key=lambda line: line.time_s):
            span = line.place.span
            first.setdefault((span.file, span.line), line.time_s)
    for finding in run.sampled.simulation.diagnostics:
        yield _Row(
            _finding_time_s(finding, first, run.sampled.simulation),
            _FINDING_LEVELS[finding.severity],
            _finding_text(finding),
        )


def _lines(simulation: Simulation) -> Iterator[ExecutedLine]:
    for robot in simulation.robots:
        yield from robot.lines


def _finding_time_s(
    finding: Diagnostic, first: dict[tuple[str, int], float], simulation: Simulation
) -> float:
    contact_s = time_of_contact_s(finding)
    if contact_s is not None:
        return contact_s
    if finding.span is None:
        return 0.0
    return first.get((finding.span.file, finding.span.line), simulation.time_s)


def _finding_text(finding: Diagnostic) -> str:
    where = ""
    if finding.span is not None:
        routine = finding.routine or finding.span.file
        where = f"{routine}:{finding.span.line}  "
    return f"{where}{finding.violation.code} {finding.violation.message}"
