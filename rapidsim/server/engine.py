"""The engine: a controller that stays on, how its time passes, and the requests it serves.

It runs in its own process, because planning a path keeps Python busy for longer than a protocol
may wait; tests drive it by hand.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from time import monotonic
from typing import Final, Protocol

from rapidsim.controller.cell.faults import Channel, Fault
from rapidsim.controller.journal.events import Event
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.server.journal import (
    event_line,
    log_line,
    refusal_line,
    request_line,
    sensor_line,
    switched_off_line,
    switched_on_line,
)
from rapidsim.server.messages import (
    DONE,
    BeginFault,
    ConnectionFaults,
    ConsoleLine,
    EndFaults,
    ErrorAnswer,
    FromNetwork,
    Inquiry,
    Message,
    Notification,
    ReadState,
    RefusedRequest,
    Reply,
    Request,
    Restarted,
    SessionEnded,
    Subscribe,
    Unsubscribe,
    Upload,
)
from rapidsim.server.network_inputs import NetworkInputs
from rapidsim.server.resources.context import RequestContext
from rapidsim.server.resources.faults import begin_fault
from rapidsim.server.resources.operator_view import looked
from rapidsim.server.resources.table import answered
from rapidsim.server.sensors import RecordingSensors
from rapidsim.server.subscriptions import Subscriptions
from rapidsim.server.versions import ServedVersion, served_versions
from rapidsim.server.wire import RecordingWire
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.event_log import LogEntry
from rapidsim.simulation.live.states import Motors

RESTART_S: Final = 1.0
"""Real time [s] for which a restarting controller cannot be reached, unless a fault says more."""
_LAG_S: Final = 0.5
"""Lag [s] of virtual time behind the wall clock that is reported first; then each doubling is."""


class RunObserver(Protocol):
    """Observer that shows the run while it executes; see `recorder.LiveRecorder`."""

    def update(self) -> None:
        """Show all changes."""
        ...

    def on_request(self, now_s: float, request: Request, reply: Reply) -> None:
        """Handle a request of a client and its reply."""
        ...

    def on_event(self, event: Event) -> None:
        """Handle an event of the run."""
        ...

    def on_log_entry(self, entry: LogEntry) -> None:
        """Handle a new entry of the event log."""
        ...

    def on_sensor_answer(self, time_s: float, answer: SensorAnswer) -> None:
        """Handle the answer of a sensor."""
        ...

    def close(self) -> None:
        """Handle the end of the controller."""
        ...


class Pace(Protocol):
    """Limit on the advance of virtual time."""

    def begin(self) -> None:
        """Start at the switch-on of the controller."""
        ...

    def horizon_s(self) -> float:
        """Return the virtual time that may be reached now [s]."""
        ...

    def wait_s(self, virtual_s: float) -> float | None:
        """Return the wall-clock time [s] until a virtual time may be reached; None for never."""
        ...

    def on_request(self) -> None:
        """Handle the arrival of a request."""
        ...

    def lag_s(self, now_s: float) -> float:
        """Return the lag [s] of virtual time behind the wall clock."""
        ...


@dataclass(slots=True)
class WallPace:
    """Pace with a fixed number of virtual seconds in each second of the wall clock."""

    speed: float
    began_s: float = 0.0
    """Start time on the wall clock [s]."""

    def begin(self) -> None:
        """Start the wall clock now."""
        self.began_s = monotonic()

    def horizon_s(self) -> float:
        """Return the time of the wall clock."""
        return (monotonic() - self.began_s) * self.speed

    def wait_s(self, virtual_s: float) -> float | None:
        """Return the time until the wall clock reaches a virtual time."""
        if math.isinf(virtual_s):
            return None
        return max(0.0, self.began_s + virtual_s / self.speed - monotonic())

    def on_request(self) -> None:
        """Do nothing: time passes without requests."""

    def lag_s(self, now_s: float) -> float:
        """Return the lag behind the wall clock."""
        return max(0.0, self.horizon_s() - now_s) / self.speed


@dataclass(slots=True)
class FullPace:
    """Pace that is limited only by the computer while there are events."""

    _began_s: float = 0.0
    """Start time [s] on a wall clock that is paused while there are no events."""
    _idle_since_s: float | None = None

    def begin(self) -> None:
        """Start the wall clock now."""
        self._began_s = monotonic()

    def horizon_s(self) -> float:
        """Return infinity."""
        if self._idle_since_s is not None:
            self._began_s += monotonic() - self._idle_since_s
            self._idle_since_s = None
        return math.inf

    def wait_s(self, virtual_s: float) -> float | None:
        """Return 0; None if no further event is possible."""
        if virtual_s < math.inf:
            return 0.0
        self._idle_since_s = monotonic()
        return None

    def on_request(self) -> None:
        """Do nothing: time passes without requests."""

    def lag_s(self, now_s: float) -> float:
        """Return the lag behind the wall clock: the computer is slower than a controller."""
        return max(0.0, monotonic() - self._began_s - now_s)


@dataclass(slots=True)
class LockStep:
    """Pace that advances with requests only: a client's script always gives the same run."""

    request_s: float
    """Virtual time that passes before each request [s]."""
    answered_s: float = 0.0
    """Virtual time granted by the answers of sensors [s]."""
    _requests: int = 0

    def begin(self) -> None:
        """Do nothing: no time is measured."""

    def horizon_s(self) -> float:
        """Return the virtual time that the requests so far have granted."""
        return self._requests * self.request_s + self.answered_s

    def wait_s(self, virtual_s: float) -> float | None:
        """Return 0 if the time is granted; else None, until the next request."""
        return 0.0 if virtual_s <= self.horizon_s() else None

    def on_request(self) -> None:
        """Grant the virtual time of one request."""
        self._requests += 1

    def lag_s(self, now_s: float) -> float:
        """Return 0: there is no wall clock."""
        del now_s
        return 0.0


@dataclass(eq=False)
class Engine:
    """A controller, its pace, and its listeners."""

    live: LiveController
    pace: Pace
    notify: Callable[[Notification], None]
    """Receives changes that clients have subscribed to, and lines for the console."""
    journal: Callable[[str], None] | None = None
    """Receives each line of the journal; None if none is kept."""
    versions: Mapping[int, ServedVersion] = field(default_factory=lambda: served_versions(None))
    """Version of RobotWare that each generation of Robot Web Services reports."""
    recorder: RunObserver | None = field(init=False, default=None)
    """Observer that shows the run; None if nothing is recorded."""
    context: RequestContext = field(init=False)
    subscriptions: Subscriptions = field(init=False)
    _inputs: NetworkInputs = field(init=False)
    _lag_reported_s: float = _LAG_S
    _deferred_lines: list[str] | None = None
    """Journal lines of a request's effects, which follow its own line."""

    def __post_init__(self) -> None:
        """Switch the controller on."""
        self.context = RequestContext(self.live, self.versions)
        is_paced = not isinstance(self.pace, LockStep)
        self.subscriptions = Subscriptions(self.context, self.notify, is_paced)
        self._inputs = NetworkInputs(self.live)
        self.live.faults.changed = self._faults_changed
        self.live.faults.restarted = self._restarted
        self.live.on_log_entry = self._logged
        self.live.on_finding = self._print_finding
        major = self.versions[2].robotware.major
        motors, mode = Motors(self.live.panel.state), self.live.panel.mode
        self._note(lambda: switched_on_line(motors, mode, major))
        if self.journal is not None:
            self._listen()
            if isinstance(self.live.wire, RecordingWire):
                self.live.wire.refused = lambda act, error: self._note(
                    lambda: refusal_line(self.live.now_s, act, error)
                )
        self.pace.begin()

    def record(self, recorder: RunObserver) -> None:
        """Record the run from now on."""
        self.recorder = recorder
        self._listen()

    def switch_off(self) -> None:
        """Stop the robots, close files and connections, and end the journal."""
        self.live.switch_off()
        self._note(lambda: switched_off_line(self.live.now_s))
        if self.recorder is not None:
            self.recorder.close()

    def step(self) -> bool:
        """Dispatch one event that is due; return whether there was one."""
        horizon_s = min(self.pace.horizon_s(), self.subscriptions.next_due_s)
        stepped = self.live.step(horizon_s)
        self._publish_changes(has_changed=stepped)
        if stepped:
            self._report_lag()
        return stepped

    def skip(self, time_s: float) -> None:
        """Do not catch up with a wall-clock time [s] in which a debugger has held the programs."""
        if isinstance(self.pace, WallPace):
            self.pace.began_s += time_s

    def wait_s(self) -> float | None:
        """Return the wall-clock time [s] until the next event; None for indefinitely."""
        return self.pace.wait_s(min(self.live.next_due_s, self.subscriptions.next_due_s))

    def reply(self, message: Inquiry) -> Reply:
        """Answer a message at the current virtual time."""
        if isinstance(message, ReadState):
            return self._replied(message)
        if isinstance(message, Upload):
            with message.opened() as request:
                return self.reply(request)
        if isinstance(message, Request):
            self.pace.on_request()
        self._catch_up()
        now_s, self._deferred_lines = self.live.now_s, []
        reply = self._replied(message)
        held, self._deferred_lines = self._deferred_lines, None
        self._note(lambda: request_line(now_s, message, reply))
        for line in held:
            self._note(lambda line=line: line)  # type: ignore[misc]
        if self.recorder is not None and isinstance(message, Request):
            self.recorder.on_request(now_s, message, reply)
        self._publish_changes()
        return reply

    def sensor_answered(self, passed_s: float) -> None:
        """Handle the answer of a sensor, which in lock-step grants a little time [s]."""
        if isinstance(self.pace, LockStep):
            self.pace.answered_s += passed_s
            self.live.advance(self.pace.horizon_s())
            self._publish_changes()

    def _replied(self, message: Message | ReadState) -> Reply:
        try:
            return self._done(message)
        except RefusedRequest as refused:
            is_later = isinstance(message, Request) and message.generation == 2
            refusal = refused.later if is_later else refused.refusal
            return replace(refusal, message=self.context.without_paths(refusal.message))
        except Exception as error:
            # A defect of rapidsim ends a request, not the controller.
            defect = f"rapidsim has a defect: {type(error).__name__}: {error}"
            self.notify(
                ConsoleLine(f"error: {defect}; please report it with the request, {message!r}")
            )
            return ErrorAnswer(500, -1, self.context.without_paths(defect))

    def _done(self, message: Message | ReadState) -> Reply:
        match message:
            case ReadState():
                return looked(self.context, message)
            case Request():
                return answered(self.context, message)
            case SessionEnded(session):
                self.context.release_all(session)
            case Subscribe():
                self.subscriptions.begin(message)
            case Unsubscribe(group):
                self.subscriptions.end(group)
            case FromNetwork():
                self._inputs.receive(message)
            case BeginFault(values):
                begin_fault(self.live, values)
            case EndFaults():
                self.live.faults.end_all()
                self.live.settle()
        return DONE

    def _faults_changed(self) -> None:
        """Let connections fail, or no longer."""
        faults = self.live.faults
        self._inputs.faults_changed()
        self.live.sensors.fail(faults.of(Channel.EGM))
        for_clients = faults.of(Channel.HTTP) + faults.of(Channel.WEBSOCKET)
        self.notify(ConnectionFaults(for_clients))

    def _restarted(self, fault: Fault) -> None:
        self.notify(Restarted(fault.for_s or RESTART_S))

    def _catch_up(self) -> None:
        """Advance to the time at which a request takes effect.

        In lock-step all events due before it are dispatched. Otherwise requests do not wait for a
        controller that lags behind its pace: they take effect at the virtual time reached. All
        events due by then are dispatched, so that the time in the journal determines their order.
        """
        horizon_s = self.pace.horizon_s()
        if isinstance(self.pace, LockStep):
            self.live.advance(horizon_s)
        else:
            self.live.step(horizon_s)
            self.live.settle()

    def _note(self, line: Callable[[], str]) -> None:
        if self.journal is None:
            return
        if self._deferred_lines is None:
            self.journal(line())
        else:
            self._deferred_lines.append(line())

    def _publish_changes(self, *, has_changed: bool = True) -> None:
        """Notify subscriptions and the recorder of changes."""
        self.subscriptions.publish_changes(has_changed=has_changed)
        if self.recorder is not None:
            self.recorder.update()

    def _listen(self) -> None:
        """Listen to events of the run, which has a small cost."""
        self.live.happened = self._happened
        if isinstance(self.live.sensors, RecordingSensors):
            self.live.sensors.answered = self._answered

    def _happened(self, event: Event) -> None:
        self._note(lambda: event_line(event))
        if self.recorder is not None:
            self.recorder.on_event(event)

    def _answered(self, number: int, time_s: float, answer: SensorAnswer) -> None:
        self._note(lambda: sensor_line(time_s, number, answer))
        if self.recorder is not None:
            self.recorder.on_sensor_answer(time_s, answer)

    def _logged(self, entry: LogEntry) -> None:
        self._note(lambda: log_line(entry))
        if self.recorder is not None:
            self.recorder.on_log_entry(entry)
        self.subscriptions.logged(entry)
        if entry.type > 1:
            kind = "error" if entry.type == 3 else "warning"
            self.notify(ConsoleLine(f"{kind}: {entry.time_s:.3f} s: {entry.title}: {entry.text}"))

    def _print_finding(self, finding: Diagnostic) -> None:
        if finding.severity is not Severity.NOTE:
            where = f" ({finding.file}, line {finding.line})" if finding.file else ""
            time = f"{self.live.now_s:.3f} s"
            self.notify(ConsoleLine(f"warning: {time}: {finding.message}{where} [{finding.code}]"))

    def _report_lag(self) -> None:
        lag_s = self.pace.lag_s(self.live.now_s)
        if lag_s > self._lag_reported_s:
            self._lag_reported_s = 2.0 * lag_s
            pace = "real time" if isinstance(self.pace, FullPace) else "its pace"
            self.notify(ConsoleLine(f"note: virtual time is {lag_s:.1f} s behind {pace}"))
