"""Sensors that guide robots, as the controller sees them: message and answer each cycle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rapidsim.motion.guidance.feedback import Feedback, GuidedFeedback
from rapidsim.motion.guidance.guided_run import GuidedRun
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class Teller:
    """How a sensor is informed of a guidance: when, and in which frames."""

    first_s: float
    """The time of the first cycle [s]."""
    samples: int
    """Cycles from one message to the next."""
    feedback: GuidedFeedback


class Sensor(Protocol):
    """A sensor that a task talks to."""

    @property
    def looks_ahead(self) -> bool:
        """Whether a stream is told in advance where the robot will be, so none is late."""
        ...

    def begin(self, run: GuidedRun, told: Teller) -> None:
        """A guidance begins; `exchange` is called at each of its cycles that is a sample."""
        ...

    def correct(self, first_s: float, sample_s: float) -> None:
        """A path is corrected from now on: `exchange` is called every so many seconds."""
        ...

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """Send where the robot is; returns what the sensor has said since the last time."""
        ...

    def stop(self, *, goes_back: bool, ramp_out_s: float) -> None:
        """The program ends the guidance; see `GuidedRun.stop`."""
        ...

    def end(self, feedback: Feedback) -> None:
        """The guidance is over: a last message."""
        ...

    def tell(self, stream: Sequence[Feedback]) -> None:
        """Tell, each at its time, where a robot is that nobody guides.

        With `looks_ahead` these times are to come, and later words replace those before.
        """
        ...

    def close(self) -> None:
        """Close the connection."""
        ...


class Sensors(Protocol):
    """All devices that a controller knows."""

    def open(self, device: str) -> Sensor:
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

    looks_ahead: bool = False

    def begin(self, run: GuidedRun, told: Teller) -> None:
        """See `Sensor`."""

    def correct(self, first_s: float, sample_s: float) -> None:
        """See `Sensor`."""

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """There is never an answer."""
        del feedback
        return None

    def stop(self, *, goes_back: bool, ramp_out_s: float) -> None:
        """See `Sensor`."""

    def end(self, feedback: Feedback) -> None:
        """See `Sensor`."""

    def tell(self, stream: Sequence[Feedback]) -> None:
        """See `Sensor`."""

    def close(self) -> None:
        """See `Sensor`."""


class NoSensors:
    """No device has a sensor."""

    def open(self, device: str) -> Sensor:
        """See `Sensors`."""
        del device
        return SilentSensor()

    def close(self) -> None:
        """See `Sensors`."""
