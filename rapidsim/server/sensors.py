"""Sensors that guide robots, with answers that are recorded and replayed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count

from rapidsim.controller.cell.faults import LastingFault
from rapidsim.controller.cell.sensors import (
    FeedbackSchedule,
    GuidanceSensor,
    GuidanceSensors,
    NoSensors,
    SilentSensor,
)
from rapidsim.motion.guidance.feedback import Feedback
from rapidsim.motion.guidance.guided_execution import GuidedExecution
from rapidsim.motion.guidance.sensor import SensorAnswer


@dataclass(slots=True)
class RecordingSensors:
    """Sensors that report each answer with the number of its exchange, for a replay."""

    sensors: GuidanceSensors = field(default_factory=NoSensors)
    answered: Callable[[int, float, SensorAnswer], None] = lambda number, time_s, answer: None
    """Called with the number, the time [s] and the answer."""
    _numbers: count[int] = field(default_factory=lambda: count(1))

    def open(self, device: str) -> GuidanceSensor:
        """See `GuidanceSensors`."""
        return _RecordingSensor(self, self.sensors.open(device))

    def fail(self, faults: tuple[LastingFault, ...]) -> None:
        """See `GuidanceSensors`."""
        self.sensors.fail(faults)

    def close(self) -> None:
        """See `GuidanceSensors`."""
        self.sensors.close()

    def exchanged(self, time_s: float, answer: SensorAnswer | None) -> None:
        """Report the answer of a sensor, if there is one."""
        number = next(self._numbers)
        if answer is not None:
            self.answered(number, time_s, answer)


@dataclass(slots=True)
class _RecordingSensor:
    all: RecordingSensors
    sensor: GuidanceSensor

    def begin(self, run: GuidedExecution, feedback: FeedbackSchedule) -> None:
        self.sensor.begin(run, feedback)

    def correct(self, first_s: float, sample_s: float) -> None:
        self.sensor.correct(first_s, sample_s)

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        answer = self.sensor.exchange(feedback)
        self.all.exchanged(feedback.time_s, answer)
        return answer

    @property
    def has_lookahead(self) -> bool:
        return self.sensor.has_lookahead

    def stop(self, *, moves_back: bool, ramp_out_s: float) -> None:
        self.sensor.stop(moves_back=moves_back, ramp_out_s=ramp_out_s)

    def end(self, feedback: Feedback) -> None:
        self.sensor.end(feedback)

    def stream(self, stream: Sequence[Feedback]) -> None:
        self.sensor.stream(stream)

    def close(self) -> None:
        self.sensor.close()


@dataclass(slots=True)
class ReplayedSensors:
    """Sensors that replay recorded answers, by the number of the exchange."""

    answers: Mapping[int, SensorAnswer]
    _numbers: count[int] = field(default_factory=lambda: count(1))

    def open(self, device: str) -> GuidanceSensor:
        """See `GuidanceSensors`."""
        del device
        return _ReplayedSensor(self)

    def fail(self, faults: tuple[LastingFault, ...]) -> None:
        """See `GuidanceSensors`: the recorded answers are those that have passed."""

    def close(self) -> None:
        """See `GuidanceSensors`."""

    def next(self) -> SensorAnswer | None:
        """Return the next recorded answer; None if the sensor did not answer."""
        return self.answers.get(next(self._numbers))


@dataclass(slots=True)
class _ReplayedSensor(SilentSensor):
    all: ReplayedSensors

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        del feedback
        return self.all.next()
