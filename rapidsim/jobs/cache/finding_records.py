"""Lossless conversion of findings and coverage to JSON values, and back.

Records are passed between processes, and stored between checks. They do not include the texts of
files: the reader of a record has the files.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from importlib import import_module
from typing import Any

from rapidsim.diagnostics import Diagnostic, Source, Span, Violation
from rapidsim.jobs.inputs.robot_choice import RobotChoice
from rapidsim.json_records.encoding import RecordEncoder
from rapidsim.json_records.reading import RecordReader
from rapidsim.reach.checked_moves import Coverage
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
    convert = RecordEncoder({Span: places.of, Violation: _violation_record})
    findings = convert(stored)
    return [places.texts, findings]


def read_findings(record: Any, sources: Iterable[Source]) -> StoredFindings:
    """Convert a record to findings, with positions in the sources.

    Raises:
        NoRecordError: If it is not a record, or was made of other files.
    """
    known = {one.file: one for one in sources}
    try:
        texts, findings = record
        files = [known[name] if text is None else Source(name, text) for name, text in texts]
        convert = RecordReader({Span: lambda place: _span(files, place), Violation: _violation})
        return convert(StoredFindings, findings)
    except (AttributeError, ImportError, IndexError, KeyError, TypeError, ValueError) as error:
        raise NoRecordError(str(error)) from error


class _Places:
    """Spans as numbers: index of the text, first and last character."""

    def __init__(self, places: Mapping[str, str]) -> None:
        self.texts: list[tuple[str, str | None]] = []
        """Name and text; None if `places` contains the text."""
        self._known = places
        self._numbers: dict[tuple[str, str | None], int] = {}

    def of(self, span: Span) -> Sequence[int]:
        span = span.written
        source = span.source
        known = self._known.get(source.file) == source.text
        text = (source.file, None if known else source.text)
        number = self._numbers.setdefault(text, len(self.texts))
        if number == len(self.texts):
            self.texts.append(text)
        return number, span.start, span.end


def _span(sources: Sequence[Source], place: Sequence[int]) -> Span:
    number, start, end = place
    return Span(sources[number], start, end)


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
