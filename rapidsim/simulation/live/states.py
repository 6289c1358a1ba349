"""The states of a controller, in its own words, and why it refuses what is asked of it."""

from __future__ import annotations

from enum import Enum, StrEnum, auto

from rapidsim.values import dataclass


class Motors(StrEnum):
    """The state of the controller that can be asked for; a simulated one has no others."""

    ON = "motoron"
    OFF = "motoroff"


class Mode(StrEnum):
    """The operating mode."""

    AUTO = "AUTO"
    REDUCED = "MANR"
    FULL = "MANF"


class Cycle(StrEnum):
    """What comes after the end of main."""

    ONCE = "once"
    FOREVER = "forever"


class Execution(StrEnum):
    """How far programs go on that are started."""

    CONTINUE = auto()
    STEP_IN = "stepin"
    """To the next statement, in whatever routine."""
    STEP_OVER = "stepover"
    """To the next statement of the routine, or of one that has called it."""
    STEP_OUT = "stepout"
    """To the next statement of the routine that has called it."""
    STEP_MOTION = "stepmotion"
    """To the statement after the next move."""


class StopMode(StrEnum):
    """When a program stops that is told to."""

    CYCLE = "cycle"
    INSTRUCTION = "instr"
    STOP = "stop"
    QUICK = "qstop"


class Why(Enum):
    """Why something was refused."""

    STATE = auto()
    """The controller is in a state that forbids it."""
    VALUE = auto()
    """What was given is no value of it."""
    NO_TASK = auto()
    NO_SYMBOL = auto()
    NO_SIGNAL = auto()
    NO_FILE = auto()
    NO_MODULE = auto()
    NO_UNIT = auto()
    READ_ONLY = auto()


class Refused(Exception):  # noqa: N818 - an answer, not a failure
    """The controller does not do what is asked of it."""

    def __init__(self, why: Why, message: str) -> None:
        """Say why, for programs and for people."""
        super().__init__(message)
        self.why = why
        self.message = message


@dataclass(frozen=True, slots=True)
class TaskState:
    """What is shown of a task."""

    name: str
    kind: str
    """In the words of the configuration: `normal`, `static`, `semistatic`."""
    is_loaded: bool
    has_pointer: bool
    executes: bool
    is_active: bool
    moves_robot: bool
