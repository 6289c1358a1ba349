"""Sensors that guide robots, recorded as they answer, and replayed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

from rapidsim.controller.cell.sensors import NoSensors, Sensor, Sensors, SilentSensor, Teller
from rapidsim.motion.guidance.feedback import Feedback
from rapidsim.motion.guidance.guided_run import GuidedRun
from rapidsim.motion.guidance.sensor import SensorAnswer


@dataclass(slots=True)
class NotedSensors:
    """Reports what sensors answer, by the number of the exchange, so that it can be replayed."""

    sensors: Sensors = field(default_factory=NoSensors)
    answered: Callable[[int, float, SensorAnswer], None] = lambda number, time_s, answer: None
    """Called with the number, the time [s] and the answer."""
    _numbers: count[int] = field(default_factory=lambda: count(1))

    def open(self, device: str) -> Sensor:
        """See `Sensors`."""
        return _NotedSensor(self, self.sensors.open(device))

    def close(self) -> None:
        """See `Sensors`."""
        self.sensors.close()

    def exchanged(self, time_s: float, answer: SensorAnswer | None) -> None:
        """A sensor has answered, or has not."""
        number = next(self._numbers)
        if answer is not None:
            self.answered(number, time_s, answer)


@dataclass(slots=True)
class _NotedSensor:
    all: NotedSensors
    sensor: Sensor

    def begin(self, run: GuidedRun, told: Teller) -> None:
        self.sensor.begin(run, told)

    def correct(self, first_s: float, sample_s: float) -> None:
        self.sensor.correct(first_s, sample_s)

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        answer = self.sensor.exchange(feedback)
        self.all.exchanged(feedback.time_s, answer)
        return answer

    @property
    def looks_ahead(self) -> bool:
        return self.sensor.looks_ahead

    def stop(self, *, goes_back: bool, ramp_out_s: float) -> None:
        self.sensor.stop(goes_back=goes_back, ramp_out_s=ramp_out_s)

    def end(self, feedback: Feedback) -> None:
        self.sensor.end(feedback)

    def tell(self, stream: Sequence[Feedback]) -> None:
        self.sensor.tell(stream)

    def close(self) -> None:
        self.sensor.close()


@dataclass(slots=True)
class RecordedSensors:
    """Replays recorded answers, by the number of the exchange."""

    answers: Mapping[int, SensorAnswer]
    _numbers: count[int] = field(default_factory=lambda: count(1))

    def open(self, device: str) -> Sensor:
        """See `Sensors`."""
        del device
        return _RecordedSensor(self)

    def close(self) -> None:
        """See `Sensors`."""

    def next(self) -> SensorAnswer | None:
        """The next recorded answer."""
        return self.answers.get(next(self._numbers))


@dataclass(slots=True)
class _RecordedSensor(SilentSensor):
    all: RecordedSensors

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        del feedback
        return self.all.next()
