"""`rapidsim run --break`: Python's debugger, seeing RAPID alone.

Routines run as Python code under the name of their RAPID file, so pdb stops in them as it is. Here
it learns to pass over the simulator's own code, to stop only where RAPID has a statement, and to
show RAPID's names and values.
"""

from __future__ import annotations

import pdb
import sys
from bdb import BdbQuit
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any, TypeVar

import click

from rapidsim.analysis.program import Program
from rapidsim.cli.terminal import echo
from rapidsim.diagnostics import Source
from rapidsim.files import InputError, did_you_mean
from rapidsim.interpreter.linking.linker import show_lines_of
from rapidsim.interpreter.runtime.error_recovery import ERRORS
from rapidsim.interpreter.tools.executable_lines import module_lines
from rapidsim.interpreter.tools.inspection import (
    NotShownError,
    is_rapid,
    module_of,
    parameters,
    place_of,
    rapid_text,
    routine_of,
)
from rapidsim.language.errors import RapidError
from rapidsim.syntax import tree

T = TypeVar("T")

_HELP = "n: next statement, s: into a routine, c: go on, w: call stack, p NAME: value, q: quit"


def debugged(run: Callable[[], T], program: Program, breaks: Sequence[str]) -> T:
    """Run with a prompt at each breakpoint.

    Args:
        run: What executes the program.
        program: The program.
        breaks: Places as `FILE:LINE`, or a line alone in a program of one file.

    Raises:
        InputError: If there is no terminal, or a breakpoint is not a place.
        click.Abort: If the user quits.
    """
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        raise InputError(
            "--break needs a terminal: the program stops there until a command is typed"
        )
    debugger = _Debugger(program)
    for text in breaks:
        _set_break(debugger, text)
    return debugger.run_to_breaks(run)


def _set_break(debugger: _Debugger, text: str) -> None:
    file, colon, number = text.rpartition(":")
    if not number.isdecimal():
        raise InputError(f"--break {text}: expected FILE:LINE")
    known = debugger.files()
    found = debugger.lookupmodule(file) if colon else known[0] if len(known) == 1 else None
    if found is None:
        raise InputError(
            f"--break {text}: which file?"
            if not file
            else f"--break: {file} is not in the program",
            did_you_mean(file, known) or f"its files are {', '.join(known[:5])}",
        )
    wanted = int(number)
    line = debugger.statement_line(found, wanted)
    if not line:
        raise InputError(f"--break: {found} has no statement on line {wanted} or below")
    if line != wanted:
        echo(f"{found}:{wanted} holds no statement; stopping at line {line}", err=True)
    debugger.set_break(found, line)


class _Debugger(pdb.Pdb):
    def __init__(self, program: Program) -> None:
        # A .pdbrc is Python code that lies where a program lies; it is not trusted either.
        super().__init__(readrc=False)
        self.prompt = "(rapid) "
        self._program = program
        self._sources: dict[str, Source] = {}
        self._lines: dict[str, frozenset[int]] = {}
        self._known: set[tree.Module] = set()
        for module in program.modules:
            self._know(module)
        for source in self._sources.values():
            show_lines_of(source)
        self._greeted = False
        self._failed: tuple[FrameType, int] | None = None

    def _know(self, module: tree.Module) -> None:
        """Take in a module: one of the program, or one that it has loaded."""
        if module not in self._known:
            self._known.add(module)
            file = module.source.file
            self._sources[file] = module.source
            self._lines[file] = self._lines.get(file, frozenset()) | module_lines(module)

    def files(self) -> list[str]:
        """The files of the program as the user named them."""
        return list(self._sources)

    def statement_line(self, file: str, line: int) -> int:
        """The first line with a statement, from a line on; 0 without one."""
        return min((one for one in self._lines[file] if one >= line), default=0)

    def run_to_breaks(self, run: Callable[[], T]) -> T:
        """Run, with the prompt wherever the user stops it.

        Raises:
            click.Abort: If the user quits.
        """
        self.reset()
        self.botframe = sys._getframe()
        self.set_continue()
        sys.settrace(self.trace_dispatch)
        try:
            return run()
        except BdbQuit:
            raise click.Abort from None
        finally:
            sys.settrace(None)

    # Callbacks of bdb while the program runs.

    def canonic(self, filename: str) -> str:
        """Code of a program is named as the user named its file."""
        return filename

    def break_anywhere(self, frame: FrameType) -> bool:
        """Follow every routine, so that stepping out of one stops in its caller."""
        return is_rapid(frame)

    def stop_here(self, frame: FrameType) -> bool:
        """Stop in routines only."""
        return is_rapid(frame) and super().stop_here(frame)

    def user_call(self, frame: FrameType, argument_list: Any) -> None:
        """Entering a routine: stop at its first statement, not before."""

    def user_line(self, frame: FrameType) -> None:
        """Stop where a statement begins."""
        self._know(module_of(frame))
        if self._failed == (frame, frame.f_lineno):
            # Its line is traced again during the search for the ERROR clause.
            return
        self._failed = None
        if frame.f_lineno in self._lines.get(frame.f_code.co_filename, ()):
            super().user_line(frame)

    def user_return(self, frame: FrameType, return_value: Any) -> None:
        """Leaving a routine: stop at the next statement of any caller."""
        if frame is self.returnframe:
            self.set_step()

    def user_exception(self, frame: FrameType, exc_info: Any) -> None:
        """Stop where an error passes, as long as the user steps."""
        error = exc_info[1]
        if isinstance(error, ERRORS):
            self._know(module_of(frame))
            self._failed = (frame, frame.f_lineno)
            self.message(f"error: {error if isinstance(error, RapidError) else 'division by zero'}")
            self.interaction(frame, None)

    def interaction(self, frame: FrameType | None, *rest: Any) -> None:
        """Show the place and take commands."""
        if not self._greeted:
            self.message(_HELP)
            self._greeted = True
        super().interaction(frame, *rest)

    def get_stack(
        self, f: FrameType | None, t: TracebackType | None
    ) -> tuple[list[tuple[FrameType, int]], int]:
        """The routines that run, the outermost first."""
        stack, _ = super().get_stack(f, t)
        routines = [(frame, line) for frame, line in stack if is_rapid(frame)]
        return routines, len(routines) - 1

    def format_stack_entry(self, frame_lineno: tuple[FrameType, int], lprefix: str = ": ") -> str:
        """One routine: place, name, statement."""
        frame, line = frame_lineno
        file = frame.f_code.co_filename
        text = self._sources[file].line(line).strip()
        return f"{file}:{line} in {place_of(frame)}{lprefix}{text}"

    # Callbacks of pdb's commands.

    @property
    def _frame(self) -> FrameType:
        """The selected routine."""
        assert self.curframe is not None
        return self.curframe

    def lookupmodule(self, filename: str) -> str | None:
        """The file of the program that a user means: as it was named, or by its last part."""
        wanted = Path(filename).name.lower()
        named = [file for file in self._sources if Path(file) == Path(filename)]
        alike = [file for file in self._sources if Path(file).name.lower() == wanted]
        return next(iter([*named, *alike]), None)

    def checkline(self, filename: str, lineno: int, module_globals: Any = None) -> int:
        """The line of the statement at which a breakpoint on a line stops; 0 for none."""
        line = self.statement_line(filename, lineno) if filename in self._lines else 0
        if not line:
            self.error("there is no statement on this line or below")
        return line

    def do_break(self, arg: str, temporary: Any = 0) -> None:
        """Stop at `b [FILE:]LINE` or `b ROUTINE`; `b` alone lists the breakpoints."""
        place = self._start_of(arg.strip()) if arg.strip().isidentifier() else arg
        if place is None:
            self.error(f"there is no routine `{arg.strip()}`")
        else:
            super().do_break(place, temporary)

    def _start_of(self, name: str) -> str | None:
        """FILE:LINE of a routine."""
        for module in self._program.modules:
            for routine in module.routines:
                if routine.name.key == name.lower():
                    line = module.source.position(routine.start)[0]
                    return f"{module.source.file}:{line}"
        return None

    def do_p(self, arg: str) -> None:
        """Show data as a program would write it: `p n`, `p p10.trans`, `p a{i}`."""
        try:
            self.message(rapid_text(arg, self._frame))
        except NotShownError as error:
            self.error(str(error))

    def message(self, msg: str, end: str = "\n") -> None:
        """Print, as everything is printed; from Python 3.13 on, with an end of the line."""
        echo(msg + end.removesuffix("\n"))

    def error(self, msg: str) -> None:
        """Report an error in a command; modules are not searched on Python's path."""
        super().error(msg.replace("from sys.path", "in the program"))

    def do_args(self, arg: str) -> None:
        """Show the arguments of the routine."""
        for name in parameters(self._frame):
            try:
                self.message(f"{name} = {rapid_text(name, self._frame)}")
            except NotShownError as error:
                self.message(f"{name}: {error}")

    def do_longlist(self, arg: str) -> None:
        """Show the whole routine."""
        routine = routine_of(self._frame)
        if routine is not None:
            source: Source = routine.module.source
            first, last = (source.position(at)[0] for at in (routine.node.start, routine.node.end))
            self.do_list(f"{first}, {last}")

    def default(self, line: str) -> None:
        """A name alone shows its value; `!` goes before Python."""
        if line.startswith("!"):
            super().default(line)
        else:
            self.do_p(line)

    do_b = do_break
    do_pp = do_p
    do_a = do_args
    do_ll = do_longlist
