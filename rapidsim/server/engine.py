"""The engine: a controller that stays on, how its time passes, and the requests it serves.

It runs in a process of its own, because planning a path keeps Python busy for longer than a
protocol may wait; tests drive it by hand.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from time import monotonic
from typing import Final, Protocol

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
    DATAGRAM,
    DONE,
    ConsoleLine,
    ErrorAnswer,
    FromNetwork,
    Inquiry,
    Notification,
    ReadState,
    RefusedRequest,
    Reply,
    Request,
    SessionEnded,
    Subscribe,
    Unsubscribe,
)
from rapidsim.server.resources.context import RequestContext
from rapidsim.server.resources.operator_view import looked
from rapidsim.server.resources.table import answered
from rapidsim.server.sensors import RecordingSensors
from rapidsim.server.subscriptions import Subscriptions
from rapidsim.server.wire import RecordingWire
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.event_log import LogEntry

_LAG_S: Final = 0.5
"""How far [s] virtual time may lag behind the wall clock before it is reported, then twice that."""


class RunObserver(Protocol):
    """Shows what happens while it does; see `recorder.LiveRecorder`."""

    def update(self) -> None:
        """Show what has changed."""
        ...

    def on_request(self, now_s: float, request: Request, reply: Reply) -> None:
        """A client has asked for something."""
        ...

    def on_event(self, event: Event) -> None:
        """Something has happened in the run."""
        ...

    def on_log_entry(self, entry: LogEntry) -> None:
        """The event log has one more entry."""
        ...

    def on_sensor_answer(self, time_s: float, answer: SensorAnswer) -> None:
        """A sensor has answered."""
        ...

    def close(self) -> None:
        """The controller is switched off."""
        ...


class Pace(Protocol):
    """Decides how far virtual time may advance."""

    def begin(self) -> None:
        """The controller is switched on."""
        ...

    def horizon_s(self) -> float:
        """The virtual time that may be reached now [s]."""
        ...

    def wait_s(self, virtual_s: float) -> float | None:
        """How long on the wall clock until that virtual time may be reached [s]; None for ever."""
        ...

    def on_request(self) -> None:
        """A request has come."""
        ...

    def lag_s(self, now_s: float) -> float:
        """How far virtual time lags behind the wall clock [s]."""
        ...


@dataclass(slots=True)
class WallPace:
    """A fixed number of virtual seconds passes in each second of the wall clock."""

    speed: float
    began_s: float = 0.0
    """When it started, on the wall clock [s]."""

    def begin(self) -> None:
        """Start the wall clock now."""
        self.began_s = monotonic()

    def horizon_s(self) -> float:
        """The time of the wall clock."""
        return (monotonic() - self.began_s) * self.speed

    def wait_s(self, virtual_s: float) -> float | None:
        """Until the wall clock gets there."""
        if math.isinf(virtual_s):
            return None
        return max(0.0, self.began_s + virtual_s / self.speed - monotonic())

    def on_request(self) -> None:
        """Time passes by itself."""

    def lag_s(self, now_s: float) -> float:
        """Behind the wall clock."""
        return max(0.0, self.horizon_s() - now_s) / self.speed


@dataclass(slots=True)
class FullPace:
    """Virtual time passes as fast as the computer allows while there is anything to do."""

    _began_s: float = 0.0
    """When it started, on a wall clock that stands while there is nothing to do [s]."""
    _idle_since_s: float | None = None

    def begin(self) -> None:
        """Start the wall clock now."""
        self._began_s = monotonic()

    def horizon_s(self) -> float:
        """Without limit."""
        if self._idle_since_s is not None:
            self._began_s += monotonic() - self._idle_since_s
            self._idle_since_s = None
        return math.inf

    def wait_s(self, virtual_s: float) -> float | None:
        """No time; for ever if nothing more can happen."""
        if virtual_s < math.inf:
            return 0.0
        self._idle_since_s = monotonic()
        return None

    def on_request(self) -> None:
        """Time passes by itself."""

    def lag_s(self, now_s: float) -> float:
        """Behind the wall clock: the computer is slower than the controller would be."""
        return max(0.0, monotonic() - self._began_s - now_s)


@dataclass(slots=True)
class LockStep:
    """Virtual time passes only with requests, so a client's script always gives the same run."""

    request_s: float
    """Virtual time that passes before each request [s]."""
    answered_s: float = 0.0
    """Virtual time that answers of sensors have let pass [s]."""
    _requests: int = 0

    def begin(self) -> None:
        """Nothing is measured."""

    def horizon_s(self) -> float:
        """What the requests so far have allowed."""
        return self._requests * self.request_s + self.answered_s

    def wait_s(self, virtual_s: float) -> float | None:
        """Until the next request."""
        return 0.0 if virtual_s <= self.horizon_s() else None

    def on_request(self) -> None:
        """Let a little time pass."""
        self._requests += 1

    def lag_s(self, now_s: float) -> float:
        """There is nothing to be behind."""
        del now_s
        return 0.0


@dataclass(eq=False)
class Engine:
    """A controller, its pace, and its listeners."""

    live: LiveController
    pace: Pace
    notify: Callable[[Notification], None]
    """Receives what clients have subscribed to, and lines for whoever started the controller."""
    journal: Callable[[str], None] | None = None
    """Receives each line of the journal; None if none is kept."""
    recorder: RunObserver | None = field(init=False, default=None)
    """Shows what happens; None if nothing is recorded."""
    context: RequestContext = field(init=False)
    subscriptions: Subscriptions = field(init=False)
    _lag_reported_s: float = _LAG_S
    _deferred_lines: list[str] | None = None
    """Lines of a request's effects, which come after its own line."""

    def __post_init__(self) -> None:
        """Switch on."""
        self.context = RequestContext(self.live)
        self.subscriptions = Subscriptions(self.context, self.notify)
        self.live.on_log_entry = self._logged
        self.live.on_finding = self._print_finding
        self._note(lambda: switched_on_line(self.live.motors, self.live.mode))
        if self.journal is not None:
            self._listen()
            if isinstance(self.live.wire, RecordingWire):
                self.live.wire.refused = lambda act, error: self._note(
                    lambda: refusal_line(self.live.now_s, act, error)
                )
        self.pace.begin()

    def record(self, recorder: RunObserver) -> None:
        """Record what happens from now on."""
        self.recorder = recorder
        self._listen()

    def switch_off(self) -> None:
        """Stop the robots, close files and connections, and end the journal."""
        self.live.switch_off()
        self._note(lambda: switched_off_line(self.live.now_s))
        if self.recorder is not None:
            self.recorder.close()

    def step(self) -> bool:
        """Do one thing that is due; returns whether there was any."""
        stepped = self.live.step(self.pace.horizon_s())
        self._publish_changes()
        if stepped:
            self._report_lag()
        return stepped

    def wait_s(self) -> float | None:
        """How long on the wall clock nothing will happen by itself [s]; None for ever."""
        return self.pace.wait_s(self.live.next_due_s)

    def reply(self, message: Inquiry) -> Reply:
        """Answer a message at the present virtual time."""
        if isinstance(message, ReadState):
            return self._replied(message)
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
        """A sensor has answered, which in lock-step lets a little time pass [s]."""
        if isinstance(self.pace, LockStep):
            self.pace.answered_s += passed_s
            self.live.advance(self.pace.horizon_s())
            self._publish_changes()

    def _replied(self, message: Inquiry) -> Reply:
        try:
            return self._done(message)
        except RefusedRequest as refused:
            is_later = isinstance(message, Request) and message.generation == 2
            return refused.later if is_later else refused.refusal
        except Exception as error:
            # A defect of rapidsim ends a request, not the controller.
            defect = f"rapidsim has a defect: {type(error).__name__}: {error}"
            self.notify(
                ConsoleLine(f"error: {defect}; please report it with the request, {message!r}")
            )
            return ErrorAnswer(500, -1, defect)

    def _done(self, message: Inquiry) -> Reply:
        match message:
            case ReadState():
                return looked(self.context, message)
            case Request():
                return answered(self.context, message)
            case SessionEnded(session):
                self.context.release_all(session)
            case Subscribe(group, resources):
                self.subscriptions.begin(group, resources)
            case Unsubscribe(group):
                self.subscriptions.end(group)
            case FromNetwork(number, port, peer, data, is_over):
                outside, now_s = self.live.external_streams, self.live.now_s
                if number == DATAGRAM:
                    self.live.mailboxes.arrived(port, peer, data)
                    self.live.wake_programs()
                    return DONE
                if peer:
                    outside.came(number, port, peer, now_s)
                if data:
                    outside.arrived(number, data, now_s)
                if is_over:
                    outside.ended(number, now_s)
                self.live.wake_programs()
        return DONE

    def _catch_up(self) -> None:
        """Let the present be the time at which a request takes effect.

        In lock-step everything happens that is due before it. Else nobody waits for a controller
        that is behind its pace: the present is how far it has come. All that is due by then has
        happened, so that the time in the journal says what a request came after.
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

    def _publish_changes(self) -> None:
        """Let subscriptions and the recording see what has changed."""
        self.subscriptions.publish_changes()
        if self.recorder is not None:
            self.recorder.update()

    def _listen(self) -> None:
        """Listen to what happens in the run, which has a small cost."""
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
