"""Subscriptions of clients to changes of resources."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from itertools import zip_longest
from typing import Final

from rapidsim.server.messages import ChangeEvent, Item, RefusedRequest, Subscribe
from rapidsim.server.resources import panel, programs, questions, signals, symbols
from rapidsim.server.resources.codes import NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext
from rapidsim.server.resources.queues import message_item
from rapidsim.simulation.live import signals as live_signals
from rapidsim.simulation.live.event_log import LogEntry
from rapidsim.simulation.live.states import RequestRefused

_SIGNALS: Final = "/rw/iosystem/signals/"
_SYMBOLS: Final = "/rw/rapid/symbol/data/RAPID/"
_SYMBOLS_2: Final = "/rw/rapid/symbol/RAPID/"
"""Addresses of data in RobotWare 7, where `/data` follows the name."""
_LOG: Final = "/rw/elog/"
_QUEUES: Final = "/rw/dipc/"
_QUESTIONS: Final = "/rw/rapid/uiinstr"

Look = Callable[[], tuple[Item, ...]]


PERIODS_S: Final = (5.25, 0.4, 0.05)
"""Least time [s] between two events of data by priority, from low to high, as measured on an IRC5
with data that always change; events of states and signals have no such time."""


@dataclass(slots=True)
class _Watched:
    """A resource that a group has subscribed to."""

    resource: str
    read: Look
    """Returns the current items of the resource."""
    last: tuple[Item, ...]
    period_s: float
    due_s: float
    """Earliest time [s] of the next event."""
    is_stale: bool = False
    """Whether something has happened since it was read."""


@dataclass(slots=True)
class _Group:
    values: list[_Watched] = field(default_factory=list)
    domains: list[str] = field(default_factory=list)
    """Domains of the event log."""
    queues: list[str] = field(default_factory=list)
    """Names of queues of clients."""


@dataclass(slots=True, eq=False)
class Subscriptions:
    """All subscription groups; a listener of the cell, so that no change of a signal is missed."""

    context: RequestContext
    on_event: Callable[[ChangeEvent], None]
    is_paced: bool = True
    """Whether time passes without requests, so that an event may wait for the end of its period."""
    _groups: dict[int, _Group] = field(default_factory=dict)
    _signals: dict[str, list[tuple[int, str]]] = field(default_factory=dict)
    """By folded name of a signal: the groups that subscribe to it, and the address each used."""

    def __post_init__(self) -> None:
        """Listen to signals."""
        self.context.live.cell.listeners.append(self)

    @property
    def groups(self) -> int:
        """The number of groups."""
        return len(self._groups)

    def begin(self, subscribe: Subscribe) -> None:
        """Subscribe a session to resources; events with their current values follow first.

        Raises:
            RefusedRequest: If there is no such resource; then nothing is subscribed to.
        """
        made, heard, now_s = _Group(), [], self.context.live.now_s
        group, session = subscribe.group, subscribe.session
        for resource, priority in zip_longest(subscribe.resources, subscribe.priorities):
            if resource.startswith(_SIGNALS):
                name = resource.removeprefix(_SIGNALS).removesuffix(";state").split("/")[-1]
                self._signal_item(name, resource)
                heard.append((name.lower(), resource))
            elif resource.startswith(_LOG):
                made.domains.append(resource.removeprefix(_LOG).strip("/"))
            elif resource.startswith(_QUEUES):
                name = resource.removeprefix(_QUEUES).strip("/")
                if self.context.queue_of(name, session) is None:
                    raise refused(NOT_FOUND, f"the client has no queue {name}")
                made.queues.append(name)
            else:
                look = self._reader_of(resource)
                is_data = resource.startswith((_SYMBOLS, _SYMBOLS_2)) and self.is_paced
                period_s = PERIODS_S[2 if priority is None else priority] if is_data else 0.0
                made.values.append(_Watched(resource, look, look(), period_s, now_s + period_s))
        self._groups[group] = made
        for name, resource in heard:
            self._signals.setdefault(name, []).append((group, resource))
            self.on_event(ChangeEvent(group, resource, (self._signal_item(name, resource),)))
        for one in made.values:
            self.on_event(ChangeEvent(group, one.resource, one.last))

    def end(self, group: int) -> None:
        """End a subscription group."""
        self._groups.pop(group, None)
        for name, listening in tuple(self._signals.items()):
            kept = [one for one in listening if one[0] != group]
            if kept:
                self._signals[name] = kept
            else:
                del self._signals[name]

    @property
    def next_due_s(self) -> float:
        """Virtual time [s] of the next event for a change that waits; infinite if none does."""
        values = (watched for one in self._groups.values() for watched in one.values)
        return min((watched.due_s for watched in values if watched.is_stale), default=math.inf)

    def publish_changes(self, *, has_changed: bool) -> None:
        """Send events for all changes that are due.

        Args:
            has_changed: Whether something has happened since the last call.
        """
        now_s = self.context.live.now_s
        for group, one in self._groups.items():
            for watched in one.values:
                watched.is_stale = watched.is_stale or has_changed
                if watched.is_stale and now_s >= watched.due_s:
                    watched.is_stale = False
                    now = watched.read()
                    if now != watched.last:
                        watched.last, watched.due_s = now, now_s + watched.period_s
                        self.on_event(ChangeEvent(group, watched.resource, now))
            for name in one.queues:
                self._take(group, name)

    def _take(self, group: int, name: str) -> None:
        """Send the messages that wait for a client, which removes them."""
        queue = self.context.queues.get(name)
        while queue is not None and queue.messages:
            item = message_item(name, queue.messages.pop(0), "dipc-msg-ev")
            self.on_event(ChangeEvent(group, item.href, (item,)))

    def logged(self, entry: LogEntry) -> None:
        """Send an entry of the event log."""
        for group, one in self._groups.items():
            for domain in one.domains:
                if domain in ("0", str(entry.domain)):
                    address = f"/rw/elog/{domain}/{entry.number}"
                    fields = {"seqnum": str(entry.number)}
                    item = Item("elog-message-ev", "", fields, href=address)
                    self.on_event(ChangeEvent(group, f"{_LOG}{domain}", (item,)))

    def listens_to(self, signal: str) -> bool:
        """See `cell.SignalListener`."""
        return signal.lower() in self._signals

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """See `cell.SignalListener`."""
        del old, value, now_s
        for group, resource in self._signals.get(signal.lower(), ()):
            self.on_event(ChangeEvent(group, resource, (self._signal_item(signal, resource),)))

    def _signal_item(self, name: str, resource: str) -> Item:
        try:
            signal = live_signals.find(self.context.live, name)
        except RequestRefused:
            raise refused(NOT_FOUND, f"there is no signal {name}") from None
        shown = signals.signal_item(self.context, signal)
        fields = {key: shown.fields[key] for key in ("lvalue", "lstate")}
        return Item("ios-signalstate-ev", signal.name, fields, href=resource)

    def _reader_of(self, resource: str) -> Look:
        """Return the function that reads a resource.

        Raises:
            RefusedRequest: If it does not exist, or cannot be subscribed to.
        """
        if resource.startswith(_SYMBOLS) or (
            resource.startswith(_SYMBOLS_2) and resource.endswith("/data;value")
        ):
            return lambda: tuple(self._symbol_items(resource))
        base, _, kind = resource.partition(";")
        if (base, kind) == (_QUESTIONS, "uievent"):
            return self._question_items
        for address, suffix, event, item in _STATES:
            if base == address and kind in ("", suffix):
                href = resource if suffix == "ctrlexecstate" else address
                return lambda: (_event(item(self.context), event, suffix, href),)
        raise refused(NOT_FOUND, f"{resource} cannot be subscribed to")

    def _question_items(self) -> tuple[Item, ...]:
        found = self.context.live.pendant.questions.values()
        items = (questions.question_item(one) for one in found)
        return tuple(replace(one, kind="rap-ui-ev", title="uiinstruction") for one in items)

    def _symbol_items(self, resource: str) -> Iterator[Item]:
        address = resource.removeprefix(_SYMBOLS)
        if resource.startswith(_SYMBOLS_2):
            address = resource.removeprefix(_SYMBOLS_2).removesuffix("/data;value")
        try:
            data = symbols.value_item(self.context, address)
        except RefusedRequest:
            raise refused(NOT_FOUND, f"there are no data RAPID/{address}") from None
        # Public clients differ in which of the two they read.
        yield Item("rap-value-ev", data.title, data.fields, href=resource)
        yield replace(data, href=resource)


_STATES: Final = (
    ("/rw/panel/ctrlstate", "ctrlstate", "pnl-ctrlstate-ev", panel.state_item),
    ("/rw/panel/ctrl-state", "ctrl-state", "pnl-ctrlstate-ev", panel.state_item),
    ("/rw/panel/ctrl-state", "ctrlstate", "pnl-ctrlstate-ev", panel.state_item),
    ("/rw/panel/opmode", "opmode", "pnl-opmode-ev", panel.mode_item),
    ("/rw/panel/speedratio", "speedratio", "pnl-speedratio-ev", panel.speed_item),
    ("/rw/panel/coldetstate", "coldetstate", "pnl-coldetstate-ev", panel.collision_item),
    ("/rw/rapid/execution", "ctrlexecstate", "rap-ctrlexecstate-ev", programs.execution_item),
    ("/rw/rapid/execution", "rapidexeccycle", "rap-execcycle-ev", programs.execution_item),
)
"""States that can be subscribed to: address, attribute, class of the event, item."""


def _event(item: Item, event: str, suffix: str, href: str) -> Item:
    field_name = {"rapidexeccycle": "cycle", "ctrl-state": "ctrlstate"}.get(suffix, suffix)
    return Item(event, item.title, {field_name: item.fields[field_name]}, href=href)
