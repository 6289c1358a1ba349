"""Services that the controller provides to a task.

The interpreter and the library use these protocols; `controller` implements them; tests use a small
recording fake. Everything here is in RAPID's units and independent of robots and NumPy.

A routine of the library requests the concern it needs by the annotation of its first parameter, or
the whole `Controller` if it needs several.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from datetime import datetime
from types import MappingProxyType
from typing import Any, Protocol

from rapidsim.language.cameras import Cameras
from rapidsim.language.cyclic_bools import CyclicBools
from rapidsim.language.data import JointTarget, Pos, RobTarget, ToolData, WobjData
from rapidsim.language.equipment import AxisSignals, Equipment, SmartGripper
from rapidsim.language.error_answers import ErrorReports
from rapidsim.language.error_log import LoggedError
from rapidsim.language.files import Files
from rapidsim.language.guidance import Guidance
from rapidsim.language.messages import Messages
from rapidsim.language.modules import Modules
from rapidsim.language.moves import AnnouncedTargets, MotionSettings, Move, Place
from rapidsim.language.option_data import RestartData
from rapidsim.language.path_control import (
    PathControl,
    PathLength,
    PathRecorder,
    Searches,
    WorldZones,
)
from rapidsim.language.path_events import Trigger
from rapidsim.language.reference import Reference
from rapidsim.language.sockets import Sockets
from rapidsim.language.symbols import Symbols
from rapidsim.language.tasks import SyncMoves, TaskService
from rapidsim.language.texts import Texts


class ClockService(Protocol):
    """Virtual time of a task, with the state that generated code uses to let it pass."""

    ticks_left: int
    """Remaining ticks of the current slice; a loop takes one each turn and calls `service` when it
    falls below zero."""
    place: Place
    """The statement being executed; set before each call that may report."""

    effect_count: int
    """Number of statements with side effects so far."""

    program_state: Callable[[], Iterable[object]]
    """Everything that decides the program's next statement, in parts to be compared; the last is
    None if it is too large. The interpreter sets it."""

    @property
    def watches(self) -> bool:
        """Whether any interrupt waits for a persistent to change."""
        ...

    def serve_persistent_changes(self) -> None:
        """Serve the interrupts of persistents that the program has changed since the last check."""
        ...

    def tick(self) -> None:
        """Let the time of one loop turn pass, so that endless loops take virtual time, too.

        Raises:
            Stopped: When a limit of the run is reached.
        """
        ...

    def service(self) -> None:
        """Dispatch due events (traps, other tasks, limits) and grant the next slice.

        Raises:
            Stopped: When a limit of the run is reached.
        """
        ...

    def now(self) -> float:
        """Virtual time [s] of the current statement."""
        ...

    def note_unknown(self) -> None:
        """Note that nobody knows what the current statement does.

        A loop that only polls around it is no endless one, but goes on to the time limit at once.
        """
        ...

    def hold_until(self, time_s: float) -> None:
        """Note that all that the current statement reads stays unchanged until a time [s].

        A loop that only reads such values is skipped to the time at which one changes.
        """
        ...

    def date_and_time(self) -> datetime:
        """Date and time of the controller's clock, to the second."""
        ...

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        """Let virtual time pass; with `in_position`, first bring the robot to rest."""
        ...

    def long_work(self) -> AbstractContextManager[None]:
        """Context of work that takes no virtual time, but may take long on the computer.

        Raises:
            Stopped: When the run has no time left; also in the middle of the work.
        """
        ...


class ExecutionControl(Protocol):
    """Execution of the program: stops and restarts."""

    def stop(self, reason: str, *, every: bool = False) -> None:
        """Stop execution of the task, or of all; returns when the program has been restarted.

        Raises:
            Stopped: If nothing can restart it: the task ends, with AllStopped the run.
        """
        ...

    def supervise(
        self, restart: Reference[RestartData], process: tuple[str | None, ...], shadow: str
    ) -> None:
        """Let each stop set process signals to 0, and record them and their shadow signal.

        Args:
            restart: Receives the record.
            process: A digital output and four groups; None for each that was omitted.
            shadow: A digital output.
        """
        ...


class Motion(Protocol):
    """The path queue of the task's robot."""

    settings: MotionSettings

    @property
    def corrections(self) -> dict[int, Pos]:
        """Offset of the path [mm] by each connected correction generator."""
        ...

    def move(self, move: Move, triggers: tuple[Trigger, ...] = ()) -> None:
        """Append a move to the path; returns when the program may continue.

        Args:
            move: The move.
            triggers: Actions at places along the move.

        Raises:
            RapidError: Errors that a program can catch, such as a position outside reach.
        """
        ...

    def expect(self, targets: AnnouncedTargets) -> None:
        """Announce the targets of the next moves, which probably differ in nothing else."""
        ...

    def repeat(self, targets: AnnouncedTargets, number: int, most: int) -> int:
        """Make moves to announced targets like the last one, from a number on, at most so many.

        Returns:
            How many it makes: as many as nothing can come between; often none.
        """
        ...

    def current_joints(self) -> JointTarget:
        """Current positions of the axes."""
        ...

    def current_speeds(self) -> JointTarget:
        """Current speeds of the axes [deg/s or mm/s]."""
        ...

    def is_moving(self) -> bool:
        """Whether the robot has moves in progress."""
        ...

    def current_target(self, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        """Current robtarget of the TCP; None selects the tool or work object of the last move."""
        ...

    def active_tool(self) -> ToolData:
        """The tool of the last move, tool0 before the first."""
        ...

    def active_wobj(self) -> WobjData:
        """The work object of the last move, wobj0 before the first."""
        ...

    def active_names(self) -> tuple[str, str]:
        """Names of the active tool and the active work object in the program."""
        ...

    def activate(self, data: ToolData | WobjData, name: str) -> None:
        """Make a tool or work object, by its name in the program, the active one."""
        ...

    def programmed_end(self, tool: ToolData, wobj: WobjData) -> RobTarget:
        """Robtarget of the end of the path so far, without the offsets of correction generators."""
        ...

    def target_at(self, joints: JointTarget, tool: ToolData, wobj: WobjData) -> RobTarget:
        """Robtarget of the TCP with the axes at other positions."""
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

    def asking(self, instruction: str) -> AbstractContextManager[None]:
        """Context of an instruction that asks; its question is withdrawn at the end."""
        ...

    @property
    def has_answered(self) -> bool:
        """Whether a question that had no answer (None) has one by now."""
        ...

    def ask_number(self, prompt: str, *, ends: bool = False) -> float | None:
        """Ask the operator for a number; never hangs without an operator.

        None if there is no operator and the question has another end (`ends`); likewise in the
        methods below.
        """
        ...

    def ask_choice(self, prompt: str, choices: Sequence[str], *, ends: bool = False) -> int | None:
        """Ask for a key and return its index from 0; keys with the text "" are hidden.

        Without an operator it is the first visible key.
        """
        ...

    def ask_text(self, prompt: str, proposal: str, *, ends: bool = False) -> str | None:
        """Ask for a text; the proposal if there is no operator."""
        ...


DISK_BYTES = 1_000_000_000
"""The size of the controller's disk, which holds the home folder alone."""
DISK_FILES = 10_000
"""Maximum number of files and folders that a run may create there."""


class Interrupts(Protocol):
    """Interrupt numbers with their traps and orders."""

    intno: float
    """RAPID's INTNO."""
    call_procedure: Callable[[str], None]
    """Calls a procedure of the program by its name, like a trap; the interpreter sets it."""

    @property
    def in_trap(self) -> bool:
        """Whether a trap runs."""
        ...

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        """Book an interrupt number for a trap routine."""
        ...

    def is_connected(self, interrupt: float) -> bool:
        """Whether an interrupt number is connected to a trap routine, ordered or not."""
        ...

    def order_timer(self, interrupt: float, seconds: float, *, single: bool) -> None:
        """Raise an interrupt once, or periodically."""
        ...

    def order_signal(
        self,
        interrupt: float,
        signal: str,
        matches: Callable[[float], bool],
        *,
        single: bool,
    ) -> None:
        """Raise an interrupt once, or each time a signal changes to a value that matches."""
        ...

    def order_persistent(self, interrupt: float, data: Reference[object], *, single: bool) -> None:
        """Raise an interrupt once, or each time a persistent has changed."""
        ...

    def order_logged(self, interrupt: float, wanted: Callable[[LoggedError], bool]) -> None:
        """Raise an interrupt at each matching entry in the event log."""
        ...

    def log_error(self, entry: LoggedError) -> None:
        """Add an entry to the event log."""
        ...

    def trap_cause(self) -> LoggedError | None:
        """The event log entry that raised the current trap; None if it has another cause."""
        ...

    def delete_interrupt(self, interrupt: float) -> None:
        """Delete an interrupt and its order."""
        ...

    def sleep_interrupt(self, interrupt: float, *, asleep: bool) -> None:
        """Switch one interrupt off or on."""
        ...

    def make_safe(self, interrupt: float) -> None:
        r"""Protect an interrupt ordered with \SingleSafe from being put to sleep."""
        ...

    def hold_interrupts(self, *, hold: bool) -> None:
        """Queue all interrupts instead of serving them, or serve them again."""
        ...


class Signals(Protocol):
    """Inputs and outputs by name, ignoring case, and waiting for conditions on them."""

    def read_signal(self, name: str) -> float:
        """The current value of a signal."""
        ...

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Set an output now or after a delay, without waiting for it."""
        ...

    def is_missing(self, name: str) -> bool:
        """Whether a cell that declares its signals has none of this name."""
        ...

    def require_within(self, name: str, value: float) -> None:
        """Refuse a value outside the limits of an analog signal or a group."""
        ...

    def wait_for_signal(
        self, name: str, condition: Callable[[float], bool], *, max_time: float | None = None
    ) -> bool:
        """Let virtual time pass until the value of a signal satisfies a condition.

        Returns at the very instant, without polling; False if `max_time` [s] ran out first.
        """
        ...

    def wait_until(
        self, condition: Callable[[], bool], *, max_time: float | None = None, poll_s: float = 0.1
    ) -> bool:
        """Let virtual time pass until a condition holds; False if `max_time` [s] ran out first."""
        ...


class ErrorNumbers(Protocol):
    """ERRNO, and the error numbers that a program books for itself."""

    errno: float
    """RAPID's ERRNO."""
    retries: int
    """Number of retries of the statement whose ERROR clause runs."""
    handler: float
    """The clause of a routine that runs, as ExecHandler returns it."""

    def book_error_number(self) -> float:
        """The next free number, from `error_numbers.FIRST_BOOKED` up."""
        ...


ACCEPTED, STUB = "accepted without effect", "what its stub says"
"""First words of notes: for effects that no run shows, and for routines of stub modules."""


class FidelityReporter(Protocol):
    """Receives reports of routines that did less than on a controller."""

    def not_simulated(self, routine: str, treated_as: str, *, is_unknown: bool = False) -> None:
        """Report that a routine was not simulated and what was done instead."""
        ...


@dataclass(slots=True, eq=False)
class Controller:
    """The controller of one task, with a service for each concern."""

    clock: ClockService
    execution: ExecutionControl
    motion: Motion
    path_control: PathControl
    path_recorder: PathRecorder
    path_length: PathLength
    searches: Searches
    world_zones: WorldZones
    operator: Operator
    files: Files
    texts: Texts
    sockets: Sockets
    interrupts: Interrupts
    signals: Signals
    error_numbers: ErrorNumbers
    errors: ErrorReports
    tasks: TaskService
    sync_moves: SyncMoves
    fidelity: FidelityReporter
    equipment: Equipment
    axis_signals: AxisSignals
    smart_gripper: SmartGripper
    cyclic_bools: CyclicBools
    cameras: Cameras
    messages: Messages
    guidance: Guidance
    symbols: Symbols = field(init=False)
    """The data of the program by name; the interpreter sets it."""
    modules: Modules = field(init=False)
    """The program memory of the task; the interpreter sets it."""


CONCERNS: Mapping[type, str] = MappingProxyType(
    {
        ClockService: "clock",
        ExecutionControl: "execution",
        Motion: "motion",
        PathControl: "path_control",
        PathRecorder: "path_recorder",
        PathLength: "path_length",
        Searches: "searches",
        WorldZones: "world_zones",
        Operator: "operator",
        Files: "files",
        Texts: "texts",
        Sockets: "sockets",
        Interrupts: "interrupts",
        Signals: "signals",
        ErrorNumbers: "error_numbers",
        ErrorReports: "errors",
        TaskService: "tasks",
        SyncMoves: "sync_moves",
        FidelityReporter: "fidelity",
        Equipment: "equipment",
        AxisSignals: "axis_signals",
        SmartGripper: "smart_gripper",
        CyclicBools: "cyclic_bools",
        Cameras: "cameras",
        Messages: "messages",
        Guidance: "guidance",
    }
)
"""Attribute of `Controller` that has the concern of each protocol."""


def uniform_controller(implementation: Any) -> Controller:
    """A controller whose concerns are all one object, for tests and analyses without a run."""
    whole = Controller(**dict.fromkeys(CONCERNS.values(), implementation))
    whole.symbols = whole.modules = implementation
    return whole
