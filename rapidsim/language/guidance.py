"""Externally guided motion: what a program asks of the controller.

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
    """What an identity is set up for."""

    STREAM = auto()
    """Only tells where the robot is."""
    JOINT = auto()
    POSE = auto()
    PATH_CORRECTION = auto()


@value_class(frozen=True, slots=True)
class SensorSetup:
    """EGMSetupUC and its like: who guides."""

    device: str
    configuration: str
    purpose: Purpose
    silence_s: float
    """How long it may be silent."""
    signals: tuple[str, ...] = ()
    """Signals that guide in place of a device, R1 or x first; empty for one that nothing guides."""


@value_class(frozen=True, slots=True)
class PoseFrames:
    """The frames poses refer to; types are those of egmframetype."""

    correction: Pose
    correction_type: float
    sensor: Pose
    sensor_type: float


@value_class(frozen=True, slots=True)
class Activation:
    """EGMActJoint and EGMActPose: what the sensor sends, and when the robot counts as there."""

    bands: tuple[EgmMinMax | None, ...]
    """J1..J7 or x..rz [deg, mm]; None where the call says nothing."""
    tool: ToolData | None
    wobj: WobjData | None
    filter_hz: float
    sample_s: float
    max_speed: float
    """[deg/s]"""
    frames: PoseFrames | None = None
    """Of poses; None for joints."""
    values: list[float] | None = None
    """Takes the numbers that the sensor sends along."""
    streams: bool = False


@value_class(frozen=True, slots=True)
class GuidanceTerms:
    """EGMRunJoint and EGMRunPose: which axes, how strongly, until when."""

    chosen: tuple[bool, ...]
    """J1..J7 or x..rz; none of them means all."""
    moves_back: bool
    waits: bool
    condition_s: float
    ramp_in_s: float
    ramp_out_s: float
    gain: float
    """PosCorrGain, 0..1."""
    offset: Pose | None = None


class Guidance(Protocol):
    """The EGM identities of a task; each is a number."""

    def connect(self) -> int:
        """A new identity."""
        ...

    def set_up(self, identity: int, setup: SensorSetup) -> None:
        """Connect an identity with a sensor."""
        ...

    def activate(self, identity: int, activation: Activation) -> None:
        """Set what the sensor's goals mean."""
        ...

    def guide(self, identity: int, terms: GuidanceTerms) -> None:
        """Let the sensor guide the robot; returns when the robot is there, or at once.

        Raises:
            RapidError: ERR_UDPUC_COMM, if the sensor says nothing for too long.
        """
        ...

    def activate_path(self, identity: int, sample_s: float) -> None:
        """Say how often the sensor tells how far from its path the robot shall be."""
        ...

    def correct(self, identity: Callable[[], int], move: Move, put: Callable[[], None]) -> None:
        """Let the sensor correct the path of a move.

        Args:
            identity: Gives that of the sensor, or raises NotAllowed if there is none.
            move: Which begins the path, or goes on with it.
            put: Puts the move on the path; returns when the program would go on.

        Raises:
            RapidError: ERR_UDPUC_COMM, if the sensor says nothing for too long.
        """
        ...

    def await_condition(self, identity: int) -> None:
        """Wait until the robot that is guided is there; raises as `guide` does."""
        ...

    def end_guidance(self, identity: int, *, moves_back: bool, ramp_out_s: float) -> None:
        """End the guidance; returns when the robot stands."""
        ...

    def stream(self, identity: int, sample_s: float | None) -> None:
        """Tell the sensor at this interval where the robot is; None ends it."""
        ...

    def give_back(self, identity: int) -> None:
        """End everything and release the identity."""
        ...

    def state(self, identity: int) -> float:
        """The state of an identity."""
        ...
