"""Sensors behind a guide process, as the controller sees them: answers at its own cycles."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from typing import Final

from rapidsim.controller.cell.sensors import Teller
from rapidsim.egm.devices import SensorDevices
from rapidsim.egm.guide import (
    Begun,
    Closed,
    Correcting,
    Heard,
    Opened,
    Order,
    Over,
    Stopping,
    Streamed,
)
from rapidsim.motion.guidance.feedback import Feedback
from rapidsim.motion.guidance.guided_run import GuidedRun
from rapidsim.motion.guidance.sensor import SensorAnswer

_PATIENCE_S: Final = 2.0
"""So long [s] the controller waits for the guide; what comes later counts as not said."""


@dataclass(slots=True, eq=False)
class GuidedSensors:
    """Implements `sensors.Sensors` over the pipe to a guide."""

    devices: SensorDevices
    connection: Connection
    speed: float
    """Virtual seconds in one on the wall."""
    began_s: float = 0.0
    """When virtual time began, on the wall's clock [s]."""
    _heard: dict[int, list[Heard]] = field(default_factory=dict)
    _last: int = 0

    def open(self, device: str) -> GuidedSensor:
        """See `Sensors`."""
        address = self.devices.address(device)
        self._last += 1
        self._heard[self._last] = []
        self.send(self._last, Opened(address, self.began_s, self.speed))
        return GuidedSensor(self, self._last)

    def close(self) -> None:
        """See `Sensors`."""

    def send(self, number: int, order: Order) -> None:
        """Send an order to the guide; if it is gone, nothing happens."""
        with suppress(OSError):
            self.connection.send((number, order))

    def next(self, number: int, guidance: int, sample: int) -> SensorAnswer | None:
        """What a sensor has answered by a sample of a guidance."""
        while True:
            known = self._heard[number]
            while known and (known[0].guidance, known[0].sample) < (guidance, sample):
                known.pop(0)
            if known and (known[0].guidance, known[0].sample) == (guidance, sample):
                return known.pop(0).answer
            with suppress(EOFError, OSError):
                if self.connection.poll(_PATIENCE_S):
                    heard: Heard = self.connection.recv()
                    self._heard.setdefault(heard.sensor, []).append(heard)
                    continue
            return None

    def forget(self, number: int) -> None:
        """Stop talking to a sensor."""
        self.send(number, Closed())
        self._heard.pop(number, None)


@dataclass(slots=True, eq=False)
class GuidedSensor:
    """Implements `sensors.Sensor`."""

    all: GuidedSensors
    number: int
    looks_ahead: bool = True
    _guidance: int = 0
    _samples: int = 0
    _correcting: Correcting | None = None

    def begin(self, run: GuidedRun, told: Teller) -> None:
        """Start the guidance in the guide, too."""
        self._guidance, self._samples = self._guidance + 1, 0
        self._correcting = None
        self.all.send(self.number, Begun(self._guidance, run, told))

    def correct(self, first_s: float, sample_s: float) -> None:
        """Have the guide report the sensor's answers to the streamed feedback."""
        self._guidance += 1
        self._correcting = Correcting(self._guidance, first_s, sample_s)
        self.all.send(self.number, self._correcting)

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """The answer by this sample; the guide has long since sent the feedback."""
        sample, self._samples = self._samples, self._samples + 1
        if (one := self._correcting) is not None:
            sample = one.sample_at(feedback.time_s)
        return self.all.next(self.number, self._guidance, sample)

    def stop(self, *, goes_back: bool, ramp_out_s: float) -> None:
        """Stop the guidance in the guide, too."""
        self.all.send(self.number, Stopping(goes_back, ramp_out_s))

    def end(self, feedback: Feedback) -> None:
        """Have the guide send a last message."""
        self.all.send(self.number, Over(feedback))

    def tell(self, stream: Sequence[Feedback]) -> None:
        """Have the guide send each message when it is due."""
        self.all.send(self.number, Streamed(tuple(stream)))

    def close(self) -> None:
        """See `Sensor`."""
        self.all.forget(self.number)
