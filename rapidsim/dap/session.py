"""The process in which the program runs under the debugger, and its requests.

A stop blocks the run before a statement: requests are handled until one lets it go on. What would
change the run, such as finding the time of a statement, is observed in a copy of the process.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from types import FrameType
from typing import TypeVar

from rapidsim.controller.journal.events import EventKind
from rapidsim.dap.breakpoints import Breakpoints, InvalidBreakpointError
from rapidsim.dap.checkpoints import Checkpoints, ObservationError
from rapidsim.dap.link import ClientLink
from rapidsim.dap.program import LaunchError
from rapidsim.dap.program_files import ProgramFiles
from rapidsim.dap.state import Change, SessionState
from rapidsim.dap.stopped import StoppedRun
from rapidsim.dap.time_search import TimeSearch
from rapidsim.dap.wire import Message
from rapidsim.findings.runs import UncaughtError
from rapidsim.interpreter.tools.debugging import Debugger, Stop, StopReason
from rapidsim.interpreter.tools.inspection import NotShownError, module_of
from rapidsim.interpreter.tools.step_positions import rapid_frames
from rapidsim.language.error_numbers import NUMBERS, name_of
from rapidsim.language.errors import RapidError
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.simulation.results.verdict import run_verdict

T = TypeVar("T")

_EXIT_OF_ERROR = 1
_MOST_STEPS = 1000
"""Steps that are remembered to be taken back."""


class DapRequestError(Exception):
    """A request that cannot be fulfilled; the message has the reason."""


@dataclass(eq=False)
class DebugSession:
    """One session, in the process that has the program."""

    link: ClientLink
    files: ProgramFiles
    state: SessionState
    checkpoints: Checkpoints | None
    """None if there are no copies of the process: the system or the run has none."""
    handlers: Mapping[str, Callable[[DebugSession, Message], object]]
    """Functions for the requests, by command."""
    debugger: Debugger = field(init=False)
    breakpoints: Breakpoints = field(init=False)
    run: RunInProgress | None = None
    _stopped: StoppedRun | None = None
    """The stop; None while the program runs."""
    _resumed: bool = False
    _hits: list[int] = field(default_factory=list)
    """Numbers of the statements at which a survey would have stopped."""
    search: TimeSearch | None = None
    """In a copy that looks for a statement by its time."""
    stepped_from: int = 0
    """Number of the statement from which the present step began; 0 without one."""
    _surveyed_from: int = 1
    """Number of the statement before which a survey began."""

    def __post_init__(self) -> None:
        """Set up the debugger."""
        self.debugger = Debugger(self._stop, self._poll, self._before)
        self.breakpoints = Breakpoints(self.files, self.debugger, self.link.output)

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
                self.handle(request)
                is_configured |= request["command"] == "configurationDone"
        if stops_on_entry:
            self.debugger.run_to(1, StopReason.ENTRY)
        return True

    def execute(self, run: Callable[[Callable[[RunInProgress], None]], FinishedRun]) -> None:
        """Run the program to its end, and report how it ended.

        Args:
            run: Runs it, and first calls a function with the run.
        """
        try:
            finished = self.follow(run)
        except LaunchError as error:
            self.link.output(str(error), "stderr")
            self._finish(_EXIT_OF_ERROR)
            return
        self._print_events()
        self._stop_at_last_error(finished)
        result = finished.simulation
        for one in result.diagnostics:
            place = "" if one.span is None else f"{one.span.file}:{one.span.line}: "
            code = f"{one.severity.value}[{one.code}]"
            self.link.output(f"{place}{code} {one.violation.message}")
        verdict = run_verdict(result)
        self.link.output(f"{result.title} {verdict.headline}")
        self._finish(0 if verdict.failure is None else _EXIT_OF_ERROR)

    def follow(self, run: Callable[[Callable[[RunInProgress], None]], T]) -> T:
        """Run the program to its end.

        Args:
            run: Runs it, and first calls a function with the run.
        """
        self._restore()
        try:
            return self.debugger.run(lambda: run(self.take_run))
        finally:
            if self.search is not None:
                self.search.end()

    def _finish(self, code: int) -> None:
        self.link.event("exited", exitCode=code)
        self.link.event("terminated")

    def _stop_at_last_error(self, finished: FinishedRun) -> None:
        """Go back to the error that ended the program, if the client wants to see it."""
        number = self.debugger.last_error
        if "unhandled" not in self.state.filters or number in (0, self.state.unhandled_error):
            return
        found = [
            one
            for one in finished.simulation.diagnostics
            if isinstance(one.violation, UncaughtError)
        ]
        if found:
            self.state.unhandled_error = number
            self.go_to(number, StopReason.ERROR, found[-1].violation.message)

    def take_run(self, run: RunInProgress) -> None:
        """Take the run, before it begins."""
        self.run = run
        self.breakpoints.run = run
        self.debugger.current_task = lambda: run.current.controller.clock

    # The run calls these.

    def _before(self, number: int, frame: FrameType) -> None:
        """Make a copy of the process now and then; apply what the user has changed."""
        if self.search is not None:
            assert self.run is not None
            self.search.note(number, self.run.current.controller.clock.moment())
            return
        if self.state.survey_until and number >= self.state.survey_until:
            self._end_survey()
        if self.checkpoints is not None and (number == 1 or self.checkpoints.is_due()):
            self._take_checkpoint(self.checkpoints, number)
        for change in self.state.changes:
            if change.number == number:
                self._apply(change, frame)

    def _take_checkpoint(self, checkpoints: Checkpoints, number: int) -> None:
        if self.run is None:
            return
        home = self.run.cell.home
        files = home.snapshot()
        message = checkpoints.take(number)
        if message is None:
            return
        if files is not None:
            home.restore(files)
        self.state, self._surveyed_from = SessionState.read(message), number
        self._restore()

    def _restore(self) -> None:
        """Continue with the session's state in a new process."""
        state = self.state
        self._stopped, self._resumed, self._hits, self.stepped_from = None, False, [], 0
        self.breakpoints.restore(state.breakpoints)
        self.set_filters()
        if state.survey_until or state.target:
            self.breakpoints.watch(state.watchpoints)
        if state.survey_until:
            self.debugger.go_on()
        elif state.target:
            self.debugger.run_to(state.target, StopReason(state.reason))
        elif state.watchpoints:
            self.breakpoints.watch(state.watchpoints)

    def _poll(self) -> None:
        """Handle the requests that have arrived while the program runs."""
        if self.search is not None:
            return
        while requests := self.link.requests(wait=False):
            for request in requests:
                self.handle(request)

    def _stop(self, stop: Stop) -> None:
        """Handle requests until the program may go on."""
        if self.state.survey_until:
            self._note(stop)
            return
        assert self.run is not None
        taken = [self.files.take(module_of(frame)) for frame in rapid_frames(stop.frame)]
        if any(taken):
            self.breakpoints.restore(self.state.breakpoints)
        self._print_events()
        if stop.reason in (StopReason.STEP, StopReason.ERROR) and self.stepped_from:
            self.state.steps = [*self.state.steps[-_MOST_STEPS:], [stop.number, self.stepped_from]]
        self.stepped_from = 0
        text = stop.text or self.state.text
        self.state.target, self.state.text = 0, ""
        stopped = self._stopped = StoppedRun(
            stop, self.run, self.files, self.debugger, self.breakpoints
        )
        reason = "step" if stop.reason is StopReason.GOTO else stop.reason.value
        more = {"text": text, "description": text} if text else {}
        self._announce(reason, stopped.thread, more)
        stopped.text = text
        self._resumed = False
        try:
            while not self._resumed:
                self._wait()
        finally:
            self._stopped = None

    def _wait(self) -> None:
        """Handle the next request while the program is stopped."""
        for request in self.link.requests(wait=True):
            self.handle(request)

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
            self.go_to(self._hits[-1], StopReason.BREAKPOINT)
        if self._surveyed_from <= 1:
            self.go_to(1, StopReason.ENTRY)
        self.state.survey_until = self._surveyed_from
        self.hand_over(self._surveyed_from - 1)

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

    def go_to(self, number: int, reason: StopReason, text: str = "") -> None:
        """Stop before a statement that has run already, in another process."""
        self.state.target, self.state.reason, self.state.text = number, reason.value, text
        self.state.survey_until = 0
        self.hand_over(number)

    def hand_over(self, number: int) -> None:
        """Continue in the last copy that is not after a statement; this process ends."""
        if self.checkpoints is not None and self.checkpoints.before(number):
            self.checkpoints.go_back(number, self.state.message())
        self.link.restart(self.state.message())
        os._exit(0)

    def _apply(self, change: Change, frame: FrameType) -> None:
        assert self.run is not None
        stop = Stop(StopReason.GOTO, frame, self.debugger.place(frame), change.number)
        stopped = StoppedRun(stop, self.run, self.files, self.debugger, self.breakpoints)
        stopped.assign(change)

    # Requests.

    def handle(self, request: Message) -> None:
        """Execute a request and answer it."""
        name = str(request.get("command"))
        try:
            handler = self.handlers.get(name)
            if handler is None:
                raise DapRequestError(f"`{name}` is not supported")
            body = handler(self, request.get("arguments") or {})
        except (DapRequestError, NotShownError, ObservationError, InvalidBreakpointError) as error:
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

    @property
    def is_running(self) -> bool:
        """Whether the program runs."""
        return self._stopped is None

    def stopped(self) -> StoppedRun:
        """The stop.

        Raises:
            DapRequestError: If the program runs.
        """
        if self._stopped is None:
            raise DapRequestError("the program runs; pause it first")
        return self._stopped

    def set_filters(self) -> None:
        """Apply the filters of errors."""
        condition = self.state.filters.get("all")
        wanted = None if condition is None else _wanted_errors(condition)
        self.debugger.stops_at_error = wanted
        self.debugger.errors_end_steps = "steps" in self.state.filters

    def resume(self) -> None:
        """Let the run go on after the present request."""
        self._resumed = True


@dataclass(frozen=True, slots=True)
class Later:
    """An answer, and what happens once it is sent."""

    body: Message | None
    """None if another process answers."""
    then: Callable[[], None]


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
