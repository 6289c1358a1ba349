"""Programs with a sensor: what it says and when is up to each test."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from simulation_program import Ran, ran

from rapidsim.controller.cell.description import CellIo
from rapidsim.controller.cell.faults import LastingFault
from rapidsim.controller.cell.network import Network
from rapidsim.controller.cell.sensors import SilentSensor
from rapidsim.motion.guidance.feedback import Feedback
from rapidsim.motion.guidance.sensor import SensorAnswer

NO_IO = CellIo()
Script = Callable[[Feedback], SensorAnswer | None]


@dataclass
class Scripted(SilentSensor):
    """Answers what a function says of what the controller tells."""

    script: Script
    heard: list[Feedback] = field(default_factory=list)
    streamed: list[Feedback] = field(default_factory=list)

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        self.heard.append(feedback)
        return self.script(feedback)

    def end(self, feedback: Feedback) -> None:
        self.heard.append(feedback)

    def stream(self, stream: Sequence[Feedback]) -> None:
        self.streamed += stream


@dataclass
class Devices:
    sensor: Scripted
    opened: list[str] = field(default_factory=list)

    def open(self, device: str) -> Scripted:
        self.opened.append(device)
        return self.sensor

    def fail(self, faults: tuple[LastingFault, ...]) -> None:
        """Nothing fails."""

    def close(self) -> None:
        """A run is over."""


def sensed(text: str, script: Script, io: CellIo = NO_IO) -> tuple[Ran, Devices]:
    devices = Devices(Scripted(script))
    return ran(text, network=Network(sensors=devices), io=io), devices


def joints_at(it: Ran, time_s: float) -> np.ndarray:
    (one,) = it.run.robots
    joints: np.ndarray = np.degrees(one.trajectory.at(np.array([time_s])).joints[0])
    return joints


def end_s(it: Ran) -> float:
    return it.run.robots[0].trajectory.duration
