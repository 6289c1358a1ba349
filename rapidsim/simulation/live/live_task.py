"""One task of a controller that stays on: its program, its robot and its program pointer."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Protocol

from rapidsim.analysis.program import Program, RoutineSymbol
from rapidsim.controller.cell.cell import Cell, SignalListener
from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.diagnostics import Diagnostic
from rapidsim.interpreter.linking.loader import FatalError, Task, load, running
from rapidsim.interpreter.runtime.shared_persistents import SharedPersistents
from rapidsim.interpreter.tools.step_positions import StepGranularity
from rapidsim.interpreter.tools.stepping import Stepper
from rapidsim.language.errors import CycleEnded, ProgramReset, Stopped
from rapidsim.language.moves import Place
from rapidsim.simulation.live.jog_motion import JogMotion
from rapidsim.simulation.live.scheduler import LiveScheduler
from rapidsim.simulation.live.states import (
    ExecutionMode,
    RefusalReason,
    RequestRefused,
    TaskState,
)
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End
from rapidsim.simulation.task_run import TaskOutcome, TaskRun, TaskSetup, new_task_run, outcome_of
from rapidsim.station.task_kind import TaskEvent, TaskKind
from rapidsim.syntax import tree


class TaskSupervisor(Protocol):
    """Supervisor of tasks: decides on stops, cycles and failures."""

    def stop_by(self, task: LiveTask, reason: str, place: Place, every: bool) -> None:
        """Stop a task, or all, as its program requests at a place."""
        ...

    def cycle_ended(self) -> bool:
        """Handle the return of main; return whether it starts again at once."""
        ...

    def step_ended(self, task: LiveTask) -> None:
        """Handle the end of a step: the program is halted before its next statement."""
        ...

    def task_failed(self, task: LiveTask, findings: tuple[Diagnostic, ...], message: str) -> None:
        """Handle a program that cannot continue: its findings, and the cause in one line."""
        ...


_REACH = {
    ExecutionMode.STEP_IN: StepGranularity.ANY,
    ExecutionMode.STEP_OVER: StepGranularity.SAME_ROUTINE,
    ExecutionMode.STEP_OUT: StepGranularity.CALLER,
    ExecutionMode.STEP_MOTION: StepGranularity.SAME_ROUTINE,
}
_MOST_UNDO_S = 10.0
"""Time [s] that UNDO clauses may take when the program pointer is set elsewhere."""


@dataclass(eq=False)
class LiveTask:
    """A task of a live controller; `begin` sets its program pointer to main."""

    number: int
    setup: TaskSetup
    cell: Cell
    scheduler: LiveScheduler
    journal: Journal
    options: RunOptions
    unit: MechanicalUnit
    shared: SharedPersistents
    supervisor: TaskSupervisor
    run: TaskRun = field(init=False)
    task: Task | None = None
    """The program with its data; None if initial values fail."""
    failure: FatalError | None = None
    """Reason why the program could not be loaded."""
    is_active: bool = True
    """Whether the task takes part when programs are started."""
    has_pointer: bool = True
    """Whether the program pointer is at a statement from which the program can continue."""
    breakpoints: set[tuple[str, int]] = field(default_factory=set)
    """Module, in lower case, and line in it of statements before which the program halts; from the
    next start on."""
    has_ended: bool = False
    """Whether main has returned, and not been started again."""
    _jogged: tuple[JogMotion, ...] = ()
    """Steps of the robot in manual mode that have not ended, in order of time."""
    _begins_again: bool = False
    """Whether a start after the end of main lets main begin again."""
    _has_started: bool = False
    _execution: ExecutionMode = ExecutionMode.CONTINUE
    _stepper: Stepper = field(init=False)
    _routine: str = ""
    """Routine that the pointer was set to; empty for the entry."""
    _own_listeners: tuple[SignalListener, ...] = ()
    _findings: tuple[Diagnostic, ...] = ()
    _failed_moves: tuple[FailedMove, ...] = ()

    def __post_init__(self) -> None:
        """Create the stepper, which is inactive."""
        self._stepper = Stepper(self._halt)

    @property
    def name(self) -> str:
        """Name in the station file."""
        return self.setup.name

    @property
    def is_normal(self) -> bool:
        """Whether the type is NORMAL; other tasks run as long as the controller is on."""
        return self.setup.kind is TaskKind.NORMAL

    @property
    def has_started(self) -> bool:
        """Whether the program was started since its pointer was set to main or a routine."""
        return self._has_started

    @property
    def executes(self) -> bool:
        """Whether the program is executing."""
        return self._has_started and not self.run.controller.execution.is_halted

    @property
    def is_stepping(self) -> bool:
        """Whether the program executes one step."""
        return self.executes and self._execution is not ExecutionMode.CONTINUE

    @property
    def outcome(self) -> TaskOutcome:
        """Outcome of the task if the controller were switched off now."""
        end = End.STOPPED if self.has_pointer else End.ERROR
        return TaskOutcome(end, self._findings, self._failed_moves, self.task)

    @property
    def place(self) -> Place:
        """Position of the program pointer."""
        return self.run.controller.clock.place

    @property
    def program(self) -> Program:
        """The loaded program; if its initial values failed, that of the setup."""
        return self.setup.program if self.task is None else self.task.program

    @property
    def entry(self) -> str:
        """Procedure that the program begins with."""
        return self.setup.entry or self.options.entry

    def state(self) -> TaskState:
        """State of the task, as clients see it."""
        return TaskState(
            self.name,
            self.setup.kind.value,
            self.failure is None,
            self.has_pointer,
            self.executes,
            self.is_active,
            self.setup.robot is not None,
        )

    def begin(self, refresh_percent: float) -> None:
        """Set the pointer to main: variables are initialised, persistents kept.

        Args:
            refresh_percent: The operator's speed ratio.
        """
        self._end()
        self._routine = ""
        before = len(self.cell.listeners)
        self.run = new_task_run(self.setup, self.unit, self.cell, self.journal, self.options)
        self._own_listeners = tuple(self.cell.listeners[before:])
        controller = self.run.controller
        controller.clock.set(self.scheduler.now_s)
        controller.execution.stops = partial(self.supervisor.stop_by, self)
        controller.execution.resumed = self._continue_execution
        controller.execution.halted = self._after_stop
        controller.execution.restarted = self._before_continuing
        self.set_speed_ratio(refresh_percent)
        old, self.failure = self.task, None
        try:
            self.task = load(self.program, controller.concerns, self.shared)
        except FatalError as error:
            self.failure = error
        else:
            if old is not None:
                self.task.keep(old)
        self.has_pointer = self._procedure(self.entry) is not None

    def put_pointer(self, module: str, routine: str, refresh_percent: float) -> None:
        """Set the pointer to a procedure; variables are initialised, as for main.

        Args:
            module: Module that declares it; empty for any.
            routine: Its name, in any case.
            refresh_percent: The operator's speed ratio.

        Raises:
            RequestRefused: If there is no such procedure without parameters.
        """
        symbol = self._procedure(routine)
        if symbol is None or module.lower() not in ("", symbol.module.name.key):
            raise RequestRefused(RefusalReason.NO_SYMBOL, self._nothing_to_begin_with(routine))
        self.begin(refresh_percent)
        self._routine, self.has_pointer = symbol.name, True
        place = Place(symbol.module.span(symbol.node.name), symbol.name)
        self.run.controller.clock.place = place

    def _end(self) -> None:
        """Unload the program; its robot discards the rest of its path."""
        self._has_started = self.has_pointer = self.has_ended = False
        if not hasattr(self, "run"):
            return
        clock = self.run.controller.clock
        self._leave_routines()
        now_s = self.scheduler.now_s
        self.scheduler.remove(clock)
        self.run.controller.files.close_all()
        self.run.controller.sockets.close_all(now_s)
        self.unit.end_guidance()
        self.run.controller.guidance.forget_all()
        self.cell.watchdog.forget(clock)
        # By identity: two tables without interrupts are equal.
        own, self._own_listeners = {id(one) for one in self._own_listeners}, ()
        self.cell.forget(own)
        self.unit.part()
        with suppress(MotionError):
            if self.unit.queue.is_open and not self.unit.queue.is_halted:
                self.unit.halt(now_s)
        self.unit.drop_paths()
        self.unit.clear()
        self.unit.resume(now_s)

    def _leave_routines(self) -> None:
        """Run the UNDO clauses of the routines in which the program is halted, or has ended."""
        execution, clock = self.run.controller.execution, self.run.controller.clock
        if not self.is_normal:
            return
        if not execution.is_halted:
            if self.task is None or not self.task.has_ended_within:
                return
            clock.set(self.scheduler.now_s)
            self.scheduler.add(self.number, clock, partial(self._undo_ended, self.task))
        execution.leave()
        if not self.scheduler.finish(clock, self.scheduler.now_s + _MOST_UNDO_S):
            message = f"its UNDO clauses take more than {_MOST_UNDO_S:g} s; the rest is left out"
            self.supervisor.task_failed(self, (), message)

    def start(self, how: ExecutionMode = ExecutionMode.CONTINUE) -> None:
        """Start at main, or continue where the program stopped: for one step, or until it stops."""
        self._execution, self._begins_again, self.has_ended = how, self.has_ended, False
        execution, clock = self.run.controller.execution, self.run.controller.clock
        if self._has_started:
            execution.resume()
            self.scheduler.wake(clock)
            return
        self._has_started = True
        clock.set(max(self.scheduler.now_s, clock.pointer_s()))
        self.scheduler.add(self.number, clock, self._execute)

    def stop(self, *, on_path: bool, is_quick: bool = False) -> None:
        """Stop now; see `TaskExecution.request_stop`."""
        if self._has_started:
            self.run.controller.execution.request_stop(
                self.scheduler.now_s, on_path=on_path, is_quick=is_quick
            )
            self.scheduler.wake(self.run.controller.clock)

    def halt_jogging(self) -> None:
        """Brake a robot that is jogged; steps that it has not begun are discarded."""
        for motion in reversed(self._jogged):
            motion.halt(self.scheduler.now_s)
        self._jogged = ()

    def add_jogging(self, motion: JogMotion) -> None:
        """Take note of a step that the robot makes after the others."""
        now_s = self.scheduler.now_s
        going = (one for one in self._jogged if one.section.end_s > now_s)
        self._jogged = (*going, motion)

    def forget(self, before_s: float) -> None:
        """Discard the robot's history before a time [s], unless it may still move back along it."""
        self.run.controller.path_length.count_to(before_s)
        self.unit.forget(before_s, self.run.controller.recorder.first)

    def set_speed_ratio(self, percent: float) -> None:
        """Set the speed of later moves, in percent of the programmed speed."""
        motion = self.run.controller.motion
        motion.settings = replace(motion.settings, speed_refresh_percent=percent)

    def _continue_execution(self) -> None:
        """Continue, for one step or until stopped, where the program was halted."""
        if self._execution is ExecutionMode.CONTINUE:
            self._stepper.end()
            if self.breakpoints and self.scheduler.trace is None:
                self._stepper.run_to(self._is_break)
            return
        given, moves = len(self.unit.moves), self.unit.moves
        to_move = self._execution is ExecutionMode.STEP_MOTION and self.setup.robot is not None
        self._stepper.begin(
            _REACH[self._execution], (lambda: len(moves) > given) if to_move else None
        )

    def module_line(self, place: Place) -> tuple[str, int] | None:
        """Return module and line in its text, from 1, of a place; None if no module has it."""
        for one in self.program.modules:
            if one.source.file == place.span.file and one.start <= place.span.start <= one.end:
                first = one.source.text.count("\n", 0, one.start)
                return one.name.text, place.span.line - first
        return None

    def _is_break(self, place: Place) -> bool:
        found = self.module_line(place)
        return found is not None and (found[0].lower(), found[1]) in self.breakpoints

    def _halt(self, before: Place) -> None:
        """End a step, or halt at a breakpoint: the robot finishes its moves, the program halts."""
        if self.run.controller.execution.is_leaving:
            return
        clock, left = self.run.controller.clock, self.run.controller.clock.ticks_left
        clock.resolve_time()
        clock.drive_to_stop()
        clock.place = before
        self.supervisor.step_ended(self)
        self.run.controller.execution.await_restart()
        clock.leave_ticks(left)

    def procedures(self) -> Iterator[str]:
        """Names of the procedures to which the pointer may be set, in the order of declaration."""
        for symbol in self.program.routines.values():
            if self._procedure(symbol.name) is not None:
                yield symbol.name

    def _after_stop(self, is_quick: bool) -> None:
        """Call the event routines of a stop, but for one at the end of main or of a step."""
        if not self.has_ended and self._execution is ExecutionMode.CONTINUE:
            self._call_event_routines(TaskEvent.QUICK_STOP if is_quick else TaskEvent.STOP)

    def _before_continuing(self) -> None:
        """Call the event routines of a start, but for that of a step."""
        if self._execution is ExecutionMode.CONTINUE:
            event = TaskEvent.START if self._begins_again else TaskEvent.RESTART
            self._call_event_routines(event)

    def _call_event_routines(self, event: TaskEvent) -> None:
        """Call the routines of an event; those that the program lacks are left out."""
        for one, name in self.setup.events:
            if one is event and self.task is not None and self._procedure(name) is not None:
                with suppress(CycleEnded):
                    self.task.run(name)

    def _procedure(self, name: str) -> RoutineSymbol | None:
        """Procedure of a name, in any case, that needs no arguments; None if there is none."""
        symbol = self.program.routines.get(name.lower())
        if symbol is None or not isinstance(symbol.node, tree.Proc):
            return None
        return None if any(not one.optional for one in symbol.parameters) else symbol

    def _nothing_to_begin_with(self, name: str) -> str:
        return f"{self.name} has no procedure {name} to begin with"

    def _execute(self) -> None:
        """Run the program, cycle after cycle; the body of its greenlet."""
        clock, execution = self.run.controller.clock, self.run.controller.execution
        found: tuple[Diagnostic, ...] = ()
        message = ""
        try:
            if self.failure is not None:
                raise self.failure
            assert self.task is not None
            with running():
                self._continue_execution()
                self._call_event_routines(TaskEvent.START)
                while True:
                    routine, self._routine = self._routine, ""
                    if not routine and self._procedure(self.entry) is None:
                        # Its module has been unloaded.
                        message = self._nothing_to_begin_with(self.entry)
                        break
                    with suppress(CycleEnded):
                        self.task.run(routine or self.entry)
                    # A routine that a client has chosen runs once only.
                    goes_on = self.supervisor.cycle_ended() and not routine
                    clock.tick()
                    if goes_on or not self.is_normal:
                        continue
                    with suppress(CycleEnded):
                        self.run.controller.motion.finish()
                    self.has_ended = True
                    execution.await_restart()
        except (FatalError, MotionError, Stopped) as error:
            if execution.is_leaving and isinstance(error, ProgramReset):
                return
            found, message = self._ended_by(error)
        except Exception as error:
            # A defect of rapidsim ends this program, not the controller.
            message = f"rapidsim has a defect: {type(error).__name__}: {error}"
        finally:
            self._stepper.end()
        self._has_started = self.has_pointer = False
        self.supervisor.task_failed(self, found, message)

    def _undo_ended(self, task: Task) -> None:
        """Run the UNDO clauses of a program that has ended; the body of a greenlet of its own."""
        try:
            task.undo_ended()
        except (FatalError, MotionError, Stopped) as error:
            self.supervisor.task_failed(self, *self._ended_by(error))

    def _ended_by(
        self, error: FatalError | MotionError | Stopped
    ) -> tuple[tuple[Diagnostic, ...], str]:
        """Record what ends the program; return its findings, and the cause in one line."""
        ended = outcome_of(error, self.run)
        if self.journal.retains_all:
            self._findings += ended.findings
            self._failed_moves += ended.failed_moves
        return ended.findings, ended.findings[0].message if ended.findings else str(error)
