"""The RAPID call stack of an error, read from Python's traceback.

Generated code carries RAPID files, lines and columns, so the traceback has all the information;
frames of library functions in between are skipped.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import islice, zip_longest
from types import CodeType, MappingProxyType, TracebackType

from rapidsim.analysis.literals import Value
from rapidsim.analysis.program import DataSymbol, Program, RoutineSymbol
from rapidsim.diagnostics import Source, Span
from rapidsim.interpreter.runtime.bulk_execution import ROW
from rapidsim.interpreter.runtime.error_recovery import GENERATED, is_generated
from rapidsim.language.errors import RapidError
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Origin:
    """Module from which the code of a namespace was generated, with its program."""

    module: tree.Module
    routines: Mapping[str, RoutineSymbol]
    """Routines by the name of their function."""
    value_of: Callable[[DataSymbol], Value]
    """Returns the current value of declared data of any module."""
    program: Callable[[], Program]
    """Returns the program that the module belongs to, with its current modules."""

    @property
    def source(self) -> Source:
        """The source the code was generated from."""
        return self.module.source


CLAUSES = MappingProxyType({"ERROR": "ERROR", "_undo": "UNDO"})
"""Clauses that are functions inside a routine's function, by the name of the function."""


@value_class(frozen=True, slots=True)
class CallFrame:
    """A routine on the stack, and the position it had reached."""

    routine: str
    """Name in RAPID's spelling; "" for the initial values of a module."""
    clause: str
    """ERROR or UNDO if that clause of the routine was running, else ""."""
    source: Source
    start: int
    """Offset of the part that was being executed; it ends on its first line."""
    end: int

    @property
    def place(self) -> str:
        """Description of the routine or clause."""
        return f"the {self.clause} clause of {self.routine}" if self.clause else self.routine

    @property
    def span(self) -> Span:
        """The span being executed."""
        return Span(self.source, self.start, self.end)

    @property
    def file(self) -> str:
        """The file as the user named it."""
        return self.source.file

    @property
    def line(self) -> int:
        """The line, from 1."""
        return self.span.line


class FatalError(Exception):
    """An error that no ERROR clause handled; it ends the program."""

    def __init__(self, error: RapidError, stack: tuple[CallFrame, ...]) -> None:
        """Set the error and the stack.

        Args:
            error: The error.
            stack: The routines that were running, the outermost first.
        """
        super().__init__(error.message)
        self.error = error
        self.stack = stack


def rapid_stack(exception: BaseException) -> tuple[CallFrame, ...]:
    """The RAPID routines in a traceback, outermost first.

    An error in an ERROR clause or a trap occurs below the statement that led there; its own
    traceback continues the outer one.
    """
    entries = list(_entries(exception.__traceback__))
    if isinstance(exception.__cause__, Exception):
        entries += _entries(exception.__cause__.__traceback__)
    # An error that an ERROR clause propagates has two entries of its routine: one at the RAISE, and
    # one at its origin.
    last_of_frame = [
        entry
        for entry, following in zip_longest(entries, entries[1:])
        if following is None or following.tb_frame is not entry.tb_frame
    ]
    return tuple(frame_of(entry) for entry in last_of_frame)


def _entries(traceback: TracebackType | None) -> Iterator[TracebackType]:
    """The entries of a traceback that belong to RAPID routines."""
    while traceback is not None:
        if is_generated(traceback.tb_frame):
            yield traceback
        traceback = traceback.tb_next


def frame_of(traceback: TracebackType) -> CallFrame:
    """The routine of an entry of a traceback, which is generated code, and its position."""
    code = traceback.tb_frame.f_code
    origin: Origin = traceback.tb_frame.f_globals[GENERATED]
    routine = origin.routines.get(code.co_qualname.partition(".")[0])
    start, end = offsets_of(origin.source, code, traceback.tb_lasti, traceback.tb_lineno)
    row = traceback.tb_frame.f_locals.get(ROW)
    if row is not None:
        # The code belongs to the statement that the bulk moves repeat.
        start, end = row.written.moved(start), row.written.moved(end)
    clause = CLAUSES.get(code.co_name, "")
    return CallFrame(routine.name if routine else "", clause, origin.source, start, end)


def offsets_of(source: Source, code: CodeType, instruction: int, line: int) -> tuple[int, int]:
    """Return the source offsets of the code that a Python instruction on a line executes."""
    _, _, column, end_column = next(
        islice(code.co_positions(), instruction // 2, None), (None,) * 4
    )
    start = source.line_starts[line - 1]
    text = source.line(line)
    if column is None or end_column is None:
        return start, start + len(text)
    # Python counts columns in bytes.
    encoded = text.encode()
    first, last = len(encoded[:column].decode()), len(encoded[:end_column].decode())
    return start + first, start + last
