"""Sensors that guide robots, as the controller sees them: message and answer each cycle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rapidsim.motion.guidance.feedback import Feedback, GuidedFeedback
from rapidsim.motion.guidance.guided_execution import GuidedExecution
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class FeedbackSchedule:
    """How a sensor is informed of a guidance: when, and in which frames."""

    first_s: float
    """The time of the first cycle [s]."""
    samples: int
    """Cycles from one message to the next."""
    feedback: GuidedFeedback


class GuidanceSensor(Protocol):
    """A sensor that a task talks to."""

    @property
    def has_lookahead(self) -> bool:
        """Whether a stream is told in advance where the robot will be, so none is late."""
        ...

    def begin(self, run: GuidedExecution, feedback: FeedbackSchedule) -> None:
        """A guidance begins; `exchange` is called at each of its cycles that is a sample."""
        ...

    def correct(self, first_s: float, sample_s: float) -> None:
        """A path is corrected from now on: `exchange` is called every so many seconds."""
        ...

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """Send where the robot is; returns what the sensor has said since the last time."""
        ...

    def stop(self, *, moves_back: bool, ramp_out_s: float) -> None:
        """The program ends the guidance; see `GuidedExecution.stop`."""
        ...

    def end(self, feedback: Feedback) -> None:
        """The guidance is over: a last message."""
        ...

    def stream(self, stream: Sequence[Feedback]) -> None:
        """Tell, each at its time, where a robot is that nobody guides.

        With `has_lookahead` these times are to come, and later words replace those before.
        """
        ...

    def close(self) -> None:
        """Close the connection."""
        ...


class GuidanceSensors(Protocol):
    """All devices that a controller knows."""

    def open(self, device: str) -> GuidanceSensor:
        """Talk to the sensor behind a device.

        Raises:
            NotAllowed: If the program may not talk to it.
        """
        ...

    def close(self) -> None:
        """Close all connections."""
        ...


class SilentSensor:
    """A sensor that never answers."""

    has_lookahead: bool = False

    def begin(self, run: GuidedExecution, feedback: FeedbackSchedule) -> None:
        """See `GuidanceSensor`."""

    def correct(self, first_s: float, sample_s: float) -> None:
        """See `GuidanceSensor`."""

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """There is never an answer."""
        del feedback
        return None

    def stop(self, *, moves_back: bool, ramp_out_s: float) -> None:
        """See `GuidanceSensor`."""

    def end(self, feedback: Feedback) -> None:
        """See `GuidanceSensor`."""

    def stream(self, stream: Sequence[Feedback]) -> None:
        """See `GuidanceSensor`."""

    def close(self) -> None:
        """See `GuidanceSensor`."""


class NoSensors:
    """No device has a sensor."""

    def open(self, device: str) -> GuidanceSensor:
        """See `GuidanceSensors`."""
        del device
        return SilentSensor()

    def close(self) -> None:
        """See `GuidanceSensors`."""
