"""Errors of a program and what became of them."""

from __future__ import annotations

from dataclasses import field
from enum import StrEnum
from typing import Protocol

from rapidsim.language.moves import Place
from rapidsim.values import value_class


class ErrorOutcome(StrEnum):
    """What an ERROR clause did about an error."""

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
    """An error of one number at one place, and what one ERROR clause did about it."""

    number: float
    name: str
    """The name of the number, or the number as text."""
    message: str
    raised: Place
    clause: Place | None
    """The ERROR clause; None if none took the error."""
    outcome: ErrorOutcome
    key: tuple[object, ...] = field(init=False)
    """What errors of one kind have in common; their messages may differ."""

    def __post_init__(self) -> None:
        """Work out the key, which is compared each time such an error is raised."""
        places = [
            (place.span.file, place.span.start, place.routine) if place else None
            for place in (self.raised, self.clause)
        ]
        object.__setattr__(self, "key", (self.number, self.outcome, *places))


def error_facts(error: AnsweredError) -> dict[str, object]:
    """The values of an error that a program wants to read, beside file, line and message."""
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
    """One line: the error, and what became of it."""
    return f"{shown_name(error)}: {error.message}; {answer_words(error)}"


def answer_words(error: AnsweredError) -> str:
    """What became of an error, in words to follow its name: `fell through main's clause`."""
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
"""With the clause of another routine than the one that raised the error, and with its own."""


class ErrorReports(Protocol):
    """Where a task notes its errors and what became of them."""

    def error_mark(self) -> object:
        """The present moment, for `answered`."""
        ...

    def answered(self, mark: object, error: AnsweredError) -> None:
        """Note an error that was raised at a moment and has been answered since."""
        ...
