"""The errors of one task, noted in its journal."""

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
        """The present moment, for `answered`."""
        return self.journal.error_mark(self.clock.moment())

    def answered(self, mark: object, error: AnsweredError) -> None:
        """Note an error that was raised at a moment and has been answered since."""
        assert isinstance(mark, ErrorMark)
        self.journal.error(mark, error)
