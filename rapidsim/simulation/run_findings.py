"""Findings at the end of a run: its cause, and features that were not simulated."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.analysis.program import Program
from rapidsim.controller.journal.journal import Journal, not_simulated_finding
from rapidsim.controller.journal.stop_reasons import (
    MoveImpossible,
    PollsForever,
    TimeLimitReached,
    TrapStorm,
    WaitsForever,
    ZoneReached,
)
from rapidsim.controller.moves.motion_findings import path_violation
from rapidsim.controller.moves.move_request import NotReachableError
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.diagnostics import Diagnostic, Related, Span
from rapidsim.findings.runs import (
    BackwardNotExecuted,
    ConveyorNotConnected,
    CutOff,
    EndlessWait,
    NotDeclaredHere,
    ProgramStopped,
    TrapStorms,
    UncaughtError,
    WorldZoneReached,
)
from rapidsim.interpreter.runtime.call_stack import CallFrame, FatalError, rapid_stack
from rapidsim.language.error_answers import AnsweredError, ErrorOutcome
from rapidsim.language.error_numbers import event_of, name_of, named
from rapidsim.language.errors import NotAllowed, NotConnected, NotDeclared, Stopped
from rapidsim.language.moves import Place
from rapidsim.syntax import tree

_SHOWN_CALLS = 5
"""Innermost and outermost calls that a finding shows; endless recursion has thousands."""


def fatal_answer(fatal: FatalError, place: Place) -> AnsweredError:
    """Return the uncaught error as the run lists it; see `fatal_finding`."""
    routine, span, _ = _stack_place(fatal.stack, place)
    error = fatal.error
    raised = Place(span, routine)
    return AnsweredError(
        error.errno, name_of(error), error.message, raised, None, ErrorOutcome.ENDED
    )


def fatal_finding(fatal: FatalError, place: Place) -> Diagnostic:
    """Return the uncaught error, with the call chain as related places, innermost first.

    Args:
        fatal: The error.
        place: The last statement that reported to the controller.
    """
    routine, span, callers = _stack_place(fatal.stack, place)
    error = fatal.error
    violation = error.violation if isinstance(error, NotReachableError) else None
    if span.line == place.span.line and span.file == place.span.file:
        span = place.span
    told = violation or UncaughtError(named(error), error.cf or event_of(error.errno))
    return Diagnostic(told, span, callers, routine=routine)


def stopped_finding(stopped: Stopped, place: Place) -> Diagnostic:
    """Return the stop of a program by itself, with the call chain as related places."""
    routine, span, callers = _stack_place(rapid_stack(stopped), place)
    return Diagnostic(ProgramStopped(stopped.reason), span, callers, routine=routine)


def not_allowed_finding(stopped: NotAllowed, place: Place) -> Diagnostic:
    """Return the instruction at which a controller stops, with the call chain as related places."""
    routine, span, callers = _stack_place(rapid_stack(stopped), place)
    return Diagnostic(UncaughtError(stopped.reason, stopped.cf), span, callers, routine=routine)


def not_declared_finding(stopped: NotDeclared, place: Place) -> Diagnostic:
    """Return the instruction that uses a missing declaration, with the call chain."""
    routine, span, callers = _stack_place(rapid_stack(stopped), place)
    return Diagnostic(NotDeclaredHere(stopped.reason), span, callers, routine=routine)


def not_connected_finding(stopped: NotConnected, place: Place) -> Diagnostic:
    """Return the instruction that would follow a conveyor, with the call chain."""
    routine, span, callers = _stack_place(rapid_stack(stopped), place)
    return Diagnostic(ConveyorNotConnected(stopped.reason), span, callers, routine=routine)


def impossible_move_finding(stopped: MoveImpossible, place: Place) -> Diagnostic:
    """Return the impossible move, with the call chain as related places."""
    routine, span, callers = _stack_place(rapid_stack(stopped), place)
    return Diagnostic(stopped.violation, span, callers, routine=routine, assumed=stopped.assumed)


def endless_wait_finding(
    stopped: WaitsForever,
    waiting: tuple[str, Place],
    other_waits: Sequence[tuple[str, Place]] = (),
) -> Diagnostic:
    """Return the wait that nothing can end.

    Args:
        stopped: The reason.
        waiting: The task and the statement that waits.
        other_waits: Further tasks that wait, which could have ended it.
    """
    _, place = waiting
    if isinstance(stopped, PollsForever):
        routine, span, callers = _stack_place(rapid_stack(stopped), place)
        return Diagnostic(EndlessWait(stopped.reason, stopped.cure), span, callers, routine=routine)
    if not other_waits or stopped.cure is not None:
        # What it waits for is outside the cell, whatever the other tasks do.
        violation = EndlessWait(stopped.reason, stopped.cure)
        return Diagnostic(violation, place.span, routine=place.routine)
    each = [
        f"{name} at {at.span.file}:{at.span.line} in `{_first_line(at)}`"
        for name, at in (waiting, *other_waits)
    ]
    violation = EndlessWait(f"the tasks wait for each other: {', '.join(each)}")
    related = tuple(Related(at.span, f"{name} waits here") for name, at in other_waits)
    return Diagnostic(violation, place.span, related, routine=place.routine)


def trap_storm_finding(stopped: TrapStorm, place: Place) -> Diagnostic:
    """Return the statement at which interrupts came too fast, with the call chain."""
    routine, span, callers = _stack_place(rapid_stack(stopped), place)
    return Diagnostic(TrapStorms(stopped.reason), span, callers, routine=routine)


def zone_finding(stopped: ZoneReached, place: Place) -> Diagnostic:
    """Return the statement during which the robot reached a zone that stops it."""
    return Diagnostic(WorldZoneReached(stopped.reason), place.span, routine=place.routine)


def time_limit_finding(stopped: TimeLimitReached, place: Place) -> Diagnostic:
    """Return the statement at the time limit, with the call chain as related places."""
    routine, span, callers = _stack_place(rapid_stack(stopped), place)
    return Diagnostic(CutOff(stopped.reason), span, callers, routine=routine)


def motion_finding(error: MotionError) -> Diagnostic:
    """Return the move that proved impossible when its path was planned."""
    place = error.queued.place
    return Diagnostic(path_violation(error), place.span, routine=place.routine)


def not_simulated_findings(journal: Journal) -> tuple[Diagnostic, ...]:
    """Return one finding for each routine that was not simulated, at its first call."""
    return tuple(
        not_simulated_finding(one.name, one.treated_as, journal.first_met(one))
        for one in journal.not_simulated()
    )


def backward_findings(program: Program) -> tuple[Diagnostic, ...]:
    """Return one note for a program with BACKWARD clauses, at the first routine that has one."""
    places = [
        (item.name.text, module.span(item.name))
        for module in program.modules
        for item in module.items
        if isinstance(item, tree.Proc) and item.backward is not None
    ]
    if not places:
        return ()
    (routine, span), *others = places
    related = tuple(Related(other, f"nor is that of {name}") for name, other in others)
    return (Diagnostic(BackwardNotExecuted(routine), span, related, routine=routine),)


def _first_line(place: Place) -> str:
    return place.span.text.splitlines()[0].rstrip(" ;") if place.span.text else place.routine


def _stack_place(
    stack: tuple[CallFrame, ...], place: Place
) -> tuple[str, Span, tuple[Related, ...]]:
    """Routine and span at the top of a stack, and its callers; those of `place` if it is empty."""
    if not stack:
        return place.routine, place.span, ()
    *outer, last = stack
    callers = list(reversed(outer))
    left_out = max(0, len(callers) - 2 * _SHOWN_CALLS)
    shown = [*callers[:_SHOWN_CALLS], *callers[_SHOWN_CALLS + left_out :]]
    related = []
    for position, frame in enumerate(shown):
        words = f"called from {frame.place}" if frame.routine else "initial value"
        if left_out and position == _SHOWN_CALLS:
            words += f", with {left_out} calls in between omitted"
        related.append(Related(frame.span, words))
    return last.routine, last.span, tuple(related)
