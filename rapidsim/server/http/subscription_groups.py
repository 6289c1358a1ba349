"""Subscription groups: each belongs to a session, and its events go to one websocket."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from typing import Final, TypeAlias

from aiohttp import WSCloseCode, WSMsgType, web

from rapidsim.controller.cell.faults import Channel, FailureKind
from rapidsim.server.http.bodies import event_text
from rapidsim.server.http.client_faults import REQUEST_KINDS, ClientFaults
from rapidsim.server.http.dialect import Dialect
from rapidsim.server.http.event_queue import EventQueue
from rapidsim.server.messages import (
    Answer,
    ChangeEvent,
    ErrorAnswer,
    Inquiry,
    Reply,
    Subscribe,
    Unsubscribe,
)
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND

MOST_GROUPS: Final = 64
"""Largest number of subscription groups of one session."""
MOST_RESOURCES: Final = 1000
"""Largest number of resources of all groups of one session."""
_PRIORITIES: Final = {"0": 0, "1": 1, "2": 2}
_PARTING_S: Final = 1.0
"""Time [s] in which a client must confirm that its websocket is closed."""
_NO_SPEAKING: Final = b"Client cannot send data."
"""Message of a controller to a client that sends on a websocket although it must not."""

Ask: TypeAlias = Callable[[Inquiry], Awaitable[Reply]]


@dataclass(eq=False)
class _Group:
    """A subscription group and the events for its websocket."""

    number: int
    session: int
    resources: int
    waiting: EventQueue = field(default_factory=EventQueue)
    changed: asyncio.Event = field(default_factory=asyncio.Event)
    transport: asyncio.BaseTransport | None = None
    """Connection of its websocket; None before it has one."""
    is_over: bool = False

    def add(self, event: ChangeEvent) -> None:
        """Queue an event for the websocket."""
        self.waiting.add(event)
        self.changed.set()

    def break_off(self) -> None:
        """Break the connection of the websocket, if there is one.

        So do controllers when a group ends or they restart: clients that want to go on reconnect
        after that, but not after a websocket that was closed in order.
        """
        if isinstance(self.transport, asyncio.WriteTransport):
            self.transport.abort()


@dataclass(eq=False)
class SubscriptionGroups:
    """All subscription groups."""

    request_engine: Ask
    """Sends a message to the engine."""
    faults: ClientFaults = field(default_factory=ClientFaults)
    _groups: dict[int, _Group] = field(default_factory=dict)
    _last: int = 0

    def __len__(self) -> int:
        """Number of groups."""
        return len(self._groups)

    def notify(self, event: ChangeEvent) -> None:
        """Pass a change to the websocket of its group."""
        group = self._groups.get(event.group)
        if group is None:
            return
        acting = self.faults.acting(Channel.WEBSOCKET, *REQUEST_KINDS)
        if FailureKind.DROP in acting:
            group.break_off()
            return
        delay = acting.get(FailureKind.DELAY)
        for _ in range(2 if FailureKind.DUPLICATE in acting else 1):
            if delay is None:
                group.add(event)
            else:
                asyncio.get_running_loop().call_later(delay.by_s, group.add, event)

    def break_dropped(self) -> None:
        """Break the open websockets that a fault drops."""
        for group in self._groups.values():
            if group.transport is not None and FailureKind.DROP in self.faults.acting(
                Channel.WEBSOCKET, FailureKind.DROP
            ):
                group.break_off()

    async def subscribe(
        self, request: web.Request, dialect: Dialect, form: Mapping[str, str], session: int
    ) -> web.StreamResponse:
        """Answer a request for a new group."""
        # A value is a resource if its key has a priority, whatever its number.
        listed = {key: value for key, value in form.items() if f"{key}-p" in form}
        resources = tuple(listed.values())
        priorities = tuple(_PRIORITIES.get(form[f"{key}-p"], 1) for key in listed)
        others = [one for one in self._groups.values() if one.session == session]
        count = len(resources) + sum(one.resources for one in others)
        if not resources or count > MOST_RESOURCES or len(others) >= MOST_GROUPS:
            refusal = ErrorAnswer(*BAD_PARAMETER, "none, or too many, subscriptions")
            return dialect.represent(request, refusal)
        self._last += 1
        group = _Group(self._last, session, len(resources))
        self._groups[group.number] = group
        reply = await self.request_engine(Subscribe(resources, group.number, session, priorities))
        if isinstance(reply, ErrorAnswer):
            del self._groups[group.number]
            return dialect.represent(request, reply)
        return dialect.subscribed(request, group.number)

    async def unsubscribe(
        self, request: web.Request, dialect: Dialect, number: str, session: int
    ) -> web.StreamResponse:
        """Answer a request to end a group."""
        group = self._group(number, session)
        if group is None:
            return dialect.represent(request, _no_group(number))
        group.break_off()
        await self._end(group)
        return dialect.represent(request, Answer())

    async def poll(
        self, request: web.Request, dialect: Dialect, number: str, session: int
    ) -> web.StreamResponse:
        """Send the events of a group until its websocket is closed, which ends the group."""
        group = self._group(number, session)
        if group is None:
            return dialect.represent(request, _no_group(number))
        if FailureKind.REFUSE in self.faults.acting(Channel.WEBSOCKET, FailureKind.REFUSE):
            return web.Response(status=503)
        protocols = (dialect.protocol,)
        socket = web.WebSocketResponse(timeout=_PARTING_S, protocols=protocols, heartbeat=30.0)
        ready = socket.can_prepare(request)
        has_protocol = dialect.clients_may_speak or ready.protocol is not None
        if not ready.ok or not has_protocol or group.transport is not None:
            return dialect.represent(
                request, ErrorAnswer(*BAD_PARAMETER, "this address is for one websocket")
            )
        group.transport = request.transport
        sending: asyncio.Task[None] | None = None
        try:
            await socket.prepare(request)
            sending = asyncio.create_task(_send(group, socket))
            async for message in socket:
                if message.type is WSMsgType.ERROR:
                    break
                if not dialect.clients_may_speak:
                    await socket.close(code=WSCloseCode.POLICY_VIOLATION, message=_NO_SPEAKING)
        finally:
            if sending is not None:
                sending.cancel()
            await self._end(group)
        return socket

    async def end_session(self, session: int) -> None:
        """End the groups of a session."""
        for group in [one for one in self._groups.values() if one.session == session]:
            group.break_off()
            await self._end(group)

    def close(self) -> None:
        """End the websockets."""
        for group in self._groups.values():
            group.is_over = True
            group.changed.set()

    def _group(self, number: str, session: int) -> _Group | None:
        """Return a group of a session by the number in its address."""
        is_number = number.isascii() and number.isdecimal() and len(number) < 10
        group = self._groups.get(int(number)) if is_number else None
        return group if group is not None and group.session == session else None

    async def _end(self, group: _Group) -> None:
        group.is_over = True
        group.changed.set()
        if self._groups.pop(group.number, None) is not None:
            await self.request_engine(Unsubscribe(group.number))


def _no_group(number: str) -> ErrorAnswer:
    return ErrorAnswer(*NOT_FOUND, f"there is no subscription {number}")


async def _send(group: _Group, socket: web.WebSocketResponse) -> None:
    """Send the events of a subscription group in order until it ends."""
    while True:
        await group.changed.wait()
        group.changed.clear()
        while group.waiting:
            await socket.send_str(event_text(group.number, group.waiting.next()))
        if group.is_over:
            await socket.close()
            return
