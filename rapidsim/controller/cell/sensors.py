"""Interface of the controller to sensors that guide robots: message and answer each cycle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rapidsim.controller.cell.faults import LastingFault
from rapidsim.motion.guidance.feedback import NO_DATA, Feedback, GuidedFeedback, ProgramData
from rapidsim.motion.guidance.guided_execution import GuidedExecution
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class FeedbackSchedule:
    """Schedule and frames of the feedback to a sensor during a guidance."""

    first_s: float
    """The time of the first cycle [s]."""
    samples: int
    """Number of cycles from one message to the next."""
    feedback: GuidedFeedback
    sent: ProgramData = NO_DATA
    """Data of the program for the sensor when it begins."""


class GuidanceSensor(Protocol):
    """A sensor that communicates with a task."""

    @property
    def has_lookahead(self) -> bool:
        """Whether a stream contains future positions of the robot, so that none is late."""
        ...

    def begin(self, run: GuidedExecution, feedback: FeedbackSchedule) -> None:
        """Begin a guidance; `exchange` is called at each of its cycles that is a sample."""
        ...

    def correct(self, first_s: float, sample_s: float) -> None:
        """Await answers without a guidance: `exchange` is called every `sample_s` seconds."""
        ...

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """Send the robot's position; return the sensor's answer, None if none is new."""
        ...

    def stop(self, *, moves_back: bool, ramp_out_s: float) -> None:
        """Notify the sensor that the program ends the guidance; see `GuidedExecution.stop`."""
        ...

    def end(self, feedback: Feedback) -> None:
        """Send the last message of a guidance."""
        ...

    def stream(self, stream: Sequence[Feedback]) -> None:
        """Send positions, each at its time, of a robot without guidance.

        With `has_lookahead` these times are in the future, and later feedback replaces earlier one.
        """
        ...

    def close(self) -> None:
        """Close the connection."""
        ...


class GuidanceSensors(Protocol):
    """All sensors of a controller, by device."""

    def open(self, device: str) -> GuidanceSensor:
        """Connect to the sensor of a device.

        Raises:
            NotAllowed: If the program may not contact it.
        """
        ...

    def fail(self, faults: tuple[LastingFault, ...]) -> None:
        """Let datagrams fail as these faults say, and no others."""
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
        """Return None: there is never an answer."""
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
    """Sensors of a cell without devices."""

    def open(self, device: str) -> GuidanceSensor:
        """See `GuidanceSensors`."""
        del device
        return SilentSensor()

    def fail(self, faults: tuple[LastingFault, ...]) -> None:
        """See `GuidanceSensors`."""

    def close(self) -> None:
        """See `GuidanceSensors`."""
