"""Sensors behind a guide process, for the controller: answers at its own cycles."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Final

from rapidsim.controller.cell.faults import LastingFault
from rapidsim.controller.cell.sensors import FeedbackSchedule
from rapidsim.egm.devices import SensorDevices
from rapidsim.egm.sensor_loop import (
    CloseSensor,
    EndGuidance,
    FailSensors,
    OpenSensor,
    Order,
    SendData,
    SensorReply,
    StartCorrection,
    StartGuidance,
    StopGuidance,
    StreamFeedback,
)
from rapidsim.motion.guidance.feedback import NO_DATA, Feedback, ProgramData
from rapidsim.motion.guidance.guided_execution import GuidedExecution
from rapidsim.motion.guidance.sensor import SensorAnswer

_PATIENCE_S: Final = 2.0
"""Time [s] for which the controller waits for the guide; later answers count as missing."""


@dataclass(slots=True, eq=False)
class GuidedSensors:
    """Implements `sensors.GuidanceSensors` over the pipe to a guide."""

    devices: SensorDevices
    connection: Connection
    speed: float
    """Virtual seconds per second of the wall clock."""
    began_s: float = 0.0
    """Start of virtual time [s] on the wall clock."""
    _replies: dict[int, list[SensorReply]] = field(default_factory=dict)
    _last: int = 0

    def open(self, device: str) -> GuidedSensor:
        """See `GuidanceSensors`."""
        address = self.devices.address(device)
        self._last += 1
        self._replies[self._last] = []
        self.send(self._last, OpenSensor(address, self.began_s, self.speed, self.devices.any_port))
        return GuidedSensor(self, self._last)

    def fail(self, faults: tuple[LastingFault, ...]) -> None:
        """See `GuidanceSensors`."""
        self.send(0, FailSensors(faults))

    def close(self) -> None:
        """See `GuidanceSensors`."""

    def send(self, number: int, order: Order) -> None:
        """Send an order to the guide; without effect if it has ended."""
        with suppress(OSError):
            self.connection.send((number, order))

    def next(self, number: int, guidance: int, sample: int) -> SensorAnswer | None:
        """Answer of a sensor up to a sample of a guidance; None if there is no answer."""
        while True:
            known = self._replies[number]
            while known and (known[0].guidance, known[0].sample) < (guidance, sample):
                known.pop(0)
            if known and (known[0].guidance, known[0].sample) == (guidance, sample):
                return known.pop(0).answer
            with suppress(EOFError, OSError):
                if self.connection.poll(_PATIENCE_S):
                    heard: SensorReply = self.connection.recv()
                    self._replies.setdefault(heard.sensor, []).append(heard)
                    continue
            return None

    def forget(self, number: int) -> None:
        """Disconnect from a sensor."""
        self.send(number, CloseSensor())
        self._replies.pop(number, None)


@dataclass(slots=True, eq=False)
class GuidedSensor:
    """Implements `sensors.GuidanceSensor`."""

    all: GuidedSensors
    number: int
    has_lookahead: bool = True
    _guidance: int = 0
    _samples: int = 0
    _correcting: StartCorrection | None = None
    _sent: ProgramData = NO_DATA
    """Data of the program that the guide sends."""

    def begin(self, run: GuidedExecution, feedback: FeedbackSchedule) -> None:
        """Start the guidance in the guide, too."""
        self._guidance, self._samples = self._guidance + 1, 0
        self._correcting, self._sent = None, feedback.sent
        self.all.send(self.number, StartGuidance(self._guidance, run, feedback))

    def correct(self, first_s: float, sample_s: float) -> None:
        """Let the guide report the sensor's answers to the streamed feedback."""
        self._guidance += 1
        self._correcting = StartCorrection(self._guidance, first_s, sample_s)
        self.all.send(self.number, self._correcting)

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """The answer up to this sample; the guide has already sent the feedback."""
        self._send_data(feedback.sent)
        sample, self._samples = self._samples, self._samples + 1
        if (one := self._correcting) is not None:
            sample = one.sample_at(feedback.time_s)
        return self.all.next(self.number, self._guidance, sample)

    def stop(self, *, moves_back: bool, ramp_out_s: float) -> None:
        """Stop the guidance in the guide, too."""
        self.all.send(self.number, StopGuidance(moves_back, ramp_out_s))

    def end(self, feedback: Feedback) -> None:
        """Let the guide send a last message."""
        self.all.send(self.number, EndGuidance(feedback))

    def stream(self, stream: Sequence[Feedback]) -> None:
        """Let the guide send each message when it is due."""
        self._send_data(stream[-1].sent if stream else self._sent)
        self.all.send(self.number, StreamFeedback(tuple(stream)))

    def close(self) -> None:
        """See `GuidanceSensor`."""
        self.all.forget(self.number)

    def _send_data(self, sent: ProgramData) -> None:
        if sent != self._sent:
            self._sent = sent
            self.all.send(self.number, SendData(sent))
