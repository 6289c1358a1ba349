"""`rapidsim run --break`: a prompt over the session of a debug adapter.

The session runs in this process; typed commands become its requests. See `dap.session`.
"""

from __future__ import annotations

import cmd
import os
import re
import signal
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import Any, TypeVar

import click

from rapidsim.cli.successors import continue_in_successor
from rapidsim.cli.terminal import echo
from rapidsim.dap.checkpoints import HAS_COPIES, Checkpoints, ObservationError
from rapidsim.dap.link import AdapterEnded
from rapidsim.dap.program_files import ProgramFiles
from rapidsim.dap.requests import HANDLERS
from rapidsim.dap.session import DebugSession
from rapidsim.dap.state import SessionState
from rapidsim.dap.wire import Message
from rapidsim.files import InputError, did_you_mean
from rapidsim.interpreter.tools.inspection import (
    NotShownError,
    is_data_path,
    module_of,
    parameters,
    place_of,
    rapid_text,
    routine_of,
)
from rapidsim.simulation.progress import RunInProgress

T = TypeVar("T")

_HELP = (
    "n: next statement, s: into a routine, back: step back, c: continue, w: call stack, "
    "p NAME: value, q: quit"
)
_PLACE = re.compile(r"\s*(?:(.+):)?(\d+)\s*(?:,(.*))?$")
"""A breakpoint: FILE, LINE and condition."""
_AROUND = 5
"""Lines that `l` shows before and behind the current one."""


def debugged(
    run: Callable[[Callable[[RunInProgress], None]], T],
    files: ProgramFiles,
    breaks: Sequence[str],
    *,
    uses_network: bool,
) -> T:
    """Run with a prompt at each breakpoint.

    Args:
        run: Executes the program, and first calls a function with the run.
        files: The files of the program.
        breaks: Places as `FILE:LINE`, or a line alone in a program of one file; with a condition
            in RAPID after a comma.
        uses_network: Whether the run may use real sockets.

    Raises:
        InputError: If there is no terminal, or a breakpoint is not a place.
        click.Abort: If the user quits.
    """
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        raise InputError(
            "--break needs a terminal: the program stops there until a command is typed"
        )
    prompt = _Prompt(files)
    for text in breaks:
        prompt.set_first(text)
    # What goes over the network cannot be taken back, nor done twice.
    can_go_back = HAS_COPIES and not uses_network
    checkpoints = Checkpoints(continue_in_successor()) if can_go_back else None
    session = prompt.session = DebugSession(prompt, files, prompt.state, checkpoints, HANDLERS)
    on_interrupt = signal.getsignal(signal.SIGINT)
    if on_interrupt is signal.default_int_handler:
        signal.signal(signal.SIGINT, prompt.interrupted)
    try:
        return session.follow(run)
    except AdapterEnded:
        raise click.Abort from None
    finally:
        signal.signal(signal.SIGINT, on_interrupt)
        if can_go_back:
            signal.signal(signal.SIGCHLD, signal.SIG_DFL)


class _Prompt(cmd.Cmd):
    """The client of a session: a person at a terminal. It is a `dap.link.ClientLink`."""

    prompt = "(rapid) "
    session: DebugSession

    def __init__(self, files: ProgramFiles) -> None:
        super().__init__()
        self._files = files
        self.state = SessionState(filters={"steps": ""})
        self._request: Message = {}
        self._thread = 1
        self._routine = 0
        """Number of the selected routine, from the innermost one."""
        self._pauses = False

    # The link.

    def requests(self, *, wait: bool) -> list[Message]:
        """Read commands until one of them is a request to the session."""
        if not wait:
            return []
        self._request = {}
        while not self._request:
            try:
                self.cmdloop()
            except KeyboardInterrupt:
                echo("")
        self.session.state.client = {"last": self.lastcmd}
        return [self._request]

    def event(self, event: str, **body: Any) -> None:
        """Show where the program stopped."""
        if event != "stopped":
            return
        client = self.session.state.client
        if not client:
            echo(_HELP)
        self.lastcmd = client.get("last", "")
        self._thread, self._routine, self._pauses = int(body["threadId"]), 0, False
        stop = self.session.stopped().stop
        if stop.error is not None:
            echo(f"error: {stop.error}")
        elif stop.text:
            echo(stop.text)
        self._show_place()

    def output(self, text: str, category: str = "console") -> None:
        """Print a line; what the program prints is in the summary of the run."""
        if category != "stdout":
            echo(text)

    def respond(self, request: Message, body: object = None) -> None:
        """Print a result."""
        if isinstance(body, dict) and "result" in body:
            echo(str(body["result"]))

    def refuse(self, request: Message, reason: str) -> None:
        """Print why a request cannot be fulfilled."""
        echo(f"*** {reason}")

    def restart(self, state: object) -> None:
        """See `ClientLink`; without copies of the process nothing goes back."""

    def interrupted(self, number: int, frame: FrameType | None) -> None:
        """Stop a running program at its next statement; the second time, end it.

        A command that lets it go on has been read: then it is about to run.
        """
        if self.session.search is not None:
            os._exit(0)
        if self._pauses or not (self._request or self.session.is_running):
            raise KeyboardInterrupt
        self._pauses = True
        self.session.debugger.pause()

    # Breakpoints.

    def set_first(self, text: str) -> None:
        """Set a breakpoint before the run.

        Raises:
            InputError: If it is not a place.
        """
        match, known = _PLACE.match(text), list(self._files.lines)
        if match is None:
            raise InputError(f"--break {text}: expected FILE:LINE")
        name, line, condition = match.groups()
        file = self._file(name) if name else known[0] if len(known) == 1 else None
        if file is None:
            raise InputError(
                f"--break: {name} is not in the program"
                if name
                else f"--break {text}: which file?",
                did_you_mean(name or "", known) or f"its files are {', '.join(known[:5])}",
            )
        first = self._files.statement_line(file, int(line))
        if first is None:
            raise InputError(f"--break: {file} has no statement on line {line} or below")
        if first != int(line):
            echo(f"{file}:{line} holds no statement; stopping at line {first}", err=True)
        self._add(self.state, file, first, condition)

    def _file(self, name: str) -> str | None:
        """The file that a user means: as it was named, or by its last part."""
        files = self._files.lines
        named = [file for file in files if Path(file) == Path(name)]
        wanted = Path(name).name.lower()
        alike = [file for file in files if Path(file).name.lower() == wanted]
        return next(iter([*named, *alike]), None)

    def _add(self, state: SessionState, file: str, line: int, condition: str | None) -> int:
        """Add a breakpoint, or replace that of the line; return its number."""
        number = max((one["number"] for _, one in _all_of(state)), default=0) + 1
        kept = [one for one in state.breakpoints.get(file, ()) if one["line"] != line]
        one = {"line": line, "condition": (condition or "").strip(), "number": number}
        state.breakpoints[file] = [*kept, one]
        return int(number)

    def do_break(self, arg: str) -> None:
        """Stop at `b [FILE:]LINE [, CONDITION]` or `b ROUTINE`; `b` alone lists the breakpoints."""
        if not arg:
            for place, one in _all_of(self.session.state):
                only = f", if {one['condition']}" if one["condition"] else ""
                echo(f"{one['number']}: {place}:{one['line']}{only}")
            return
        routine, comma, condition = arg.partition(",")
        if routine.strip().isidentifier():
            arg = f"{self._start_of(routine.strip())}{comma}{condition}"
        match = _PLACE.match(arg)
        if match is None:
            raise NotShownError(f"`{arg}` is neither [FILE:]LINE nor a routine")
        name, line, condition = match.groups()
        file = self._file(name) if name else self._frame.f_code.co_filename
        if file is None:
            raise NotShownError(f"{name!r} not found in the program")
        first = self._files.statement_line(file, int(line))
        if first is None:
            raise NotShownError("there is no statement on this line or below")
        number = self._add(self.session.state, file, first, condition)
        self.session.breakpoints.restore(self.session.state.breakpoints)
        echo(f"Breakpoint {number} at {file}:{first}")

    def _start_of(self, name: str) -> str:
        """FILE:LINE of a routine."""
        for module in self._files.modules:
            for routine in module.routines:
                if routine.name.key == name.lower():
                    line = module.source.position(routine.start)[0]
                    return f"{module.source.file}:{line}"
        raise NotShownError(f"there is no routine `{name}`")

    def do_clear(self, arg: str) -> None:
        """Remove breakpoints by their numbers, `cl 2`; `cl` alone removes all."""
        state, numbers = self.session.state, [*map(int, re.findall(r"\d+", arg))]
        state.breakpoints = {
            file: [one for one in of_file if arg and one["number"] not in numbers]
            for file, of_file in state.breakpoints.items()
        }
        self.session.breakpoints.restore(state.breakpoints)

    # Steps.

    def _send(self, command: str, **arguments: object) -> None:
        self._request = {"seq": 0, "command": command, "arguments": arguments}

    def do_next(self, arg: str) -> None:
        """Run to the next statement of the routine."""
        self._send("next", threadId=self._thread)

    def do_step(self, arg: str) -> None:
        """Run to the next statement, also of a routine or trap."""
        self._send("stepIntoTraps", threadId=self._thread)

    def do_return(self, arg: str) -> None:
        """Run until the routine returns."""
        self._send("stepOut", threadId=self._thread)

    def do_continue(self, arg: str) -> None:
        """Run to the next breakpoint."""
        self._send("continue")

    def do_back(self, arg: str) -> None:
        """Go back to where the last step came from, else to the statement before."""
        self._require_copies()
        self._send("stepBack")

    def do_reverse(self, arg: str) -> None:
        """Go back to the breakpoint before."""
        self._require_copies()
        self._send("reverseContinue")

    def _require_copies(self) -> None:
        if self.session.checkpoints is None:
            raise NotShownError("not on Windows, and not in a run with --allow-network")

    def do_until(self, arg: str) -> None:
        """Run to a virtual time [s]: `until 2.5`."""
        self._require_copies()
        self._send("evaluate", expression=f"until {arg}", context="repl")

    def do_quit(self, arg: str) -> None:
        """Quit the run, without recording and summary."""
        raise AdapterEnded

    # Values.

    def do_p(self, arg: str) -> None:
        """Show data or an expression: `p n`, `p p10.trans`, `p a{i}`, `p n+1`."""
        try:
            echo(rapid_text(arg, self._frame))
        except NotShownError:
            if is_data_path(arg):
                raise
            echo(self.session.breakpoints.value(arg, self._frame)[0])

    def do_args(self, arg: str) -> None:
        """Show the arguments of the routine."""
        for name in parameters(self._frame):
            try:
                echo(f"{name} = {rapid_text(name, self._frame)}")
            except NotShownError as error:
                echo(f"{name}: {error}")

    def default(self, line: str) -> None:
        """A name alone shows its value; `NAME:=VALUE` sets it."""
        if ":=" not in line:
            self.do_p(line)
            return
        number = self.session.stopped().number(self._frame)
        self._send("evaluate", expression=line, context="repl", frameId=number)

    # Places.

    @property
    def _frames(self) -> Sequence[FrameType]:
        stopped = self.session.stopped()
        frames = stopped.frames_of(stopped.task(self._thread))
        if not frames:
            raise NotShownError("this task does not run")
        return frames

    @property
    def _frame(self) -> FrameType:
        return self._frames[self._routine]

    def _entry(self, frame: FrameType) -> str:
        """A routine: place, name, statement."""
        line = self.session.debugger.line(frame)
        source = module_of(frame).source
        stopped = self.session.stopped()
        task = stopped.task(self._thread).setup.name
        of = f" of {task}" if len(stopped.run.tasks()) > 1 else ""
        return f"{source.file}:{line} in {place_of(frame)}{of}\n-> {source.line(line).strip()}"

    def _show_place(self) -> None:
        echo(f"> {self._entry(self._frame)}")

    def do_w(self, arg: str) -> None:
        """Show the call stack."""
        for number, frame in reversed(list(enumerate(self._frames))):
            echo(f"{'>' if number == self._routine else ' '} {self._entry(frame)}")

    def do_up(self, arg: str) -> None:
        """Select the caller."""
        self._select(self._routine + 1, "this is the outermost routine")

    def do_down(self, arg: str) -> None:
        """Select the routine that is called."""
        self._select(self._routine - 1, "this is the innermost routine")

    def _select(self, routine: int, refusal: str) -> None:
        if not 0 <= routine < len(self._frames):
            raise NotShownError(refusal)
        self._routine = routine
        self._show_place()

    def do_task(self, arg: str) -> None:
        """Select a task by name; `t` alone lists the tasks."""
        tasks = self.session.stopped().run.tasks()
        names = [one.setup.name for one in tasks]
        if not arg:
            for number, name in enumerate(names, 1):
                echo(f"{'>' if number == self._thread else ' '} {name}")
            return
        found = [k for k, name in enumerate(names, 1) if name.lower() == arg.lower()]
        if not found:
            raise NotShownError(f"there is no task `{arg}`")
        self._thread, self._routine = found[0], 0
        self._show_place()

    def do_list(self, arg: str) -> None:
        """Show the surrounding lines."""
        line = self.session.debugger.line(self._frame)
        self._show_lines(line - _AROUND, line + _AROUND)

    def do_longlist(self, arg: str) -> None:
        """Show the whole routine."""
        routine = routine_of(self._frame)
        if routine is not None:
            source = routine.module.source
            first, last = (source.position(at)[0] for at in (routine.node.start, routine.node.end))
            self._show_lines(first, last)

    def _show_lines(self, first: int, last: int) -> None:
        source, current = module_of(self._frame).source, self.session.debugger.line(self._frame)
        of_file = self.session.state.breakpoints.get(source.file, ())
        stops = {one["line"] for one in of_file}
        for line in range(max(first, 1), min(last, source.text.count("\n") + 1) + 1):
            marks = f"{'B' if line in stops else ' '}{'->' if line == current else '  '}"
            echo(f"{line:3d} {marks} {source.line(line)}".rstrip())

    # The loop of `cmd`.

    def onecmd(self, line: str) -> bool:
        """Execute a command; whether the loop ends."""
        try:
            super().onecmd("quit" if line == "EOF" else line)
        except (NotShownError, ObservationError) as error:
            echo(f"*** {error}")
        return bool(self._request)

    do_b = do_break
    do_cl = do_clear
    do_n = do_next
    do_s = do_step
    do_r = do_return
    do_c = do_cont = do_continue
    do_rc = do_reverse
    do_q = do_exit = do_quit
    do_pp = do_p
    do_a = do_args
    do_bt = do_w
    do_u = do_up
    do_d = do_down
    do_t = do_task
    do_l = do_list
    do_ll = do_longlist


def _all_of(state: SessionState) -> list[tuple[str, Message]]:
    """All breakpoints with their files, by number."""
    found = [(file, one) for file, of_file in state.breakpoints.items() for one in of_file]
    return sorted(found, key=lambda pair: int(pair[1]["number"]))
