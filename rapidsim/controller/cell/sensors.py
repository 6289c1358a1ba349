"""Sensors that guide robots, as the controller talks to them: a word and an answer each cycle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from rapidsim.motion.guidance.feedback import Feedback
from rapidsim.motion.guidance.guided_run import GuidedRun
from rapidsim.motion.guidance.sensor import SensorAnswer


class Sensor(Protocol):
    """A sensor that a task talks to."""

    def begin(self, run: GuidedRun, told: Teller) -> None:
        """A guidance begins; `exchange` is called at each of its cycles that is a sample."""
        ...

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """Tell where the robot is; what the sensor has said since the last time."""
        ...

    def end(self) -> None:
        """The guidance is over."""
        ...

    def close(self) -> None:
        """Nobody talks to it any more."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Teller:
    """How a guidance is told to its sensor: when, and in which frames."""

    first_s: float
    """Of the first cycle [s]."""
    samples: int
    """Cycles from one word to the next."""
    feedback: FeedbackMaker


class FeedbackMaker(Protocol):
    """Makes what a sensor is told of a guidance."""

    def __call__(self, run: GuidedRun, time_s: float) -> Feedback:
        """What is told at a time [s]."""
        ...


class Sensors(Protocol):
    """All devices that a controller knows."""

    def open(self, device: str) -> Sensor:
        """Talk to the sensor behind a device."""
        ...


class SilentSensor:
    """Nobody is there."""

    def begin(self, run: GuidedRun, told: Teller) -> None:
        """See `Sensor`."""

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """Nobody answers."""
        del feedback
        return None

    def end(self) -> None:
        """See `Sensor`."""

    def close(self) -> None:
        """See `Sensor`."""


class NoSensors:
    """Nobody is at the other end of any device."""

    def open(self, device: str) -> Sensor:
        """See `Sensors`."""
        del device
        return SilentSensor()
