"""Interrupt numbers with their traps, their orders, and the queue of raised interrupts.

Raised interrupts wait in a queue and are served in the order in which they were raised.

Source: Technical reference manual RAPID Overview, "Interrupts".
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import field

from rapidsim.controller.journal.stop_reasons import TrapStorm
from rapidsim.language.error_log import LoggedError
from rapidsim.language.error_numbers import ERR_INOISSAFE, ERR_INOMAX, ERR_UNKINO, rapid_error
from rapidsim.language.errors import NotAllowed, RapidError
from rapidsim.language.messages import Message, MessageKind
from rapidsim.language.reference import Reference
from rapidsim.values import value_class

MIN_TIMER_PERIOD_S = 0.1
"""The shortest period that ITimer accepts if it repeats."""
MIN_TIMER_SINGLE_S = 0.01
"""The shortest time that ITimer accepts if it fires once."""
MOST_CONNECTED = 100
"""Maximum number of interrupts that a task may define at one time."""
LONGEST_QUEUE = 1000
"""Maximum number of interrupts that may wait for their traps."""
MOST_AT_ONCE = 10_000
"""Maximum number of traps that may run without any time passing."""


@value_class(frozen=True, slots=True)
class Due:
    """An interrupt whose time has come."""

    number: float
    time_s: float
    trap: Callable[[], None]
    trap_name: str
    is_trap: bool = True
    """Whether it is a trap, not a procedure that runs at a place of the path."""
    cause: LoggedError | None = None
    """The entry of the event log that raised it."""


@value_class(slots=True)
class _Connection:
    trap: Callable[[], None]
    trap_name: str
    asleep: bool = False
    safe: bool = False
    r"""It was ordered with \SingleSafe and cannot be put to sleep."""
    next_s: float | None = None
    """Time [s] at which a timer fires next."""
    period_s: float | None = None
    signal: str | None = None
    """Folded name of the signal whose change may raise the interrupt."""
    matches: Callable[[float], bool] = bool
    """Whether a change of the signal to a value raises the interrupt."""
    persistent: Reference[object] | None = None
    """The persistent whose change raises the interrupt."""
    seen: object = None
    """Its value when it was last checked."""
    single: bool = False
    wanted: Callable[[LoggedError], bool] | None = None
    """Whether an entry of the event log raises the interrupt."""
    message: MessageKind | None = None
    """Type of the messages that raise it."""

    @property
    def ordered(self) -> bool:
        """Whether anything can raise the interrupt."""
        orders = (self.next_s, self.signal, self.persistent, self.wanted, self.message)
        return any(order is not None for order in orders)

    def withdraw(self) -> None:
        """Cancel the order."""
        self.next_s = self.period_s = self.signal = self.persistent = self.wanted = None
        self.message = None
        self.safe = False


@value_class(slots=True)
class InterruptTable:
    """The interrupts of one task."""

    is_on_hold: bool = False
    """Whether IDisable is in effect: interrupts wait until IEnable."""
    watches: bool = False
    """Whether any persistent must be checked for changes."""
    _connections: dict[float, _Connection] = field(default_factory=dict)
    _queue: list[Due] = field(default_factory=list)
    _last_number: int = 0
    _last_s: float = -1.0
    _at_once: int = 0

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        """Assign the next number to a trap.

        Raises:
            RapidError: If no more can be defined.
        """
        if len(self._connections) >= MOST_CONNECTED:
            raise rapid_error(
                ERR_INOMAX, f"{MOST_CONNECTED} interrupts are defined, and no task has more"
            )
        self._last_number += 1
        self._connections[float(self._last_number)] = _Connection(trap, trap_name)
        return float(self._last_number)

    def is_connected(self, number: float) -> bool:
        """Whether a number belongs to a trap."""
        return number in self._connections

    def order_timer(self, number: float, now_s: float, seconds: float, *, single: bool) -> None:
        """Raise an interrupt once, or every so many seconds.

        Raises:
            RapidError: If the interrupt is not connected or has an order already.
            NotAllowed: If the time is too short.
        """
        connection = self._find_free(number)
        shortest = MIN_TIMER_SINGLE_S if single else MIN_TIMER_PERIOD_S
        if seconds < shortest:
            raise NotAllowed(f"a timer of {seconds:g} s is too short; the least is {shortest:g} s")
        connection.next_s = now_s + seconds
        connection.period_s = None if single else seconds

    def order_signal(
        self, number: float, signal: str, matches: Callable[[float], bool], *, single: bool
    ) -> None:
        """Raise an interrupt when a signal changes to a value that matches.

        Raises:
            RapidError: If the interrupt is not connected or has an order already.
        """
        connection = self._find_free(number)
        connection.signal, connection.matches = signal.lower(), matches
        connection.single = single

    def order_persistent(self, number: float, data: Reference[object], *, single: bool) -> None:
        """Raise an interrupt when a persistent has changed.

        Raises:
            RapidError: If the interrupt is not connected or has an order already.
        """
        connection = self._find_free(number)
        connection.persistent, connection.seen = data, _frozen(data.value)
        connection.single = single
        self.watches = True

    def order_logged(self, number: float, wanted: Callable[[LoggedError], bool]) -> None:
        """Raise an interrupt when a wanted entry is added to the event log.

        Raises:
            RapidError: If the interrupt is not connected or has an order already.
        """
        self._find_free(number).wanted = wanted

    def error_logged(self, entry: LoggedError, now_s: float) -> None:
        """Raise the interrupts that wait for this entry."""
        for number, connection in self._connections.items():
            if connection.wanted is not None and connection.wanted(entry):
                self._raise(number, connection, now_s, entry)

    def order_message(self, number: float, kind: MessageKind) -> None:
        """Raise an interrupt at each message of a kind.

        Raises:
            RapidError: If the interrupt is not connected or has an order already.
        """
        self._find_free(number).message = kind

    def message_received(self, message: Message, now_s: float) -> bool:
        """Raise the interrupts that wait for such a message; return whether there are any."""
        waiting = [
            (number, one)
            for number, one in self._connections.items()
            if one.message is not None and one.message.fits(message.kind)
        ]
        for number, connection in waiting:
            self._raise(number, connection, now_s)
        return bool(waiting)

    @property
    def is_listening(self) -> bool:
        """Whether an entry of the event log may raise an interrupt."""
        return any(c.wanted is not None for c in self._connections.values())

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """Raise the interrupts that wait for this change."""
        del old
        for number, connection in self._connections.items():
            if connection.signal == signal.lower() and connection.matches(value):
                self._raise(number, connection, now_s)

    def raise_changed(self, now_s: float) -> None:
        """Raise the interrupts whose persistents have changed since the last check."""
        for number, connection in self._connections.items():
            if connection.persistent is None:
                continue
            value = _frozen(connection.persistent.value)
            if value != connection.seen:
                connection.seen = value
                self._raise(number, connection, now_s)

    def raise_now(self, number: float, now_s: float) -> None:
        """Raise one interrupt.

        Raises:
            RapidError: If it is not connected.
        """
        self._raise(number, self._find(number), now_s)

    def post(self, due: Due) -> None:
        """Queue a procedure that runs like a trap."""
        self._queue.append(due)

    def delete(self, number: float) -> None:
        """Delete an interrupt; one that is not connected is not an error."""
        self._connections.pop(number, None)
        self._update_watches()
        self._queue = [due for due in self._queue if due.number != number]

    def sleep(self, number: float, *, asleep: bool) -> None:
        """Switch one interrupt off or on.

        Raises:
            RapidError: ERR_UNKINO, if it is not connected; ERR_INOISSAFE, if it is a safe one.
        """
        connection = self._find(number)
        if asleep and connection.safe:
            raise rapid_error(
                ERR_INOISSAFE, r"an interrupt ordered with \SingleSafe cannot be put to sleep"
            )
        connection.asleep = asleep

    def make_safe(self, number: float) -> None:
        """Make an interrupt safe, so that it cannot be put to sleep."""
        self._find(number).safe = True

    @property
    def armed(self) -> bool:
        """Whether any interrupt may be raised."""
        return bool(self._queue) or any(c.ordered for c in self._connections.values())

    def listens_to(self, signal: str) -> bool:
        """Whether a change of this signal raises an interrupt."""
        return any(c.signal == signal.lower() for c in self._connections.values())

    def next_due_s(self) -> float | None:
        """Time [s] at which the next interrupt is due; None if none can be."""
        if self.is_on_hold:
            return None
        times = [c.next_s for c in self._connections.values() if c.next_s is not None]
        times += [due.time_s for due in self._queue[:1]]
        return min(times, default=None)

    def take_due(self, until_s: float) -> Due | None:
        """Remove and return the earliest interrupt due by `until_s`; sleeping ones are dropped.

        Raises:
            TrapStorm: If traps follow each other without time passing.
        """
        while (time_s := self.next_due_s()) is not None and time_s <= until_s:
            due = self._take(time_s)
            connection = self._connections.get(due.number)
            if connection is None or not connection.asleep:
                self._count(due)
                return due
        return None

    def waiting(self) -> tuple[Due, ...]:
        """The interrupts that wait for their traps."""
        return tuple(self._queue)

    def discard_while_stopped(
        self, waited: tuple[Due, ...], since_s: float, until_s: float
    ) -> None:
        """Discard the interrupts raised while the program was stopped, except safe ones.

        Args:
            waited: The interrupts that waited when it stopped.
            since_s: Time [s] at which it stopped.
            until_s: Time [s] at which it continued.
        """
        safe = {number for number, one in self._connections.items() if one.safe}
        kept = {id(one) for one in waited}
        self._queue = [one for one in self._queue if id(one) in kept or one.number in safe]
        for connection in self._connections.values():
            next_s, period_s = connection.next_s, connection.period_s
            if next_s is None or next_s > until_s:
                continue
            if period_s is not None:
                missed = math.floor((until_s - next_s) / period_s) + 1
                connection.next_s = next_s + missed * period_s
            elif next_s > since_s:
                connection.withdraw()
        self._update_watches()

    def _take(self, time_s: float) -> Due:
        """The interrupt that is due at a time: a raised one precedes a timer."""
        if self._queue and self._queue[0].time_s <= time_s:
            return self._queue.pop(0)
        number, connection = next(
            item for item in self._connections.items() if item[1].next_s == time_s
        )
        period_s = connection.period_s
        connection.next_s = None if period_s is None else time_s + period_s
        return Due(number, time_s, connection.trap, connection.trap_name)

    def _raise(
        self,
        number: float,
        connection: _Connection,
        now_s: float,
        cause: LoggedError | None = None,
    ) -> None:
        if connection.asleep:
            return
        if connection.single:
            connection.withdraw()
            self._update_watches()
        due = Due(number, now_s, connection.trap, connection.trap_name, cause=cause)
        self._queue.append(due)
        if len(self._queue) > LONGEST_QUEUE:
            raise TrapStorm(
                f"more than {LONGEST_QUEUE} interrupts wait for their traps, the last for "
                f"{connection.trap_name}"
            )

    def _update_watches(self) -> None:
        self.watches = any(c.persistent is not None for c in self._connections.values())

    def _count(self, due: Due) -> None:
        """Detect traps that raise themselves."""
        self._at_once = self._at_once + 1 if due.time_s <= self._last_s else 0
        self._last_s = max(due.time_s, self._last_s)
        if self._at_once > MOST_AT_ONCE:
            raise TrapStorm(
                f"{due.trap_name} was raised {MOST_AT_ONCE} times without time passing: does it "
                "change what raises it?"
            )

    def _find_free(self, number: float) -> _Connection:
        connection = self._find(number)
        if connection.ordered:
            raise RapidError(ERR_INOISSAFE, "the interrupt has an order already; IDelete it first")
        return connection

    def _find(self, number: float) -> _Connection:
        connection = self._connections.get(number)
        if connection is None:
            raise RapidError(
                ERR_UNKINO, "the interrupt is not connected to a trap routine; CONNECT comes first"
            )
        return connection


def _frozen(value: object) -> object:
    """A copy to compare with later: arrays change in place."""
    return [_frozen(one) for one in value] if isinstance(value, list) else value
