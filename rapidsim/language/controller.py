"""What a running task may ask of its controller.

The interpreter and the library speak to these protocols; `simulation` implements them; tests use a
small recording fake. Everything here is in RAPID's units and knows no robot and no NumPy.

One object implements them all for one task, so generated code and library share its clock.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Protocol

from rapidsim.diagnostics import Span
from rapidsim.language.data import (
    ExtJoint,
    JointTarget,
    Pose,
    RobTarget,
    SpeedData,
    ToolData,
    WobjData,
    ZoneData,
)


@dataclass(frozen=True, slots=True)
class Place:
    """Where a statement stands, for events and reports."""

    span: Span
    routine: str
    arguments: Mapping[str, str] = field(default_factory=dict)
    """Source text of the call's arguments, by folded parameter name: `{"topoint": "p20"}`."""


class Interpolation(Enum):
    """How a move gets to its end."""

    JOINT = "joint"
    """MoveJ: straight in joint space to a pose."""
    LINE = "line"
    """MoveL: the TCP on a straight line."""
    CIRCLE = "circle"
    """MoveC: the TCP on an arc through a circle point."""
    AXES = "axes"
    """MoveAbsJ: straight in joint space to axis positions."""


@dataclass(frozen=True, slots=True)
class Move:
    """One move instruction with its arguments evaluated."""

    instruction: str
    interpolation: Interpolation
    to: RobTarget | JointTarget
    speed: SpeedData
    zone: ZoneData
    tool: ToolData
    wobj: WobjData
    circle_point: RobTarget | None = None
    duration_s: float | None = None
    """The argument \\T: time of the whole move, which replaces the speed."""
    concurrent: bool = False
    """The argument \\Conc: the program goes on at once."""


@dataclass(frozen=True, slots=True)
class MotionSettings:
    """What VelSet, AccSet, ConfL and their like have set; these are the values after PP to main."""

    speed_override_percent: float = 100.0
    max_speed_mm_s: float | None = None
    acceleration_percent: float = 100.0
    ramp_percent: float = 100.0
    conf_j: bool = True
    conf_l: bool = True
    displacement: Pose | None = None
    """PDispOn, PDispSet: moves reach the controller with it applied already."""
    axis_offsets: ExtJoint | None = None
    """EOffsOn, EOffsSet: moves reach the controller with them applied already."""


class Clock(Protocol):
    """Virtual time of a task."""

    def now(self) -> float:
        """Virtual time [s] of the statement that runs."""
        ...

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        """Let virtual time pass; with `in_position`, first let the robot come to rest."""
        ...

    def wait_until(
        self, condition: Callable[[], bool], *, max_time: float | None = None, poll_s: float = 0.1
    ) -> bool:
        """Let virtual time pass until a condition holds; False if `max_time` [s] ran out first."""
        ...


class Motion(Protocol):
    """The path queue of the task's robot."""

    settings: MotionSettings

    def move(self, move: Move) -> None:
        """Put a move on the path; returns when the program would go on.

        Raises:
            RapidError: What RAPID can catch, such as a position outside reach.
        """
        ...

    def current_joints(self) -> JointTarget:
        """Where the axes are now."""
        ...

    def current_target(self, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        """Where the TCP is now; None takes the tool or work object of the last move."""
        ...

    def active_tool(self) -> ToolData:
        """The tool of the last move, tool0 before the first."""
        ...

    def active_wobj(self) -> WobjData:
        """The work object of the last move, wobj0 before the first."""
        ...

    def target_at(self, joints: JointTarget, tool: ToolData, wobj: WobjData) -> RobTarget:
        """Where the TCP would be with the axes at given positions."""
        ...

    def joints_at(self, target: RobTarget, tool: ToolData, wobj: WobjData) -> JointTarget:
        """Axis positions that reach a target in its configuration.

        Raises:
            RapidError: ERR_OUTSIDE_REACH or ERR_ROBLIMIT.
        """
        ...


class Operator(Protocol):
    """The FlexPendant and the person at it."""

    def show(self, text: str) -> None:
        """Write a line on the screen."""
        ...

    def clear_screen(self) -> None:
        """Remove all lines."""
        ...

    def ask_number(self, prompt: str) -> float:
        """The operator's answer to a question; never hangs where nobody sits."""
        ...

    def ask_choice(self, prompt: str, choices: Sequence[str]) -> int:
        """Index from 0 of the key the operator presses; keys with the text "" are not there.

        The first key that is there, where nobody sits.
        """
        ...

    def ask_text(self, prompt: str, proposal: str) -> str:
        """A text the operator types; the proposal, where nobody sits."""
        ...


class FileMode(Enum):
    """What a file is opened for."""

    READ = "read"
    WRITE = "write"
    APPEND = "append"


class OpenFile(Protocol):
    """An open file of the controller's home folder; bytes are text in ISO 8859-1."""

    def write(self, data: bytes) -> None:
        """Append bytes."""
        ...

    def read_line(self) -> bytes | None:
        """The next line without its end; None at the end of the file."""
        ...

    def read(self, count: int) -> bytes:
        """Up to `count` bytes; none at the end of the file."""
        ...

    def rewind(self) -> None:
        """Go back to the first byte."""
        ...

    def close(self) -> None:
        """Flush and close; closing twice does nothing."""
        ...


class Files(Protocol):
    """The controller's disk, confined to the home folder of the run."""

    def open_file(self, path: str, mode: FileMode) -> OpenFile:
        """Open a file named as RAPID names it, such as "HOME:/log/today.txt".

        Raises:
            RapidError: ERR_FILEOPEN when it is missing, outside the home folder, or not to be had.
        """
        ...


class Interrupts(Protocol):
    """Interrupt numbers, what they are connected to, and what raises them."""

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        """Book an interrupt number for a trap routine."""
        ...

    def is_connected(self, interrupt: float) -> bool:
        """Whether an interrupt number belongs to a trap routine, ordered or not."""
        ...

    def order_timer(self, interrupt: float, seconds: float, *, single: bool) -> None:
        """Raise an interrupt once, or every so many seconds."""
        ...

    def order_signal(
        self, interrupt: float, signal: str, value: float | None, *, single: bool
    ) -> None:
        """Raise an interrupt once, or each time a signal changes to a value; None: to any."""
        ...

    def delete_interrupt(self, interrupt: float) -> None:
        """Forget an interrupt and its order."""
        ...

    def sleep_interrupt(self, interrupt: float, *, asleep: bool) -> None:
        """Switch one interrupt off or on."""
        ...

    def hold_interrupts(self, *, hold: bool) -> None:
        """Queue all interrupts instead of serving them, or serve them again."""
        ...


class Signals(Protocol):
    """Inputs and outputs by name; names compare without case."""

    def read_signal(self, name: str) -> float:
        """The value of a signal now."""
        ...

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Set an output now or after a delay, without waiting for it."""
        ...

    def wait_for_signal(
        self, name: str, condition: Callable[[float], bool], *, max_time: float | None = None
    ) -> bool:
        """Let virtual time pass until the value of a signal satisfies a condition.

        Returns at the very instant, without polling; False if `max_time` [s] ran out first.
        """
        ...


class ErrorNumbers(Protocol):
    """Error numbers that a program books for itself."""

    def book_error_number(self) -> float:
        """The next number that is free, from `error_numbers.FIRST_BOOKED` up."""
        ...


class Honesty(Protocol):
    """How a routine says that it did less than the controller would."""

    def not_simulated(self, routine: str, treated_as: str) -> None:
        """Report that a routine was not simulated and what was done instead."""
        ...


class Controller(
    Clock, Motion, Operator, Files, Interrupts, Signals, ErrorNumbers, Honesty, Protocol
):
    """All of it, for one task, and what generated code needs at run time."""

    left: int
    """Ticks of the current slice that are left; a loop takes one each turn and calls `service` when
    it falls below zero."""
    place: Place
    """The statement that runs, set before each call that reports."""
    errno: float
    """RAPID's ERRNO."""
    intno: float
    """RAPID's INTNO."""

    def service(self) -> None:
        """Do what is due (traps, other tasks, limits) and grant the next slice.

        Raises:
            Stopped: When a limit of the run is reached.
        """
        ...
