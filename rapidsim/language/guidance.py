"""Externally guided motion: the services that the controller provides to a program.

Everything is in RAPID's units: mm, degrees, seconds.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum, auto
from typing import Final, Protocol

from rapidsim.language.data import EgmMinMax, Pose, ToolData, WobjData
from rapidsim.language.moves import Move
from rapidsim.values import value_class

DISCONNECTED: Final = 0.0
CONNECTED: Final = 1.0
RUNNING: Final = 2.0
"""The states of an EGM identity: EGM_STATE_DISCONNECTED and its like."""
RAMP_DOWN: Final = 1.0
"""EGM_STOP_RAMP_DOWN."""


class Purpose(Enum):
    """Purpose of an identity."""

    STREAM = auto()
    """Only streams the robot's position."""
    JOINT = auto()
    POSE = auto()
    PATH_CORRECTION = auto()


@value_class(frozen=True, slots=True)
class SensorSetup:
    """Data of EGMSetupUC and its like: the source of the guidance."""

    device: str
    configuration: str
    purpose: Purpose
    silence_s: float
    """Maximum time [s] without an answer."""
    signals: tuple[str, ...] = ()
    """Signals that guide in place of a device, R1 or x first; "" for a value without a signal."""


@value_class(frozen=True, slots=True)
class Exchange:
    """Data and signals that the program exchanges with the sensor beside goals and positions."""

    numbers_to: list[float] | None = None
    """Array that the sensor receives with each message; it is read then."""
    output_to: str | None = None
    """Digital output whose value the sensor receives."""
    numbers_from: list[float] | None = None
    """Array that receives the numbers of the sensor's answers."""
    input_from: str | None = None
    """Digital input that takes the value in the sensor's answers."""

    def over(self, before: Exchange) -> Exchange:
        """Return the exchange whose parts replace those of an earlier instruction."""
        return Exchange(
            before.numbers_to if self.numbers_to is None else self.numbers_to,
            self.output_to or before.output_to,
            before.numbers_from if self.numbers_from is None else self.numbers_from,
            self.input_from or before.input_from,
        )

    @property
    def receives(self) -> bool:
        """Whether the program receives anything from the sensor."""
        return self.numbers_from is not None or self.input_from is not None


NO_EXCHANGE: Final = Exchange()


@value_class(frozen=True, slots=True)
class PoseFrames:
    """The frames to which poses refer; types are those of egmframetype."""

    correction: Pose
    correction_type: float
    sensor: Pose
    sensor_type: float


@value_class(frozen=True, slots=True)
class Activation:
    """Data of EGMActJoint and EGMActPose: meaning and tolerances of the sensor's goals."""

    bands: tuple[EgmMinMax | None, ...]
    """J1..J7 or x..rz [deg, mm]; None if the call omits it."""
    tool: ToolData | None
    wobj: WobjData | None
    filter_hz: float | None
    """Bandwidth of the goal's filter; None for that of the configuration."""
    sample_s: float
    max_speed: float
    """[deg/s]"""
    max_deviation: float
    """Largest distance [deg] of an axis from where the guidance began."""
    frames: PoseFrames | None = None
    """Frames of poses; None for joints."""
    exchange: Exchange = NO_EXCHANGE
    streams: bool = False


@value_class(frozen=True, slots=True)
class GuidanceTerms:
    """Data of EGMRunJoint and EGMRunPose: axes, gain and end of a guidance."""

    chosen: tuple[bool, ...]
    """J1..J7 or x..rz; the others do not move."""
    moves_back: bool
    waits: bool
    condition_s: float
    ramp_in_s: float | None
    ramp_out_s: float | None
    """None for the ramps of the configuration."""
    gain: float
    """PosCorrGain, 0..1."""
    offset: Pose | None = None
    exchange: Exchange = NO_EXCHANGE
    """Replaces parts of that of the activation."""


class Guidance(Protocol):
    """The EGM identities of a task; each is a number."""

    def connect(self) -> int:
        """Create an identity."""
        ...

    def set_up(self, identity: int, setup: SensorSetup) -> None:
        """Connect an identity with a sensor."""
        ...

    def activate(self, identity: int, activation: Activation) -> None:
        """Set the meaning of the sensor's goals."""
        ...

    def guide(self, identity: int, terms: GuidanceTerms) -> None:
        """Let the sensor guide the robot; returns when the robot has arrived, or at once.

        Raises:
            RapidError: ERR_UDPUC_COMM, if the sensor does not answer for too long.
        """
        ...

    def activate_path(self, identity: int, sample_s: float) -> None:
        """Set the period [s] at which the sensor corrects a path."""
        ...

    def correct(self, identity: Callable[[], int], move: Move, put: Callable[[], None]) -> None:
        """Let the sensor correct the path of a move.

        Args:
            identity: Returns that of the sensor, or raises NotAllowed if it has none.
            move: The move, which begins the path or continues it.
            put: Appends the move to the path; returns when the program may continue.

        Raises:
            RapidError: ERR_UDPUC_COMM, if the sensor does not answer for too long.
        """
        ...

    def await_condition(self, identity: int) -> None:
        """Wait until the guided robot has arrived; raises as `guide` does."""
        ...

    def end_guidance(self, identity: int, *, moves_back: bool, ramp_out_s: float | None) -> None:
        """End the guidance; returns when the robot is at rest.

        Args:
            identity: That of the sensor.
            moves_back: Whether the robot returns to where the guidance began.
            ramp_out_s: Time [s] for that; None for the ramp of the configuration.
        """
        ...

    def stream(self, identity: int, sample_s: float | None) -> None:
        """Stream the robot's position to the sensor at this interval; None ends it."""
        ...

    def give_back(self, identity: int) -> None:
        """End guidance and streams, and release the identity."""
        ...

    def state(self, identity: int) -> float:
        """The state of an identity."""
        ...
