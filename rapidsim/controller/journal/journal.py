"""Dated record of a run, while the times themselves may still be unknown.

The program runs ahead of the robot: an output set after a fly-by move happens when the robot starts
that move, and that time is unknown until the path is planned. An `Instant` represents such a time;
entries refer to it and are dated when the run is over.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import field, replace
from typing import NamedTuple

import numpy as np

from rapidsim.controller.journal.events import (
    ErrorTally,
    Event,
    EventKind,
    Unsimulated,
    Wait,
)
from rapidsim.controller.journal.executed_lines import (
    DatedPlace,
    DatedRows,
    ExecutedLines,
    in_parts,
)
from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.controller.journal.stop_reasons import EventLimitReached
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.findings.runs import AcceptedWithoutEffect, RoutineNotSimulated
from rapidsim.language.controller import ACCEPTED
from rapidsim.language.error_answers import AnsweredError, answer_text, error_facts
from rapidsim.language.moves import AnnouncedTargets, Place
from rapidsim.values import value_class

ITEMS_OF_A_MOVE = 8
"""Items that take as long to date and write as a move, with its part of the figures of a run."""
MOST_EVENTS = 1_000_000
"""Maximum number of events of a run: an endless loop that writes would exhaust the memory."""

_MANY_LINES = 1000
"""Number of statements that settle together at least."""


class Instant:
    """A point in virtual time; `time` [s] is None until the path that decides it is planned."""

    __slots__ = ("time",)

    def __init__(self, time: float | None = None) -> None:
        """Make an instant, known now or later."""
        self.time = time


@value_class(frozen=True, slots=True)
class Moment:
    """A time some seconds after an instant."""

    instant: Instant
    offset_s: float = 0.0

    @property
    def is_known(self) -> bool:
        """Whether its time is known."""
        return self.instant.time is not None

    @property
    def time_s(self) -> float:
        """Virtual time [s]; the instant must be known."""
        assert self.instant.time is not None
        return self.instant.time + self.offset_s

    @property
    def earliest_s(self) -> float:
        """Virtual time [s]; minus infinity if the instant is unknown."""
        return self.time_s if self.is_known else -math.inf


@value_class(frozen=True, slots=True, eq=False)
class _Rows:
    """Successive statements with announced targets, reached at instants that follow each other."""

    instants: Sequence[Instant]
    targets: AnnouncedTargets
    first: int

    @property
    def size(self) -> int:
        """Number of statements."""
        return len(self.instants)

    @property
    def has_time(self) -> bool:
        """Whether the times of all are known."""
        return self.instants[-1].time is not None

    def part(self) -> Sequence[DatedPlace]:
        """Return those whose times are known."""
        times = [one.time for one in self.instants if one.time is not None]
        return DatedRows(np.array(times), self.targets, self.first)


class _Line(NamedTuple):
    """A statement."""

    moment: Moment
    place: Place

    @property
    def size(self) -> int:
        """Number of statements."""
        return 1

    @property
    def has_time(self) -> bool:
        """Whether its time is known."""
        return self.moment.is_known


@value_class(frozen=True, slots=True)
class ErrorMark:
    """Moment of an error and its position: events of its handler follow it."""

    moment: Moment
    position: int
    """In the list of events."""


@value_class(slots=True)
class _Entry:
    moment: Moment
    event: Event
    """Its own time is unused."""
    is_committed: bool = False

    def dated(self) -> Event:
        """The event with its time, which must be known."""
        # The details of an error change as long as it is raised.
        return replace(self.event, time_s=self.moment.time_s, details=dict(self.event.details))


@value_class(slots=True)
class _Tally:
    """Number of times that an error was raised and answered in one way."""

    error: AnsweredError
    first: Moment
    last: Moment
    count: int
    entry: _Entry
    details: dict[str, object]


@value_class(slots=True)
class Journal:
    """Everything a task reports while it runs."""

    task: str
    retains_all: bool = True
    """Whether statements, waits and findings are kept, which grow without bound."""
    moves_given: int = 0
    """Number of moves that the task's robot has got."""
    _events: list[_Entry] = field(default_factory=list)
    _lines: list[_Line | _Rows] = field(default_factory=list)
    _settled: list[Sequence[DatedPlace]] = field(default_factory=list)
    """Statements before these, in parts."""
    _more_lines: int = 0
    """Number of statements so far, less the number of entries of `_lines`."""
    _waits: list[Wait] = field(default_factory=list)
    _diagnostics: list[Diagnostic] = field(default_factory=list)
    _failed_moves: list[FailedMove] = field(default_factory=list)
    _reported: set[object] = field(default_factory=set)
    _errors: dict[AnsweredError, _Tally] = field(default_factory=dict)
    _unsimulated: dict[tuple[str, str, bool], int] = field(default_factory=dict)
    _first_met: dict[tuple[str, str, bool], Place] = field(default_factory=dict)
    on_finding: Callable[[Diagnostic], None] | None = None
    """Called at once with each finding or unsimulated routine, once for each rule and place."""
    remarks: int = 0
    """Number of findings, failed moves and unsimulated calls so far."""

    def for_task(self, task: str) -> Journal:
        """The journal of another task of the cell, whose events go into the same list.

        Events at the same instant thus keep the order in which they happened.
        """
        return Journal(task, self.retains_all, _events=self._events, on_finding=self.on_finding)

    @property
    def noted(self) -> int:
        """The number of events of the cell and statements of this task so far; moves count more."""
        statements = len(self._lines) + self._more_lines
        return len(self._events) + statements + ITEMS_OF_A_MOVE * self.moves_given

    def undated(self, begin: int) -> tuple[Event, ...]:
        """The events of the cell from a position on; their times may be unknown, and are NaN."""
        return tuple(one.event for one in self._events[begin:])

    def event(
        self, moment: Moment, kind: EventKind, place: Place | None, message: str, **details: object
    ) -> None:
        """Record an event."""
        event = Event(math.nan, self.task, kind, place, message, details, self.moves_given)
        self._insert(len(self._events), _Entry(moment, event))

    def _insert(self, position: int, entry: _Entry) -> None:
        if len(self._events) >= MOST_EVENTS:
            raise EventLimitReached(
                f"the run was cut off: {MOST_EVENTS} events are as many as it may note"
            )
        self._events.insert(position, entry)

    def error_mark(self, moment: Moment) -> ErrorMark:
        """Position of an error among the events, at which it is recorded once it is answered."""
        return ErrorMark(moment, len(self._events))

    def error(self, mark: ErrorMark, error: AnsweredError) -> None:
        """Record an error that was raised at a mark; errors of one kind are one event."""
        tally = self._errors.get(error) or self._same_tally(error)
        if tally is None:
            entry, details = self._error_event(mark, error)
            self._errors[error] = _Tally(error, mark.moment, mark.moment, 1, entry, details)
            return
        tally.last = mark.moment
        tally.count += 1
        if tally.entry.is_committed:
            tally.entry, tally.details = self._error_event(mark, error)
        else:
            tally.details["count"] = tally.details["count"] + 1  # type: ignore[operator]

    def _same_tally(self, error: AnsweredError) -> _Tally | None:
        """The tally of the same error before its program was loaded again."""
        known = next((known for known in self._errors if known.key == error.key), None)
        if known is None:
            return None
        tally = self._errors[error] = self._errors.pop(known)
        return tally

    def _error_event(
        self, mark: ErrorMark, error: AnsweredError
    ) -> tuple[_Entry, dict[str, object]]:
        details: dict[str, object] = {**error_facts(error), "count": 1}
        message = answer_text(error)
        event = Event(
            math.nan, self.task, EventKind.ERROR, error.raised, message, details, self.moves_given
        )
        entry = _Entry(mark.moment, event)
        self._insert(min(mark.position, len(self._events)), entry)
        return entry, details

    def errors(self, end_s: float) -> tuple[ErrorTally, ...]:
        """The errors of this task in order of their first times; unplanned times are the end."""
        tallies = []
        for tally in self._errors.values():
            first_s, last_s = (
                moment.time_s if moment.is_known else end_s for moment in (tally.first, tally.last)
            )
            tallies.append(ErrorTally(first_s, last_s, self.task, tally.error, tally.count))
        return tuple(sorted(tallies, key=lambda tally: tally.time_s))

    def take(self) -> tuple[Event, ...]:
        """Remove and return the events of the cell whose time is known."""
        events = self.events()
        for entry in self._events:
            entry.is_committed = entry.moment.is_known
        self._events[:] = [entry for entry in self._events if not entry.is_committed]
        return events

    def restore(self, events: Iterable[Event]) -> None:
        """Record taken events again."""
        self._events[:0] = [_Entry(Moment(Instant(one.time_s)), one) for one in events]

    def line(self, moment: Moment, place: Place) -> None:
        """Record that the program pointer reached a statement."""
        if self.retains_all and (not self._lines or self._lines[-1] != (moment, place)):
            self._lines.append(_Line(moment, place))

    def rows(self, instants: Sequence[Instant], targets: AnnouncedTargets, first: int) -> None:
        """Record that the pointer reached statements with announced targets, from a number on."""
        if self.retains_all:
            self._lines.append(_Rows(instants, targets, first))
            self._more_lines += len(instants) - 1

    def settle(self) -> None:
        """Store many statements whose times are known as columns."""
        count = next(
            (at for at, line in enumerate(self._lines) if not line.has_time), len(self._lines) - 1
        )
        size = sum(one.size for one in self._lines[:count])
        if size >= _MANY_LINES:
            self._settled += _parts_of(self._lines[:count])
            self._more_lines += count
            del self._lines[:count]

    def wait(self, wait: Wait) -> None:
        """Record a wait that is over."""
        if self.retains_all:
            self._waits.append(wait)

    def finding(
        self,
        violation: Violation,
        place: Place | None,
        *,
        once: object = None,
        assumed: bool = False,
    ) -> None:
        """Record a finding; with `once`, only the first of those that share the key.

        A finding that is `assumed` is no error: the run continues.
        """
        if once is not None:
            if self.has_finding(once):
                return
            self._reported.add(once)
        self.remarks += 1
        if not self.retains_all and self.on_finding is None:
            return
        span = place.span if place else None
        routine = place.routine if place else None
        found = Diagnostic(violation, span, routine=routine, assumed=assumed)
        if self.retains_all:
            self._diagnostics.append(found)
        self._add_finding(found)

    def failed_move(self, failed: FailedMove) -> None:
        """Record a move that could not be made; once, even if a loop tries it again."""
        self.remarks += 1
        key = (failed.place.span, failed.violation)
        if self.retains_all and key not in self._reported:
            self._reported.add(key)
            self._failed_moves.append(failed)

    def has_finding(self, once: object) -> bool:
        """Whether a finding with this key has been recorded, so that its facts can be skipped."""
        return once in self._reported

    def unsimulated(
        self, name: str, treated_as: str, place: Place, *, is_unknown: bool = False
    ) -> None:
        """Count a routine that was not simulated, and record where it was first called."""
        self.remarks += 1
        key = (name, treated_as, is_unknown)
        self._unsimulated[key] = self._unsimulated.get(key, 0) + 1
        self._first_met.setdefault(key, place)
        self._add_finding(not_simulated_finding(name, treated_as, place))

    def _add_finding(self, finding: Diagnostic) -> None:
        key = (finding.code, finding.span)
        if self.on_finding is not None and key not in self._reported:
            self._reported.add(key)
            self.on_finding(finding)

    def events(self) -> tuple[Event, ...]:
        """All events of the cell in order of time; at the same time, in the order of recording."""
        dated = [one.dated() for one in self._events if one.moment.instant.time is not None]
        return tuple(sorted(dated, key=lambda event: event.time_s))

    def lines(self) -> ExecutedLines:
        """All statements in order of time."""
        return ExecutedLines(self.task, [*self._settled, *_parts_of(self._lines)])

    def waits(self) -> tuple[Wait, ...]:
        """All waits of this task in order of their starts."""
        return tuple(sorted(self._waits, key=lambda wait: wait.start_s))

    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All findings, in the order they were made."""
        return tuple(self._diagnostics)

    def failed_moves(self) -> tuple[FailedMove, ...]:
        """The moves that could not be made, in the order they were tried."""
        return tuple(self._failed_moves)

    def not_simulated(self) -> tuple[Unsimulated, ...]:
        """All routines that were not simulated, in the order of their first calls."""
        return tuple(
            Unsimulated(name, count, how, is_unknown)
            for (name, how, is_unknown), count in self._unsimulated.items()
        )

    def first_met(self, notice: Unsimulated) -> Place:
        """Place at which an unsimulated routine was first called."""
        return self._first_met[notice.name, notice.treated_as, notice.is_unknown]


def not_simulated_finding(name: str, treated_as: str, place: Place) -> Diagnostic:
    """Finding for a routine that was called and not simulated, or accepted without effect."""
    kind = AcceptedWithoutEffect if treated_as.startswith(ACCEPTED) else RoutineNotSimulated
    return Diagnostic(kind(name, treated_as), place.span, routine=place.routine)


def _parts_of(lines: Sequence[_Line | _Rows]) -> list[Sequence[DatedPlace]]:
    """Return the statements whose times are known, in parts."""
    parts: list[Sequence[DatedPlace]] = []
    others: list[DatedPlace] = []
    for line in lines:
        if isinstance(line, _Line):
            if line.has_time:
                others.append((line.moment.time_s, line.place))
            continue
        parts += [*in_parts(others), line.part()]
        others = []
    return [*parts, *in_parts(others)]
