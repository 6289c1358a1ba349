"""Record of errors: the statement that raised each, and the ERROR clause that answered it.

Errors may be many. The record of one depends on the code that raised and the code that answered it,
so it is determined once and looked up afterwards.
"""

from __future__ import annotations

from types import CodeType, FunctionType, TracebackType
from typing import cast

from rapidsim.interpreter.runtime.bulk_execution import ROW
from rapidsim.interpreter.runtime.call_stack import Origin, frame_of
from rapidsim.interpreter.runtime.error_recovery import GENERATED, Handler, LongJump, is_generated
from rapidsim.language.error_answers import AnsweredError, ErrorOutcome, ErrorReports
from rapidsim.language.error_numbers import name_of
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import Place

_Key = tuple[CodeType, int, object, CodeType, float, ErrorOutcome]


class ErrorTrace:
    """The errors of one task."""

    def __init__(self, reports: ErrorReports) -> None:
        """Record them with a controller."""
        self._reports = reports
        self._known: dict[_Key, AnsweredError] = {}

    def mark(self) -> object:
        """Return the current moment, for `answered`."""
        return self._reports.error_mark()

    def answered(
        self, mark: object, error: RapidError, handler: Handler, outcome: ErrorOutcome
    ) -> None:
        """Record the outcome of an ERROR clause for an error."""
        entry = _innermost(error)
        if entry is None:
            # An error of an initial value: no routine runs.
            return
        clause = cast(FunctionType, handler)
        code = entry.tb_frame.f_code
        row = entry.tb_frame.f_locals.get(ROW) if ROW in code.co_varnames else None
        key = (code, entry.tb_lasti, row, clause.__code__, error.errno, outcome)
        known = self._known.get(key)
        if known is None:
            known = self._known[key] = AnsweredError(
                error.errno, name_of(error), error.message, _place(entry), _clause(clause), outcome
            )
        self._reports.answered(mark, known)


def _innermost(error: RapidError) -> TracebackType | None:
    """The entry of the RAPID statement that raised an error."""
    found = None
    traceback = (error.error if isinstance(error, LongJump) else error).__traceback__
    while traceback is not None:
        if is_generated(traceback.tb_frame):
            found = traceback
        traceback = traceback.tb_next
    return found


def _place(entry: TracebackType) -> Place:
    frame = frame_of(entry)
    return Place(frame.span, frame.routine)


def _clause(handler: FunctionType) -> Place | None:
    origin: Origin = handler.__globals__[GENERATED]
    symbol = origin.routines.get(handler.__code__.co_qualname.partition(".")[0])
    if symbol is None or symbol.node.error is None:
        return None
    return Place(symbol.module.span(symbol.node.error), symbol.name)
