"""The states of a controller, in its own words, and why it refuses a request."""

from __future__ import annotations

from enum import Enum, StrEnum, auto

from rapidsim.values import value_class


class Motors(StrEnum):
    """The states of the motors that can be requested; a simulated controller has no others."""

    ON = "motoron"
    OFF = "motoroff"


class OperatingMode(StrEnum):
    """The operating mode."""

    AUTO = "AUTO"
    REDUCED = "MANR"
    FULL = "MANF"


class Cycle(StrEnum):
    """What happens after the end of main."""

    ONCE = "once"
    FOREVER = "forever"


class ExecutionMode(StrEnum):
    """How far programs run when they are started."""

    CONTINUE = auto()
    STEP_IN = "stepin"
    """To the next statement, in whatever routine."""
    STEP_OVER = "stepover"
    """To the next statement of the routine, or of one of its callers."""
    STEP_OUT = "stepout"
    """To the next statement of the caller."""
    STEP_MOTION = "stepmotion"
    """To the statement after the next move."""


class StopMode(StrEnum):
    """Where a program stops when it is told to."""

    CYCLE = "cycle"
    INSTRUCTION = "instr"
    STOP = "stop"
    QUICK = "qstop"


class RefusalReason(Enum):
    """Why something was refused."""

    STATE = auto()
    """The state of the controller forbids it."""
    VALUE = auto()
    """The value given is not one it can take."""
    NO_TASK = auto()
    NO_SYMBOL = auto()
    NO_SIGNAL = auto()
    NO_FILE = auto()
    NO_MODULE = auto()
    NO_UNIT = auto()
    READ_ONLY = auto()


class RequestRefused(Exception):  # noqa: N818 - an answer, not a failure
    """The controller refuses a request."""

    def __init__(self, reason: RefusalReason, message: str) -> None:
        """Say why, for programs and for people."""
        super().__init__(message)
        self.why = reason
        self.message = message


@value_class(frozen=True, slots=True)
class TaskState:
    """The state of a task, as clients see it."""

    name: str
    kind: str
    """In the words of the configuration: `normal`, `static`, `semistatic`."""
    is_loaded: bool
    has_pointer: bool
    executes: bool
    is_active: bool
    moves_robot: bool
