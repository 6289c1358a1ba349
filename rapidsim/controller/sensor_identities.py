"""EGM identities of a task's sensors, and the active guidance by one of them."""

from __future__ import annotations

from collections.abc import Callable

from rapidsim.controller.cell.sensors import FeedbackSchedule, GuidanceSensor
from rapidsim.controller.moves.guidance_start import DEFAULT_DATA, ExternalMotionData
from rapidsim.controller.sensor_streams import SensorStream
from rapidsim.language.guidance import DISCONNECTED, NO_EXCHANGE, Activation, Exchange, SensorSetup
from rapidsim.motion.guidance.guided_execution import GuidedExecution
from rapidsim.motion.guidance.joint_law import CYCLE_S
from rapidsim.motion.guidance.sensor import SensorAnswer
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.values import value_class


@value_class(slots=True, eq=False)
class SensorIdentity:
    """State of an EGM identity of a task."""

    state: float = DISCONNECTED
    setup: SensorSetup | None = None
    data: ExternalMotionData = DEFAULT_DATA
    sensor: GuidanceSensor | None = None
    activation: Activation | None = None
    exchange: Exchange = NO_EXCHANGE
    """Data and signals exchanged with the sensor at present."""
    sample_s: float | None = None
    """Period [s] at which a sensor corrects paths; None before EGMActMove."""
    stream: SensorStream | None = None


@value_class(slots=True, eq=False)
class ActiveGuidance:
    """A guidance; implements `member.GuidedMotion`."""

    identity: SensorIdentity
    run: GuidedExecution
    schedule: FeedbackSchedule
    section: GuidedSection
    waits: bool
    is_released: Callable[[], None]
    """Called when the guidance no longer moves the robot."""
    cycles: int = 0

    @property
    def next_s(self) -> float:
        """Time [s] of its next cycle."""
        return self.schedule.first_s + self.cycles * CYCLE_S

    def step(self, answer: SensorAnswer | None) -> None:
        """Advance by a cycle."""
        self.cycles += 1
        self.run.step(answer)
        self.section.append(self.run.motion.joints, self.run.motion.speed)

    def release(self) -> None:
        """Brake to rest; the guidance ends."""
        self.run.stop(moves_back=False, ramp_out_s=0.0)
        self.run.cancel_return()
        while not self.run.is_over:
            self.step(None)
        self.is_released()
