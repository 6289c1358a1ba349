"""Errors of one task, recorded in its journal."""

from __future__ import annotations

from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.journal import ErrorMark, Journal
from rapidsim.language.error_answers import AnsweredError
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TaskErrors:
    """Implements `language.error_answers.ErrorReports`."""

    clock: TaskClock
    journal: Journal

    def error_mark(self) -> ErrorMark:
        """The current moment, for `answered`."""
        return self.journal.error_mark(self.clock.moment())

    def answered(self, mark: object, error: AnsweredError) -> None:
        """Record an error that was raised at a moment and has been handled since."""
        assert isinstance(mark, ErrorMark)
        self.journal.error(mark, error)
