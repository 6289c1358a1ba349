"""The virtual controller of one task: one clock, a program pointer that runs ahead, a path queue.

The program pointer's time is an instant plus an offset. After a fly-by move the instant is "the
robot starts that move", which nobody knows until the path is planned; the program runs on and what
it does is dated later. Whoever must know the time or the position calls `_observe`.

RAPID statements take no virtual time except waits, motion, and a small fixed cost a loop turn.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress

from rapidsim.frames.transform import Array
from rapidsim.language.controller import (
    FileMode,
    MotionSettings,
    Move,
    OpenFile,
    Place,
)
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    TOOL0,
    WOBJ0,
    JointTarget,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.error_numbers import FIRST_BOOKED
from rapidsim.motion.targets import rob_joint
from rapidsim.simulation.home import HomeFolder
from rapidsim.simulation.interrupts import Due, InterruptTable
from rapidsim.simulation.journal import Instant, Journal, Moment
from rapidsim.simulation.operator import Operator
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.path_queue import (
    LOOK_AHEAD_SLACK_S,
    MAX_OPEN_MOVES,
    MotionError,
    PathQueue,
)
from rapidsim.simulation.pointer_time import PointerTime
from rapidsim.simulation.resolve import Resolver
from rapidsim.simulation.result import CornerKind, EventKind
from rapidsim.simulation.signals import Change, SignalTable
from rapidsim.simulation.stops import TimeLimitReached, WaitsForever


class VirtualController:
    """Implements `language.controller.Controller` for one task with one robot."""

    def __init__(
        self,
        queue: PathQueue,
        resolver: Resolver,
        journal: Journal,
        options: RunOptions,
        place: Place,
    ) -> None:
        """Start at time zero with the arm where the queue says and the pointer at `place`."""
        self.settings = MotionSettings()
        self.errno = 0.0
        self.intno = 0.0
        self.place = place
        self.left = 0
        self._time = PointerTime()
        self._in_trap = False
        self._booked_errors = 0
        self._queue = queue
        self._resolver = resolver
        self._journal = journal
        self._max_time_s = options.max_time_s
        self._interrupts = InterruptTable()
        self._signals = SignalTable()
        self._operator = Operator(options.answers)
        self.home = HomeFolder(options.home)
        self._active: tuple[ToolData, WobjData] = (TOOL0, WOBJ0)

    # --- clock

    def now(self) -> float:
        """Virtual time [s] of the statement that runs."""
        self._note_line()
        return self._observe()

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        """Let virtual time pass; with `in_position`, first let the robot come to rest."""
        self._note_line()
        if in_position:
            self._come_to_rest()
        now_s = self._observe()
        self._pass_time(now_s + max(0.0, seconds))

    def wait_until(
        self, condition: Callable[[], bool], *, max_time: float | None = None, poll_s: float = 0.1
    ) -> bool:
        """Let virtual time pass until a condition holds; False if `max_time` [s] ran out first."""
        self._note_line()
        now_s = self._observe()
        deadline_s = math.inf if max_time is None else now_s + max_time
        while not condition():
            if now_s >= deadline_s:
                return False
            self._pass_time(min(now_s + poll_s, deadline_s))
            now_s = self._observe()
        return True

    def service(self) -> None:
        """Do what is due and grant the next slice.

        Raises:
            TimeLimitReached: When the time limit is reached.
        """
        time = self._time
        time.settle(self.left)
        if not time.is_known and time.offset_s > LOOK_AHEAD_SLACK_S:
            self._observe()
        if time.is_known:
            self._pass_time(time.known_s)
        self._grant()

    # --- motion

    def move(self, move: Move) -> None:
        """Put a move on the path; returns when the program would go on.

        Raises:
            RapidError: When the end of the move cannot be reached.
            MotionError: When a move on the path cannot be made.
        """
        self._note_line()
        queued = self._resolver.resolve(move, self.place, self._queue.end, self.settings)
        self._time.settle(self.left)
        if not self._queue.is_open or self._time.offset_s > LOOK_AHEAD_SLACK_S:
            self._observe()
        moment = self._moment()
        now_s = moment.time_s if moment.instant.time is not None else -math.inf
        self._queue.append(queued, now_s)
        self._active = (move.tool, move.wobj)
        if queued.corner is CornerKind.STOP:
            self._wait_for_stop()
            return
        self._time.follow(queued.started)
        if self._interrupts.armed or self._queue.open_moves > MAX_OPEN_MOVES:
            self._keep_up()

    def current_joints(self) -> JointTarget:
        """Where the axes are now."""
        self._note_line()
        return JointTarget(rob_joint(self._joints_now()), NO_EXTERNAL_AXES)

    def current_target(self, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        """Where the TCP is now; None takes the tool or work object of the last move."""
        self._note_line()
        active_tool, active_wobj = self._active
        return self._resolver.target(self._joints_now(), tool or active_tool, wobj or active_wobj)

    def active_tool(self) -> ToolData:
        """The tool of the last move, tool0 before the first."""
        return self._active[0]

    def active_wobj(self) -> WobjData:
        """The work object of the last move, wobj0 before the first."""
        return self._active[1]

    def target_at(self, joints: JointTarget, tool: ToolData, wobj: WobjData) -> RobTarget:
        """Where the TCP would be with the axes at given positions."""
        return self._resolver.target(self._resolver.joints(joints), tool, wobj)

    def joints_at(self, target: RobTarget, tool: ToolData, wobj: WobjData) -> JointTarget:
        """Axis positions that reach a target in its configuration.

        Raises:
            RapidError: ERR_OUTSIDE_REACH or ERR_ROBLIMIT.
        """
        joints = self._resolver.reach(target, tool, wobj, self._queue.end.joints)
        return JointTarget(rob_joint(joints), target.extax)

    # --- operator

    def show(self, text: str) -> None:
        """Write a line on the FlexPendant."""
        self._event(EventKind.TEXT, text)

    def clear_screen(self) -> None:
        """Remove all lines from the FlexPendant."""
        self._event(EventKind.TEXT, "", cleared=True)

    def ask_number(self, prompt: str) -> float:
        """The operator's answer to a question."""
        self._observe()
        answer = self._operator.number(prompt)
        for violation in answer.findings:
            self._journal.finding(violation, self.place)
        self._event(
            EventKind.TEXT, f"{prompt} {answer.value:g}", prompt=prompt, answer=answer.value
        )
        return answer.value

    def ask_choice(self, prompt: str, choices: Sequence[str]) -> int:
        """Index of the key the operator presses; the first that is there, where nobody sits."""
        self._observe()
        answer = self._operator.choice(prompt, choices)
        for violation in answer.findings:
            self._journal.finding(violation, self.place)
        pressed = choices[answer.value]
        self._event(EventKind.TEXT, f"{prompt} {pressed}", prompt=prompt, answer=pressed)
        return answer.value

    def ask_text(self, prompt: str, proposal: str) -> str:
        """A text the operator types; the proposal, where nobody sits."""
        self._observe()
        answer = self._operator.text(prompt, proposal)
        for violation in answer.findings:
            self._journal.finding(violation, self.place)
        self._event(EventKind.TEXT, f"{prompt} {answer.value}", prompt=prompt, answer=answer.value)
        return answer.value

    # --- files

    def open_file(self, path: str, mode: FileMode) -> OpenFile:
        """Open a file of the home folder.

        Raises:
            RapidError: See `HomeFolder.open_file`.
        """
        file = self.home.open_file(path, mode)
        self._event(EventKind.FILE, f"opened {path} to {mode.value}", path=path, mode=mode.value)
        return file

    # --- interrupts

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        """Book an interrupt number for a trap routine."""
        return self._interrupts.connect(trap, trap_name)

    def is_connected(self, interrupt: float) -> bool:
        """Whether an interrupt number belongs to a trap routine, ordered or not."""
        return self._interrupts.is_connected(interrupt)

    def order_timer(self, interrupt: float, seconds: float, *, single: bool) -> None:
        """Raise an interrupt once, or every so many seconds."""
        self._interrupts.order_timer(interrupt, self._observe(), seconds, single=single)
        self._grant()

    def order_signal(
        self, interrupt: float, signal: str, value: float | None, *, single: bool
    ) -> None:
        """Raise an interrupt once, or each time a signal changes to a value; None: to any."""
        self._observe()
        self._interrupts.order_signal(interrupt, signal, value, single=single)

    def delete_interrupt(self, interrupt: float) -> None:
        """Forget an interrupt and its order."""
        self._observe()
        self._interrupts.delete(interrupt)

    def sleep_interrupt(self, interrupt: float, *, asleep: bool) -> None:
        """Switch one interrupt off or on."""
        self._observe()
        self._interrupts.sleep(interrupt, asleep=asleep)

    def hold_interrupts(self, *, hold: bool) -> None:
        """Queue all interrupts, or serve them again."""
        now_s = self._observe()
        self._interrupts.held = hold
        self._pass_time(now_s)

    # --- signals

    def read_signal(self, name: str) -> float:
        """The value of a signal now."""
        self._observe()
        return self._signals.read(name)

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        """Set an output at the time of the program pointer, or later by a delay."""
        self._note_line()
        if delay_s > 0.0:
            moment = self._moment()
            later = Moment(moment.instant, moment.offset_s + delay_s)
            self._signals.schedule(Change(later, name, value))
            return
        heard = self._interrupts.listens_to(name)
        now_s = self._observe() if heard else 0.0
        self._set_signal(self._moment(), name, value)
        if heard:
            self._pass_time(now_s)

    def wait_for_signal(
        self, name: str, condition: Callable[[float], bool], *, max_time: float | None = None
    ) -> bool:
        """Let virtual time pass until the value of a signal satisfies a condition.

        Raises:
            Stopped: When nothing that is known to happen can ever satisfy it.
        """
        self._note_line()
        now_s = self._observe()
        deadline_s = math.inf if max_time is None else now_s + max_time
        while not condition(self._signals.read(name)):
            next_s = self._next_due_s()
            if next_s is None and math.isinf(deadline_s):
                raise WaitsForever(f"`{name}` is waited for and nothing ever changes it")
            if self._observe() >= deadline_s:
                return False
            self._pass_time(min(deadline_s, math.inf if next_s is None else next_s))
        return True

    # --- errors

    def book_error_number(self) -> float:
        """The next error number that is free."""
        self._booked_errors += 1
        return FIRST_BOOKED + self._booked_errors - 1.0

    # --- honesty

    def not_simulated(self, routine: str, treated_as: str) -> None:
        """Report that a routine was not simulated and what was done instead."""
        self._journal.unsimulated(routine, treated_as)

    # --- the run as a whole

    def finish(self) -> None:
        """Let the robot come to rest after the last statement."""
        if self._queue.is_open:
            self._observe()
            self._queue.close()
        self._pass_time(max(self._observe(), self._queue.trajectory.duration))

    def abandon(self) -> None:
        """Let the robot make the moves it has before the program stopped with an error."""
        if self._queue.is_open:
            with suppress(MotionError):
                self._queue.close()

    def end_time_s(self) -> float:
        """When everything is over [s]: the program pointer and the arm."""
        pointer_s = self._time.known_s if self._time.is_known else 0.0
        return min(self._max_time_s, max(pointer_s, self._queue.trajectory.duration))

    def _joints_now(self) -> Array:
        """Joints (n,) [rad] at the time of the statement that runs."""
        return self._queue.joints_at(self._observe())

    # --- time, inside

    def _moment(self) -> Moment:
        """When the statement that runs happens."""
        self._time.settle(self.left)
        return self._time.moment()

    def _grant(self) -> None:
        """Give the program ticks until something is due."""
        due_s = self._next_due_s()
        until_s = min(self._max_time_s, math.inf if due_s is None else due_s)
        self.left = self._time.grant(until_s, LOOK_AHEAD_SLACK_S)

    def _observe(self) -> float:
        """The time [s] of the statement that runs, planned if nobody has had to know it yet."""
        time = self._time
        time.settle(self.left)
        if not time.is_known:
            offset_s = time.offset_s
            self._pass_time(self._queue.commit_last_start())
            self._pass_time(time.known_s + offset_s)
        return time.known_s

    def _pass_time(self, until_s: float) -> None:
        """Go to a later time, serving the interrupts that fall due on the way.

        Raises:
            TimeLimitReached: When the time limit comes first.
        """
        reached_s = min(until_s, self._max_time_s)
        served_s = self._serve_due(reached_s)
        now_s = self._time.known_s if self._time.is_known else 0.0
        self._time.set(max(reached_s, served_s, now_s))
        if until_s > self._max_time_s:
            raise TimeLimitReached(f"the time limit of {self._max_time_s:g} s was reached")
        self._grant()

    def _next_due_s(self) -> float | None:
        """When the next thing happens by itself [s]: a signal change or an interrupt."""
        times = (self._signals.next_change_s(), self._interrupts.next_due_s())
        return min((time_s for time_s in times if time_s is not None), default=None)

    def _serve_due(self, until_s: float) -> float:
        """Let everything due by a time happen; returns when the last trap ended [s].

        No trap interrupts a trap: what falls due meanwhile is served afterwards.
        """
        ended_s = 0.0
        while True:
            change_s = self._signals.next_change_s()
            trap_s = None if self._in_trap else self._interrupts.next_due_s()
            if change_s is not None and change_s <= min(until_s, trap_s or math.inf):
                change = self._signals.take_change()
                self._set_signal(change.moment, change.name, change.value)
                continue
            due = None if self._in_trap else self._interrupts.take_due(until_s)
            if due is None:
                return ended_s
            ended_s = self._serve(due, max(due.time_s, ended_s))

    def _serve(self, due: Due, start_s: float) -> float:
        """Run a trap, then go on where the program was; returns when the trap ended [s]."""
        instant, offset_s, place = self._time.instant, self._time.offset_s, self.place
        if instant.time is not None:
            start_s = max(start_s, instant.time + offset_s)
        self._time.set(start_s)
        self._event(EventKind.INTERRUPT, f"trap {due.trap_name}", trap=due.trap_name)
        self._in_trap, self.intno = True, due.number
        self._grant()
        try:
            due.trap()
        finally:
            self._in_trap = False
        ended_s = self._observe()
        self.place = place
        if instant.time is None:
            self._time.instant, self._time.offset_s = instant, offset_s
        else:
            self._time.set(max(ended_s, instant.time + offset_s))
        return ended_s

    def _wait_for_stop(self) -> None:
        """The program goes on at a stop point when the arm stands still there.

        Source: RAPID Overview, "Motion and I/O principles". A controller was measured to go on some
        40 ms earlier; then CRobT after a stop point would miss the point, which nobody expects.
        """
        reached_s = self._queue.close() + self._queue.model.filter_time
        self._time.follow(Instant())
        self._pass_time(reached_s)

    def _come_to_rest(self) -> None:
        """End an open block and wait until the arm stands still."""
        if self._queue.is_open:
            self._observe()
            self._queue.close(CornerKind.STOP_CORNER_PATH_FAILURE)
        self._pass_time(max(self._observe(), self._queue.trajectory.duration))

    def _keep_up(self) -> None:
        """Let interrupts happen on time although the program runs ahead of the robot.

        Planning after each move would be slow. Nothing is planned until the moves last, at their
        programmed speeds, until the next interrupt falls due and the arm could stop after it.
        """
        due_s = self._next_due_s()
        queue = self._queue
        early = due_s is None or queue.nominal_last_start() - queue.braking_s < due_s
        if early and queue.open_moves <= MAX_OPEN_MOVES:
            return
        fixed_s = queue.commit_ahead()
        if fixed_s is None:
            return
        self._serve_due(min(fixed_s, self._max_time_s))
        if fixed_s > self._max_time_s:
            self._time.follow(Instant())
            self._pass_time(fixed_s)

    def _set_signal(self, moment: Moment, name: str, value: float) -> None:
        """Change a signal at a moment and make the interrupts due that listen to it."""
        if self._signals.write(name, value) and self._interrupts.listens_to(name):
            self._interrupts.signal_changed(name, value, moment.time_s)
        self._journal.event(
            moment, EventKind.SIGNAL, self.place, f"{name} = {value:g}", signal=name, value=value
        )

    # --- reports, inside

    def _note_line(self) -> None:
        self._journal.line(self._moment(), self.place)

    def _event(self, kind: EventKind, message: str, **details: object) -> None:
        self._note_line()
        self._journal.event(self._moment(), kind, self.place, message, **details)
