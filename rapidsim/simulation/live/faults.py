"""Faults of a controller that stays on: when they begin and end, and their effect on it.

Faults of connections have their effect where messages pass; here they begin and end.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from types import MappingProxyType
from typing import Final, Protocol

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.due_occasions import DueOccasion, Occasions
from rapidsim.controller.cell.faults import Channel, FailureKind, Fault, LastingFault
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Instant, Journal, Moment
from rapidsim.language.error_log import ERROR, STATE, WARNING, LoggedError
from rapidsim.simulation.live.panel import Panel
from rapidsim.simulation.live.states import RefusalReason, RequestRefused, SafetyStop

MOST_LASTING: Final = 1000
"""Largest number of faults that last at one time."""
_STOPS: Final[Mapping[FailureKind, SafetyStop]] = MappingProxyType(
    {
        FailureKind.EMERGENCY_STOP: SafetyStop.EMERGENCY,
        FailureKind.GUARD_STOP: SafetyStop.AUTOMATIC,
        FailureKind.GENERAL_STOP: SafetyStop.GENERAL,
    }
)
_SEVERITIES: Final = MappingProxyType({"information": STATE, "warning": WARNING, "error": ERROR})
_LOST, _FOUND = 58.0, 59.0
"""Numbers, in domain 7, of the entries about a lost device and one that is back, from memory."""


class FaultOwner(Protocol):
    """The controller that fails."""

    cell: Cell
    panel: Panel

    @property
    def now_s(self) -> float:
        """The virtual time [s]."""
        ...

    def soon(self, act: Callable[[], None]) -> None:
        """Do something at the present time, outside of all programs."""
        ...

    def log_error(self, entry: LoggedError) -> None:
        """Put an entry into the event log."""
        ...

    def restart(self, *, cold: bool) -> None:
        """Restart the controller."""
        ...


def _ignore() -> None:
    """A listener that ignores everything."""


@dataclass(eq=False)
class LiveFaults:
    """All faults; listens to signals, as a `cell.SignalListener`."""

    owner: FaultOwner
    journal: Journal
    changed: Callable[[], None] = _ignore
    """Called when the lasting faults of connections have changed."""
    lasting: dict[int, LastingFault] = field(default_factory=dict)
    """By number."""
    restarted: Callable[[Fault], None] = lambda fault: None
    """Called when the controller has restarted."""
    _occasions: Occasions[Fault] = field(init=False)
    _last: int = 0
    _era: int = 0
    """Number of times that all faults were ended."""

    def __post_init__(self) -> None:
        """Await the faults of the station."""
        cell = self.owner.cell
        self._occasions = Occasions(cell.station_faults)
        cell.listeners.append(self)
        for due in self._occasions.begin(cell.signals.read):
            self._await(due)

    def listens_to(self, signal: str) -> bool:
        """Whether a fault depends on a signal."""
        return self._occasions.depends_on(signal)

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """Begin the faults whose condition has become true."""
        del old, value
        for due in self._occasions.change(signal, now_s, self.owner.cell.signals.read):
            self._await(due)

    def add(self, fault: Fault) -> None:
        """Add a fault, which begins at once if it has neither a time nor a condition.

        Raises:
            RequestRefused: If too many last, or there is no such device.
        """
        if len(self.lasting) >= MOST_LASTING:
            raise RequestRefused(RefusalReason.STATE, f"{MOST_LASTING} faults last already")
        if fault.kind is FailureKind.DEVICE_LOST:
            self._signals_of(fault.device)
        now_s = self.owner.now_s
        for due in self._occasions.add(fault, self.owner.cell.signals.read, now_s):
            self._await(due)

    def end_all(self) -> None:
        """End the faults that last, and withdraw those that were added and have not begun."""
        self._era += 1
        self._occasions.remove_added()
        for number in tuple(self.lasting):
            self._end(number)

    def _await(self, due: DueOccasion[Fault]) -> None:
        begin = partial(self._begin, due, self._era)
        if due.time_s <= self.owner.now_s:
            self.owner.soon(begin)
        else:
            self.owner.cell.happen(due.time_s, lambda _: self.owner.soon(begin))

    def _begin(self, due: DueOccasion[Fault], era: int) -> None:
        fault = due.occasion
        if era != self._era and fault not in self.owner.cell.station_faults:
            return
        if (following := due.following(self.owner.now_s)) is not None:
            self._await(following)
        self._note(fault, "begins" if fault.lasts else "happens")
        if fault.lasts:
            if len(self.lasting) >= MOST_LASTING:
                return
            self._last += 1
            self.lasting[self._last] = LastingFault(self._last, fault)
            if fault.for_s is not None:
                end = partial(self._end, self._last)
                self.owner.cell.happen(
                    self.owner.now_s + fault.for_s, lambda _: self.owner.soon(end)
                )
        if (act := _BEGINS.get(fault.kind)) is not None:
            act(self, fault)
        if fault.is_of_connection:
            self.changed()

    def _end(self, number: int) -> None:
        """End a fault, unless it has ended already."""
        ended = self.lasting.pop(number, None)
        if ended is None:
            return
        fault = ended.fault
        self._note(fault, "ends")
        if (act := _ENDS.get(fault.kind)) is not None:
            act(self, fault)
        if fault.is_of_connection:
            self.changed()

    def of(self, channel: Channel) -> tuple[LastingFault, ...]:
        """The lasting faults of a connection, in the order in which they began."""
        return tuple(
            one
            for one in self.lasting.values()
            if one.fault.is_of_connection and one.fault.on is channel
        )

    def lasts(self, kind: FailureKind) -> bool:
        """Whether a fault of a kind lasts."""
        return any(one.fault.kind is kind for one in self.lasting.values())

    def _note(self, fault: Fault, word: str) -> None:
        moment = Moment(Instant(self.owner.now_s))
        where = f" on {fault.on}" if fault.is_of_connection else ""
        message = f"{fault.kind}{where} {word}"
        self.journal.event(moment, EventKind.FAULT, None, message, fault=fault.kind.value)

    def open_chain(self, fault: Fault) -> None:
        """Open the safety chain."""
        self.owner.panel.open_chain(_STOPS[fault.kind])

    def close_chain(self, fault: Fault) -> None:
        """Close the safety chain."""
        self.owner.panel.close_chain(_STOPS[fault.kind])

    def restart(self, fault: Fault) -> None:
        """Restart the controller."""
        self.owner.restart(cold=fault.mode == "cold")
        self.restarted(fault)

    def set_disk(self, fault: Fault) -> None:
        """Fill the disk, or empty it."""
        del fault
        self.owner.cell.home.disk.is_full = self.lasts(FailureKind.FULL_DISK)

    def log(self, fault: Fault) -> None:
        """Write an entry of the event log."""
        domain, number = divmod(fault.code, 10_000)
        type_, texts = _SEVERITIES[fault.severity], fault.texts[:5]
        self.owner.log_error(LoggedError(float(domain), float(number), type_, fault.title, texts))

    def set_devices(self, fault: Fault) -> None:
        """Lose contact with devices, or find it again."""
        kind, cell = FailureKind.DEVICE_LOST, self.owner.cell
        before = set(cell.lost_devices)
        lost = [one.fault.device for one in self.lasting.values() if one.fault.kind is kind]
        cell.lost_devices = {device.lower() for device in lost}
        signals: set[str] = set()
        for device in lost:
            with suppress(RequestRefused):
                signals |= self._signals_of(device)
        cell.signals.lost = frozenset(signals)
        if before != cell.lost_devices:
            is_lost = fault.device.lower() in cell.lost_devices
            number, title = (
                (_LOST, "Lost communication with I/O device")
                if is_lost
                else (_FOUND, "Communication with I/O device established")
            )
            type_ = WARNING if is_lost else STATE
            self.owner.log_error(LoggedError(7.0, number, type_, title, (fault.device,)))

    def _signals_of(self, device: str) -> set[str]:
        """Folded names of the signals of a device; of all in a cell without devices.

        Raises:
            RequestRefused: If the cell has devices, and none of this name.
        """
        parameters = self.owner.cell.parameters
        known = [
            one.get("Name", "")
            for of in parameters.types("EIO")
            if of.endswith("_DEVICE") or of == "EIO_UNIT"
            for one in parameters.instances("EIO", of) or ()
        ]
        if not known:
            return {one.name.lower() for one in self.owner.cell.declared}
        if device.lower() not in map(str.lower, known):
            message = f"there is no device {device}; known: {', '.join(known)}"
            raise RequestRefused(RefusalReason.VALUE, message)
        return {
            one.get("Name", "").lower()
            for one in parameters.instances("EIO", "EIO_SIGNAL") or ()
            if device.lower() in (one.get("Device", "").lower(), one.get("Unit", "").lower())
        }


Act = Callable[[LiveFaults, Fault], None]
_BEGINS: Final[Mapping[FailureKind, Act]] = MappingProxyType(
    {
        **dict.fromkeys(_STOPS, LiveFaults.open_chain),
        FailureKind.RESTART: LiveFaults.restart,
        FailureKind.FULL_DISK: LiveFaults.set_disk,
        FailureKind.ELOG: LiveFaults.log,
        FailureKind.DEVICE_LOST: LiveFaults.set_devices,
    }
)
_ENDS: Final[Mapping[FailureKind, Act]] = MappingProxyType(
    {
        **dict.fromkeys(_STOPS, LiveFaults.close_chain),
        FailureKind.FULL_DISK: LiveFaults.set_disk,
        FailureKind.DEVICE_LOST: LiveFaults.set_devices,
    }
)
"""Effects on the controller; a fault of a connection has none."""
