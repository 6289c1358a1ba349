"""Execution of a program statement by statement, halting before one.

Like the debugger, it uses Python's line tracing: routines run as Python code with the lines of
RAPID. Without a step nothing is traced, so this costs a running program nothing.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from types import FrameType
from typing import Any

from rapidsim.interpreter.tools.inspection import is_rapid
from rapidsim.interpreter.tools.step_positions import (
    FramePositions,
    StatementStarts,
    StepGranularity,
    StepPosition,
    rapid_frames,
)
from rapidsim.language.moves import Place


@dataclass(eq=False)
class Stepper:
    """Steps the program that runs in one greenlet."""

    halt: Callable[[Place], None]
    """Called before the statement that ends a step; it may let time pass and begin a new step."""
    _reach: StepGranularity = StepGranularity.ANY
    _is_enough: Callable[[], bool] | None = None
    _is_break: Callable[[Place], bool] | None = None
    """Whether a program that is not stepped halts before a statement; None for a step."""
    _from: StepPosition | None = None
    """Position at the start of the step; None before the first statement."""
    _positions: FramePositions = field(default_factory=FramePositions)

    def begin(self, reach: StepGranularity, is_enough: Callable[[], bool] | None = None) -> None:
        """Begin a step of the routines that have called this.

        Args:
            reach: Granularity of the step.
            is_enough: Called before each statement to end the step; None applies `reach`.
        """
        self._reach, self._is_enough, self._is_break = reach, is_enough, None
        self._trace()

    def run_to(self, is_break: Callable[[Place], bool]) -> None:
        """Run on until a statement for which this holds; the current one does not count."""
        self._is_break = is_break
        self._trace()

    def _trace(self) -> None:
        self._from = None
        for frame in reversed(list(rapid_frames(sys._getframe()))):
            tracer = self._tracer(frame, self._positions.line(frame), frame.f_lasti)
            frame.f_trace, self._from = tracer.trace, tracer.position
        sys.settrace(self._entered)

    def end(self) -> None:
        """End the step."""
        if sys.gettrace() == self._entered:
            sys.settrace(None)

    def _entered(self, frame: FrameType, event: str, argument: object) -> Any:
        del event, argument
        return self._tracer(frame).trace if is_rapid(frame) else None

    def _tracer(self, frame: FrameType, line: int = 0, instruction: int = 0) -> _FrameTracer:
        """The tracer of a frame, from its current statement on."""
        starts = StatementStarts(self._positions.places(frame), frame.f_code, line, instruction)
        return _FrameTracer(self, starts, self._positions.traced(frame))

    def pass_statement(self, place: Place, now: StepPosition) -> None:
        """Halt the program before a statement if the step ends there."""
        if self._halts_before(place, now):
            self.end()
            # Halting lets time pass, in which other tasks' programs run: without this, Python
            # would treat them as part of the tracing.
            sys.call_tracing(self.halt, (place,))

    def _halts_before(self, place: Place, now: StepPosition) -> bool:
        """Whether the program halts before a statement."""
        if self._is_break is not None:
            return self._is_break(place)
        if self._from is None:
            self._from = now
            return False
        return self._ends_before(now, self._from)

    def _ends_before(self, now: StepPosition, start: StepPosition) -> bool:
        """Whether the step ends before the current statement."""
        if self._is_enough is None:
            return now.ends_step(start, self._reach)
        return now.ends_step(start, StepGranularity.ANY) and self._is_enough()


class _FrameTracer:
    """The trace function of one frame."""

    __slots__ = ("_starts", "_stepper", "position")

    def __init__(self, stepper: Stepper, starts: StatementStarts, position: StepPosition) -> None:
        self._stepper, self._starts, self.position = stepper, starts, position

    def trace(self, frame: FrameType, event: str, argument: object) -> Any:
        del argument
        place = self._starts.start(frame) if event == "line" else None
        if place is not None:
            self._stepper.pass_statement(place, self.position)
        return self.trace
