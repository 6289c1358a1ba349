"""Lossless conversion of findings and coverage to JSON values, and back.

Records are passed between processes, and stored between checks. They do not include the texts of
files: the reader of a record has the files.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from importlib import import_module
from typing import Any

from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Source, Span, Violation
from rapidsim.jobs.inputs.robot_choice import RobotChoice
from rapidsim.reach.checked_moves import Coverage, UncheckedMove
from rapidsim.values import value_class

Record = list[Any]
"""Values that JSON can represent."""
_PACKAGE = __name__.partition(".")[0]


class NoRecordError(Exception):
    """A value that is not a record of this version."""


@value_class(frozen=True, slots=True, eq=False)
class StoredFindings:
    """Content of a record."""

    diagnostics: tuple[Diagnostic, ...]
    coverage: Coverage
    notices: tuple[str, ...]
    """Notices about the arms that were used."""
    lasts: bool
    """Whether another check finds the same; False if the wall-clock limit ended a run."""
    arm: RobotChoice | None = None
    """Arm on which moves were checked; None for one task."""


def record_of(stored: StoredFindings, sources: Iterable[Source]) -> Record:
    """Convert findings to a record.

    Args:
        stored: The findings.
        sources: Texts that the record may omit; others are included.
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
    """Convert a record to findings, with positions in the sources.

    Raises:
        NoRecordError: If it is not a record, or was made of other files.
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
    """Spans as numbers: index of the text, first and last character."""

    def __init__(self, places: Mapping[str, str]) -> None:
        self.texts: list[tuple[str, str | None]] = []
        """Name and text; None if `places` contains the text."""
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
    """Numbers as spans, with one source object per file."""

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
    """Convert a fact: a text, a number, or several of them; a violation becomes an object."""
    if isinstance(fact, Violation):
        return {"violation": _violation_record(fact)}
    if isinstance(fact, tuple):
        return [_fact_record(one) for one in fact]
    if fact is None or isinstance(fact, str | bool | int | float):
        return fact
    # NumPy's numbers are no subclasses of Python's, except float64.
    return fact.item()


def _fact(record: Any) -> Any:
    if isinstance(record, dict):
        return _violation(record["violation"])
    return tuple(map(_fact, record)) if isinstance(record, list) else record
