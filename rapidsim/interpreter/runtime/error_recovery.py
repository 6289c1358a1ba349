"""Errors at run time: ERROR clauses, long jumps, UNDO, traps, and uncatchable errors.

A routine's ERROR clause is a function inside its Python function. It returns 1 for RETRY, 0 for
TRYNEXT, raises `HandlerReturn` for RETURN and `ErrorPropagation` for RAISE. A statement that may
fail is wrapped in a small loop that calls `recover` for the decision.

Source: Technical reference manual RAPID Overview, "Error recovery" and "UNDO".
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import field
from functools import partial
from types import CodeType, FrameType, TracebackType
from typing import Final, Protocol

from rapidsim.language.controller import ErrorNumbers
from rapidsim.language.error_answers import ErrorOutcome
from rapidsim.language.error_numbers import (
    ERR_DIVZERO,
    ERR_EXCRTYMAX,
    ERR_FNCNORET,
    ERR_ILLRAISE,
    FIRST_BOOKED,
    IN_ERROR,
    IN_NO_HANDLER,
    IN_UNDO,
    LONG_JMP_ALL_ERR,
    MAX_RETRIES,
    NUMBERS,
    rapid_error,
)
from rapidsim.language.errors import (
    ProgramReset,
    RaisedError,
    RaisedToUser,
    RapidError,
    Stopped,
)
from rapidsim.values import value_class

ERRORS: Final = (RapidError, ZeroDivisionError)
"""Errors that a program can catch. Python itself raises on division by zero; any other is a bug."""

GENERATED: Final = "_rapid_origin"
"""A name that the namespaces of generated code have, and no other namespace."""

Handler = Callable[[RapidError], int]


class Trace(Protocol):
    """Recorder of the errors that ERROR clauses handle."""

    def mark(self) -> object:
        """Return the current moment, for `answered`."""
        ...

    def answered(
        self, mark: object, error: RapidError, handler: Handler, outcome: ErrorOutcome
    ) -> None:
        """Record the outcome of an ERROR clause for an error that was raised at a moment."""
        ...


class HandlerReturn(Exception):  # noqa: N818 - it is no error
    """RETURN in an ERROR clause: the routine returns a value."""

    def __init__(self, value: object) -> None:
        """Take the value of a function, None for other routines."""
        super().__init__(value)
        self.value = value


class FellThrough(HandlerReturn):
    """The end of an ERROR clause that does not handle the error."""


class ErrorPropagation(Exception):  # noqa: N818 - it carries one
    """RAISE in an ERROR clause: the error propagates to the caller."""

    def __init__(self, error: RapidError) -> None:
        """Carry the error."""
        super().__init__(error)
        self.error = error


class LongJump(RapidError):  # noqa: N818 - it is no new error
    """An error that propagates to the ERROR clause of an outer routine that lists its number."""

    def __init__(self, error: RapidError, target: FrameType) -> None:
        """Take an error and the frame of the routine that handles it."""
        super().__init__(error.errno, error.message, cf=error.cf, name=error.name)
        self.error = error
        self.target = target


class Unrecoverable(BaseException):
    """An error that no ERROR clause may handle: in an ERROR or UNDO clause, or from a trap."""

    def __init__(self, error: RapidError) -> None:
        """Carry the error."""
        super().__init__(error)
        self.error = error


@value_class(frozen=True, slots=True)
class Recovery:
    """The error handling of one task."""

    numbers: ErrorNumbers
    trace: Trace
    long_jumps: dict[CodeType, Callable[[], tuple[float, ...]]] = field(default_factory=dict)
    """For each routine whose ERROR clause lists numbers: a function that returns them."""
    ended: list[Callable[[], object]] = field(default_factory=list)
    """UNDO clauses of the routines in which the program has ended with an error, innermost first:
    a controller is still in them."""

    def recover(self, handler: Handler, error: Exception, tries: int) -> int:
        """Let an ERROR clause decide about an error.

        Args:
            handler: The clause.
            error: One of `ERRORS`.
            tries: How often the statement was retried.

        Returns:
            0 to continue after the statement, otherwise the number of tries so far, to retry it.
        """
        rapid = as_rapid_error(error)
        if isinstance(rapid, LongJump) and rapid.target is not sys._getframe(1):
            raise rapid
        if isinstance(rapid, RaisedToUser) and _hides(sys._getframe(1)):
            raise rapid
        self.ended.clear()
        numbers = self.numbers
        # If a clause calls a routine with an ERROR clause, each counts its own retries.
        around, tries_around = numbers.handler, numbers.retries
        numbers.errno, numbers.retries, numbers.handler = rapid.errno, tries, IN_ERROR
        mark, outcome = self.trace.mark(), ErrorOutcome.ENDED
        try:
            retry = handler(rapid)
            outcome = ErrorOutcome.RETRIED if retry else ErrorOutcome.NEXT
        except HandlerReturn as leave:
            dropped = isinstance(leave, FellThrough)
            outcome = ErrorOutcome.FELL_THROUGH if dropped else ErrorOutcome.RETURNED
            raise
        except RaisedToUser:
            outcome = ErrorOutcome.RAISED
            raise
        except ErrorPropagation as propagated:
            outcome = ErrorOutcome.RAISED
            error = propagated.error
            if error.__traceback__ is None:
                # A new error, raised in the clause.
                error = error.with_traceback(propagated.__traceback__)
            raise error from None
        except RaisedError as inside:
            outcome = ErrorOutcome.RAISED
            raise inside from None
        except ERRORS as inside:
            raise Unrecoverable(as_rapid_error(inside)) from inside
        finally:
            # ResetRetryCount may have restarted the count.
            tries = numbers.retries
            numbers.handler = around
            if around == IN_ERROR:
                numbers.retries = tries_around
            if outcome is ErrorOutcome.RETRIED and tries >= MAX_RETRIES:
                outcome = ErrorOutcome.RAISED
            self.trace.answered(mark, rapid, handler, outcome)
        if not retry:
            return 0
        if tries >= MAX_RETRIES:
            raise rapid_error(ERR_EXCRTYMAX, f"{tries} retries did not help: {rapid.message}")
        return tries + 1

    def leave(self, exception: BaseException, clause: Callable[[], object]) -> None:
        """Run the UNDO clause of a routine that an exception leaves, or keep it; see `ended`."""
        if isinstance(exception, LongJump):
            if exception.target is not sys._getframe(1):
                self.undo(clause)
        elif isinstance(exception, ProgramReset):
            self.undo(clause)
        elif not isinstance(exception, HandlerReturn):
            self.ended.append(clause)

    def undo_ended(self) -> None:
        """Run the UNDO clauses of the routines in which the program has ended with an error."""
        clauses = tuple(self.ended)
        self.ended.clear()
        for clause in clauses:
            self.undo(clause)

    def undo(self, clause: Callable[[], object]) -> None:
        """Run the UNDO clause of a routine; after an error or EXIT in it, no other one runs."""
        around, self.numbers.handler = self.numbers.handler, IN_UNDO
        try:
            clause()
        except ProgramReset as again:
            raise Stopped(again.reason).with_traceback(again.__traceback__) from None
        except ERRORS as inside:
            raise Unrecoverable(as_rapid_error(inside)) from inside
        finally:
            self.numbers.handler = around

    def propagate(self, error: RapidError, number: float | None, written: str) -> ErrorPropagation:
        """RAISE in an ERROR clause, with an explicit number, as written, or the current one."""
        if number is not None:
            error = raised(number, written)
        elif isinstance(error, LongJump):
            error = error.error
        # Up from the ERROR clause over `recover` and its routine to that routine's caller.
        frame: FrameType | None = sys._getframe(1)
        while frame is not None and (not is_generated(frame) or frame.f_code.co_name == "ERROR"):
            frame = frame.f_back
        target = self._long_jump_target(error.errno, frame.f_back if frame is not None else None)
        return ErrorPropagation(error if target is None else LongJump(error, target))

    def _long_jump_target(self, errno: float, frame: FrameType | None) -> FrameType | None:
        """Nearest routine, from a frame outwards, whose ERROR clause lists the number."""
        if not self.long_jumps:
            return None
        while frame is not None:
            in_handler = is_generated(frame) and frame.f_code.co_name == "ERROR"
            if in_handler or frame.f_code is Recovery._run_trap.__code__:
                return None
            numbers = self.long_jumps.get(frame.f_code)
            if numbers is not None:
                wanted = numbers()
                if errno in wanted or LONG_JMP_ALL_ERR in wanted:
                    return frame
            frame = frame.f_back
        return None

    def trap(self, routine: Callable[[], object]) -> Callable[[], None]:
        """Wrap a trap routine for the controller: ERRNO is preserved, errors are fatal.

        An error listed in an ERROR clause of the interrupted routines propagates there instead.
        """
        return partial(self._run_trap, routine)

    def _run_trap(self, routine: Callable[[], object]) -> None:
        numbers = self.numbers
        errno, retries, around = numbers.errno, numbers.retries, numbers.handler
        numbers.handler = IN_NO_HANDLER
        try:
            routine()
        except ERRORS as error:
            rapid = as_rapid_error(error)
            target = self._long_jump_target(rapid.errno, sys._getframe(1))
            if target is None:
                raise Unrecoverable(rapid) from error
            raise LongJump(rapid, target) from error
        finally:
            numbers.handler = around
        numbers.errno, numbers.retries = errno, retries


def _hides(frame: FrameType) -> bool:
    """Whether a routine belongs to a module that is NOSTEPIN."""
    attributes = frame.f_globals[GENERATED].module.attributes
    return any(name.key == "nostepin" for name in attributes)


def raised(number: float, written: str) -> RapidError:
    """The error of `RAISE number`, with the number as written."""
    names = [name for name, value in NUMBERS.items() if value == number]
    if not (names or 1 <= number <= 90 or number >= FIRST_BOOKED) or number != int(number):
        what = written if written == f"{number:g}" else f"{written}, which is {number:g}"
        return rapid_error(
            ERR_ILLRAISE, f"RAISE {what}: allowed are 1 to 90, booked numbers and ERR_ names"
        )
    message = f"the program raised error {names[0] if names else written}"
    return rapid_error(number, message, name=written)


def no_return(function: str) -> RapidError:
    """Raise the error of a function that reaches its end without RETURN."""
    return rapid_error(ERR_FNCNORET, f"the function {function} ended without RETURN")


def as_rapid_error(error: Exception) -> RapidError:
    """Return the RAPID error that a caught exception represents.

    Raises:
        ZeroDivisionError: If it is a Python error from outside generated code; that is a defect of
            the library, not of the program.
    """
    if isinstance(error, RapidError):
        return error
    traceback = error.__traceback__
    while traceback is not None and traceback.tb_next is not None:
        traceback = traceback.tb_next
    if not isinstance(error, ZeroDivisionError) or not _in_generated(traceback):
        raise error
    return rapid_error(ERR_DIVZERO, "division by zero").with_traceback(error.__traceback__)


def _in_generated(traceback: TracebackType | None) -> bool:
    return traceback is not None and is_generated(traceback.tb_frame)


def is_generated(frame: FrameType) -> bool:
    """Whether a frame runs code of a RAPID routine."""
    return GENERATED in frame.f_globals
