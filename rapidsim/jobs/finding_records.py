"""Findings and coverage as lists and texts that JSON can hold, and back; the same to the last bit.

They pass so from one process to another, and from one check to the next. Texts of files do not go
along: who reads a record has the files.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from importlib import import_module
from typing import Any

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Source, Span, Violation
from rapidsim.jobs.robot_choice import RobotChoice
from rapidsim.reach.checked_moves import Coverage, UncheckedMove
from rapidsim.values import value_class

Record = list[Any]
"""What JSON can hold."""
_PACKAGE = __name__.partition(".")[0]


class NoRecordError(Exception):
    """What is read is no record of this version."""


@value_class(frozen=True, slots=True, eq=False)
class StoredFindings:
    """What a record holds."""

    diagnostics: tuple[Diagnostic, ...]
    coverage: Coverage
    notices: tuple[str, ...]
    """What is special about the arms that were used."""
    lasts: bool
    """Whether another check finds the same; not where a run had no more time on the clock."""
    arm: RobotChoice | None = None
    """The arm on which moves were checked; None of one task."""


def record_of(stored: StoredFindings, sources: Iterable[Source]) -> Record:
    """What was found as a record.

    Args:
        stored: It.
        sources: Texts that need not be in it; others are.
    """
    places = _Places({one.file: one.text for one in sources})
    coverage = stored.coverage
    diagnostics = [_diagnostic_record(one, places) for one in stored.diagnostics]
    unchecked, unchecked_paths = (
        [[places.of(one.span), one.reason] for one in moves]
        for moves in (coverage.unchecked, coverage.unchecked_paths)
    )
    counts = [coverage.by_value, coverage.by_run, unchecked, coverage.main_left_out]
    counts += [coverage.paths, unchecked_paths]
    arm = None if stored.arm is None else [stored.arm.name, stored.arm.reason, stored.arm.scale]
    return [places.texts, diagnostics, counts, list(stored.notices), stored.lasts, arm]


def read_findings(record: object, sources: Iterable[Source]) -> StoredFindings:
    """What a record holds, with these sources at its places.

    Raises:
        NoRecordError: If it is none, or was made of other files.
    """
    try:
        return _found_in(record, {one.file: one for one in sources})
    except (AttributeError, ImportError, IndexError, KeyError, TypeError, ValueError) as error:
        raise NoRecordError(str(error)) from error


def _found_in(record: Any, known: Mapping[str, Source]) -> StoredFindings:
    texts, diagnostics, counts, notices, lasts, arm = record
    by_value, by_run, unchecked, left_out, paths, unchecked_paths = counts
    sources = [known[name] if text is None else Source(name, text) for name, text in texts]
    spans = _Spans(sources)
    return StoredFindings(
        tuple(_diagnostic(one, spans) for one in diagnostics),
        Coverage(
            by_value,
            by_run,
            tuple(UncheckedMove(spans.at(place), reason) for place, reason in unchecked),
            left_out,
            paths,
            tuple(UncheckedMove(spans.at(place), reason) for place, reason in unchecked_paths),
        ),
        tuple(notices),
        lasts,
        None if arm is None else RobotChoice(*arm),
    )


class _Places:
    """Spans as numbers: which text, first and last character."""

    def __init__(self, places: Mapping[str, str]) -> None:
        self.texts: list[tuple[str, str | None]] = []
        """Name and text; None where `known` has it."""
        self._known = places
        self._numbers: dict[tuple[str, str | None], int] = {}

    def of(self, span: Span) -> Sequence[int]:
        source = span.source
        known = self._known.get(source.file) == source.text
        text = (source.file, None if known else source.text)
        number = self._numbers.setdefault(text, len(self.texts))
        if number == len(self.texts):
            self.texts.append(text)
        return number, span.start, span.end


class _Spans:
    """Spans again, all of a file in the same source."""

    def __init__(self, sources: Sequence[Source]) -> None:
        self._sources = sources

    def at(self, place: Sequence[int]) -> Span:
        number, start, end = place
        return Span(self._sources[number], start, end)


def _diagnostic_record(finding: Diagnostic, places: _Places) -> Record:
    fix = finding.fix
    return [
        _violation_record(finding.violation),
        finding.span and places.of(finding.span),
        [[places.of(related.span), related.message] for related in finding.related],
        fix and [fix.title, [[places.of(edit.span), edit.text] for edit in fix.edits], fix.safe],
        finding.routine,
        finding.assumed,
    ]


def _diagnostic(record: Any, spans: _Spans) -> Diagnostic:
    violation, place, related, fix, routine, assumed = record
    return Diagnostic(
        _violation(violation),
        place and spans.at(place),
        tuple(Related(spans.at(at), message) for at, message in related),
        fix and Fix(fix[0], tuple(Edit(spans.at(at), text) for at, text in fix[1]), fix[2]),
        routine,
        assumed,
    )


def _violation_record(violation: Violation) -> Record:
    kind = type(violation)
    facts = [_fact_record(getattr(violation, name)) for name in kind.facts]
    return [kind.__module__, kind.__qualname__, facts]


def _violation(record: Any) -> Violation:
    module, name, facts = record
    kind = getattr(_own_module(module), name)
    if not issubclass(kind, Violation):
        raise TypeError(f"{name} is no violation")
    made: Violation = kind(*map(_fact, facts))
    return made


def _own_module(name: str) -> object:
    if name.partition(".")[0] != _PACKAGE:
        raise ValueError(f"{name} is not ours")
    return import_module(name)


def _fact_record(fact: Any) -> Any:
    """A fact: a text, a number, or several of them; others of its kind as an object."""
    if isinstance(fact, Violation):
        return {"violation": _violation_record(fact)}
    if isinstance(fact, tuple):
        return [_fact_record(one) for one in fact]
    if fact is None or isinstance(fact, str | bool | int | float):
        return fact
    # NumPy's numbers are no subclasses of Python's, but for the one that all compute with.
    return fact.item()


def _fact(record: Any) -> Any:
    if isinstance(record, dict):
        return _violation(record["violation"])
    return tuple(map(_fact, record)) if isinstance(record, list) else record
