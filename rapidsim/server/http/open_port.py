"""Open ports of the server.

Connections are accepted one after the other, each with its place among the `Connections` before the
next: asyncio's own server accepts a hundred at once, and a flood takes all files that the process
may have open.
"""

from __future__ import annotations

import asyncio
import logging
import signal
import socket
import ssl
import struct
from contextlib import suppress
from typing import Final, cast

from aiohttp import web

from rapidsim.server.http.connections import ClientConnection, Connections, MakeProtocol
from rapidsim.values import value_class

_LAST_S: Final = 0.2
"""Wall-clock time [s] for active requests at the end, once to finish and once more after they are
cancelled."""
_BACKLOG: Final = 128
"""Number of clients that wait to be accepted."""
_FULL_S: Final = 0.1
"""Time [s] until the next attempt when the system has no more files for the process."""
_RESET: Final = struct.pack("ii", 1, 0)
"""Option of a socket that discards what is unsent when it is closed."""
_QUIET: Final = logging.getLogger("rapidsim.requests")
"""The library would log each request that it cannot read, with a traceback."""
_QUIET.disabled = True


@value_class(frozen=True, slots=True, eq=False)
class OpenPort:
    """A port at which an application is served."""

    address: str
    """Address for clients: `http://127.0.0.1:8080`."""
    _runner: web.AppRunner
    _sockets: tuple[socket.socket, ...]
    _accepting: tuple[asyncio.Task[None], ...]

    async def close(self) -> None:
        """Close the port and all its connections."""
        for task in self._accepting:
            task.cancel()
        await asyncio.wait(self._accepting)
        for one in self._sockets:
            one.close()
        await self._runner.cleanup()


def end_signal() -> asyncio.Event:
    """Return what is set at Ctrl-C and SIGTERM."""
    over = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        # Windows has none in a loop; Ctrl-C raises KeyboardInterrupt there.
        with suppress(NotImplementedError):
            asyncio.get_running_loop().add_signal_handler(number, over.set)
    return over


async def listen(
    app: web.Application,
    connections: Connections,
    host: str,
    port: int,
    tls: ssl.SSLContext | None = None,
) -> OpenPort:
    """Serve an application at a port; 0 for a free one.

    Raises:
        OSError: If the port is taken.
    """
    sockets = await _bind(host, port)
    runner = web.AppRunner(
        app, handle_signals=False, access_log=None, shutdown_timeout=_LAST_S, logger=_QUIET
    )
    await runner.setup()
    make = cast("MakeProtocol", runner.server)
    loop = asyncio.get_running_loop()
    accepting = tuple(
        loop.create_task(_accept(listening, connections, make, tls)) for listening in sockets
    )
    scheme = "http" if tls is None else "https"
    shown = f"[{host}]" if ":" in host else host
    number = sockets[0].getsockname()[1]
    return OpenPort(f"{scheme}://{shown}:{number}", runner, sockets, accepting)


async def _bind(host: str, port: int) -> tuple[socket.socket, ...]:
    """Return a listening socket for each address of a host."""
    loop = asyncio.get_running_loop()
    sockets = dict[tuple[str, int], socket.socket]()
    try:
        for family, _, _, _, place in await loop.getaddrinfo(host, port, type=socket.SOCK_STREAM):
            address = str(place[0]), int(place[1])
            if address not in sockets:
                sockets[address] = socket.create_server(address, family=family, backlog=_BACKLOG)
                sockets[address].setblocking(False)
    except OSError:
        for one in sockets.values():
            one.close()
        raise
    return tuple(sockets.values())


async def _accept(
    listening: socket.socket,
    connections: Connections,
    make: MakeProtocol,
    tls: ssl.SSLContext | None,
) -> None:
    loop = asyncio.get_running_loop()
    while True:
        try:
            accepted, _ = await loop.sock_accept(listening)
        except OSError:
            await asyncio.sleep(_FULL_S)
            continue
        if connections.refuses():
            # Closed so, the client's connection is reset.
            accepted.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _RESET)
            accepted.close()
            continue
        try:
            with suppress(OSError):
                await loop.connect_accepted_socket(
                    lambda: ClientConnection(connections, make, tls), accepted
                )
        except BaseException:
            accepted.close()
            raise
