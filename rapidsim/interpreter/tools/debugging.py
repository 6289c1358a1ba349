"""The engine of a debugger: it follows every statement of all tasks, and decides where to stop.

It uses Python's line tracing: routines run as Python code with the lines of RAPID, and what runs is
the same code as without a debugger. Statements are counted over all tasks. A run is a function of
its inputs, so the number of a statement names the state before it: going back is running again up
to that number.

The engine knows no prompt and no protocol. Whoever uses it is called where the program stops, looks
at the frames, and says how it goes on.
"""

from __future__ import annotations

import re
import sys
import time
from array import array
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import FrameType
from typing import Any, TypeVar

import greenlet

from rapidsim.interpreter.runtime.error_recovery import ERRORS, GENERATED
from rapidsim.interpreter.tools.inspection import is_rapid
from rapidsim.interpreter.tools.step_positions import (
    FramePositions,
    StatementStarts,
    StepGranularity,
    StepPosition,
)
from rapidsim.language.error_numbers import ERR_DIVZERO, name_of, rapid_error
from rapidsim.language.errors import RapidError
from rapidsim.language.moves import Place
from rapidsim.values import value_class

T = TypeVar("T")

_POLLS_S = 0.02
"""Real time [s] between two looks at requests while the program runs."""
_MOST_TRAPS = 16
"""Depths of traps that are told apart."""
_HIT_CONDITION = re.compile(r"\s*(>=|>|==|=|%|)\s*(\d+)\s*$")


class StopReason(StrEnum):
    """Reason of a stop."""

    ENTRY = "entry"
    STEP = "step"
    BREAKPOINT = "breakpoint"
    PAUSE = "pause"
    ERROR = "exception"
    DATA = "data breakpoint"
    GOTO = "goto"


@value_class(frozen=True, slots=True)
class Stop:
    """A stop of all tasks before a statement of one of them."""

    reason: StopReason
    frame: FrameType
    """Frame of the routine, or of its clause."""
    place: Place
    number: int
    """Number of the statement, from 1."""
    text: str = ""
    """Description: the error, or the change at a watchpoint."""
    error: RapidError | None = None


@dataclass(eq=False)
class Breakpoint:
    """A line at which the program stops."""

    file: str
    line: int
    condition: Callable[[FrameType], bool] | None = None
    """Whether it counts in a frame; None if it always does."""
    hit_condition: Callable[[int], bool] | None = None
    """Whether the program stops the n-th time; None for each time."""
    log: Callable[[FrameType], None] | None = None
    """Prints a message instead of stopping."""
    hits: int = 0


def hit_condition(text: str) -> Callable[[int], bool]:
    """Return the function for a number of hits: `3` or `>= 3` from the third on, `% 3`, `= 3`.

    Raises:
        ValueError: If the text is none of these.
    """
    match = _HIT_CONDITION.match(text)
    if match is None or (match[1] == "%" and int(match[2]) == 0):
        raise ValueError(f"`{text}` is not a number of hits, such as `3`, `= 3`, `> 3` or `% 3`")
    operator, number = match[1], int(match[2])
    match operator:
        case "%":
            return lambda hits: hits % number == 0
        case "=" | "==":
            return lambda hits: hits == number
        case ">":
            return lambda hits: hits > number
        case _:
            return lambda hits: hits >= number


@dataclass(eq=False)
class Debugger:
    """Follows the statements of a run.

    Requests that arrive while the program runs may replace `breakpoints` and call `pause`.
    """

    on_stop: Callable[[Stop], None]
    """Called at each stop; it calls one of `step`, `go_on`, `run_to` before it returns."""
    poll: Callable[[], None] = lambda: None
    """Called now and then while the program runs."""
    before: Callable[[int, FrameType], None] = lambda number, frame: None
    """Called before each statement with its number and its frame."""
    current_task: Callable[[], object] = greenlet.getcurrent
    """Returns an object that identifies the running task."""
    breakpoints: Mapping[tuple[str, int], Breakpoint] = field(default_factory=dict)
    """By file, as the user named it, and line."""
    watchpoints: Mapping[str, Callable[[], str]] = field(default_factory=dict)
    """Functions that return the value of data or signals as text, by name."""
    stops_at_error: Callable[[RapidError], bool] | None = None
    """Whether the program stops at an error when it occurs; None if it never does."""
    keeps_history: bool = True
    """Whether `number_before` can be asked for."""
    has_ended: bool = False
    """Whether frames that are still traced are traced no longer."""
    errors_end_steps: bool = False
    """Whether a step ends where an error occurs, or passes a routine."""
    number: int = 0
    """Number of statements so far, the current one included."""
    _marks: array[int] = field(default_factory=lambda: array("H"))
    """Task and depth of traps of each statement so far; see `_mark`."""
    _tasks: dict[object, int] = field(default_factory=dict)
    last_error: int = 0
    """Number of the statement that failed last."""
    _reach: StepGranularity | None = None
    _step_start: StepPosition | None = None
    _task: object = None
    """The greenlet that a step belongs to."""
    _target: int | None = None
    """Number of the statement at which the program stops; until then nothing else counts."""
    _target_reason: StopReason = StopReason.GOTO
    _pauses: bool = False
    _values: dict[str, str] = field(default_factory=dict)
    _positions: FramePositions = field(default_factory=FramePositions)
    _polled_s: float = 0.0
    _error: BaseException | None = None
    """The last error."""

    def run(self, run: Callable[[], T]) -> T:
        """Execute a run while following it.

        Args:
            run: Runs the program, with all of its tasks, to the end.
        """
        before = greenlet.settrace(self._switched)
        sys.settrace(self.entered)
        try:
            return run()
        finally:
            sys.settrace(None)
            greenlet.settrace(before)

    def follow(self, frames: Iterable[FrameType]) -> None:
        """Follow routines that run already, in tasks that are suspended."""
        for frame in frames:
            places, line = self._positions.places(frame), self._positions.line(frame)
            starts = StatementStarts(places, frame.f_code, line, frame.f_lasti)
            frame.f_trace = self._tracer(frame, starts).trace

    def pause(self) -> None:
        """Stop before the next statement of any task."""
        self._pauses = True

    def go_on(self) -> None:
        """Run to the next breakpoint."""
        self._reach = self._target = None

    def step(self, reach: StepGranularity, frame: FrameType, task: object = None) -> None:
        """Run until a step has ended.

        Args:
            reach: Its granularity.
            frame: Frame from which it begins.
            task: The task of the frame; None for the running one.
        """
        self._target, self._reach = None, reach
        self._step_start = self._positions.of(frame)
        self._task = self.current_task() if task is None else task

    def run_to(self, number: int, reason: StopReason = StopReason.GOTO) -> None:
        """Run to a statement by its number, and stop there and nowhere before."""
        self._reach, self._target, self._target_reason = None, number, reason

    def watch(self, watchpoints: Mapping[str, Callable[[], str]]) -> None:
        """Stop after each change of these data and signals."""
        self.watchpoints = watchpoints
        self._values = {name: read() for name, read in watchpoints.items()}

    def place(self, frame: FrameType) -> Place:
        """The statement that a frame executes."""
        return self._positions.places(frame)[self.line(frame)]

    def line(self, frame: FrameType) -> int:
        """Line on which the statement that a frame executes begins."""
        return self._positions.line(frame)

    def first_number(self, frame: FrameType) -> int:
        """Number of the first statement that a frame has executed."""
        tracer = _tracer_of(frame)
        return 1 if tracer is None else tracer.first

    def _switched(self, event: str, arguments: Any) -> None:
        # A greenlet has a trace function of its own.
        del event, arguments
        sys.settrace(self.entered)

    def entered(self, frame: FrameType, event: str, argument: object) -> Any:
        """The trace function of a task: it returns that of a frame."""
        del event, argument
        if self.has_ended:
            sys.settrace(None)
            return None
        if GENERATED not in frame.f_globals or not is_rapid(frame):
            return None
        starts = StatementStarts(self._positions.places(frame), frame.f_code)
        return self._tracer(frame, starts).trace

    def _tracer(self, frame: FrameType, starts: StatementStarts) -> _FrameTracer:
        position = self._positions.traced(frame)
        return _FrameTracer(self, starts, self.number + 1, position, self._mark(position))

    def _mark(self, position: StepPosition) -> int:
        """Number of the running task and number of traps that it is in, as one number."""
        task = self._tasks.setdefault(self.current_task(), len(self._tasks))
        return task * _MOST_TRAPS + min(position.traps, _MOST_TRAPS - 1)

    def number_before(self, number: int) -> int:
        """Number of the statement before another in its task, not counting traps between them.

        Returns:
            0 if there is none.
        """
        task, traps = divmod(self._marks[number - 1], _MOST_TRAPS)
        for before in range(number - 1, 0, -1):
            task_before, traps_before = divmod(self._marks[before - 1], _MOST_TRAPS)
            if task_before == task and traps_before <= traps:
                return before
        return 0

    def at(self, frame: FrameType, place: Place, mark: int) -> None:
        """Count a statement that is about to run, and stop there if there is a reason."""
        self.number += 1
        if self.keeps_history:
            self._marks.append(mark)
        self.before(self.number, frame)
        if self._target is not None:
            if self.number < self._target:
                return
            self._values = {name: read() for name, read in self.watchpoints.items()}
            self._stop(self._target_reason, frame, place)
            return
        now_s = time.monotonic()
        if now_s - self._polled_s > _POLLS_S:
            self._polled_s = now_s
            self.poll()
        if self._pauses:
            self._stop(StopReason.PAUSE, frame, place)
        elif changed := self._changed():
            self._stop(StopReason.DATA, frame, place, changed)
        elif self._is_at_breakpoint(frame):
            self._stop(StopReason.BREAKPOINT, frame, place)
        elif self._reach is not None and self._ends_step(frame):
            self._stop(StopReason.STEP, frame, place)

    def failed(self, frame: FrameType, error: BaseException) -> None:
        """Note that a statement failed, and stop there if errors like it are stopped at."""
        # An error passes through the frames of all callers without a clause.
        if not isinstance(error, ERRORS):
            return
        is_new = error is not self._error
        if is_new:
            self._error, self.last_error = error, self.number
        place = self._positions.places(frame).get(self._positions.line(frame))
        if self._target is not None or place is None:
            return
        # Its traceback, from which `as_rapid_error` would know, is not complete yet.
        division = rapid_error(ERR_DIVZERO, "division by zero")
        known = error if isinstance(error, RapidError) else division
        ends_step = self.errors_end_steps and self._reach is not None and self._ends_step(frame)
        if ends_step or (is_new and self.stops_at_error is not None and self.stops_at_error(known)):
            self._stop(StopReason.ERROR, frame, place, error_text(known), known)

    def _stop(
        self,
        reason: StopReason,
        frame: FrameType,
        place: Place,
        text: str = "",
        error: RapidError | None = None,
    ) -> None:
        self._pauses = False
        self._reach = self._target = None
        self.on_stop(Stop(reason, frame, place, self.number, text, error))
        self._polled_s = time.monotonic()

    def _ends_step(self, frame: FrameType) -> bool:
        # Other tasks run meanwhile, as far as the time of the step's task requires.
        if self.current_task() is not self._task or self._step_start is None:
            return False
        assert self._reach is not None
        tracer = _tracer_of(frame)
        position = self._positions.of(frame) if tracer is None else tracer.position
        return position.ends_step(self._step_start, self._reach)

    def _is_at_breakpoint(self, frame: FrameType) -> bool:
        if not self.breakpoints:
            return False
        found = self.breakpoints.get((frame.f_code.co_filename, frame.f_lineno))
        if found is None or (found.condition is not None and not found.condition(frame)):
            return False
        found.hits += 1
        if found.hit_condition is not None and not found.hit_condition(found.hits):
            return False
        if found.log is not None:
            found.log(frame)
            return False
        return True

    def _changed(self) -> str:
        """Description of the first change of a watchpoint since the last statement, or ""."""
        for name, read in self.watchpoints.items():
            value, before = read(), self._values.get(name)
            if value != before:
                self._values[name] = value
                return f"{name} changed from {before} to {value}"
        return ""


class _FrameTracer:
    """The trace function of one frame."""

    __slots__ = ("_debugger", "_mark", "_starts", "first", "position")

    def __init__(
        self,
        debugger: Debugger,
        starts: StatementStarts,
        first: int,
        position: StepPosition,
        mark: int,
    ) -> None:
        self._debugger, self._starts, self._mark = debugger, starts, mark
        self.first, self.position = first, position

    def trace(self, frame: FrameType, event: str, argument: Any) -> Any:
        if self._debugger.has_ended:
            frame.f_trace = None
            sys.settrace(None)
        elif event == "line":
            if (place := self._starts.start(frame)) is not None:
                self._debugger.at(frame, place, self._mark)
        elif event == "exception":
            self._starts.has_failed = True
            self._debugger.failed(frame, argument[1])
        return self.trace


def _tracer_of(frame: FrameType) -> _FrameTracer | None:
    tracer = getattr(frame.f_trace, "__self__", None)
    return tracer if isinstance(tracer, _FrameTracer) else None


def error_text(error: RapidError) -> str:
    """Description of an error: name and message."""
    return f"{name_of(error)}: {error.message}"
