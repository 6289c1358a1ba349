"""States of a controller, in the controller's terms, and reasons for refusing a request."""

from __future__ import annotations

from enum import Enum, StrEnum, auto

from rapidsim.values import value_class


class Motors(StrEnum):
    """The states of the motors that can be requested; see `ControllerState`."""

    ON = "motoron"
    OFF = "motoroff"


class ControllerState(StrEnum):
    """The state of a controller."""

    MOTORS_ON = "motoron"
    MOTORS_OFF = "motoroff"
    GUARD_STOP = "guardstop"
    """The automatic or the general stop is open."""
    EMERGENCY_STOP = "emergencystop"
    EMERGENCY_STOP_RELEASED = "emergencystopreset"
    """The emergency stop is released, and that is not confirmed yet."""


class SafetyStop(Enum):
    """A part of the safety chain; while it is open, the motors are off."""

    EMERGENCY = auto()
    AUTOMATIC = auto()
    """The guard of automatic mode; in manual mode without effect."""
    GENERAL = auto()


class OperatingMode(StrEnum):
    """The operating mode."""

    AUTO = "AUTO"
    REDUCED = "MANR"
    FULL = "MANF"


class Cycle(StrEnum):
    """Cycle mode: end after one run of main, or start main again."""

    ONCE = "once"
    FOREVER = "forever"


class ExecutionMode(StrEnum):
    """Extent of an execution after a start."""

    CONTINUE = auto()
    STEP_IN = "stepin"
    """To the next statement, in any routine."""
    STEP_OVER = "stepover"
    """To the next statement of the routine, or of one of its callers."""
    STEP_OUT = "stepout"
    """To the next statement of the caller."""
    STEP_MOTION = "stepmotion"
    """To the statement after the next move."""


class StopMode(StrEnum):
    """Kind of a stop: at the end of the cycle or instruction, on the path, or quick."""

    CYCLE = "cycle"
    INSTRUCTION = "instr"
    STOP = "stop"
    QUICK = "qstop"


class RefusalReason(Enum):
    """Reason why a request was refused."""

    STATE = auto()
    """The state of the controller forbids it."""
    VALUE = auto()
    """The value is out of range or has the wrong type."""
    NO_TASK = auto()
    NO_SYMBOL = auto()
    NO_SIGNAL = auto()
    NO_FILE = auto()
    NO_MODULE = auto()
    NO_UNIT = auto()
    READ_ONLY = auto()


class RequestRefused(Exception):  # noqa: N818 - an answer, not a failure
    """A request that the controller refuses."""

    def __init__(self, reason: RefusalReason, message: str) -> None:
        """Store the reason, for programs, and the message, for people."""
        super().__init__(message)
        self.why = reason
        self.message = message


@value_class(frozen=True, slots=True)
class TaskState:
    """The state of a task, as clients see it."""

    name: str
    kind: str
    """As the configuration spells it: `normal`, `static`, `semistatic`."""
    is_loaded: bool
    has_pointer: bool
    executes: bool
    is_active: bool
    moves_robot: bool
