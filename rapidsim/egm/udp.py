"""Sensors over UDP: one socket per device, on which the controller sends first.

No incoming data can end a run: datagrams that are not sensor messages are dropped.
"""

from __future__ import annotations

import select
import socket
from collections.abc import Collection, Sequence
from contextlib import suppress
from dataclasses import InitVar, dataclass, field
from functools import partial
from time import monotonic
from typing import Final

from rapidsim.controller.cell.faults import LastingFault
from rapidsim.controller.cell.sensors import FeedbackSchedule, SilentSensor
from rapidsim.egm.codec import DecodeError
from rapidsim.egm.datagram_faults import DatagramFaults, DatagramLine
from rapidsim.egm.devices import Address, SensorDevices
from rapidsim.egm.frames import robot_datagram, sensor_answer
from rapidsim.egm.sensor_host import PATIENCE_S, SensorHost
from rapidsim.motion.guidance.feedback import Feedback
from rapidsim.motion.guidance.guided_execution import GuidedExecution
from rapidsim.motion.guidance.joint_law import CYCLE_S
from rapidsim.motion.guidance.sensor import SensorAnswer

_LARGEST: Final = 65536
_MOST_AT_ONCE: Final = 100
"""Maximum number of datagrams read in one go, so that a flood does not delay the robot."""


@dataclass(slots=True, eq=False)
class Ports:
    """The controller's local ports, one per sensor, kept as long as it is on.

    A sensor that remembers the previous program's address still reaches the same port.
    """

    faults: DatagramFaults = field(default_factory=DatagramFaults)
    patience_s: float | None = PATIENCE_S
    """Time [s] to wait for the address of a host; None for no limit."""
    _streams: dict[Address, socket.socket] = field(default_factory=dict)
    _hosts: dict[Address, SensorHost] = field(default_factory=dict)

    def to(self, address: Address, *, any_port: bool = False) -> SensorSocket:
        """Connect to a sensor, discarding what it sent to the previous program.

        Args:
            address: Of the sensor.
            any_port: Whether answers from any port of its computer count; otherwise only those
                from the port of the first one.
        """
        if address not in self._streams:
            stream = self._streams[address] = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            stream.setblocking(False)
            local = address.host in ("127.0.0.1", "localhost")
            stream.bind(("127.0.0.1" if local else "", 0))
        if address in self._hosts:
            self._hosts[address].end()
        # A host that has started again may have another address.
        host = self._hosts[address] = SensorHost(address)
        host.begin(self.patience_s)
        SensorSocket(host, self._streams[address], self.faults).receive()
        return SensorSocket(host, self._streams[address], self.faults, any_port)

    def close(self) -> None:
        """Close all ports."""
        for host in self._hosts.values():
            host.end()
        for stream in self._streams.values():
            stream.close()
        self._streams.clear()


@dataclass(slots=True, eq=False)
class SensorSocket:
    """Datagrams to and from one sensor."""

    host: SensorHost
    """Its address, with a numeric host as in incoming datagrams."""
    stream: socket.socket
    faults: InitVar[DatagramFaults]
    any_port: bool = False
    """Whether answers from any port of the host count."""
    dropped: int = 0
    """Number of datagrams that were not messages, or came from another host or port."""
    _port: int | None = None
    """Port of the first answer, which the sensor keeps; None before."""
    _number: int = 0
    _answer: SensorAnswer | None = None
    _has_guided: bool = False
    _time_s: float = 0.0
    """Time [s] of the last feedback."""
    _out: DatagramLine[bytes] = field(init=False)
    _in: DatagramLine[SensorAnswer] = field(init=False)

    def __post_init__(self, faults: DatagramFaults) -> None:
        """Connect both directions with the faults."""
        self._out = DatagramLine(faults, is_outgoing=True)
        self._in = DatagramLine(faults, is_outgoing=False)

    def send(self, feedback: Feedback) -> None:
        """Send the robot's position to the sensor; delivery is not confirmed."""
        self._time_s = feedback.time_s
        data = robot_datagram(self._number, feedback)
        to = self.host.numeric
        for one in self._out.passed(data, self._time_s):
            if to is not None:
                with suppress(OSError):
                    self.stream.sendto(one, to)
        self._number += 1

    def receive(self) -> int:
        """Read the datagrams that have arrived; return the number of answers."""
        answers = 0
        for _ in range(_MOST_AT_ONCE):
            try:
                data, sender = self.stream.recvfrom(_LARGEST)
            except BlockingIOError:
                break
            except OSError:
                # Some systems report here that the last message was not received.
                continue
            known = self.host.numeric
            if known is None or sender[0] != known.host or self._port not in (None, sender[1]):
                # Nobody else may guide the robot.
                self.dropped += 1
                continue
            try:
                answer = sensor_answer(data)
            except DecodeError:
                self.dropped += 1
                continue
            if not self.any_port:
                self._port = sender[1]
            answers += 1
            self._keep(answer)
        self._keep(None)
        return answers

    def _keep(self, answer: SensorAnswer | None) -> None:
        """Keep the last answer that passes, of a new one and of those that are delayed."""
        for one in self._in.passed(answer, self._time_s):
            self._answer = one

    def take(self) -> SensorAnswer | None:
        """The last answer, returned once."""
        answer, self._answer = self._answer, None
        return answer

    def begin(self) -> None:
        """Begin a guidance; the first keeps the last answer: a sensor may send its goal once.

        Later ones discard it: an answer since the last guidance may still belong to that one.
        """
        self.receive()
        if self._has_guided:
            self._answer = None
        self._has_guided = True


@dataclass(slots=True, eq=False)
class PacedSensor(SilentSensor):
    """A sensor whose cycles take real time; implements `sensors.GuidanceSensor`."""

    socket: SensorSocket
    waits_full: bool
    """Whether a cycle takes its full time, or ends with an answer."""
    _is_awaited: bool = True
    """Whether the sensor has answered the last message of a stream, so that the next may wait."""
    _sample_s: float = CYCLE_S
    _due_s: float = 0.0

    def begin(self, run: GuidedExecution, feedback: FeedbackSchedule) -> None:
        """Start timing now."""
        del run
        self.correct(feedback.first_s, feedback.samples * CYCLE_S)

    def correct(self, first_s: float, sample_s: float) -> None:
        """Start timing now."""
        del first_s
        self._sample_s, self._due_s = sample_s, monotonic()
        self.socket.begin()

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """Send a message and wait for the answer until the next one is due."""
        self._send(feedback)
        return self.socket.take()

    def _send(self, feedback: Feedback) -> bool:
        """Send a message and wait until the next one is due; return whether there is an answer."""
        answers = 0
        self.socket.send(feedback)
        self._due_s = max(self._due_s + self._sample_s, monotonic() - self._sample_s)
        while (left_s := self._due_s - monotonic()) > 0.0:
            ready, _, _ = select.select([self.socket.stream], [], [], left_s)
            if ready:
                answers += self.socket.receive()
                if answers and not self.waits_full:
                    break
        return bool(answers + self.socket.receive())

    def end(self, feedback: Feedback) -> None:
        """Send a last message."""
        self.socket.send(feedback)

    def stream(self, stream: Sequence[Feedback]) -> None:
        """Send each message at its wall-clock time; at once if nobody listens and none is kept."""
        for feedback in stream:
            if self.waits_full or self._is_awaited:
                self._is_awaited = self._send(feedback)
            else:
                self.socket.send(feedback)
                self._is_awaited = bool(self.socket.receive())


@dataclass(slots=True, eq=False)
class PacedSensors:
    """Implements `sensors.GuidanceSensors` for runs in real time."""

    devices: SensorDevices
    waits_full: bool = True
    _ports: Ports = field(default_factory=Ports)

    def fail(self, faults: tuple[LastingFault, ...]) -> None:
        """See `GuidanceSensors`."""
        self._ports.faults.begin(faults)

    def open(self, device: str) -> PacedSensor:
        """See `GuidanceSensors`."""
        address = self.devices.address(device)
        return PacedSensor(self._ports.to(address, any_port=self.devices.any_port), self.waits_full)

    def close(self) -> None:
        """See `GuidanceSensors`."""
        self._ports.close()


@dataclass(slots=True, eq=False)
class StepSensor(SilentSensor):
    """A sensor whose answers advance time; implements `sensors.GuidanceSensor`."""

    socket: SensorSocket
    sample_s: float = CYCLE_S
    is_open: bool = True

    def begin(self, run: GuidedExecution, feedback: FeedbackSchedule) -> None:
        """See `GuidanceSensor`."""
        del run
        self.correct(feedback.first_s, feedback.samples * CYCLE_S)

    def correct(self, first_s: float, sample_s: float) -> None:
        """See `GuidanceSensor`."""
        del first_s
        self.sample_s = sample_s
        self.socket.begin()

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """Send a message; return the answer to the previous one."""
        answer = self.socket.take()
        self.socket.send(feedback)
        return answer

    def end(self, feedback: Feedback) -> None:
        """Send a last message."""
        self.socket.send(feedback)

    def stream(self, stream: Sequence[Feedback]) -> None:
        """Send all messages."""
        for feedback in stream:
            self.socket.send(feedback)

    def close(self) -> None:
        """See `GuidanceSensor`."""
        self.is_open = False


@dataclass(slots=True, eq=False)
class StepSensors:
    """Implements `sensors.GuidanceSensors` in lock-step."""

    devices: SensorDevices
    _open: list[StepSensor] = field(default_factory=list)
    # Its answers advance time: the first message must not be lost.
    _ports: Ports = field(default_factory=partial(Ports, patience_s=None))

    def fail(self, faults: tuple[LastingFault, ...]) -> None:
        """See `GuidanceSensors`."""
        self._ports.faults.begin(faults)

    def open(self, device: str) -> StepSensor:
        """See `GuidanceSensors`."""
        address = self.devices.address(device)
        sensor = StepSensor(self._ports.to(address, any_port=self.devices.any_port))
        self._open.append(sensor)
        return sensor

    def close(self) -> None:
        """See `GuidanceSensors`."""
        self._open.clear()
        self._ports.close()

    def sockets(self) -> list[socket.socket]:
        """The sockets on which answers may arrive."""
        self._open = [one for one in self._open if one.is_open]
        return [one.socket.stream for one in self._open]

    def came(self, ready: Collection[object]) -> float:
        """Read arrived datagrams; return the time [s] by which they advance the run."""
        passed_s = 0.0
        for one in self._open:
            if one.socket.stream in ready and one.socket.receive():
                passed_s += one.sample_s
        return passed_s
