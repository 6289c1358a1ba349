"""State that all tasks of a cell share: signals and their sources, home folder, operator.

A signal change triggers everything that depends on it at the same instant: connected signals,
interrupts, and stimuli whose condition becomes true. Future changes are kept in one list; a task
dispatches them while it passes time, through `scheduler`, so that tasks can share one clock.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Set
from types import FrameType
from typing import Protocol

from rapidsim.controller.cell.camera_scripts import camera_state
from rapidsim.controller.cell.conveyors import SWITCH_S, ConveyorState
from rapidsim.controller.cell.datagrams import DatagramTable
from rapidsim.controller.cell.description import (
    CrossConnection,
    SignalDeclaration,
    Status,
    Stimulus,
)
from rapidsim.controller.cell.due_occasions import DueOccasion, Occasions
from rapidsim.controller.cell.faults import Fault
from rapidsim.controller.cell.finger_motion import Fingers
from rapidsim.controller.cell.home_folder import HomeFolder
from rapidsim.controller.cell.inputs import CellInputs
from rapidsim.controller.cell.message_queues import MessageQueues
from rapidsim.controller.cell.operator import OperatorDialog
from rapidsim.controller.cell.pendant import Pendant
from rapidsim.controller.cell.rendezvous import RendezvousTable
from rapidsim.controller.cell.sensors import GuidanceSensors, NoSensors
from rapidsim.controller.cell.signals import SignalTable
from rapidsim.controller.cell.streams import SocketTable
from rapidsim.controller.cell.system_parameters import SystemParameters
from rapidsim.controller.cell.text_tables import TextTables
from rapidsim.controller.cell.watchdog import Watchdog
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Instant, Journal, Moment
from rapidsim.language.error_log import LoggedError
from rapidsim.language.moves import Place
from rapidsim.values import value_class

CELL_TASK = "cell"
"""Used in place of a task's name for events that no task causes."""


class SignalListener(Protocol):
    """Receives signal changes (interrupts, searches)."""

    def listens_to(self, signal: str) -> bool:
        """Whether changes of this signal matter."""
        ...

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """Handle a change of a signal for which `listens_to` is true."""
        ...


class EventLogListener(Protocol):
    """Receives event-log entries that may raise interrupts."""

    @property
    def is_listening(self) -> bool:
        """Whether any entry may raise an interrupt."""
        ...

    def error_logged(self, entry: LoggedError, now_s: float) -> None:
        """Handle a new entry of the event log."""
        ...


class SampledSignal(Protocol):
    """Test signal of an axis."""

    def value(self, now_s: float, reader: object) -> float:
        """Value sampled last before a time [s], for the task that reads it."""
        ...


class TimeScheduler(Protocol):
    """Grants time advances. A multitasking scheduler replaces it."""

    def request_advance(self, task: object, time_s: float) -> float:
        """Let the other tasks catch up to a time [s].

        Returns:
            Time up to which the task may advance: the requested time, or an earlier one if an event
            that may matter to it has happened by then. Infinite if infinity was requested and no
            event follows.
        """
        ...

    def next_s(self, task: object) -> float:
        """Time [s] at which the next of the other tasks is due; infinite if none is."""
        ...

    def wake_at(self, time_s: float) -> None:
        """Wake the other tasks at the time [s] of an event."""
        ...

    def mark_waiting(self, task: object) -> bool:
        """Note that a task waits for others; returns whether all tasks do."""
        ...

    @property
    def current(self) -> object:
        """The running task; None if only one can run."""
        ...

    def frame_of(self, task: object) -> FrameType | None:
        """Python frame at which a task is suspended; None if it runs, or has ended."""
        ...


class SingleTaskScheduler:
    """Scheduler of a cell with one task."""

    current: object = None

    def request_advance(self, task: object, time_s: float) -> float:
        """Grant the requested time."""
        del task
        return time_s

    def next_s(self, task: object) -> float:
        """Return infinity: there are no other tasks."""
        del task
        return math.inf

    def wake_at(self, time_s: float) -> None:
        """Do nothing: there are no other tasks."""

    def mark_waiting(self, task: object) -> bool:
        """Return True: the only task waits."""
        del task
        return True

    def frame_of(self, task: object) -> FrameType | None:
        """Return None: the only task is never suspended."""
        del task
        return None


@value_class(frozen=True, slots=True)
class Cause:
    """Origin of a change: a task and the statement, or the station."""

    journal: Journal
    place: Place | None = None

    @property
    def description(self) -> str:
        """Task and line, or the station, as text."""
        if self.place is None:
            return "the station" if self.journal.task == CELL_TASK else self.journal.task
        return f"{self.journal.task}, {self.place.span.file}:{self.place.span.line}"


@value_class(frozen=True, slots=True)
class _Change:
    """Last change of a signal: text, moment and cause."""

    kind: str
    moment: Moment
    cause: Cause


@value_class(frozen=True, slots=True)
class _ScheduledChange:
    """A change scheduled for a moment."""

    moment: Moment
    act: Callable[[Moment], None]
    signals: tuple[str, ...]
    """Folded names of the signals it may change."""


class Cell:
    """The signals, the environment of the robot, and the dependencies between them.

    Its future changes are an `event_source.EventSource` of every task.
    """

    on_path = False

    def __init__(self, inputs: CellInputs, journal: Journal) -> None:
        """Set the cell up at time zero; changes without a task are recorded next to `journal`."""
        self.max_time_s = inputs.max_time_s
        self.watchdog = Watchdog(inputs.max_wall_s, lambda: journal.noted, inputs.max_work_s)
        self.signals = SignalTable(inputs.io.signals)
        self.home = HomeFolder(inputs.home, inputs.ramdisk)
        self.operator = OperatorDialog(inputs.answers, inputs.answers_are_typed)
        self.pendant: Pendant | None = None
        """Queue of questions to clients; None if answers are scripted or missing."""
        self.texts = TextTables()
        scripts = inputs.io.sockets
        streams = [script for script in scripts if not script.is_datagrams]
        self.sockets = SocketTable(streams, self.happen)
        datagrams = [script for script in scripts if script.is_datagrams]
        self.datagrams = DatagramTable(datagrams, self.happen)
        self.network = inputs.network
        """None if sockets may not use the network."""
        self.sensors: GuidanceSensors = NoSensors()
        """The sensors that guide robots."""
        if inputs.network is not None and inputs.network.sensors is not None:
            self.sensors = inputs.network.sensors
        self.starts_at = inputs.starts_at
        """Date and time of day at time zero."""
        self.cameras = {one.name.lower(): camera_state(one) for one in inputs.io.cameras}
        """By folded name."""
        conveyors = (ConveyorState(one, self.signals.read) for one in inputs.io.conveyors)
        self.conveyors = {one.script.unit.lower(): one for one in conveyors}
        """By folded name of the unit."""
        self.parts = inputs.io.parts
        self.messages = MessageQueues(frozenset(f"RMQ_{task}" for task in inputs.tasks))
        self.parameters = SystemParameters(inputs.configured)
        self.disabled_devices: set[str] = set()
        """Folded names of the I/O devices that the program has switched off."""
        self.lost_devices: set[str] = set()
        """Folded names of the I/O devices without contact."""
        self.sampled: dict[int, SampledSignal] = {}
        """The test signals by channel."""
        self.rendezvous = RendezvousTable()
        self.scheduler: TimeScheduler = SingleTaskScheduler()
        self.is_shared = False
        """Whether other tasks may change signals and data for which a task waits."""
        self.has_clients = False
        """Whether clients may act at any time, so that programs must keep pace with robots."""
        self.logbook: Callable[[str, LoggedError, float], None] | None = None
        """Called with each entry of the event log, its task and its time [s]."""
        wired = (conveyor for conveyor in self.conveyors.values() if conveyor.is_wired)
        self.listeners: list[SignalListener] = list(wired)
        self.error_listeners: list[EventLogListener] = []
        self.event_count = 0
        """Number of events to which another task may have to react."""
        self._fingers: dict[str, Fingers] = {}
        """By folded name of the task."""
        self._io = inputs.io
        self._outside_cause = Cause(journal.for_task(CELL_TASK))
        self._scheduled: list[_ScheduledChange] = []
        self._last_changes: dict[str, _Change] = {}
        """Last change of each signal, by folded name."""
        self._stimuli = Occasions(self._io.stimuli)
        sources = [cross.condition for cross in self._io.crosses]
        sources += [stimulus.when for stimulus in self._io.stimuli if stimulus.when]
        self._sources = {name.lower() for source in sources for name in source.signals()}
        self._begin()

    @property
    def station_faults(self) -> tuple[Fault, ...]:
        """The faults of the station, which have an effect on a controller that stays on."""
        return self._io.faults

    @property
    def connected(self) -> frozenset[str]:
        """Folded names of the signals that follow others."""
        return frozenset(cross.result.lower() for cross in self._io.crosses)

    @property
    def declared(self) -> tuple[SignalDeclaration, ...]:
        """The signals of its I/O configuration."""
        return self._io.signals

    def fingers_of(self, task: str) -> Fingers:
        """The fingers of the gripper of a task's robot."""
        folded = task.lower()
        if folded not in self._fingers:
            described = (one for one in self._io.smart_grippers if one.is_of(task))
            found = next(described, None)
            self._fingers[folded] = Fingers(None if found is None else found.object_mm)
        return self._fingers[folded]

    def attach_scheduler(self, turns: TimeScheduler) -> None:
        """Replace the scheduler by one of several tasks."""
        self.scheduler, self.is_shared = turns, True

    def detach_scheduler(self) -> None:
        """Restore the scheduler of one task: results are read without waiting for others."""
        self.scheduler, self.is_shared = SingleTaskScheduler(), False

    def has_listener(self, name: str) -> bool:
        """Whether anything depends on a signal, so that its changes need a known time."""
        folded = name.lower()
        return (
            self.is_shared
            or folded in self._sources
            or any(one.listens_to(name) for one in self.listeners)
            or any(folded in one.signals for one in self._scheduled)
        )

    def set_signal(self, cause: Cause, moment: Moment, name: str, value: float) -> bool:
        """Change a signal with all that depends on it; the time is known if anything does.

        Returns:
            Whether the value differs from the old one; an equal value has no effect.
        """
        old = self.signals.read(name)
        if not self.signals.write(name, value):
            return False
        cause.journal.event(
            moment,
            EventKind.SIGNAL,
            cause.place,
            f"{name} = {value:g}",
            signal=name,
            value=value,
        )
        self._last_changes[name.lower()] = _Change(f"{name} = {value:g}", moment, cause)
        self.notify(moment)
        for listener in tuple(self.listeners):
            if listener.listens_to(name):
                listener.signal_changed(name, old, value, moment.time_s)
        if name.lower() in self._sources:
            self._follow(name, cause, moment)
            self._stimulate(name, moment)
        return True

    @property
    def has_log_listeners(self) -> bool:
        """Whether any listener needs the entries of the event log."""
        return self.logbook is not None or any(one.is_listening for one in self.error_listeners)

    def log(self, task: str, entry: LoggedError, time_s: float) -> None:
        """Put an entry of a task into the event log."""
        if self.logbook is not None:
            self.logbook(task, entry, time_s)
        self.error_logged(entry, time_s)

    def error_logged(self, entry: LoggedError, time_s: float) -> None:
        """Raise the interrupts of all tasks that are connected to an entry of the event log."""
        for one in tuple(self.error_listeners):
            one.error_logged(entry, time_s)
        self.notify(Moment(Instant(time_s)))

    def forget(self, listeners: Set[int]) -> None:
        """Remove the listeners of these identities."""
        self.listeners[:] = [one for one in self.listeners if id(one) not in listeners]
        left = [one for one in self.error_listeners if id(one) not in listeners]
        self.error_listeners[:] = left

    def task_ended(self, task: str, time_s: float, *, failed: bool) -> None:
        """Update the system outputs: a task has stopped executing, and may have failed."""
        moment = Moment(Instant(time_s))
        for signal in self._io.signals:
            if signal.task is not None and signal.task.lower() != task.lower():
                continue
            if signal.status is Status.TASK_EXECUTING and signal.task is not None:
                self.set_signal(self._outside_cause, moment, signal.name, 0.0)
            elif signal.status in (Status.ERROR, Status.EXECUTION_ERROR) and failed:
                self.set_signal(self._outside_cause, moment, signal.name, 1.0)

    def last_change(self, names: Iterable[str], since_s: float) -> str:
        """The last change among some signals with its cause; empty if none since a time."""
        found = [self._last_changes.get(name.lower()) for name in names]
        dated = [(one.moment.time_s, one) for one in found if one and one.moment.is_known]
        recent = [(time_s, one) for time_s, one in dated if time_s >= since_s]
        if not recent:
            return ""
        _, last = max(recent, key=lambda item: item[0])
        return f"{last.kind}, set by {last.cause.description}"

    def schedule(self, cause: Cause, moment: Moment, values: Mapping[str, float]) -> None:
        """Change signals at a later moment, whose time may be unknown yet."""

        def change(now: Moment) -> None:
            for name, value in values.items():
                self.set_signal(cause, now, name, value)

        self._scheduled.append(_ScheduledChange(moment, change, _folded(values)))
        self.notify(moment)

    def close(self) -> None:
        """Close the files and connections that the program left open."""
        self.home.close_all()
        self.sensors.close()
        if self.network is not None:
            self.network.close()

    def happen(self, time_s: float, act: Callable[[float], None]) -> None:
        """Schedule an action at a later time [s] that changes no signal."""
        moment = Moment(Instant(time_s))
        self._scheduled.append(_ScheduledChange(moment, lambda now: act(now.time_s), ()))
        self.notify(moment)

    def notify(self, moment: Moment) -> None:
        """Wake the other tasks for an event at a moment."""
        self.event_count += 1
        if self.is_shared:
            self.scheduler.wake_at(moment.time_s)

    def next_s(self) -> float | None:
        """Time [s] of the next change whose time is known; None if no such change is scheduled."""
        times = [
            one.moment.time_s for one in self._scheduled if one.moment.instant.time is not None
        ]
        return min(times, default=None)

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Carry out the earliest change whose time is known; see `event_source.EventSource`."""
        del passed_s, until_s
        known = [one for one in self._scheduled if one.moment.instant.time is not None]
        coming = min(known, key=lambda one: one.moment.time_s)
        self._scheduled.remove(coming)
        self.event_count += 1
        coming.act(coming.moment)
        return coming.moment.time_s

    def advance_to(self, time_s: float) -> None:
        """Do nothing: changes keep their times."""

    def may_change(self, name: str) -> bool:
        """Whether a signal may change without a program, directly or through others."""
        changing: set[str] = set()
        new = {signal for one in self._scheduled for signal in one.signals}
        while new - changing:
            changing |= new
            new = {
                cross.result.lower()
                for cross in self._io.crosses
                if changing.intersection(_folded(cross.condition.signals()))
            }
            for stimulus in self._io.stimuli:
                if stimulus.when and changing.intersection(_folded(stimulus.when.signals())):
                    new |= set(_folded(stimulus.values))
        return name.lower() in changing

    def _begin(self) -> None:
        """Apply cross connections and stimuli at time zero."""
        for cross in self._io.crosses:
            self.signals.write(cross.result, float(cross.condition.holds(self.signals.read)))
        for due in self._stimuli.begin(self.signals.read):
            self._apply_stimulus(due)
        for conveyor in self.conveyors.values():
            conveyor.begin(self._pulse, self._show)

    def _show(self, name: str, value: float, time_s: float) -> None:
        """Set a signal of the cell at a time [s]."""
        self.set_signal(self._outside_cause, Moment(Instant(time_s)), name, value)

    def _pulse(self, name: str, time_s: float, is_due: Callable[[float], bool]) -> None:
        """Let a signal be 1 for a moment, at a time [s], if that is due then."""

        def act(now: Moment) -> None:
            if is_due(now.time_s):
                pulse = Stimulus(values={name: 1.0}, pulse_s=SWITCH_S)
                self._apply_stimulus(DueOccasion(pulse, now.time_s))

        moment = Moment(Instant(time_s))
        self._scheduled.append(_ScheduledChange(moment, act, _folded((name,))))
        self.notify(moment)

    def _follow(self, name: str, cause: Cause, moment: Moment) -> None:
        """Update the signals that are connected to one that has changed."""
        for cross in self._io.crosses:
            if name.lower() in _folded(cross.condition.signals()):
                value = float(cross.condition.holds(self.signals.read))
                if cross.after_s > 0.0:
                    self._follow_later(cross, value, moment.time_s + cross.after_s)
                elif self.signals.read(cross.result) != value:
                    self.set_signal(cause, moment, cross.result, value)

    def _follow_later(self, cross: CrossConnection, value: float, time_s: float) -> None:
        """Update a connected signal at a time [s]."""

        def act(now: Moment) -> None:
            if self.signals.read(cross.result) != value:
                self.set_signal(self._outside_cause, now, cross.result, value)

        moment = Moment(Instant(time_s))
        self._scheduled.append(_ScheduledChange(moment, act, _folded((cross.result,))))
        self.notify(moment)

    def _stimulate(self, name: str, moment: Moment) -> None:
        """Start the stimuli whose condition became true by a change of a signal."""
        for due in self._stimuli.change(name, moment.time_s, self.signals.read):
            self._apply_stimulus(due)

    def _apply_stimulus(self, due: DueOccasion[Stimulus]) -> None:
        """Apply a stimulus when it is due, and schedule it again if it repeats."""
        stimulus = due.occasion

        def act(now: Moment) -> None:
            before = {name: self.signals.read(name) for name in stimulus.values}
            if stimulus.pulse_s is not None:
                later = Moment(Instant(now.time_s + stimulus.pulse_s))
                self.schedule(self._outside_cause, later, before)
            for name, value in stimulus.values.items():
                if value != before[name]:
                    self.set_signal(self._outside_cause, now, name, value)
            if (following := due.following(now.time_s)) is not None:
                self._apply_stimulus(following)

        moment = Moment(Instant(due.time_s))
        self._scheduled.append(_ScheduledChange(moment, act, _folded(stimulus.values)))


def _folded(names: Mapping[str, float] | tuple[str, ...]) -> tuple[str, ...]:
    return tuple(name.lower() for name in names)
