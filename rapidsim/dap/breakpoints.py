"""Breakpoints as the client sets them, and as the debugger uses them."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from types import FrameType

from rapidsim.analysis.program import Program
from rapidsim.dap.checkpoints import ObservationError, observed_in_copy
from rapidsim.dap.program_files import ProgramFiles
from rapidsim.dap.wire import Message
from rapidsim.interpreter.linking.linker import LinkedProgram
from rapidsim.interpreter.linking.loader import Task
from rapidsim.interpreter.tools.called_expressions import called_value
from rapidsim.interpreter.tools.debugging import Breakpoint, Debugger, hit_condition
from rapidsim.interpreter.tools.frame_expressions import (
    CallNeededError,
    FrameExpression,
    FrameExpressions,
)
from rapidsim.interpreter.tools.inspection import NotShownError, program_of
from rapidsim.language.types import NUM
from rapidsim.library.text import value_text
from rapidsim.simulation.progress import RunInProgress

_EXPRESSION = re.compile(r"\{([^{}]+(?:\{[^{}]*\}[^{}]*)*)\}")
"""An expression in a log message, which may have an index in braces."""


class InvalidBreakpointError(Exception):
    """A breakpoint that cannot be set; the message has the reason."""


@dataclass(eq=False)
class Breakpoints:
    """The breakpoints of a session."""

    files: ProgramFiles
    debugger: Debugger
    print: Callable[[str], None]
    """Prints a line in the client's console."""
    run: RunInProgress | None = None
    expressions: FrameExpressions = field(init=False)
    _by_path: dict[str, dict[tuple[str, int], Breakpoint]] = field(default_factory=dict)
    _settings: dict[tuple[str, int], Message] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Set up the evaluation of conditions."""
        self.expressions = FrameExpressions(self._signal)

    def restore(self, by_path: dict[str, list[Message]]) -> None:
        """Set all breakpoints of a session again."""
        for path in [path for path in self._by_path if path not in by_path]:
            self.set(path, [])
        for path, wanted in by_path.items():
            self.set(path, wanted)

    def set(self, path: str, wanted: Sequence[Message]) -> list[Message]:
        """Replace the breakpoints of a source; return what the client needs to know of each."""
        answers, own = [], dict[tuple[str, int], Breakpoint]()
        file = self.files.file_of(path)
        for one in wanted:
            line = None if file is None else self.files.statement_line(file, int(one["line"]))
            if file is None or line is None:
                reason = "there is no statement on this line or below"
                if file is None:
                    reason = "the program does not have this file"
                answers.append({"verified": False, "message": reason})
                continue
            try:
                own[file, line] = self._breakpoint(file, line, one)
            except InvalidBreakpointError as error:
                answers.append({"verified": False, "message": str(error)})
                continue
            answers.append({"verified": True, "line": line})
        self._by_path[path] = own
        self.debugger.breakpoints = {
            place: found for of_path in self._by_path.values() for place, found in of_path.items()
        }
        return answers

    def watch(self, names: Sequence[str]) -> None:
        """Stop when data or signals of these names change."""
        self.debugger.watch({name: self._reader(name) for name in names})

    def _breakpoint(self, file: str, line: int, wanted: Message) -> Breakpoint:
        place = file, line
        before = self.debugger.breakpoints.get(place)
        if before is not None and self._settings.get(place) == wanted:
            # Its number of hits is kept.
            return before
        self._settings[place] = wanted
        condition, message = wanted.get("condition"), wanted.get("logMessage")
        try:
            hits = hit_condition(text) if (text := wanted.get("hitCondition")) else None
        except ValueError as error:
            raise InvalidBreakpointError(str(error)) from None
        return Breakpoint(
            file,
            line,
            self._condition(condition) if condition else None,
            hits,
            self._logging(message) if message else None,
        )

    def _condition(self, text: str) -> Callable[[FrameType], bool]:
        # A program has other modules once it loads one.
        known: dict[Program, FrameExpression] = {}

        def holds(frame: FrameType) -> bool:
            program = program_of(frame)
            try:
                if program not in known:
                    known[program] = self.expressions.condition(text, frame)
                try:
                    return bool(known[program].value(frame).value)
                except CallNeededError:
                    return self._called(text, frame) == "TRUE"
            except (NotShownError, ObservationError) as error:
                self.print(f"the condition cannot be evaluated: {error}")
                return True

        return holds

    def _logging(self, message: str) -> Callable[[FrameType], None]:
        def print_it(frame: FrameType) -> None:
            self.print(_EXPRESSION.sub(lambda found: self.text(found[1], frame), message))

        return print_it

    def text(self, expression: str, frame: FrameType) -> str:
        """Value of an expression in a frame, or the reason why there is none, in parentheses."""
        try:
            return self.value(expression, frame)[0]
        except (NotShownError, ObservationError) as error:
            return f"({error})"

    def value(self, expression: str, frame: FrameType) -> tuple[str, str]:
        """Value and type of an expression in a frame.

        Raises:
            NotShownError: If it has none.
            ObservationError: If it calls a function, and that is not possible here.
        """
        checked = self.expressions.checked(expression, frame)
        try:
            return checked.value(frame).text, checked.type.name
        except CallNeededError:
            return self._called(expression, frame), checked.type.name

    def _called(self, expression: str, frame: FrameType) -> str:
        assert self.run is not None
        of = self.expressions.checked(expression, frame).type
        symbols = [one.controller.concerns.symbols for one in self.run.tasks()]
        found = [getattr(one, "linked", None) for one in symbols]
        linked = next(one for one in found if one and one.program is program_of(frame))
        text: str = observed_in_copy(lambda: called_value(expression, of, frame, linked))
        return text

    def _signal(self, name: str) -> float:
        return 0.0 if self.run is None else self.run.cell.signals.read(name)

    def _reader(self, name: str) -> Callable[[], str]:
        """Function that returns the value of data or a signal; data of the first task with it."""
        if name.startswith("signal:"):
            signal = name.partition(":")[2]
            return lambda: value_text(self._signal(signal), NUM)
        task, _, data = name.partition("/")

        def read() -> str:
            run = self.run
            if run is None:
                return ""
            for one in run.tasks():
                symbols = one.controller.concerns.symbols
                linked = getattr(symbols, "linked", None)
                if one.setup.name == task and linked is not None:
                    return _text_of(linked, data)
            return ""

        return read


def _text_of(linked: object, name: str) -> str:
    assert isinstance(linked, LinkedProgram)
    task = Task(linked)
    symbol = task.data(name)
    return "" if symbol is None else value_text(task.value_of(symbol), symbol.type)
