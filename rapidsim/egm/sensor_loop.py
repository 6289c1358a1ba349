"""The guide: a process that communicates with sensors on time, even if the controller is busy.

It runs the same guidance as the controller, in parallel and ahead of it, so that messages to a
sensor are never late. The sensor's answer at each sample is sent to the controller, which moves its
robot by these answers alone.
"""

from __future__ import annotations

import gc
import math
import select
import signal
from contextlib import suppress
from dataclasses import field, replace
from multiprocessing.connection import Connection, wait
from queue import SimpleQueue
from threading import Thread
from time import monotonic
from typing import Final, TypeAlias

from rapidsim.controller.cell.faults import LastingFault
from rapidsim.controller.cell.sensors import FeedbackSchedule
from rapidsim.egm.devices import Address
from rapidsim.egm.udp import Ports, SensorSocket
from rapidsim.motion.guidance.feedback import NO_DATA, Feedback, ProgramData
from rapidsim.motion.guidance.guided_execution import GuidedExecution
from rapidsim.motion.guidance.joint_law import CYCLE_S
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.values import value_class

_MOST_LATE: Final = 25
"""Maximum number of cycles that are caught up; after a longer delay all cycles are shifted."""
_ROUNDING_S: Final = 1e-6
_HOLDS_S: Final = 0.5
"""Time [s] on the wall clock for which a stream continues without data of the controller."""


@value_class(frozen=True, slots=True)
class OpenSensor:
    """Order to connect to a sensor."""

    address: Address
    began_s: float
    """Start of virtual time [s] on the wall clock, which all processes share."""
    speed: float
    """Virtual seconds per second of the wall clock."""
    any_port: bool = False
    """Whether the sensor may answer from any port of its computer."""


@value_class(frozen=True, slots=True)
class StartGuidance:
    """Order to begin a guidance."""

    number: int
    run: GuidedExecution
    schedule: FeedbackSchedule


@value_class(frozen=True, slots=True)
class StartCorrection:
    """Order to report the answers to the streamed feedback: those that correct a path or stream."""

    number: int
    first_s: float
    """Time of the first sample [s]."""
    sample_s: float

    def sample_at(self, time_s: float) -> int:
        """The sample number at a time [s]; guide and controller count alike."""
        return round((time_s - self.first_s) / self.sample_s)


@value_class(frozen=True, slots=True)
class StopGuidance:
    """Order of the program to end the guidance."""

    moves_back: bool
    ramp_out_s: float


@value_class(frozen=True, slots=True)
class EndGuidance:
    """Order to end the guidance with a last message."""

    feedback: Feedback


@value_class(frozen=True, slots=True)
class StreamFeedback:
    """Order to stream the robot's future positions."""

    stream: tuple[Feedback, ...]


@value_class(frozen=True, slots=True)
class SendData:
    """Order to send data of the program with all further feedback."""

    sent: ProgramData


@value_class(frozen=True, slots=True)
class CloseSensor:
    """Order to disconnect from a sensor."""


@value_class(frozen=True, slots=True)
class FailSensors:
    """Order to let the datagrams of all sensors fail."""

    faults: tuple[LastingFault, ...]


Order: TypeAlias = (
    OpenSensor
    | StartGuidance
    | StartCorrection
    | StopGuidance
    | EndGuidance
    | StreamFeedback
    | SendData
    | CloseSensor
    | FailSensors
)


@value_class(frozen=True, slots=True)
class SensorReply:
    """Answer of a sensor up to a sample of a guidance; None without an answer."""

    sensor: int
    guidance: int
    sample: int
    answer: SensorAnswer | None


@value_class(slots=True, eq=False)
class _Guidance:
    """A guidance in progress in this process."""

    number: int
    run: GuidedExecution
    schedule: FeedbackSchedule
    cycles: int = 0
    late_s: float = 0.0
    """Delay [s] of its cycles on the wall clock."""


@value_class(slots=True, eq=False)
class _SensorSession:
    """Communication with one sensor."""

    number: int
    opened: OpenSensor
    socket: SensorSocket
    guidance: _Guidance | None = None
    correcting: StartCorrection | None = None
    stream: list[Feedback] = field(default_factory=list)
    """Feedback to be sent, by time."""
    last: Feedback | None = None
    """Feedback that was sent last; None before."""
    held_s: float = 0.0
    """Time [s] for which the last feedback has been repeated."""
    sample_s: float = math.inf
    sent: ProgramData = NO_DATA
    """Data of the program for the sensor."""

    def due_s(self) -> float:
        """Time [s] of the next action on the wall clock; infinite if none is due."""
        if (guidance := self.guidance) is not None:
            virtual_s = guidance.schedule.first_s + guidance.cycles * CYCLE_S
            return self._wall_s(virtual_s) + guidance.late_s
        if self.stream:
            return self._wall_s(self.stream[0].time_s)
        if self.last is None or self.held_s > _HOLDS_S:
            return math.inf
        return self._wall_s(self.last.time_s + self.sample_s)

    def act(self, now_s: float) -> SensorReply | None:
        """Carry out the action that is due [s]; return the reply for the controller, if any."""
        guidance = self.guidance
        if guidance is None:
            return self._send_feedback()
        behind_s = now_s - self.due_s()
        if behind_s > _MOST_LATE * CYCLE_S / self.opened.speed:
            guidance.late_s += behind_s
        self.socket.receive()
        heard, answer = None, None
        if guidance.cycles % guidance.schedule.samples == 0:
            answer = self.socket.take()
            sample = guidance.cycles // guidance.schedule.samples
            heard = SensorReply(self.number, guidance.number, sample, answer)
            if not guidance.run.is_over:
                time_s = guidance.schedule.first_s + guidance.cycles * CYCLE_S
                self._send(guidance.schedule.feedback(guidance.run, time_s))
        guidance.run.step(answer)
        guidance.cycles += 1
        return heard

    def follow(self, order: Order) -> None:
        """Carry out an order of the controller."""
        match order:
            case StartGuidance(number, run, told):
                self.socket.begin()
                self.stream.clear()
                self.guidance, self.last = _Guidance(number, run, told), None
                self.sent = told.sent
                behind_s = monotonic() - self.due_s()
                self.guidance.late_s = max(0.0, behind_s)
            case StartCorrection():
                self.socket.begin()
                self.stream.clear()
                self.correcting, self.last, self.held_s = order, None, 0.0
            case StopGuidance(goes_back, ramp_out_s) if self.guidance is not None:
                self.guidance.run.stop(moves_back=goes_back, ramp_out_s=ramp_out_s)
            case EndGuidance(feedback):
                if self.correcting is not None:
                    self.stream.clear()
                    if self.last is not None:
                        # The sensor got feedback on time, even if the controller was behind.
                        after_s = max(feedback.time_s, self.last.time_s)
                        feedback = replace(feedback, time_s=after_s)
                self.guidance = self.correcting = self.last = None
                self._send(feedback)
            case StreamFeedback(stream):
                after_s = -math.inf if self.last is None else self.last.time_s
                fresh = [one for one in stream if one.time_s > after_s + _ROUNDING_S]
                if fresh:
                    self.stream = [one for one in self.stream if one.time_s < fresh[0].time_s]
                    self.stream += fresh
                self.held_s = 0.0
            case SendData(sent):
                self.sent = sent
            case _:
                pass

    def _send(self, feedback: Feedback) -> None:
        self.socket.send(replace(feedback, sent=self.sent))

    def _send_feedback(self) -> SensorReply | None:
        """Send the next feedback of the stream; return the sensor's answer if it is needed."""
        answer, one = None, self.correcting
        self.socket.receive()
        if one is not None:
            answer = self.socket.take()
        if self.stream:
            told = self.stream.pop(0)
            if self.last is not None:
                self.sample_s = told.time_s - self.last.time_s
        else:
            assert self.last is not None
            told = replace(self.last, time_s=self.last.time_s + self.sample_s)
            self.held_s += self.sample_s / self.opened.speed
        self.last = told
        self._send(told)
        if one is None:
            return None
        return SensorReply(self.number, one.number, one.sample_at(told.time_s), answer)

    def _wall_s(self, virtual_s: float) -> float:
        return self.opened.began_s + virtual_s / self.opened.speed


def run_sensor_loop(connection: Connection) -> None:
    """The main function of the guide process; see `serve_sensors`."""
    # Ctrl-C goes to all processes of a terminal; the guide ends with its controller.
    for name in ("SIGINT", "SIGTERM"):
        signal.signal(getattr(signal, name), signal.SIG_IGN)
    gc.freeze()
    serve_sensors(connection)


def serve_sensors(connection: Connection) -> None:
    """Communicate with sensors until the controller disconnects."""
    talks: dict[int, _SensorSession] = {}
    ports, told = Ports(), SimpleQueue[SensorReply]()
    # The pipe to a busy controller may fill up; sensors must not wait for that.
    Thread(target=_send, args=(connection, told), daemon=True).start()
    with suppress(EOFError, OSError):
        while True:
            _pass(connection, talks, ports, told)
    ports.close()


def _send(connection: Connection, replies: SimpleQueue[SensorReply]) -> None:
    with suppress(OSError):
        while True:
            connection.send(replies.get())


def _pass(
    connection: Connection,
    sessions: dict[int, _SensorSession],
    ports: Ports,
    replies: SimpleQueue[SensorReply],
) -> None:
    """Wait for the next action or order, and carry it out."""
    due_s = min((one.due_s() for one in sessions.values()), default=math.inf)
    if math.isinf(due_s):
        wait([connection])
    elif (left_s := due_s - monotonic()) > 0.0:
        # Waiting for pipes is not exact enough on all systems: the controller waits for a cycle.
        streams = [one.socket.stream for one in sessions.values()]
        select.select(streams, [], [], min(left_s, CYCLE_S))
        for one in sessions.values():
            one.socket.receive()
    while connection.poll():
        number, order = connection.recv()
        if isinstance(order, FailSensors):
            ports.faults.begin(order.faults)
        elif isinstance(order, OpenSensor):
            to = ports.to(order.address, any_port=order.any_port)
            sessions[number] = _SensorSession(number, order, to)
        elif number in sessions:
            sessions[number].follow(order)
            if isinstance(order, CloseSensor):
                sessions.pop(number).socket.host.end()
    for one in sessions.values():
        now_s = monotonic()
        if one.due_s() <= now_s:
            heard = one.act(now_s)
            if heard is not None:
                replies.put(heard)
