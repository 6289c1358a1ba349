"""The process in which the program runs under the debugger, and its requests.

A stop blocks the run before a statement: requests are handled until one lets it go on. What would
change the run, such as finding the time of a statement, is observed in a copy of the process.
"""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import FrameType, MappingProxyType
from typing import Any

from rapidsim.controller.journal.events import EventKind
from rapidsim.dap.breakpoints import Breakpoints, InvalidBreakpointError
from rapidsim.dap.checkpoints import HAS_COPIES, Checkpoints, ObservationError
from rapidsim.dap.link import AdapterEnded, Link
from rapidsim.dap.program import DebuggedProgram, LaunchError
from rapidsim.dap.state import Change, SessionState
from rapidsim.dap.stopped import StoppedRun
from rapidsim.dap.time_search import TimeSearch
from rapidsim.dap.wire import Message, read_message
from rapidsim.findings.runs import UncaughtError
from rapidsim.interpreter.tools.debugging import Debugger, Stop, StopReason
from rapidsim.interpreter.tools.inspection import NotShownError
from rapidsim.interpreter.tools.step_positions import StepGranularity
from rapidsim.language.error_numbers import NUMBERS, name_of
from rapidsim.language.errors import RapidError
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.simulation.results.verdict import run_verdict

_STEPS = MappingProxyType(
    {
        "next": StepGranularity.SAME_ROUTINE,
        "stepIn": StepGranularity.ANY,
        "stepOut": StepGranularity.CALLER,
    }
)
_EXIT_OF_ERROR = 1
_MOST_STEPS = 1000
"""Steps that are remembered to be taken back."""


class Refused(Exception):  # noqa: N818 - the client asked for what cannot be done
    """A request that cannot be fulfilled; the message has the reason."""


@dataclass(eq=False)
class Debuggee:
    """One session, in the process that has the program."""

    link: Link
    program: DebuggedProgram
    state: SessionState
    checkpoints: Checkpoints
    debugger: Debugger = field(init=False)
    breakpoints: Breakpoints = field(init=False)
    run: RunInProgress | None = None
    _stopped: StoppedRun | None = None
    """Where the program is; None while it runs."""
    _goes_on: bool = False
    _hits: list[int] = field(default_factory=list)
    """Numbers of the statements at which a survey would have stopped."""
    _search: TimeSearch | None = None
    """In a copy that looks for a statement by its time."""
    _stepped_from: int = 0
    """Number of the statement from which the present step began; 0 without one."""
    _surveyed_from: int = 1
    """Number of the statement before which a survey began."""

    def __post_init__(self) -> None:
        """Set up the debugger."""
        self.debugger = Debugger(self._stop, self._poll, self._before)
        self.breakpoints = Breakpoints(self.program, self.debugger, self.link.output)

    def configure(self, *, stops_on_entry: bool) -> bool:
        """Handle requests until the client has configured the session.

        Returns:
            False if it has ended it.
        """
        self.link.event("initialized")
        is_configured = False
        while not is_configured:
            for request in self.link.requests(wait=True):
                if request["command"] == "disconnect":
                    self.link.respond(request)
                    return False
                self._handle(request)
                is_configured |= request["command"] == "configurationDone"
        if stops_on_entry:
            self.debugger.run_to(1, StopReason.ENTRY)
        return True

    def execute(self) -> None:
        """Run the program to its end, and say how it ended."""
        self._restore()
        try:
            finished = self.debugger.run(lambda: self.program.run(self._watch))
        except LaunchError as error:
            self.link.output(str(error), "stderr")
            self._finish(_EXIT_OF_ERROR)
            return
        if self._search is not None:
            self._search.end()
        self._print_events()
        self._stop_at_last_error(finished)
        run = finished.simulation
        for one in run.diagnostics:
            place = "" if one.span is None else f"{one.span.file}:{one.span.line}: "
            code = f"{one.severity.value}[{one.code}]"
            self.link.output(f"{place}{code} {one.violation.message}")
        verdict = run_verdict(run)
        self.link.output(f"{run.title} {verdict.headline}")
        self._finish(0 if verdict.failure is None else _EXIT_OF_ERROR)

    def _finish(self, code: int) -> None:
        self.link.event("exited", exitCode=code)
        self.link.event("terminated")

    def _stop_at_last_error(self, finished: FinishedRun) -> None:
        """Go back to the error that ended the program, if the client wants to see it."""
        number = self.debugger.last_error
        if "unhandled" not in self.state.filters or number in (0, self.state.shown_error):
            return
        found = [
            one
            for one in finished.simulation.diagnostics
            if isinstance(one.violation, UncaughtError)
        ]
        if found:
            self.state.shown_error = number
            self._go_to(number, StopReason.ERROR, found[-1].violation.message)

    def _watch(self, run: RunInProgress) -> None:
        self.run = run
        self.breakpoints.run = run
        self.debugger.current_task = lambda: run.current.controller.clock

    # The run calls these.

    def _before(self, number: int, frame: FrameType) -> None:
        """Make a copy of the process now and then; apply what the user has changed."""
        if self._search is not None:
            assert self.run is not None
            self._search.note(number, self.run.current.controller.clock.moment())
            return
        if self.state.survey_until and number >= self.state.survey_until:
            self._end_survey()
        if number == 1 or self.checkpoints.is_due():
            self._take_checkpoint(number)
        for change in self.state.changes:
            if change.number == number:
                self._apply(change, frame)

    def _take_checkpoint(self, number: int) -> None:
        if not HAS_COPIES or self.run is None:
            return
        home = self.run.cell.home
        files = home.snapshot()
        message = self.checkpoints.take(number)
        if message is None:
            return
        if files is not None:
            home.restore(files)
        self.state, self._surveyed_from = SessionState.read(message), number
        self._restore()

    def _restore(self) -> None:
        """Continue with the session's state in a new process."""
        state = self.state
        self._stopped, self._goes_on, self._hits, self._stepped_from = None, False, [], 0
        self.breakpoints.restore(state.breakpoints)
        self._set_filters()
        if state.survey_until or state.target:
            self.breakpoints.watch(state.watched)
        if state.survey_until:
            self.debugger.go_on()
        elif state.target:
            self.debugger.run_to(state.target, StopReason(state.reason))
        elif state.watched:
            self.breakpoints.watch(state.watched)

    def _poll(self) -> None:
        """Handle the requests that have arrived while the program runs."""
        if self._search is not None:
            return
        for request in self.link.requests(wait=False):
            self._handle(request)

    def _stop(self, stop: Stop) -> None:
        """Handle requests until the program may go on."""
        if self.state.survey_until:
            self._note(stop)
            return
        assert self.run is not None
        self._print_events()
        if stop.reason is StopReason.STEP and self._stepped_from:
            self.state.steps = [*self.state.steps[-_MOST_STEPS:], [stop.number, self._stepped_from]]
        self._stepped_from = 0
        text = stop.text or self.state.text
        self.state.target, self.state.text = 0, ""
        stopped = self._stopped = StoppedRun(
            stop, self.run, self.program, self.debugger, self.breakpoints
        )
        reason = "step" if stop.reason is StopReason.GOTO else stop.reason.value
        more = {"text": text, "description": text} if text else {}
        self._announce(reason, stopped.thread, more)
        stopped.text = text
        self._goes_on = False
        while not self._goes_on:
            for request in self.link.requests(wait=True):
                self._handle(request)
        self._stopped = None

    def _announce(self, reason: str, thread: int, more: Message) -> None:
        self.link.event("stopped", reason=reason, threadId=thread, allThreadsStopped=True, **more)

    def _note(self, stop: Stop) -> None:
        """Note a stop of a survey; at its end go to the last one."""
        if stop.number < self.state.survey_until:
            self._hits.append(stop.number)
        self.debugger.go_on()

    def _end_survey(self) -> None:
        """Go to the last stop of a survey; if there is none, look at what ran before."""
        if self._hits:
            self._go_to(self._hits[-1], StopReason.BREAKPOINT)
        if self._surveyed_from <= 1:
            self._go_to(1, StopReason.ENTRY)
        self.state.survey_until = self._surveyed_from
        self._hand_over(self._surveyed_from - 1)

    def _print_events(self) -> None:
        """Show the texts of the run that the client has not seen."""
        if self.run is None or not self.run.tasks():
            return
        # Events of other kinds may be inserted before these.
        events = self.run.tasks()[0].journal.undated(0)
        texts = [event.message for event in events if event.kind is EventKind.TEXT]
        for text in texts[self.state.printed :]:
            self.link.output(text, "stdout")
        self.state.printed = max(self.state.printed, len(texts))

    # Going back.

    def _go_to(self, number: int, reason: StopReason, text: str = "") -> None:
        """Stop before a statement that has run already, in another process."""
        self.state.target, self.state.reason, self.state.text = number, reason.value, text
        self.state.survey_until = 0
        self._hand_over(number)

    def _hand_over(self, number: int) -> None:
        if HAS_COPIES and self.checkpoints.before(number):
            self.checkpoints.go_back(number, self.state.message())
        self.link.restart(self.state.message())
        os._exit(0)

    def _apply(self, change: Change, frame: FrameType) -> None:
        assert self.run is not None
        stop = Stop(StopReason.GOTO, frame, self.debugger.place(frame), change.number)
        stopped = StoppedRun(stop, self.run, self.program, self.debugger, self.breakpoints)
        stopped.assign(change)

    # Requests.

    def _handle(self, request: Message) -> None:
        name = str(request.get("command"))
        try:
            handler = _HANDLERS.get(name)
            if handler is None:
                raise Refused(f"`{name}` is not supported")
            body = handler(self, request.get("arguments") or {})
        except (Refused, NotShownError, ObservationError, InvalidBreakpointError) as error:
            self.link.refuse(request, str(error))
        except (LookupError, TypeError, ValueError) as error:
            self.link.refuse(request, f"`{name}` has wrong arguments: {error}")
        else:
            if isinstance(body, Later):
                if body.body is not None:
                    self.link.respond(request, body.body)
                body.then()
            else:
                self.link.respond(request, body)

    def stopped(self) -> StoppedRun:
        """The stop.

        Raises:
            Refused: If the program runs.
        """
        if self._stopped is None:
            raise Refused("the program runs; pause it first")
        return self._stopped

    def _set_filters(self) -> None:
        condition = self.state.filters.get("all")
        wanted = None if condition is None else _wanted_errors(condition)
        self.debugger.stops_at_error = wanted

    def _resume(self) -> None:
        self._goes_on = True

    def set_breakpoints(self, arguments: Message) -> Message:
        """Replace the breakpoints of a source."""
        path = arguments["source"]["path"]
        wanted = arguments.get("breakpoints") or [
            {"line": line} for line in arguments.get("lines") or ()
        ]
        self.state.breakpoints[path] = wanted
        return {"breakpoints": self.breakpoints.set(path, wanted)}

    def set_exception_breakpoints(self, arguments: Message) -> Message:
        """Replace the filters of errors."""
        filters = dict.fromkeys(arguments.get("filters") or (), "")
        for one in arguments.get("filterOptions") or ():
            filters[one["filterId"]] = one.get("condition") or ""
        self.state.filters = filters
        self._set_filters()
        return {}

    def data_breakpoint_info(self, arguments: Message) -> Message:
        """Whether a name can have a data breakpoint."""
        return self.stopped().data_breakpoint_info(arguments)

    def set_data_breakpoints(self, arguments: Message) -> Message:
        """Replace the data breakpoints."""
        names = [one["dataId"] for one in arguments.get("breakpoints") or ()]
        self.state.watched = names
        self.breakpoints.watch(names)
        return {"breakpoints": [{"verified": True} for _ in names]}

    def configuration_done(self, arguments: Message) -> Message:
        """Begin; see `configure`."""
        return {}

    def threads(self, arguments: Message) -> Message:
        """The tasks."""
        tasks = () if self.run is None else self.run.tasks()
        names = [one.setup.name for one in tasks] or [
            setup.name for setup in self.program.prepared.setups
        ]
        return {"threads": [{"id": k, "name": name} for k, name in enumerate(names, 1)]}

    def go_on(self, arguments: Message) -> Later:
        """Continue."""
        self.stopped()
        self.debugger.go_on()
        return Later({"allThreadsContinued": True}, self._resume)

    def step(self, arguments: Message, reach: StepGranularity) -> Later:
        """Step in the task of a thread."""
        stopped = self.stopped()
        thread = int(arguments.get("threadId") or stopped.thread)
        frame = stopped.innermost(thread)
        if frame is None:
            raise Refused("this task does not run")
        self.debugger.step(reach, frame, stopped.task(thread).controller.clock)
        self._stepped_from = stopped.stop.number
        return Later({}, self._resume)

    def step_back(self, arguments: Message) -> Later:
        """Go to where the last step came from, else to the statement before in the task."""
        number = self.stopped().stop.number
        steps = self.state.steps
        while steps and steps[-1][0] > number:
            steps.pop()
        came_from = steps.pop()[1] if steps and steps[-1][0] == number else 0
        before = came_from or self.debugger.number_before(number)
        if not before:
            raise Refused("this is the first statement of the task")
        return Later({}, lambda: self._go_to(before, StopReason.STEP))

    def reverse_continue(self, arguments: Message) -> Later:
        """Go to the last stop before this one."""
        number = self.stopped().stop.number

        def survey() -> None:
            self.state.survey_until = number
            self._hand_over(max(1, number - 1))

        return Later({}, survey)

    def restart(self, arguments: Message) -> Later:
        """Begin again, without what the user has changed."""
        self.state.changes = []
        self.state.shown_error = self.state.printed = 0
        return Later({}, lambda: self._go_to(1, StopReason.ENTRY))

    def restart_frame(self, arguments: Message) -> Later:
        """Go to the first statement of a routine that runs."""
        frame = self.stopped().frame(int(arguments["frameId"]))
        number = self.debugger.first_number(frame)
        return Later({}, lambda: self._go_to(number, StopReason.GOTO))

    def pause(self, arguments: Message) -> Message:
        """Stop before the next statement."""
        self.debugger.pause()
        return {}

    def stack_trace(self, arguments: Message) -> Message:
        """The routines that a task runs."""
        return self.stopped().stack_trace(arguments)

    def scopes(self, arguments: Message) -> Message:
        """The scopes of a routine."""
        return self.stopped().scopes(arguments)

    def variables(self, arguments: Message) -> Message:
        """The lines below a scope or value."""
        stopped = self.stopped()
        return {"variables": stopped.handles.unfolded(int(arguments["variablesReference"]))}

    def evaluate(self, arguments: Message) -> object:
        """The value of an expression; in the console also `n := 5` and `until 2.5`."""
        stopped, text = self.stopped(), str(arguments["expression"])
        if arguments.get("context") == "repl":
            word, _, rest = text.strip().partition(" ")
            if word.lower() == "until":
                return self._run_until(float(rest))
            name, becomes, value = text.partition(":=")
            if becomes:
                return {"result": self._change(arguments, name, value), "variablesReference": 0}
        return stopped.evaluate(text, arguments)

    def _run_until(self, time_s: float) -> object:
        self.stopped()
        search = TimeSearch.begun(time_s)
        if isinstance(search, TimeSearch):
            # This is the copy that searches: it runs on, and tells the number it finds.
            self._search = search
            self.debugger.breakpoints, self.debugger.stops_at_error = {}, None
            self.debugger.watch({})
            self.debugger.go_on()
            return Later(None, self._resume)
        number = search
        if number is None:
            raise Refused(f"no statement begins at {time_s:g} s or later")
        self.debugger.run_to(number, StopReason.GOTO)
        return Later({"result": f"runs to {time_s:g} s", "variablesReference": 0}, self._resume)

    def run_to_time(self, arguments: Message) -> object:
        """Run to the first statement at a virtual time [s] or after it."""
        return self._run_until(float(arguments["time"]))

    def set_variable(self, arguments: Message) -> Message:
        """Set data by name, in the scope of the stop."""
        path = self.stopped().handles.path(
            int(arguments["variablesReference"]), str(arguments["name"])
        )
        return {"value": self._change(arguments, path, str(arguments["value"]))}

    def set_expression(self, arguments: Message) -> Message:
        """Set data by an expression that names them."""
        text = self._change(arguments, str(arguments["expression"]), str(arguments["value"]))
        return {"value": text}

    def _change(self, arguments: Message, name: str, text: str) -> str:
        """Set a value now, and whenever the run gets here again."""
        stopped = self.stopped()
        change = stopped.change(name.strip(), text.strip(), arguments.get("frameId"))
        shown = stopped.assign(change)
        self.checkpoints.forget_after(stopped.stop.number)
        self.state.changes.append(change)
        return shown

    def exception_info(self, arguments: Message) -> Message:
        """The error at which the program stopped."""
        stopped = self.stopped()
        error = stopped.stop.error
        name = stopped.text.partition(":")[0] if error is None else error.name
        return {
            "exceptionId": name or "error",
            "description": stopped.text,
            "breakMode": "unhandled" if error is None else "always",
        }

    def loaded_sources(self, arguments: Message) -> Message:
        """The files of the program."""
        return {
            "sources": [
                {"name": Path(path).name, "path": path} for path in self.program.paths.values()
            ]
        }

    def end(self, arguments: Message) -> Later:
        """End the session."""
        return Later({}, _leave)


@dataclass(frozen=True, slots=True)
class Later:
    """An answer, and what happens once it is sent."""

    body: Message | None
    """None if another process answers."""
    then: Callable[[], None]


def _leave() -> None:
    raise AdapterEnded


Handler = Callable[[Debuggee, Message], object]


def _stepping(reach: StepGranularity) -> Handler:
    return lambda session, arguments: session.step(arguments, reach)


_HANDLERS: Mapping[str, Handler] = MappingProxyType(
    {
        "setBreakpoints": Debuggee.set_breakpoints,
        "setExceptionBreakpoints": Debuggee.set_exception_breakpoints,
        "dataBreakpointInfo": Debuggee.data_breakpoint_info,
        "setDataBreakpoints": Debuggee.set_data_breakpoints,
        "configurationDone": Debuggee.configuration_done,
        "threads": Debuggee.threads,
        "continue": Debuggee.go_on,
        **{name: _stepping(reach) for name, reach in _STEPS.items()},
        "stepBack": Debuggee.step_back,
        "reverseContinue": Debuggee.reverse_continue,
        "restart": Debuggee.restart,
        "restartFrame": Debuggee.restart_frame,
        "pause": Debuggee.pause,
        "stackTrace": Debuggee.stack_trace,
        "scopes": Debuggee.scopes,
        "variables": Debuggee.variables,
        "evaluate": Debuggee.evaluate,
        "runToTime": Debuggee.run_to_time,
        "setVariable": Debuggee.set_variable,
        "setExpression": Debuggee.set_expression,
        "exceptionInfo": Debuggee.exception_info,
        "loadedSources": Debuggee.loaded_sources,
        "terminate": Debuggee.end,
        "disconnect": Debuggee.end,
    }
)
"""Requests of the protocol that the debuggee handles."""


def _wanted_errors(condition: str) -> Callable[[RapidError], bool]:
    """Whether an error has one of the names or numbers of a condition; any error if it is empty."""
    words = {word.strip().upper() for word in condition.split(",") if word.strip()}
    if not words:
        return lambda error: True

    def is_wanted(error: RapidError) -> bool:
        number = NUMBERS.get(name_of(error), error.errno)
        return bool(words & {name_of(error).upper(), f"{error.errno:g}", f"{number:g}"}) or any(
            (error.cf or "").endswith(word) for word in words if word.isdecimal()
        )

    return is_wanted


def main(incoming: int, outgoing: int, alive: int) -> None:
    """Run one session over descriptors of pipes."""
    link = Link(os.fdopen(incoming, "rb"), os.fdopen(outgoing, "wb"))
    first = read_message(link.incoming)
    if first is None:
        return
    try:
        _session(link, first, alive)
    except AdapterEnded:
        pass
    except BaseException:
        link.output(f"rapidsim has a defect:\n{traceback.format_exc()}", "stderr")
        link.event("terminated")
    link.ended()


def _session(link: Link, first: Message, alive: int) -> None:
    launch, state = first["launch"], first["state"]
    arguments: dict[str, Any] = launch.get("arguments") or {}
    try:
        program = DebuggedProgram.launched(arguments)
    except LaunchError as error:
        link.output(str(error), "stderr")
        link.refuse(launch, str(error).partition("\n")[0])
        link.event("terminated")
        return
    began = SessionState() if state is None else SessionState.read(state)
    session = Debuggee(link, program, began, Checkpoints(alive))
    if state is None:
        link.respond(launch)
        if not session.configure(stops_on_entry=bool(arguments.get("stopOnEntry"))):
            return
    session.execute()


if __name__ == "__main__":
    received, sent = os.dup(0), os.dup(1)
    # What anything prints must not get between the messages.
    os.dup2(2, 1)
    main(received, sent, int(sys.argv[1]))
