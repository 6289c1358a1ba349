"""Controller that stays on: requests of an operator, or of a client over the network.

It knows neither the wall clock nor the network. Its owner advances virtual time (`advance`) and
makes requests in between, which take effect at the time reached.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import InitVar, dataclass, field, replace
from datetime import datetime, timedelta

from rapidsim.controller.cell.cell import CELL_TASK, Cause, Cell
from rapidsim.controller.cell.external_streams import ExternalStreams, NullWire, Wire
from rapidsim.controller.cell.outside_datagrams import OutsideMailboxes
from rapidsim.controller.cell.pendant import Pendant
from rapidsim.controller.cell.rendezvous import RendezvousTable
from rapidsim.controller.cell.sensors import GuidanceSensors, NoSensors
from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.controller.journal.journal import Instant, Journal, Moment
from rapidsim.controller.queue.motion_queue import REMEMBERED_S
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError
from rapidsim.interpreter.runtime.shared_persistents import SharedPersistents, shared_persistents
from rapidsim.language.error_log import LoggedError
from rapidsim.language.errors import Stopped
from rapidsim.language.moves import Place
from rapidsim.simulation.live import event_log
from rapidsim.simulation.live.event_log import EventLog, LogEntry
from rapidsim.simulation.live.faults import LiveFaults
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.panel import Panel
from rapidsim.simulation.live.restart import restart
from rapidsim.simulation.live.scheduler import LiveScheduler
from rapidsim.simulation.live.states import (
    ControllerState,
    Cycle,
    ExecutionMode,
    Motors,
    OperatingMode,
    RefusalReason,
    RequestRefused,
    StopMode,
    TaskState,
)
from rapidsim.simulation.live.system_inputs import SystemInputs
from rapidsim.simulation.live.system_outputs import status_value
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.result_builder import FinishedRun, build_result
from rapidsim.simulation.shared_access import ScheduledAccess
from rapidsim.simulation.task_run import TaskSetup, require_limits, unit_of

_SCREEN_LINES = 100


def _ignore(entry: LogEntry | Event | Diagnostic) -> None:
    """A listener that ignores everything."""


@dataclass(eq=False)
class LiveController:
    """A controller with motors on, in automatic mode, pointers at main, and no program started."""

    setups: Sequence[TaskSetup]
    options: RunOptions
    on_log_entry: Callable[[LogEntry], None] = _ignore
    """Called with each entry of the event log."""
    happened: Callable[[Event], None] = _ignore
    """Called with each event of the run, once its time is known."""
    on_finding: Callable[[Diagnostic], None] = _ignore
    """Called with each finding that does not end a run, once for each rule and place."""
    motors: InitVar[Motors] = Motors.ON
    mode: InitVar[OperatingMode] = OperatingMode.AUTO
    cycle: Cycle = Cycle.FOREVER
    wire: Wire = field(default_factory=NullWire)
    """The network of the programs' sockets."""
    sensors: GuidanceSensors = field(default_factory=NoSensors)
    keeps_all: bool = False
    """Whether all events and motion are kept for `finished`; memory then grows without bound."""
    has_clients: bool = True
    """Whether clients answer questions and are the peers of sockets; else the options say who is,
    and limit the run in wall-clock time."""
    cell: Cell = field(init=False)
    pendant: Pendant = field(init=False, default_factory=Pendant)
    """Questions that wait for an answer."""
    screen: deque[str] = field(init=False, default_factory=lambda: deque(maxlen=_SCREEN_LINES))
    """Lines that programs have written on the FlexPendant, the newest last."""
    external_streams: ExternalStreams = field(init=False)
    mailboxes: OutsideMailboxes = field(init=False)
    log: EventLog = field(init=False)
    panel: Panel = field(init=False)
    tasks: dict[str, LiveTask] = field(init=False, default_factory=dict)
    """Tasks by folded name, in the order of the station."""
    scheduler: LiveScheduler = field(init=False)
    faults: LiveFaults = field(init=False)
    stopped_by: tuple[str, Place] | None = None
    """Instruction that has stopped the programs last, and its place; None if none has."""
    _journal: Journal = field(init=False)
    _acts: deque[Callable[[], None]] = field(default_factory=deque)
    """Acts outside of all programs that are due at the present time."""
    _is_acting: bool = False
    _ends_with_cycle: bool = False
    _shows_executing: bool = False
    _forgets_s: float = 0.0
    """Time [s] at which the robots' history is discarded next."""
    _events: list[Event] = field(default_factory=list)

    def __post_init__(self, motors: Motors, mode: OperatingMode) -> None:
        """Switch the controller on.

        Raises:
            InputError: If an arm cannot be timed, or no task moves one.
        """
        max_wall_s = None if self.has_clients else self.options.max_wall_s
        self.options = replace(self.options, max_time_s=math.inf, max_wall_s=max_wall_s)
        self._journal = Journal(
            self.setups[0].name, self.keeps_all, on_finding=lambda found: self.on_finding(found)
        )
        self.cell = Cell(self.options.cell, self._journal)
        self.cell.has_clients = True
        self.cell.logbook = lambda task, entry, time_s: self.log.written(entry, time_s)
        self.log = EventLog(lambda entry: self.on_log_entry(entry))
        self.panel = Panel(self, self.log, ControllerState(motors), mode)
        self.scheduler = LiveScheduler(self.cell)
        self.cell.attach_scheduler(self.scheduler)
        self.external_streams = ExternalStreams(self.wire)
        self.mailboxes = OutsideMailboxes(self.wire)
        if self.has_clients:
            self.cell.pendant = self.pendant
            self.cell.sockets.external = self.external_streams
            self.cell.datagrams.outside = self.mailboxes
            self.cell.sensors = self.sensors
        arms = [setup.robot for setup in self.setups if setup.robot is not None]
        if not arms:
            raise InputError("no task moves a robot", "give one of them `motion = true`")
        for arm in arms:
            require_limits(arm, self.options)
        shared = self._shared()
        for number, setup in enumerate(self.setups):
            journal = self._journal if number == 0 else self._journal.for_task(setup.name)
            self.tasks[setup.name.lower()] = LiveTask(
                number,
                setup,
                self.cell,
                self.scheduler,
                journal,
                self.options,
                unit_of(setup, arms[0], self.cell, journal, self.options),
                shared,
                self,
            )
        for task in self.tasks.values():
            task.begin(self.panel.refresh_percent)
        self._link_tasks()
        self._show_states()
        # A log is never empty: public clients remember the number of its newest entry.
        self.log.operational(event_log.OF_MODE[mode], self.now_s, "")
        self.log.operational(event_log.OF_STATE[self.panel.state], self.now_s, "")
        for task in self.tasks.values():
            if not task.is_normal:
                task.start()
        inputs = {one.name.lower(): one for one in self.options.io.signals if one.action}
        self.cell.listeners.append(SystemInputs(self, inputs))
        self.faults = LiveFaults(self, self._journal.for_task(CELL_TASK))

    # Time.

    @property
    def now_s(self) -> float:
        """The virtual time [s]."""
        return self.scheduler.now_s

    @property
    def date(self) -> datetime:
        """Date and time that the controller's clock shows."""
        return self.date_at(self.now_s)

    def date_at(self, time_s: float) -> datetime:
        """Return the date and time that the controller's clock shows at a virtual time [s]."""
        return self.cell.starts_at + timedelta(seconds=math.floor(time_s))

    def set_date(self, date: datetime) -> None:
        """Set the controller's clock; virtual time is unaffected."""
        self.cell.starts_at = date - timedelta(seconds=math.floor(self.now_s))

    @property
    def next_due_s(self) -> float:
        """Time [s] of the next event; infinite if there is none."""
        return self.now_s if self._acts else self.scheduler.due_s()

    def step(self, until_s: float) -> bool:
        """Dispatch one event that is due by a time [s]; return whether there was one."""
        stepped = self.scheduler.step(until_s)
        if self._acts and not self._is_acting:
            self._act()
            stepped = True
        if not self.keeps_all and self.now_s >= self._forgets_s:
            self._forgets_s = self.now_s + REMEMBERED_S
            for task in self.tasks.values():
                task.forget(self.now_s - REMEMBERED_S)
        events = self._journal.take()
        if self.keeps_all:
            self._events.extend(events)
        for event in events:
            if event.kind is EventKind.TEXT:
                self._show(event)
            self.happened(event)
        if self.executes is not self._shows_executing:
            self._show_states()
        return stepped

    def _show(self, event: Event) -> None:
        if event.details.get("cleared"):
            self.screen.clear()
        else:
            self.screen.append(event.message)

    def soon(self, act: Callable[[], None]) -> None:
        """Do something at the present time, outside of all programs; see `FaultOwner`."""
        self._acts.append(act)

    def _act(self) -> None:
        self._is_acting = True
        try:
            while self._acts:
                self._acts.popleft()()
        finally:
            self._is_acting = False

    def advance(self, until_s: float) -> None:
        """Advance virtual time to a time [s] and dispatch all events due by then."""
        while self.step(until_s):
            pass

    def settle(self) -> None:
        """Dispatch all events that are due now."""
        self.advance(self.now_s)

    def restart(self, *, cold: bool) -> None:
        """Restart; see `restart.restart`."""
        restart(self, cold=cold)

    # Programs.

    @property
    def normal_tasks(self) -> Iterator[LiveTask]:
        """Active tasks of type NORMAL: those that start and stop together."""
        return (one for one in self.tasks.values() if one.is_normal and one.is_active)

    @property
    def executes(self) -> bool:
        """Whether any normal task is executing."""
        return any(one.executes for one in self.normal_tasks)

    def start(
        self, cycle: Cycle | None = None, how: ExecutionMode = ExecutionMode.CONTINUE
    ) -> None:
        """Start the programs, from main or from where they stopped.

        Args:
            cycle: Cycle mode after the end of main; None for the current one.
            how: Until they are stopped, or for one step of each task.

        Raises:
            RequestRefused: In a state that forbids it.
        """
        tasks = list(self.normal_tasks)
        if how is not ExecutionMode.CONTINUE and self.scheduler.trace is not None:
            raise RequestRefused(RefusalReason.STATE, "steps are those of the attached debugger")
        if self.panel.state is not ControllerState.MOTORS_ON:
            raise RequestRefused(RefusalReason.STATE, "the motors are off")
        if not tasks:
            raise RequestRefused(RefusalReason.STATE, "no normal task is active")
        if self.executes:
            # Those that their programs have stopped may continue.
            tasks = [one for one in tasks if not (one.executes or one.has_ended)]
        if not tasks:
            raise RequestRefused(RefusalReason.STATE, "the program executes already")
        if any(not one.has_pointer for one in tasks):
            raise RequestRefused(RefusalReason.STATE, "the program pointer is lost; set it to main")
        self.cycle = cycle or self.cycle
        self._ends_with_cycle, self.stopped_by = False, None
        for task in tasks:
            code = event_log.STARTED_AGAIN if task.has_started else event_log.STARTED_FROM_MAIN
            self.log.operational(code, self.now_s, f"{task.name} has been started.", task.name)
            task.start(how)
        self._show_states()
        self.settle()

    def stop(self, how: StopMode = StopMode.STOP) -> None:
        """Stop the programs of the normal tasks; does nothing if none is executing."""
        if how is StopMode.CYCLE:
            self._ends_with_cycle = True
            return
        self._stop_tasks(self.normal_tasks, "", how)
        self.settle()
        self._show_states()

    def reset_pointers(self, name: str = "") -> None:
        """Set the program pointers of all normal tasks, or of one, to main.

        Raises:
            RequestRefused: While a program executes, or if there is no such task.
        """
        self._require_stopped()
        if not name:
            self.cell.rendezvous = RendezvousTable()
        chosen = [self.task(name)] if name else self.tasks.values()
        self.begin_tasks([task for task in chosen if task.is_normal])

    def begin_tasks(self, tasks: Iterable[LiveTask], *, keeps_data: bool = True) -> None:
        """Set the program pointers of tasks to main; persistents keep their values, or do not."""
        if not keeps_data:
            shared = self._shared()
            for task in self.tasks.values():
                task.shared, task.task = shared, None
        for task in tasks:
            task.begin(self.panel.refresh_percent)
        self._link_tasks()
        self._show_states()

    def switch_off(self) -> None:
        """Stop the robots, end the programs, close files and connections."""
        self.stop(StopMode.QUICK)
        for task in self.tasks.values():
            self.scheduler.remove(task.run.controller.clock)
            task.run.controller.sockets.close_all(self.now_s)
            task.run.controller.guidance.forget_all()
        self.cell.close()

    def finished(self) -> FinishedRun:
        """Return the result of the run; requires `keeps_all`, and `switch_off` before."""
        self._journal.restore(self._events)
        runs = [one.run for one in self.tasks.values()]
        outcomes = [one.outcome for one in self.tasks.values()]
        self.cell.detach_scheduler()
        return build_result(runs, outcomes, self.cell, self.now_s, self.options)

    def put_pointer(self, task: str, module: str, routine: str) -> None:
        """Set the program pointer of a normal task to a routine of a module, or of any module.

        Raises:
            RequestRefused: While a program executes, or if there is no such procedure.
        """
        self._require_stopped()
        found = self.task(task)
        if not found.is_normal:
            raise RequestRefused(
                RefusalReason.STATE, f"{found.name} is neither started nor stopped"
            )
        found.put_pointer(module, routine, self.panel.refresh_percent)
        self._link_tasks()
        self._show_states()

    def stopped_task(self, name: str) -> LiveTask:
        """Return a task whose program may be changed: see `program_memory`.

        Raises:
            RequestRefused: While a program executes, or if there is no such task.
        """
        self._require_stopped()
        return self.task(name)

    def task(self, name: str) -> LiveTask:
        """Return a task by name, in any case.

        Raises:
            RequestRefused: If there is no such task.
        """
        task = self.tasks.get(name.lower())
        if task is None:
            raise RequestRefused(RefusalReason.NO_TASK, f"there is no task {name}")
        return task

    def activate(self, name: str | None, *, active: bool) -> None:
        """Activate or deactivate a normal task, or all if the name is None.

        Raises:
            RequestRefused: If there is no such task, or while a program executes.
        """
        chosen = list(self.tasks.values()) if name is None else [self.task(name)]
        self._require_stopped()
        for task in chosen:
            if task.is_normal:
                task.is_active = active

    def task_states(self) -> tuple[TaskState, ...]:
        """States of all tasks, as clients see them."""
        return tuple(task.state() for task in self.tasks.values())

    def apply_speed_ratio(self) -> None:
        """Let later moves have the speed of the panel."""
        for task in self.tasks.values():
            task.set_speed_ratio(self.panel.refresh_percent)

    def panel_changed(self) -> None:
        """Show a state in system outputs; see `PanelOwner`."""
        self._show_states()

    def log_error(self, entry: LoggedError) -> None:
        """Put an entry into the event log, which raises the interrupts that wait for it."""
        self.cell.log(CELL_TASK, entry, self.now_s)

    # Inputs from operators and clients.

    def answer(self, task: str, text: str) -> None:
        """Answer the question of a task.

        Raises:
            LookupError: If the task has no open question.
            ValueError: If the text is no answer to it.
        """
        self.pendant.answer(task, text)
        self.wake_programs()

    def wake_programs(self) -> None:
        """Wake the programs after a change from outside that they may be waiting for."""
        self.cell.notify(Moment(Instant(self.now_s)))
        self.settle()

    def change_signal(self, name: str, value: float) -> None:
        """Change a signal now.

        Raises:
            RequestRefused: On a trap storm, which stops the programs.
        """
        cause = Cause(self._journal.for_task(CELL_TASK))
        moment = Moment(Instant(self.now_s))
        try:
            self.cell.set_signal(cause, moment, name, value)
        except Stopped as storm:
            self.stop(StopMode.STOP)
            raise RequestRefused(RefusalReason.STATE, storm.reason) from None

    # Notifications from tasks: implements `live_task.TaskSupervisor`.

    def stop_by(self, task: LiveTask, reason: str, place: Place, every: bool) -> None:
        """Stop a task, or all, as its program requests at a place."""
        self.stopped_by = reason, place
        self._stop_tasks(self.normal_tasks if every else (task,), f" by {reason}", StopMode.STOP)

    def _stop_tasks(self, tasks: Iterable[LiveTask], by: str, how: StopMode) -> None:
        for task in tasks:
            task.halt_jogging()
            if task.executes:
                task.stop(on_path=how is not StopMode.INSTRUCTION, is_quick=how is StopMode.QUICK)
                text = f"{task.name} has been stopped{by}."
                self.log.operational(event_log.STOPPED, self.now_s, text, task.name)

    def cycle_ended(self) -> bool:
        """Return whether main starts again at once after its end."""
        return self.cycle is Cycle.FOREVER and not self._ends_with_cycle

    def step_ended(self, task: LiveTask) -> None:
        """Log that a step has ended."""
        text = f"{task.name} is ready with this step."
        self.log.operational(event_log.STEPPED, self.now_s, text, task.name)

    def task_failed(self, task: LiveTask, findings: tuple[Diagnostic, ...], message: str) -> None:
        """Stop all tasks and log the reason, after the program of one task failed."""
        for one in findings:
            entry = self.log.finding(one, self.now_s, task.name)
            self.cell.error_logged(entry, self.now_s)
        self.log.execution_error(self.now_s, task.name, message)
        for other in self.normal_tasks:
            if other is not task and other.executes:
                other.stop(on_path=True)
        self._show_states(failed=task.name)

    # Private.

    def _require_stopped(self) -> None:
        if self.executes:
            raise RequestRefused(RefusalReason.STATE, "the program executes")

    def _shared(self) -> SharedPersistents:
        programs = [setup.program for setup in self.setups]
        # Clients may write all of them.
        return shared_persistents(
            programs, ScheduledAccess(self.scheduler), [None for _ in programs]
        )

    def _link_tasks(self) -> None:
        others = {key: one.run.controller.coordination for key, one in self.tasks.items()}
        for one in others.values():
            one.neighbours = others

    def _show_states(self, failed: str | None = None) -> None:
        """Update the system outputs."""
        self._shows_executing = self.executes
        has_failed = failed is not None or not all(one.has_pointer for one in self.tasks.values())
        for signal in self.options.io.signals:
            of = self.tasks.get((signal.task or "").lower(), self)
            value = status_value(
                signal.status, executes=of.executes, failed=has_failed, panel=self.panel
            )
            if value is not None and value != self.cell.signals.read(signal.name):
                self.change_signal(signal.name, value)
