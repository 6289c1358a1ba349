"""Following a program from statement to statement, to halt it before one.

Like the debugger, it rests on Python's tracing of lines: routines run as Python code whose lines
are those of RAPID. While nobody steps, nothing is traced, so this costs a running program nothing.
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
    """Before which statement a step ends."""

    ANY = auto()
    """The next one, in whatever routine."""
    SAME_ROUTINE = auto()
    """The next one in the routine, or in one that has called it."""
    CALLER = auto()
    """The next one in a routine that has called it."""


@dataclass(frozen=True, slots=True)
class _StepPosition:
    """How far a program has come."""

    frame: FrameType
    reached: dict[FrameType, tuple[int, int]]
    """Of this routine and those that have called it, the line of the statement that runs, and
    Python's instruction: a statement that runs once only goes on to later ones."""
    depth: int
    """Routines that have called each other; an ERROR clause belongs to its routine."""
    traps: int
    """How many of these are traps."""
    cycle: FrameType
    """The first routine."""

    def has_moved(self, before: _StepPosition) -> bool:
        """Whether another statement runs than before, or the same anew."""
        line, instruction = self.reached[self.frame]
        line_before, instruction_before = before.reached.get(self.frame, (0, 0))
        return line != line_before or instruction <= instruction_before


@dataclass(eq=False)
class Stepper:
    """Follows the program that runs in one greenlet."""

    halt: Callable[[Place], None]
    """Called before the statement that ends a step; it may take time, and begin the next step."""
    _reach: StepGranularity = StepGranularity.ANY
    _is_enough: Callable[[], bool] | None = None
    _from: _StepPosition | None = None
    """Where the step began; None before the first statement."""
    _places: dict[tree.Module, dict[int, Place]] = field(default_factory=dict)

    def begin(self, reach: StepGranularity, is_enough: Callable[[], bool] | None = None) -> None:
        """Follow the routines that have called this.

        Args:
            reach: How far.
            is_enough: Asked before each statement, instead; None goes by `reach`.
        """
        self._reach, self._is_enough = reach, is_enough
        frames = [one for one in _callers(sys._getframe()) if is_rapid(one)]
        self._from = self._position_of(frames[0]) if frames else None
        for frame in frames:
            frame.f_trace = self._passed
        sys.settrace(self._entered)

    def end(self) -> None:
        """Follow no longer."""
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
                # What halts passes time, and other tasks' programs run meanwhile: without this
                # Python would take them for a part of the tracing.
                sys.call_tracing(self.halt, (place,))
        return self._passed

    def _ends_before(self, now: _StepPosition) -> bool:
        """Whether the step ends before the statement that the program has come to."""
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
        """The line on which the statement begins that runs."""
        lines = self._places_in(frame)
        return max((one for one in lines if one <= frame.f_lineno), default=frame.f_lineno)

    def _places_in(self, frame: FrameType) -> dict[int, Place]:
        module = module_of(frame)
        if module not in self._places:
            self._places[module] = places_to_stop(module)
        return self._places[module]


def _callers(frame: FrameType | None) -> Iterator[FrameType]:
    """A frame and those that have called it, the innermost first."""
    while frame is not None:
        yield frame
        frame = frame.f_back


def _is_trap(frame: FrameType) -> bool:
    routine = routine_of(frame)
    return routine is not None and isinstance(routine.node, tree.Trap)
