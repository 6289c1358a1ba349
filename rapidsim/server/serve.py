"""Serve a controller until it is ended."""

from __future__ import annotations

import asyncio
import signal
import ssl
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from aiohttp import web

from rapidsim.files import InputError
from rapidsim.server.http.app import HttpFrontend, runner_of
from rapidsim.server.http.basic import BasicAuthentication
from rapidsim.server.http.dialect import Dialect
from rapidsim.server.http.digest import DigestAuthentication
from rapidsim.server.http.guard import Guard
from rapidsim.server.http.rws1 import Rws1Dialect
from rapidsim.server.http.rws2 import Rws2Dialect
from rapidsim.server.memory import give_large_blocks_back
from rapidsim.server.messages import ConsoleLine, Notification
from rapidsim.server.process import EngineProcess
from rapidsim.server.settings import ServerSettings
from rapidsim.syntax.garbage_collection import gc_for_server


@dataclass(frozen=True, slots=True)
class Addresses:
    """Addresses that the server listens at; None for a protocol that is not served."""

    rws1: str | None
    rws2: str | None


def serve(
    engine: EngineProcess,
    settings: ServerSettings,
    is_ready: Callable[[Addresses], None],
    noted: Callable[[str], None],
) -> bool:
    """Serve a controller.

    Args:
        engine: The controller, in its process.
        settings: Addresses and users.
        is_ready: Called with the addresses once it listens at all of them.
        noted: Called with a line at each event that matters to the user.

    Returns:
        Whether it was ended by a signal; False if its engine has died.

    Raises:
        InputError: If a port is taken.
    """
    give_large_blocks_back()
    try:
        with gc_for_server():
            return asyncio.run(_serve(engine, settings, is_ready, noted))
    finally:
        engine.end()


async def _serve(
    engine: EngineProcess,
    settings: ServerSettings,
    is_ready: Callable[[Addresses], None],
    noted: Callable[[str], None],
) -> bool:
    guard = Guard(settings.host)
    face = HttpFrontend(engine, guard, noted, settings.most_sessions, settings.session_timeout_s)

    def told(notification: Notification) -> None:
        if isinstance(notification, ConsoleLine):
            noted(notification.text)
        else:
            face.notify(notification)

    engine.listener = told
    engine.attach()
    over = asyncio.Event()
    loop = asyncio.get_running_loop()
    for number in (signal.SIGINT, signal.SIGTERM):
        # Windows has none in a loop; Ctrl-C raises KeyboardInterrupt there.
        with suppress(NotImplementedError):
            loop.add_signal_handler(number, over.set)
    first = Rws1Dialect(DigestAuthentication(settings.users))
    second = Rws2Dialect(BasicAuthentication(settings.users))
    runners: list[web.AppRunner] = []
    try:
        rws1 = rws2 = None
        if settings.rws1_port is not None:
            rws1 = await _listen(runners, face, first, settings.host, settings.rws1_port)
        if settings.rws2_port is not None:
            port, tls = settings.rws2_port, settings.tls
            rws2 = await _listen(runners, face, second, settings.host, port, tls)
        is_ready(Addresses(rws1, rws2))
        waits = [asyncio.create_task(one.wait()) for one in (over, engine.ended)]
        await asyncio.wait(waits, return_when=asyncio.FIRST_COMPLETED)
        for one in waits:
            one.cancel()
        return over.is_set()
    finally:
        await asyncio.gather(*(runner.cleanup() for runner in runners))


async def _listen(
    runners: list[web.AppRunner],
    face: HttpFrontend,
    dialect: Dialect,
    host: str,
    port: int,
    tls: ssl.SSLContext | None = None,
) -> str:
    """Listen at a port for one generation and return the address.

    Raises:
        InputError: If the port is taken.
    """
    app = face.app(dialect)
    runner = runner_of(app)
    runners.append(runner)
    await runner.setup()
    try:
        await web.TCPSite(runner, host, port, ssl_context=tls).start()
    except OSError as error:
        raise InputError(
            f"{host}:{port} cannot be listened at: {error.strerror or error}",
            f"`--rws{dialect.generation}-port 0` takes a free port",
        ) from None
    scheme = "http" if tls is None else "https"
    shown = f"[{host}]" if ":" in host else host
    return f"{scheme}://{shown}:{runner.addresses[0][1]}"
