"""Interrupt numbers, what they are connected to, and which are due.

Source: Technical reference manual RAPID Overview, "Interrupts".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from rapidsim.language.error_numbers import ERR_INOISSAFE, ERR_UNKINO
from rapidsim.language.errors import RapidError

MIN_TIMER_PERIOD_S = 0.1
"""The shortest period ITimer takes when it repeats."""
MIN_TIMER_SINGLE_S = 0.01
"""The shortest time ITimer takes when it fires once."""


@dataclass(frozen=True, slots=True)
class Due:
    """An interrupt whose time has come."""

    number: float
    time_s: float
    trap: Callable[[], None]
    trap_name: str


@dataclass(slots=True)
class _Connection:
    trap: Callable[[], None]
    trap_name: str
    asleep: bool = False
    next_s: float | None = None
    period_s: float | None = None
    signal: str | None = None
    """Folded name of the signal whose change raises the interrupt."""
    value: float | None = None
    """The value it must change to; None means any."""
    single: bool = False

    @property
    def ordered(self) -> bool:
        """Whether anything can raise the interrupt."""
        return self.next_s is not None or self.signal is not None


@dataclass(slots=True)
class InterruptTable:
    """The interrupts of one task."""

    held: bool = False
    """IDisable: interrupts wait until IEnable."""
    _connections: dict[float, _Connection] = field(default_factory=dict)
    _last_number: int = 0

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        """Book the next number for a trap."""
        self._last_number += 1
        self._connections[float(self._last_number)] = _Connection(trap, trap_name)
        return float(self._last_number)

    def is_connected(self, number: float) -> bool:
        """Whether a number belongs to a trap."""
        return number in self._connections

    def order_timer(self, number: float, now_s: float, seconds: float, *, single: bool) -> None:
        """Raise an interrupt once, or every so many seconds.

        Raises:
            RapidError: If the interrupt is not connected, has an order already, or the time is too
                short.
        """
        connection = self._find_free(number)
        shortest = MIN_TIMER_SINGLE_S if single else MIN_TIMER_PERIOD_S
        if seconds < shortest:
            raise RapidError(
                ERR_INOISSAFE,
                f"a timer of {seconds:g} s is too short; the least is {shortest:g} s",
                cf="ABB 40622",
            )
        connection.next_s = now_s + seconds
        connection.period_s = None if single else seconds

    def order_signal(
        self, number: float, signal: str, value: float | None, *, single: bool
    ) -> None:
        """Raise an interrupt when a signal changes to a value; None: to any.

        Raises:
            RapidError: If the interrupt is not connected or has an order already.
        """
        connection = self._find_free(number)
        connection.signal, connection.value = signal.lower(), value
        connection.single = single

    def signal_changed(self, signal: str, value: float, now_s: float) -> None:
        """Make the interrupts due that wait for this change."""
        for connection in self._connections.values():
            if connection.signal == signal.lower() and connection.value in (None, value):
                connection.next_s = now_s
                if connection.single:
                    connection.signal = None

    def delete(self, number: float) -> None:
        """Forget an interrupt; one that is not connected is no mistake."""
        self._connections.pop(number, None)

    def sleep(self, number: float, *, asleep: bool) -> None:
        """Switch one interrupt off or on."""
        self._find(number).asleep = asleep

    @property
    def armed(self) -> bool:
        """Whether any interrupt may come."""
        return any(c.ordered for c in self._connections.values())

    def listens_to(self, signal: str) -> bool:
        """Whether a change of this signal raises an interrupt."""
        return any(c.signal == signal.lower() for c in self._connections.values())

    def next_due_s(self) -> float | None:
        """Time [s] at which the next interrupt comes; None while none can."""
        if self.held:
            return None
        times = [c.next_s for c in self._connections.values() if c.next_s is not None]
        return min(times, default=None)

    def take_due(self, until_s: float) -> Due | None:
        """The earliest interrupt due by `until_s`, taken off; sleeping ones are dropped."""
        while (time_s := self.next_due_s()) is not None and time_s <= until_s:
            number, connection = next(
                item for item in self._connections.items() if item[1].next_s == time_s
            )
            period_s = connection.period_s
            connection.next_s = None if period_s is None else time_s + period_s
            if not connection.asleep:
                return Due(number, time_s, connection.trap, connection.trap_name)
        return None

    def _find_free(self, number: float) -> _Connection:
        connection = self._find(number)
        if connection.ordered:
            raise RapidError(ERR_INOISSAFE, "the interrupt has an order already; IDelete it first")
        return connection

    def _find(self, number: float) -> _Connection:
        connection = self._connections.get(number)
        if connection is None:
            raise RapidError(ERR_UNKINO, "the interrupt is not connected to a trap routine")
        return connection
