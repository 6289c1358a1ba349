"""Open ports of the server."""

from __future__ import annotations

import asyncio
import logging
import ssl
from typing import Final, cast

from aiohttp import web

from rapidsim.server.http.connections import ClientConnection, Connections, MakeProtocol
from rapidsim.values import value_class

_LAST_S: Final = 0.2
"""Wall-clock time [s] for active requests at the end, once to finish and once more after they are
cancelled."""
_QUIET: Final = logging.getLogger("rapidsim.requests")
"""The library would log each request that it cannot read, with a traceback."""
_QUIET.disabled = True


@value_class(frozen=True, slots=True, eq=False)
class OpenPort:
    """A port at which an application is served."""

    address: str
    """Address for clients: `http://127.0.0.1:8080`."""
    _runner: web.AppRunner
    _server: asyncio.Server

    async def close(self) -> None:
        """Close the port and all its connections."""
        self._server.close()
        await self._runner.cleanup()


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
    runner = web.AppRunner(
        app, handle_signals=False, access_log=None, shutdown_timeout=_LAST_S, logger=_QUIET
    )
    await runner.setup()
    make = cast("MakeProtocol", runner.server)
    try:
        server = await asyncio.get_running_loop().create_server(
            lambda: ClientConnection(connections, make, tls), host, port
        )
    except OSError:
        await runner.cleanup()
        raise
    scheme = "http" if tls is None else "https"
    shown = f"[{host}]" if ":" in host else host
    number = server.sockets[0].getsockname()[1]
    return OpenPort(f"{scheme}://{shown}:{number}", runner, server)
