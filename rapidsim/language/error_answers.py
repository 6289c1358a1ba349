"""Errors of a program and their outcomes."""

from __future__ import annotations

from dataclasses import field
from enum import StrEnum
from typing import Protocol

from rapidsim.language.moves import Place
from rapidsim.values import value_class


class ErrorOutcome(StrEnum):
    """Effect of an ERROR clause on an error."""

    RETRIED = "retried"
    NEXT = "next"
    """TRYNEXT: the program continued after the statement."""
    RETURNED = "returned"
    RAISED = "raised"
    """The error, or another number for it, was passed on to the caller."""
    FELL_THROUGH = "fell through"
    """The clause has no branch for the error, so its routine returned as if it had succeeded."""
    ENDED = "ended the program"


@value_class(frozen=True, slots=True, eq=False)
class AnsweredError:
    """An error of one number at one place, with the outcome of one ERROR clause."""

    number: float
    name: str
    """The name of the number, or the number as text."""
    message: str
    raised: Place
    clause: Place | None
    """The ERROR clause; None if none handled the error."""
    outcome: ErrorOutcome
    key: tuple[object, ...] = field(init=False)
    """Identity of errors of one kind, whose messages may differ."""

    def __post_init__(self) -> None:
        """Compute the key, which is compared each time such an error is raised."""
        places = [
            (place.span.file, place.span.start, place.routine) if place else None
            for place in (self.raised, self.clause)
        ]
        object.__setattr__(self, "key", (self.number, self.outcome, *places))


def error_facts(error: AnsweredError) -> dict[str, object]:
    """Values of an error for programs, in addition to file, line and message."""
    clause = error.clause
    return {
        "number": error.number,
        "name": error.name,
        "routine": error.raised.routine,
        "answered_by": clause.routine if clause else None,
        "answered_file": clause.span.file if clause else None,
        "answered_line": clause.span.line if clause else None,
        "outcome": error.outcome.value,
    }


def shown_name(error: AnsweredError) -> str:
    """The name of an error in a sentence: `ERR_DIVZERO`, `error 5`."""
    return f"error {error.name}" if error.name[:1].isdigit() else error.name


def answer_text(error: AnsweredError) -> str:
    """One line: the error and its outcome."""
    return f"{shown_name(error)}: {error.message}; {answer_words(error)}"


def answer_words(error: AnsweredError) -> str:
    """Outcome of an error, as text to follow its name: `fell through main's clause`."""
    clause = error.clause
    if clause is None:
        return ErrorOutcome.ENDED.value
    words, own_words = _WORDS[error.outcome]
    if own_words and clause.routine == error.raised.routine:
        return own_words
    return words.format(clause=f"{clause.routine}'s clause")


_WORDS = {
    ErrorOutcome.RETRIED: ("retried by {clause}", "retried"),
    ErrorOutcome.NEXT: ("skipped by {clause}", "skipped"),
    ErrorOutcome.RETURNED: ("ended by {clause}, which returned", ""),
    ErrorOutcome.RAISED: ("raised on by {clause}", "raised on"),
    ErrorOutcome.FELL_THROUGH: ("fell through {clause}", ""),
    ErrorOutcome.ENDED: ("ended the program in {clause}", ""),
}
"""Text with the clause of another routine than the one that raised the error, and with its own."""


class ErrorReports(Protocol):
    """Receives the errors of a task and their outcomes."""

    def error_mark(self) -> object:
        """The current moment, for `answered`."""
        ...

    def answered(self, mark: object, error: AnsweredError) -> None:
        """Record an error that was raised at a moment and has been handled since."""
        ...
