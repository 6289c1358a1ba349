"""Connections of clients: their number, and the time until they have logged in.

A connection belongs to its address until a request on it is admitted, then to that session. An
owner of too many loses the oldest one that serves no request, so that neither half requests nor
handshakes without end keep others out.
"""

from __future__ import annotations

import asyncio
import ssl
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Final, TypeAlias

MOST_OF_OWNER: Final = 128
"""Largest number of connections of one address before login, and of one session after it."""
HEAD_S: Final = 10.0
"""Time [s] in which the head of a request, and before it the TLS handshake, must be complete."""
LOGIN_S: Final = 30.0
"""Time [s] in which a request must have been admitted."""

ANSWER_S: Final = 0.1
"""Time [s] for an answer to be sent before its connection is closed."""

MakeProtocol: TypeAlias = Callable[[], asyncio.Protocol]
_Owner: TypeAlias = str | int
"""An address, or the number of a session."""


@dataclass(slots=True, eq=False)
class Connections:
    """All connections, in the order in which they were opened."""

    most: int = 512
    """Largest number of connections."""
    most_of_owner: int = MOST_OF_OWNER
    head_s: float = HEAD_S
    login_s: float = LOGIN_S
    refuses: Callable[[], bool] = lambda: False
    """Returns whether a new connection is reset at once."""
    _by_owner: dict[_Owner, dict[ClientConnection, None]] = field(default_factory=dict)
    _by_protocol: dict[asyncio.BaseProtocol, ClientConnection] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Leave half of the open files that the system allows for other purposes."""
        self.most = min(self.most, _open_file_limit() // 2)

    def __len__(self) -> int:
        """Number of connections."""
        return sum(map(len, self._by_owner.values()))

    def abort_all(self) -> None:
        """Close all connections, those that serve a request after their answer."""
        for connections in tuple(self._by_owner.values()):
            for connection in tuple(connections):
                connection.end_soon()

    def of(self, protocol: asyncio.BaseProtocol) -> ClientConnection:
        """Return the connection of an HTTP protocol."""
        return self._by_protocol[protocol]

    def register(self, connection: ClientConnection) -> None:
        """Add a connection to those of its owner, and close others where there are too many."""
        self._by_owner.setdefault(connection.owner, {})[connection] = None
        self._by_protocol[connection.protocol] = connection
        if len(self._by_owner[connection.owner]) > self.most_of_owner:
            self._close_one(connection.owner)
        if len(self) > self.most:
            self._close_one(max(self._by_owner, key=lambda owner: len(self._by_owner[owner])))

    def remove(self, connection: ClientConnection) -> None:
        """Remove a connection."""
        self._by_protocol.pop(connection.protocol, None)
        connections = self._by_owner.get(connection.owner, {})
        connections.pop(connection, None)
        if not connections:
            self._by_owner.pop(connection.owner, None)

    def _close_one(self, owner: _Owner) -> None:
        """Close the oldest idle connection of an owner; the newest one if all serve requests."""
        connections = list(self._by_owner[owner])
        idle = (one for one in connections if not one.is_active)
        next(idle, connections[-1]).abort()


class ClientConnection(asyncio.Protocol):
    """A connection, which passes what arrives to an HTTP protocol."""

    def __init__(
        self, connections: Connections, make: MakeProtocol, tls: ssl.SSLContext | None
    ) -> None:
        """Wait for a client."""
        self.owner: _Owner = ""
        self.address = ""
        """Address of the client."""
        self.protocol = make()
        self.is_active = False
        """Whether a request is being served."""
        self._connections = connections
        self._tls = tls
        self._transport: asyncio.Transport | None = None
        self._opening: asyncio.Task[None] | None = None
        self._timer: asyncio.TimerHandle | None = None
        self._login_by_s = 0.0

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Register; with TLS, the HTTP protocol waits for the end of the handshake."""
        assert isinstance(transport, asyncio.Transport)
        self._transport = transport
        self.owner = self.address = str((transport.get_extra_info("peername") or ("",))[0])
        loop = asyncio.get_running_loop()
        self._login_by_s = loop.time() + self._connections.login_s
        self._connections.register(self)
        self._await_head()
        if self._tls is None:
            self.protocol.connection_made(transport)
        else:
            # Nothing is read in the clear.
            transport.pause_reading()
            self._opening = loop.create_task(self._secure(transport, self._tls))

    def data_received(self, data: bytes) -> None:
        """Pass bytes on; if they begin a request, it must soon be complete."""
        if not self.is_active and self._timer is None:
            self._await_head()
        self.protocol.data_received(data)

    def eof_received(self) -> bool | None:
        """Pass the end of what the client sends on."""
        return self.protocol.eof_received()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget the connection."""
        self._stop_timer()
        self._connections.remove(self)
        self.protocol.connection_lost(exc)

    def pause_writing(self) -> None:
        """Pass on that the client reads slowly."""
        self.protocol.pause_writing()

    def resume_writing(self) -> None:
        """Pass on that the client has read."""
        self.protocol.resume_writing()

    def begin_request(self) -> None:
        """Handle a complete head."""
        self.is_active = True
        self._stop_timer()

    def end_request(self) -> None:
        """Handle the end of a request; before login, the next one must come soon."""
        self.is_active = False
        if isinstance(self.owner, str):
            self._await_head()

    def admit(self, session: int) -> None:
        """Handle a login: from now on the connection is one of its session's."""
        if self.owner != session:
            self._connections.remove(self)
            self.owner = session
            self._connections.register(self)

    def abort(self) -> None:
        """Close at once."""
        if self._transport is not None:
            self._transport.abort()

    def end_soon(self) -> None:
        """Close, if a request is being served after its answer."""
        if self.is_active:
            asyncio.get_running_loop().call_later(ANSWER_S, self.abort)
        else:
            self.abort()

    def _await_head(self) -> None:
        self._stop_timer()
        loop = asyncio.get_running_loop()
        due_s = loop.time() + self._connections.head_s
        if isinstance(self.owner, str):
            due_s = min(due_s, self._login_by_s)
        self._timer = loop.call_at(due_s, self.abort)

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    async def _secure(self, plain: asyncio.Transport, tls: ssl.SSLContext) -> None:
        loop = asyncio.get_running_loop()
        secured: asyncio.Transport | None = None
        with suppress(OSError):
            secured = await loop.start_tls(
                plain,
                self,
                tls,
                server_side=True,
                ssl_handshake_timeout=self._connections.head_s,
                ssl_shutdown_timeout=1.0,
            )
        if secured is None:
            # `connection_lost` is not called after a failed handshake.
            self._stop_timer()
            self._connections.remove(self)
        else:
            self._transport = secured
            self.protocol.connection_made(secured)


def _open_file_limit() -> int:
    """Return the number of files that the process may have open."""
    try:
        import resource  # noqa: PLC0415 - Windows has none
    except ImportError:
        return 2**16
    limit, _ = resource.getrlimit(resource.RLIMIT_NOFILE)
    return 2**16 if limit == resource.RLIM_INFINITY else limit
