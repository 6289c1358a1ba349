"""Execution of a program statement by statement, halting before one.

Like the debugger, it uses Python's line tracing: routines run as Python code with the lines of
RAPID. Without a step nothing is traced, so this costs a running program nothing.
Statements that share a line are one step.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from enum import Enum, auto
from types import FrameType
from typing import Any

from rapidsim.interpreter.runtime.call_stack import CLAUSES
from rapidsim.interpreter.tools.executable_lines import places_to_stop
from rapidsim.interpreter.tools.inspection import is_rapid, module_of, routine_of
from rapidsim.language.moves import Place
from rapidsim.syntax import tree


class StepGranularity(Enum):
    """Granularity of a step: the statement before which it ends."""

    ANY = auto()
    """The next statement, in any routine."""
    SAME_ROUTINE = auto()
    """The next statement in the routine, or in one of its callers."""
    CALLER = auto()
    """The next statement in one of its callers."""


@dataclass(frozen=True, slots=True)
class _StepPosition:
    """Position of a program in its control flow."""

    frame: FrameType
    reached: dict[FrameType, tuple[int, int]]
    """Line of the current statement and Python instruction, for the routine and its callers: a
    statement that runs only once continues with later instructions.
    """
    depth: int
    """Number of routines on the call stack; an ERROR clause belongs to its routine."""
    traps: int
    """Number of traps on the call stack."""
    cycle: FrameType
    """The outermost routine."""

    def has_moved(self, before: _StepPosition) -> bool:
        """Whether another statement runs than before, or the same one again."""
        line, instruction = self.reached[self.frame]
        line_before, instruction_before = before.reached.get(self.frame, (0, 0))
        return line != line_before or instruction <= instruction_before


@dataclass(eq=False)
class Stepper:
    """Steps the program that runs in one greenlet."""

    halt: Callable[[Place], None]
    """Called before the statement that ends a step; it may let time pass and begin a new step."""
    _reach: StepGranularity = StepGranularity.ANY
    _is_enough: Callable[[], bool] | None = None
    _from: _StepPosition | None = None
    """Position at the start of the step; None before the first statement."""
    _places: dict[tree.Module, dict[int, Place]] = field(default_factory=dict)

    def begin(self, reach: StepGranularity, is_enough: Callable[[], bool] | None = None) -> None:
        """Begin a step of the routines that have called this.

        Args:
            reach: Granularity of the step.
            is_enough: Called before each statement to end the step; None applies `reach`.
        """
        self._reach, self._is_enough = reach, is_enough
        frames = [one for one in _callers(sys._getframe()) if is_rapid(one)]
        self._from = self._position_of(frames[0]) if frames else None
        for frame in frames:
            frame.f_trace = self._passed
        sys.settrace(self._entered)

    def end(self) -> None:
        """End the step."""
        if sys.gettrace() == self._entered:
            sys.settrace(None)

    def _entered(self, frame: FrameType, event: str, argument: object) -> Any:
        del event, argument
        return self._passed if is_rapid(frame) else None

    def _passed(self, frame: FrameType, event: str, argument: object) -> Any:
        del argument
        place = self._places_in(frame).get(frame.f_lineno) if event == "line" else None
        if place is not None:
            now = self._position_of(frame)
            if self._from is None:
                self._from = now
            elif self._ends_before(now):
                self.end()
                # Halting lets time pass, in which other tasks' programs run: without this, Python
                # would treat them as part of the tracing.
                sys.call_tracing(self.halt, (place,))
        return self._passed

    def _ends_before(self, now: _StepPosition) -> bool:
        """Whether the step ends before the current statement."""
        begun = self._from
        assert begun is not None
        if now.traps > begun.traps or not now.has_moved(begun):
            return False
        if self._is_enough is not None:
            return self._is_enough()
        match self._reach:
            case StepGranularity.ANY:
                return True
            case StepGranularity.SAME_ROUTINE:
                return now.depth <= begun.depth
            case StepGranularity.CALLER:
                return now.depth < begun.depth or now.cycle is not begun.cycle

    def _position_of(self, frame: FrameType) -> _StepPosition:
        called = [one for one in _callers(frame) if is_rapid(one)]
        routines = [one for one in called if one.f_code.co_name not in CLAUSES]
        traps = sum(_is_trap(one) for one in routines)
        reached = {one: (self._line_of(one), one.f_lasti) for one in called}
        return _StepPosition(frame, reached, len(routines), traps, called[-1])

    def _line_of(self, frame: FrameType) -> int:
        """Line on which the running statement begins."""
        lines = self._places_in(frame)
        return max((one for one in lines if one <= frame.f_lineno), default=frame.f_lineno)

    def _places_in(self, frame: FrameType) -> dict[int, Place]:
        module = module_of(frame)
        if module not in self._places:
            self._places[module] = places_to_stop(module)
        return self._places[module]


def _callers(frame: FrameType | None) -> Iterator[FrameType]:
    """Yield a frame and its callers, the innermost first."""
    while frame is not None:
        yield frame
        frame = frame.f_back


def _is_trap(frame: FrameType) -> bool:
    routine = routine_of(frame)
    return routine is not None and isinstance(routine.node, tree.Trap)
