"""What a task knows of its sensors: who they are, and the guidance by one that is under way."""

from __future__ import annotations

from collections.abc import Callable

from rapidsim.controller.cell.sensors import FeedbackSchedule, GuidanceSensor
from rapidsim.controller.moves.guidance_start import DEFAULT_DATA, ExternalMotionData
from rapidsim.controller.sensor_streams import SensorStream
from rapidsim.language.guidance import DISCONNECTED, Activation, SensorSetup
from rapidsim.motion.guidance.guided_execution import GuidedExecution
from rapidsim.motion.guidance.joint_law import CYCLE_S
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.values import value_class


@value_class(slots=True, eq=False)
class SensorIdentity:
    """What a task knows by an EGM identity."""

    state: float = DISCONNECTED
    setup: SensorSetup | None = None
    data: ExternalMotionData = DEFAULT_DATA
    sensor: GuidanceSensor | None = None
    activation: Activation | None = None
    sample_s: float | None = None
    """Of a sensor that corrects paths: how often [s] it does; None before EGMActMove."""
    stream: SensorStream | None = None


@value_class(slots=True, eq=False)
class ActiveGuidance:
    """A guidance; implements `solo_queue.GuidedMotion`."""

    identity: SensorIdentity
    run: GuidedExecution
    schedule: FeedbackSchedule
    section: GuidedSection
    waits: bool
    is_released: Callable[[], None]
    """Told when nobody guides the robot any more."""
    cycles: int = 0

    @property
    def next_s(self) -> float:
        """Of its next cycle [s]."""
        return self.schedule.first_s + self.cycles * CYCLE_S

    def step(self, answer: SensorAnswer | None) -> None:
        """Go on by a cycle."""
        self.cycles += 1
        self.run.step(answer)
        self.section.append(self.run.motion.joints, self.run.motion.speed)

    def release(self) -> None:
        """The robot brakes and stands; nobody guides it any more."""
        self.run.stop(moves_back=False, ramp_out_s=0.0)
        self.run.cancel_return()
        while not self.run.is_over:
            self.step(None)
        self.is_released()
